// Checks that a disk has room for a result before the work begins.
#ifndef RG_CORE_IMAGE_FILES_DISK_H
#define RG_CORE_IMAGE_FILES_DISK_H

#include <stdint.h>

#include "core/image/files/why.h"

// Whether the file system of the file's folder has this many bytes for this user; true where it
// does not say. False, and `why` has both numbers.
bool rg_disk_has_room(const char *path, int64_t bytes, struct rg_why *why);

#endif
