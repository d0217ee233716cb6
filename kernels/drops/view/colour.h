// Colours of the pictures of drops.
#ifndef RG_KERNELS_DROPS_VIEW_COLOUR_H
#define RG_KERNELS_DROPS_VIEW_COLOUR_H

#include "kernels/dialect/image/format.h"

#define DROPS_BESIDE rg_rgba(0.02f, 0.02f, 0.02f, 1.0f) // beside the pane

// The fractional part of id * step / 2^32.
RG_FN float drops_share(uint id, uint step)
{
    return rg_to_float((id * step) >> 8) * (1.0f / 16777216.0f);
}

// A channel of a colour: squared, so that equal steps of `share` look equal.
RG_FN float drops_channel(float share)
{
    float seen = 0.1f + 0.9f * share;
    return seen * seen;
}

// An owner's colour: black for nobody. Red, green and blue go in steps of 1 / 1.2207... and its
// square and cube. These spread the points of a sequence over a cube, successive ones farthest
// apart (M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018; x^4 = x + 1).
RG_FN rgba drops_colour_of(uint id)
{
    float owned = id == 0u ? 0.0f : 1.0f;
    return rg_rgba(owned * drops_channel(drops_share(id, 3518319155u)),
                   owned * drops_channel(drops_share(id, 2882110345u)),
                   owned * drops_channel(drops_share(id, 2360945575u)), 1.0f);
}

#endif
