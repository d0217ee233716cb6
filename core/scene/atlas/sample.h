// A fingerprint of this program's tracing and drawing.
#ifndef RG_CORE_SCENE_ATLAS_SAMPLE_H
#define RG_CORE_SCENE_ATLAS_SAMPLE_H

#include "core/scene/atlas/atlas.h"

// A hash of a few coarse streaks, the water of all splashes, how one is seen, and the resolution of
// the size. A cached file with another hash comes from another tracer. Takes some milliseconds.
// That of a packed atlas has splashes alone. 0 when memory runs out.
uint64_t rg_atlas_sample(enum rg_atlas_size size);

#endif
