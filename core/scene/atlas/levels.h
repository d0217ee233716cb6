// Mip levels of the atlas: cells shrink each by itself, and below the size of a cell whole images
// shrink.
#ifndef RG_CORE_SCENE_ATLAS_LEVELS_H
#define RG_CORE_SCENE_ATLAS_LEVELS_H

#include "core/scene/atlas/atlas.h"

// Memory for an atlas of a size, with texels 0. NULL, and one logged line, on failure.
struct rg_atlas *rg_atlas_allocate(enum rg_atlas_size size);

// The number of texels of one image, all layers and levels.
size_t rg_atlas_image_texels(const struct rg_atlas_image *image);

// Resizes a picture; each pixel is the mean of the area that it covers. Tightly packed, row 0 on
// top.
void rg_shrink(const float *from, int width, int height, float *to, int to_width, int to_height);

// Puts a cell's picture into level `level` (of the full size) of a layer of point or env. The
// picture has the cell's size there. `column` is the cell's number in its row, 0 in env.
void rg_atlas_put_cell(struct rg_atlas *atlas, enum rg_atlas_part part, int layer, int view,
                       int column, int level, const float *texels);

// The same for this level and all smaller ones down to RG_ATLAS_CELL_LEVELS, each shrunk from the
// first. False, and one logged line, when memory runs out.
bool rg_atlas_put_cell_levels(struct rg_atlas *atlas, enum rg_atlas_part part, int layer, int view,
                              int column, int level, const float *texels);

// Makes the levels of a layer from `level` (an index into the image's own) on, each from the one
// above it. False, and one logged line, when memory runs out.
bool rg_atlas_shrink_layer(struct rg_atlas_image *image, int layer, int level);

// Convert floats to half floats, rounded to the nearest, and back; values below the least normal
// half become 0, as on devices.
uint16_t rg_half_of(float value);
float rg_half_value(uint16_t half);

// Finishes an atlas after the last cell: levels below those of the cells, the splashes, the hash.
// False, and one logged line, when memory runs out.
bool rg_atlas_finish(struct rg_atlas *atlas);

// Computes atlas->hash.
bool rg_atlas_find_hash(struct rg_atlas *atlas);

#endif
