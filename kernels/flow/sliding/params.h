// Drops that slide (`move=sliding`): what its kernels share. docs/flow.md has the rules.
//
// Rules that look farther than a texel are worked out on a lattice whose cells are a little over a
// millimetre wide whatever the resolution, so that drops run alike at each. A lattice has a margin
// of FLOW_MARGIN cells, as a pane has of texels, and the same layout.
#ifndef RG_KERNELS_FLOW_SLIDING_PARAMS_H
#define RG_KERNELS_FLOW_SLIDING_PARAMS_H

#include "kernels/flow/water/water.h"

#define FLOW_PACES      8          // 0: at rest
#define FLOW_PACE_RATIO 1.4142135f // between one pace and the next
#define FLOW_MOST_GIVEN 0.2f       // of a texel's water, to one neighbour, while it levels

RG_STRUCT(flow_slide_params)
{
    int size;           // texels along a side of a pane
    int cells;          // of the lattice, along a side
    int texels_a_cell;  // along a side
    float side_weight;  // of the cells beside one, where the lattice is smoothed
    float slides_above; // smoothed height above which water slides on an upright pane
    float gain_mm_s;    // speed that as much water again adds
    float slowest_mm_s; // the first pace
    float reach2;       // square of how far a drop's middle carries along, in cells
    float aside;        // from a drop's axis to where its flanks are looked for, in cells
    float levelling;    // share of a difference of pressure that a unit of water levels in a run
    float bent;         // height up to which pressure grows with its square
    float least_layer, most_layer; // heights between which water is the more mobile the higher
    float advance;                 // height from which on water wets a dry neighbour
    float cohesion;                // pull of the water around, a unit of its smoothed height
    float dried2;                  // by which a height's square falls
    float part;                    // of a droplet, 0 to 1, that is rounded up in this run
    float holds;                   // height above which water drips off
};
RG_STRUCT_SIZE(flow_slide_params, 18)

// A map of the lattice at the middle of a texel, bilinear: the first of four cells, and the weights
// of those to the right and below.
RG_STRUCT(flow_between)
{
    int i;
    float fx;
    float fy;
};

RG_FN int flow_lattice_stride(flow_slide_params p)
{
    return p.cells + 2 * FLOW_MARGIN;
}

// The four cells around a place in cells, (0.5, 0.5) being the middle of the first.
RG_FN flow_between flow_between_at(flow_slide_params p, int z, float u, float v)
{
    float left = rg_floor(u - 0.5f);
    float top = rg_floor(v - 0.5f);
    flow_between b;
    b.i = flow_pane_index(p.cells, z, rg_to_int(left), rg_to_int(top));
    b.fx = u - 0.5f - left;
    b.fy = v - 0.5f - top;
    return b;
}

// A map's rows of cells, mixed across, lie over the texels of a pane: as many columns as a pane's
// map has, and a row for each of the lattice with a margin of one.
RG_FN int flow_rows_index(flow_slide_params p, int pane, int x, int row)
{
    return (pane * (p.cells + 2) + row + 1) * (p.size + 2 * FLOW_MARGIN) + x;
}

// The two rows between which a texel's middle lies, and the weight of the lower one.
RG_STRUCT(flow_rows)
{
    int above;
    int below;
    float fy;
};

RG_FN flow_rows flow_rows_of(flow_slide_params p, int z, int x, int y)
{
    float v = (rg_to_float(y) + 0.5f) / rg_to_float(p.texels_a_cell);
    float top = rg_floor(v - 0.5f);
    flow_rows r;
    r.above = flow_rows_index(p, z, x, rg_to_int(top));
    r.below = r.above + p.size + 2 * FLOW_MARGIN;
    r.fy = v - 0.5f - top;
    return r;
}

RG_FN float flow_mix_down(flow_rows r, float above, float below)
{
    return above * (1.0f - r.fy) + below * r.fy;
}

RG_FN float flow_mix_across(flow_between b, float a, float right)
{
    return a * (1.0f - b.fx) + right * b.fx;
}

RG_FN float flow_mix(flow_between b, float a, float right, float below, float across)
{
    float top = flow_mix_across(b, a, right);
    float bottom = flow_mix_across(b, below, across);
    return top * (1.0f - b.fy) + bottom * b.fy;
}

#endif
