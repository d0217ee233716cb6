// Water on a pane: the formulas of flow, after Stuppacher & Supan, "Rendering of Water Drops in
// Real-Time" (2007), sections 4.2 and 4.3. docs/flow.md says how the paper's gaps are filled.
//
// A pane is a square of `size` texels, row 0 on top; x runs right, y down. Its maps have a dry
// margin of FLOW_MARGIN texels on every side, so that no pass needs to check where the pane ends;
// flow_index has the layout. Maps of several panes follow one another. Each texel holds an amount
// of water in units of height, a whole number of droplets of 2^-16 ("droplets are atomic and
// therefore the smallest amount of water", section 3). Amounts below 256 add and subtract exactly
// in a float, so that water is conserved to the last droplet, and never subnormal.
#ifndef RG_KERNELS_FLOW_WATER_WATER_H
#define RG_KERNELS_FLOW_WATER_WATER_H

#include "kernels/dialect/vec.h"

#define FLOW_DROPLETS_PER_UNIT 65536.0f
#define FLOW_DROPLET           1.52587890625e-5f
#define FLOW_REMAINDER_ENTRIES 1024  // of the remainder map, evenly spaced over the water amount
#define FLOW_MARGIN            4     // the farthest that water goes in a step
#define FLOW_EDGE_HOLDS        64.0f // up to this much, a texel takes in water that crosses an edge

#define FLOW_MAX_PANES 6
#define FLOW_NO_PANE   -1

// Words of the ledger, of all panes together: droplets that came and that left, modulo 2^32.
#define FLOW_LEDGER_SOURCED 0
#define FLOW_LEDGER_DRAINED 1
#define FLOW_LEDGER_WORDS   2
#define FLOW_STRIPS         (4 * FLOW_MARGIN) // rows and columns at the edges that water crosses

RG_STRUCT(flow_params)
{
    int size;               // texels along a side of a pane
    float move_threshold;   // L: a texel with more water gives some away
    float fast_threshold;   // M: one with more than this also reaches the texel two below,
    float third_threshold;  // with more than this the one three below,
    float fourth_threshold; // and four below
    float far_share;        // r: share of the water that goes so far and goes a texel further
    float capacity;         // most water that a texel keeps
    float remainder_scale;  // entries of the remainder map per unit of water
    int noise_size;         // texels along a side of the noise map
    float noise_step;       // noise texels per pane texel
    float noise_x, noise_y; // beginning of the window, in noise texels
    float sweep; // for texels that keep directions: the neighbours' share in a texel's own
    int blur;    // 0: the height map is lit as it is
};
RG_STRUCT_SIZE(flow_params, 14)

// The destination of water that leaves a pane over an edge.
RG_STRUCT(flow_neighbour)
{
    int pane;   // the one beyond the edge; FLOW_NO_PANE: the water is lost
    int side;   // of that pane, by which the water enters: 0 top, 1 bottom, 2 left, 3 right
    int turned; // 1: places run along that side the other way
};

// A pane of a scene.
RG_STRUCT(flow_pane)
{
    int ax, ay;        // the direction down, in whole texels (figure 8)
    int bx, by;        // a second direction, if gravity lies between two of the eight
    float b_share;     // the share of the given water that goes that way, 0 to 1
    float speed;       // equation 2: scales the given water by the cosine of alpha
    float noise_shift; // of the noise map's window, in noise texels: no two panes move alike
    flow_neighbour top, bottom, left, right;
    // Tangent (right), binormal (down) and normal (outwards) in the world.
    v3 t, b, n;
};
RG_STRUCT_SIZE(flow_pane, 28)

RG_FN float flow_whole_droplets(float amount)
{
    return rg_floor(amount * FLOW_DROPLETS_PER_UNIT) * FLOW_DROPLET;
}

// The index at which the texel at x reads the noise map: a window that scrolls and wraps (section
// 4.2.3).
RG_FN int flow_noise_index(float begin, float step, int x, int noise_size)
{
    int i = rg_to_int(begin + step * rg_to_float(x));
    i = i >= 2 * noise_size ? i - 2 * noise_size : i;
    return i >= noise_size ? i - noise_size : i;
}

// The water that a texel gives away in one step, from its water, remainder and noise: the second
// line of equation 3, scaled by the pane's inclination (equation 2). Water above the capacity
// spills whatever the maps say; else a user's map could dam it up without end.
RG_FN float flow_given(flow_params p, float speed, float water, float remainder, float noise)
{
    float given = flow_whole_droplets(water * (1.0f - remainder * noise) * speed);
    return water > p.move_threshold ? rg_max(given, water - p.capacity) : 0.0f;
}

// The parts of a texel's given water in each of two directions: to the next texel, to the one after
// it (section 4.2.3, figure 13), and, if thresholds let it, to the two beyond. The paper leaves
// these two open. All parts add up to `given` exactly.
RG_STRUCT(flow_parts)
{
    float near_a;
    float far_a;
    float third_a;
    float fourth_a;
    float near_b;
    float far_b;
    float third_b;
    float fourth_b;
};

RG_FN flow_parts flow_divide(flow_params p, flow_pane pane, float water, float given)
{
    flow_parts parts;
    float far_share = water > p.fast_threshold ? p.far_share : 0.0f;
    float third_share = water > p.third_threshold ? p.far_share : 0.0f;
    float fourth_share = water > p.fourth_threshold ? p.far_share : 0.0f;
    float b = flow_whole_droplets(given * pane.b_share);
    float a = given - b;
    float beyond_a = flow_whole_droplets(a * far_share);
    float beyond_b = flow_whole_droplets(b * far_share);
    float last_a = flow_whole_droplets(beyond_a * third_share);
    float last_b = flow_whole_droplets(beyond_b * third_share);
    parts.near_a = a - beyond_a;
    parts.near_b = b - beyond_b;
    parts.far_a = beyond_a - last_a;
    parts.far_b = beyond_b - last_b;
    parts.fourth_a = flow_whole_droplets(last_a * fourth_share);
    parts.fourth_b = flow_whole_droplets(last_b * fourth_share);
    parts.third_a = last_a - parts.fourth_a;
    parts.third_b = last_b - parts.fourth_b;
    return parts;
}

RG_FN int flow_index(int size, int x, int y)
{
    return (y + FLOW_MARGIN) * (size + 2 * FLOW_MARGIN) + (x + FLOW_MARGIN);
}

// Elements of a pane's map with its margins.
RG_FN int flow_map_length(int size)
{
    return (size + 2 * FLOW_MARGIN) * (size + 2 * FLOW_MARGIN);
}

RG_FN int flow_pane_index(int size, int pane, int x, int y)
{
    return pane * flow_map_length(size) + flow_index(size, x, y);
}

RG_FN bool flow_on_pane(int size, int x, int y)
{
    return x >= 0 && y >= 0 && x < size && y < size;
}

#endif
