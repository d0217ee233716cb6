// The parameters of the styles. Colours are display values, 0 to 1: their squares are light.
#ifndef RG_KERNELS_CARTOON_SCENE_SHADE_PARAMS_H
#define RG_KERNELS_CARTOON_SCENE_SHADE_PARAMS_H

#include "kernels/dialect/matrix.h"

// Tones of hatching with strokes, the darkest first; the one after them, 6, is blank paper. The
// channels of two layers of strokes hold tones 0 to 3 and 3 to 6.
#define CARTOON_TONES 6

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
    int inked;   // 1: there is ink, 0: its one texel has none
    float ink_r; // its colour
    float ink_g;
    float ink_b;
    float paper_r;
    float paper_g;
    float paper_b;
    // Gooch.
    float blue; // of cool light, and yellow of warm light
    float yellow;
    float alpha; // the material's share of cool light
    float beta;  // and of warm light
    // Cartoon.
    float shadow_tone; // factor of the material's colour
    float middle_tone;
    float middle_from; // the cosine from which on a tone begins
    float lit_from;
    float per_softness; // 1 over the width of the step between tones, as cosine
    float glint_from;   // a highlight's edge, as a share of its brightest place
    float shadow_blue;  // blue light that the darkest shadow gets
    // Hatching.
    float ambient;  // tone of what faces away from the light
    float lit;      // and of what faces it
    float wash;     // the material's share
    float per_tile; // tiles of strokes a metre
    float lod;      // level of the strokes at a distance of 1 m: log2 of their texels per pixel
};
RG_STRUCT_SIZE(cartoon_shade_params, 52)

#endif
