// Drops that slide (`move=sliding`): the parameters and layouts of their kernels. docs/flow.md has
// the rules.
//
// Rules that look farther than a texel use a lattice. Its cells are a little over a millimetre wide
// at any resolution, so that drops run alike at each. A lattice has the layout of a pane, with a
// margin of FLOW_MARGIN cells.
#ifndef RG_KERNELS_FLOW_SLIDING_PARAMS_H
#define RG_KERNELS_FLOW_SLIDING_PARAMS_H

#include "kernels/flow/water/water.h"

#define FLOW_PACES      8          // 0: at rest
#define FLOW_PACE_RATIO 1.4142135f // of one pace by the one before
#define FLOW_MOST_GIVEN 0.2f       // most of its water that a texel gives a neighbour as it levels

RG_STRUCT(flow_slide_params)
{
    int size;           // texels along a side of a pane
    int cells;          // of the lattice, along a side
    int texels_a_cell;  // along a side
    float side_weight;  // of a cell's neighbours when the lattice is smoothed
    float slides_above; // smoothed height above which water slides on an upright pane
    float gain_mm_s;    // speed that is added by as much water again
    float slowest_mm_s; // the first pace
    float reach2;       // square of how far a drop's middle carries water along, in cells
    float aside;        // distance from a drop's axis at which it looks for the flanks, in cells
    float levelling;    // share of a pressure difference levelled in a run, per unit of water
    float bent;         // height up to which pressure grows with its square
    float least_layer, most_layer; // heights between which water gets more mobile with height
    float advance;                 // height from which on water wets a dry neighbour
    float cohesion;                // pull of the water around, per unit of its smoothed height
    float dried2;                  // decrease of a height's square in a run
    float part;                    // of a droplet, 0 to 1, added before rounding down in this run
    float holds;                   // height above which water drips off
    float joined;         // height above which water of cells or texels side by side forms one drop
    float wet_per_height; // share of wet glass by the water's height, up to 1
    float fill;           // share of wet glass around from which a dry texel gets wet
    float tension;        // pull of the wet glass around
    float steeper;        // slope of the threshold to wet a dry texel, per share of wet glass less
    int apart;            // texels between those that tell how wet the glass is around
    float near;           // so many of them away a texel counts no more; at most 5
    float near_scale;     // 1 over the sum of their weights
    int reach;            // of this levelling, in texels
};
RG_STRUCT_SIZE(flow_slide_params, 27)

// The weight of wet glass by its distance from a texel, in steps of p.apart texels.
RG_FN float flow_near_weight(flow_slide_params p, int away)
{
    return rg_max(p.near - rg_to_float(away), 0.0f);
}

// Bilinear interpolation on the lattice: the index of the first of four cells, and the weights of
// those to the right and below.
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

// The four cells around a place, in cells; (0.5, 0.5) is the middle of the lattice's first.
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

// The index in a map of the lattice that was interpolated across (across.h). Such a map has a
// column for each of a pane's map, and a row for each of the lattice, with a margin of one.
RG_FN int flow_rows_index(flow_slide_params p, int pane, int x, int row)
{
    return (pane * (p.cells + 2) + row + 1) * (p.size + 2 * FLOW_MARGIN) + x;
}

// The indices in the two rows between which a texel's middle lies, and the weight of the lower one.
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
