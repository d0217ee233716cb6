// Colours of the pictures of drops.
#ifndef RG_KERNELS_DROPS_VIEW_COLOUR_H
#define RG_KERNELS_DROPS_VIEW_COLOUR_H

#include "kernels/dialect/image/format.h"

#define DROPS_BESIDE rg_rgba(0.02f, 0.02f, 0.02f, 1.0f) // beside the pane

// The part behind the point of `id` times a number of 2^-32.
RG_FN float drops_share(uint id, uint step)
{
    return rg_to_float((id * step) >> 8) * (1.0f / 16777216.0f);
}

// A channel of a hue of 0 to 1 at full strength: 0 to 1. `from` is 0 red, 2 green, 1 blue, in
// thirds.
RG_FN float drops_hue_channel(float hue, float from)
{
    float turned = hue + from * 0.33333334f;
    float around = 6.0f * (turned - rg_floor(turned));
    return rg_clamp(rg_abs(around - 3.0f) - 1.0f, 0.0f, 1.0f);
}

// An owner's colour: black for nobody. Hue, saturation and brightness go in steps of the powers of
// 1 / 1.2207..., with which points of a row lie far from each other in a cube (the plastic number
// of three dimensions, x^4 = x + 1; M. Roberts, "The Unreasonable Effectiveness of Quasirandom
// Sequences", 2018). So the colours of drops that came about one after the other differ most.
RG_FN rgba drops_colour_of(uint id)
{
    float hue = drops_share(id, 3518319155u);
    float white = 0.55f * drops_share(id, 2882110345u);
    float bright = 0.12f + 0.88f * drops_share(id, 2360945575u);
    float is_owned = id == 0u ? 0.0f : bright;
    return rg_rgba(is_owned * (white + (1.0f - white) * drops_hue_channel(hue, 0.0f)),
                   is_owned * (white + (1.0f - white) * drops_hue_channel(hue, 2.0f)),
                   is_owned * (white + (1.0f - white) * drops_hue_channel(hue, 1.0f)), 1.0f);
}

#endif
