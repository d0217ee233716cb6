// Reads the database's pictures.
#ifndef RG_CORE_SCENE_ATLAS_CAVE_PICTURE_H
#define RG_CORE_SCENE_ATLAS_CAVE_PICTURE_H

#include "core/scene/atlas/cave/factors.h"

// Reads a picture, whose values are codes over the largest code, and resizes it to width x height
// texels; `is_mirrored`: left and right are exchanged. False, and a sentence in `why`, when it is
// missing or invalid.
bool rg_cave_read_picture(const char *path, int width, int height, bool is_mirrored, float *texels,
                          struct rg_cave_why *why);

// The width in a picture's header; 0 if the file is no picture.
int rg_cave_picture_width(const char *path);
// Reads a picture of a view, whatever its width, and resizes it to `level`, or, if the picture is
// coarser, to the picture's own level, which `level` then becomes.
bool rg_cave_read_any(const char *path, int view, int *level, float *texels,
                      struct rg_cave_why *why);

// The light of the left half minus that of the right half, over their sum: -1 to 1; 0 for a dark
// picture.
float rg_cave_leaning(const float *texels, int width, int height);

#endif
