// The file that a result is written to before it is whole.
#ifndef RG_CORE_IMAGE_FILES_TEMPORARY_H
#define RG_CORE_IMAGE_FILES_TEMPORARY_H

#include <stdbool.h>
#include <stddef.h>

#include "core/image/files/why.h"

// Makes an empty file beside `path`, whose path becomes `temporary`. False, and `why` is set, where
// `path` cannot be written.
bool rg_temporary_make(const char *path, char *temporary, size_t size, struct rg_why *why);

// Renames it to `path` where it has been `written`, and removes it otherwise. False where `path` is
// untouched; `why` is set where it could not be renamed.
bool rg_temporary_end(const char *temporary, const char *path, bool written, struct rg_why *why);

// Makes one and removes it: whether `path` can be written is known before any work.
bool rg_temporary_try(const char *path, struct rg_why *why);

#endif
