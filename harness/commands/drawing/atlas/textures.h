// Writes the textures that a technique generates to files for people.
#ifndef RG_HARNESS_COMMANDS_DRAWING_ATLAS_TEXTURES_H
#define RG_HARNESS_COMMANDS_DRAWING_ATLAS_TEXTURES_H

#include "core/techniques/technique.h"

// A texture: its name, size of the finest level, and number of levels.
struct rg_texture_row {
    char name[40];
    int side_px, levels;
};

enum { RG_MAX_TEXTURE_ROWS = 64 };

struct rg_texture_rows {
    int count;
    struct rg_texture_row items[RG_MAX_TEXTURE_ROWS];
};

// Makes and lists the textures of a technique that has some. Writes into `folder`, if given; its
// last part is made if missing:
//   textures.csv          the list
//   NAME.png              a texture as it looks, its colours not multiplied by alpha
//   NAME-level-LEVEL.exr  its texels as kernels sample them: premultiplied linear light, or grey
//   sheet.png             all of them
// False, and one logged line, when something cannot be made or written.
bool rg_textures_make(const struct rg_technique *technique, const char *folder,
                      struct rg_texture_rows *rows);

#endif
