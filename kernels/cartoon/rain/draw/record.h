// The record of a sprite, which its fragments read (draw/sprite.h).
#ifndef RG_KERNELS_CARTOON_RAIN_DRAW_RECORD_H
#define RG_KERNELS_CARTOON_RAIN_DRAW_RECORD_H

#include "kernels/dialect/lang.h"

RG_STRUCT(cartoon_sprite)
{
    float x_px; // of its middle
    float y_px;
    float side_px;
    float along_x; // the texture's v on the screen, of unit length; its u is to the left of it
    float along_y;
    float depth;
    float alpha;
    int layer;
    int level;
    int seen;
};
RG_STRUCT_SIZE(cartoon_sprite, 10)

#endif
