// The user's cache: $XDG_CACHE_HOME/raingauge, or ~/.cache/raingauge.
#ifndef RG_CORE_BASE_FILES_CACHE_H
#define RG_CORE_BASE_FILES_CACHE_H

#include <stdbool.h>
#include <stddef.h>

// The path of a name in the cache. False, and `why`, where neither variable names a folder or the
// path does not fit.
bool rg_cache_path(const char *name, char *path, size_t size, char why[256]);

// Makes the folders of a path, the last name left out. False, and `why`; where the place takes no
// folders, what is written there later says so.
bool rg_cache_make_folders(const char *path, char why[256]);

#endif
