// Endless pictures of the streak atlas, for repeating streaks.
#ifndef RG_CORE_TECHNIQUES_STREAKS_FAR_JOIN_H
#define RG_CORE_TECHNIQUES_STREAKS_FAR_JOIN_H

#include "core/scene/atlas/atlas.h"

// A level of a layer, with the pictures of all views made endless. NULL, and one logged line, when
// memory runs out. The caller frees it.
uint16_t *streaks_joined(const struct rg_atlas *atlas, enum rg_atlas_part part, int layer, int own);

#endif
