// flow: what of each texel's water slides in this run, and at which pace. Where the glass holds
// water, a drop that slides on leaves a bead behind, along its axis.
#include "kernels/flow/sliding/params.h"

#define RG_PARAMS flow_slide_params
#define RG_SLOTS                                                                                   \
    IN(1, float, water)                                                                            \
    IN(2, uint, pace)                                                                              \
    IN(3, float, ridge)                                                                            \
    IN(4, float, beads) IN(5, int, ways) OUT(6, float, given) OUT(7, uint, paced)
#include "kernels/dialect/slots/slots.h"

// The beads of a pane are those of the first, shifted: no two panes hold water at the same places.
RG_FN float bead_of(rg_ctx rg, flow_slide_params p, int z, int x, int y)
{
    int shifted = x + z * (p.size / FLOW_MAX_PANES);
    return beads_at(rg, y * p.size + (shifted >= p.size ? shifted - p.size : shifted));
}

RG_GRID_KERNEL(flow_cling)
{
    int i = flow_pane_index(p.size, z, x, y);
    int k = p.texels_a_cell;
    uint pace = pace_at(rg, flow_pane_index(p.cells, z, x / k, y / k));
    int way = (z * FLOW_PACES + rg_to_int(pace)) * 2;
    bool stands = ways_at(rg, way) == 0 && ways_at(rg, way + 1) == 0;
    flow_between b = flow_between_of(p, z, x, y);
    int below = b.i + flow_lattice_stride(p);
    float ridge = flow_mix(b, ridge_at(rg, b.i), ridge_at(rg, b.i + 1), ridge_at(rg, below),
                           ridge_at(rg, below + 1));
    float water = water_at(rg, i);
    float held = flow_whole_droplets(bead_of(rg, p, z, x, y) * ridge);
    float given = stands ? 0.0f : rg_max(water - held, 0.0f);
    given_put(rg, i, given);
    paced_put(rg, i, pace);
}
