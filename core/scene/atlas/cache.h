// The atlas in the user's cache: a file for each size, in $XDG_CACHE_HOME/raingauge or
// ~/.cache/raingauge.
//
// A file holds a header, the factors and the texels, and their checksum. It is written under
// another name and renamed, so that nobody reads half a file even with several writers. It is stale
// when this program's tracing gives other values than the writer's, which a small sample shows.
#ifndef RG_CORE_SCENE_ATLAS_CACHE_H
#define RG_CORE_SCENE_ATLAS_CACHE_H

#include "core/scene/atlas/atlas.h"

enum { RG_ATLAS_PATH_SIZE = 1024 };

enum rg_atlas_cached { RG_ATLAS_SOUND, RG_ATLAS_ABSENT, RG_ATLAS_STALE, RG_ATLAS_DAMAGED };

// The path of a size's file. False, and a clause in `why`, when there is no place for it.
bool rg_atlas_cache_path(enum rg_atlas_size size, char path[RG_ATLAS_PATH_SIZE], char why[256]);

// Reads a size from the cache. NULL when it is missing, stale or damaged, as *state and a clause in
// `why` say; nothing is logged. The caller destroys it.
struct rg_atlas *rg_atlas_cache_read(enum rg_atlas_size size, enum rg_atlas_cached *state,
                                     char why[256]);

// Writes an atlas to the cache, making folders as needed. False, and a clause in `why`, when it
// cannot be written; an existing file then stays.
bool rg_atlas_cache_write(const struct rg_atlas *atlas, char why[256]);

#endif
