// The parameters of flow's glow: bright.h, blur.h and glow.h.
#ifndef RG_KERNELS_FLOW_GLOW_PARAMS_H
#define RG_KERNELS_FLOW_GLOW_PARAMS_H

#include "kernels/dialect/lang.h"

#define FLOW_GLOW_REDUCTION 4  // target pixels a side of a pixel of the glow
#define FLOW_GLOW_RADIUS    12 // of the blur, in pixels of the glow

RG_STRUCT(flow_glow_params)
{
    float threshold;    // light above this glows
    float strength;     // share of it that is spread
    int step_x, step_y; // the blur's direction
    int last_x, last_y; // of the image that is read
};
RG_STRUCT_SIZE(flow_glow_params, 6)

// The part of a channel's light that is spread.
RG_FN float flow_glowing(flow_glow_params p, float light)
{
    return p.strength * rg_max(light - p.threshold, 0.0f);
}

#endif
