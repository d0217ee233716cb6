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

// A channel of a colour, as it looks: equal steps of `share` are squared to be seen as such.
RG_FN float drops_channel(float share)
{
    float seen = 0.1f + 0.9f * share;
    return seen * seen;
}

// An owner's colour: black for nobody. Red, green and blue go in steps of 1 / 1.2207... and its
// square and cube, with which points of a row lie far from each other in a cube, those that follow
// each other farthest (M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences",
// 2018; x^4 = x + 1).
RG_FN rgba drops_colour_of(uint id)
{
    float owned = id == 0u ? 0.0f : 1.0f;
    return rg_rgba(owned * drops_channel(drops_share(id, 3518319155u)),
                   owned * drops_channel(drops_share(id, 2882110345u)),
                   owned * drops_channel(drops_share(id, 2360945575u)), 1.0f);
}

#endif
