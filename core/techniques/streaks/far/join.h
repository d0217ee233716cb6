// Pictures of the streak atlas without ends, as streaks repeat them.
#ifndef RG_CORE_TECHNIQUES_STREAKS_FAR_JOIN_H
#define RG_CORE_TECHNIQUES_STREAKS_FAR_JOIN_H

#include "core/scene/atlas/atlas.h"

// A level of a layer, the pictures of all its views joined. NULL, and one logged line, without
// memory. The caller frees it.
uint16_t *streaks_joined(const struct rg_atlas *atlas, enum rg_atlas_part part, int layer, int own);

#endif
