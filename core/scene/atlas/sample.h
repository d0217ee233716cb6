// A fingerprint of this program's tracing and drawing.
#ifndef RG_CORE_SCENE_ATLAS_SAMPLE_H
#define RG_CORE_SCENE_ATLAS_SAMPLE_H

#include "core/scene/atlas/atlas.h"

// A hash of a few coarse streaks, some splashes, and the resolution of the size. A cached file with
// another hash comes from another tracer. Takes some milliseconds. 0 where the atlas is not traced,
// or when memory runs out.
uint64_t rg_atlas_sample(enum rg_atlas_size size);

#endif
