// What the styles are told. Colours are display values, 0 to 1: their squares are light.
#ifndef RG_KERNELS_CARTOON_SCENE_SHADE_PARAMS_H
#define RG_KERNELS_CARTOON_SCENE_SHADE_PARAMS_H

#include "kernels/dialect/matrix.h"

// Floats of a material: its colour, and how much it shines, 0 to 1.
#define CARTOON_MATERIAL_WORDS 4

RG_STRUCT(cartoon_shade_params)
{
    m4 from_pixel; // pixels and depth to the world, over w
    float eye_x;
    float eye_y;
    float eye_z;
    float light_x; // towards the light, of unit length
    float light_y;
    float light_z;
    float height_px; // of the picture
    float sky_r;     // above
    float sky_g;
    float sky_b;
    float low_r; // below
    float low_g;
    float low_b;
    float blue; // of cool light, and yellow of warm light
    float yellow;
    float alpha; // the material's share of cool light
    float beta;  // and of warm light
};
RG_STRUCT_SIZE(cartoon_shade_params, 33)

#endif
