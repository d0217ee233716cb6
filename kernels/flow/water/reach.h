// flow: water comes from three and four texels above, if `reach` lets it go so far. Runs after
// flow_move, which brings the rest.
#include "kernels/flow/water/water.h"

#define RG_PARAMS flow_params
#define RG_SLOTS                                                                                   \
    IN(1, float, water) IN(2, float, given) INOUT(3, float, moved) IN(4, flow_pane, panes)
#include "kernels/dialect/slots/slots.h"

#include "kernels/flow/water/taken.h"

RG_GRID_KERNEL(flow_reach)
{
    int i = flow_pane_index(p.size, z, x, y);
    flow_pane q = panes_at(rg, z);
    float third = parts_from(rg, p, q, z, x - 3 * q.ax, y - 3 * q.ay).third_a +
                  parts_from(rg, p, q, z, x - 3 * q.bx, y - 3 * q.by).third_b;
    float fourth = parts_from(rg, p, q, z, x - 4 * q.ax, y - 4 * q.ay).fourth_a +
                   parts_from(rg, p, q, z, x - 4 * q.bx, y - 4 * q.by).fourth_b;
    moved_put(rg, i, moved_at(rg, i) + (third + fourth));
}
