// The database's pictures.
#ifndef RG_CORE_SCENE_ATLAS_CAVE_PICTURE_H
#define RG_CORE_SCENE_ATLAS_CAVE_PICTURE_H

#include "core/scene/atlas/cave/factors.h"

// Reads a picture, whose values are codes over the largest code, and brings it to width x height
// texels; `is_mirrored`: left and right change places. False, and a sentence in `why`, when it is
// not there or is not what it should be.
bool rg_cave_read_picture(const char *path, int width, int height, bool is_mirrored, float *texels,
                          struct rg_cave_why *why);

// How wide a picture says that it is; 0 of what is none.
int rg_cave_picture_width(const char *path);
// Reads a picture of a view, whatever its width, and brings it to the size of a level: `level`, or
// the picture's own, which `level` becomes, where that is coarser.
bool rg_cave_read_any(const char *path, int view, int *level, float *texels,
                      struct rg_cave_why *why);

// The light of its left half less that of its right half, over both: -1 to 1; 0 of a dark one.
float rg_cave_leaning(const float *texels, int width, int height);

#endif
