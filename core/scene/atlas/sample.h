// A fingerprint of what this program traces and draws.
#ifndef RG_CORE_SCENE_ATLAS_SAMPLE_H
#define RG_CORE_SCENE_ATLAS_SAMPLE_H

#include "core/scene/atlas/atlas.h"

// A hash of a few coarse streaks and of some splashes, and of how finely the size is traced. If a
// file of the cache has another hash, another tracer made it. Takes some milliseconds. 0 where the
// atlas is not traced, or when memory is short.
uint64_t rg_atlas_sample(enum rg_atlas_size size);

#endif
