// Writes the streak atlas to files for people: every level of every layer, the factors, and sheets.
#ifndef RG_HARNESS_COMMANDS_DRAWING_ATLAS_EXPORT_H
#define RG_HARNESS_COMMANDS_DRAWING_ATLAS_EXPORT_H

#include "core/scene/atlas/atlas.h"

// Names of the parts: "point", "env", "splash".
extern const char *const rg_atlas_part_names[RG_ATLAS_PART_COUNT];

// The least and the largest factor above 0.
struct rg_atlas_range {
    double least, largest;
};
struct rg_atlas_range rg_atlas_range(const float *factors, size_t count);

// Writes into a folder, whose last part is made if missing:
//   factors.csv                 each cell's factor
//   PART-LAYER-level-LEVEL.exr  the texels, half floats as they are
//   sheet-LAYER.png             an oscillation as the thesis's figures 4.8 and 4.9 show it: point
//                               and env, each cell with a largest value of 1; then the same times
//                               its factor, four times as bright
//   splash.png                  the frames, a material in three rows
// False, and one logged line, when something cannot be written.
bool rg_atlas_export(const struct rg_atlas *atlas, const char *folder);

#endif
