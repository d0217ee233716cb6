// flow: water slides over the edges of each pane, on to the pane beyond, or off.
#include "kernels/flow/sliding/params.h"
#include "kernels/flow/edges/strip.h"

#define RG_PARAMS flow_slide_params
#define RG_SLOTS                                                                                   \
    IN(1, float, given)                                                                            \
    IN(2, uint, paced)                                                                             \
    IN(3, int, ways) ATOMIC(4, uint, ledger) IN(5, flow_pane, panes) ATOMIC(6, uint, arriving)
#include "kernels/dialect/slots/slots.h"

#include "kernels/flow/edges/leave.h"

RG_GRID_KERNEL(flow_slide_off)
{
    flow_texel at = flow_strip_texel(p.size, x, y);
    if (at.x < 0)
        return;
    int i = flow_pane_index(p.size, z, at.x, at.y);
    float given = given_at(rg, i);
    if (given == 0.0f)
        return;
    int way = (z * FLOW_PACES + rg_to_int(paced_at(rg, i))) * 2;
    leave(rg, p.size, panes_at(rg, z), at.x + ways_at(rg, way), at.y + ways_at(rg, way + 1), given);
}
