// flow: how much of each texel's water slides in this run, and at which pace. A drop that slides
// over a place where the glass holds water leaves a bead there, along its axis.
#include "kernels/flow/sliding/params.h"

#define RG_PARAMS flow_slide_params
#define RG_SLOTS                                                                                   \
    IN(1, float, water)                                                                            \
    IN(2, uint, pace)                                                                              \
    IN(3, float, ridge_rows)                                                                       \
    IN(4, float, beads) IN(5, int, ways) INOUT(6, float, given) OUT(7, uint, paced)
#include "kernels/dialect/slots/slots.h"

// A pane has the beads of the first one, shifted, so that no two panes hold water at the same
// places. The map is stored twice, side by side, so that a shifted index needs no wrapping.
RG_FN float bead_of(rg_ctx rg, flow_slide_params p, int z, int x, int y)
{
    return beads_at(rg, 2 * y * p.size + x + z * (p.size / FLOW_MAX_PANES));
}

// The cell of a texel, by floats, because compilers vectorise no division of integers.
RG_FN int cell_of(flow_slide_params p, int x)
{
    return rg_to_int((rg_to_float(x) + 0.5f) / rg_to_float(p.texels_a_cell));
}

RG_FN bool stands(rg_ctx rg, int z, uint pace)
{
    int way = (z * FLOW_PACES + rg_to_int(pace)) * 2;
    return ways_at(rg, way) == 0 && ways_at(rg, way + 1) == 0;
}

// Whether the cells of `count` texels stand.
RG_FN bool all_stand(rg_ctx rg, flow_slide_params p, int x, int y, int z, int count)
{
    int row = flow_pane_index(p.cells, z, 0, cell_of(p, y));
    bool stand = true;
    for (int c = cell_of(p, x); c <= cell_of(p, x + count - 1) && stand; c++)
        stand = stands(rg, z, pace_at(rg, row + c));
    return stand;
}

// Idle: dry texels, and those of drops at rest, which give nothing.
#define RG_IDLE_ITEMS 16
RG_GRID_IDLE(flow_cling)
{
    int i = flow_pane_index(p.size, z, x, y);
    uint wet = 0u;
    uint gives = 0u;
    RG_KEPT
    for (int k = 0; k < count; k++) {
        wet = wet | rg_float_bits(water_at(rg, i + k));
        gives = gives | rg_float_bits(given_at(rg, i + k));
    }
    return gives == 0u && (wet == 0u || all_stand(rg, p, x, y, z, count));
}

RG_GRID_KERNEL(flow_cling)
{
    int i = flow_pane_index(p.size, z, x, y);
    uint pace = pace_at(rg, flow_pane_index(p.cells, z, cell_of(p, x), cell_of(p, y)));
    flow_rows r = flow_rows_of(p, z, x, y);
    float ridge = flow_mix_down(r, ridge_rows_at(rg, r.above), ridge_rows_at(rg, r.below));
    float water = water_at(rg, i);
    float held = flow_whole_droplets(bead_of(rg, p, z, x, y) * ridge);
    float given = stands(rg, z, pace) ? 0.0f : rg_max(water - held, 0.0f);
    given_put(rg, i, given);
    paced_put(rg, i, given > 0.0f ? pace : 0u);
}
