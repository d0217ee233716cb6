// flow: water slides. All that a texel gives goes to one texel, as far away as its pace says, so
// that a drop keeps its shape.
#include "kernels/flow/sliding/params.h"

#define RG_PARAMS flow_slide_params
#define RG_SLOTS                                                                                   \
    IN(1, float, water)                                                                            \
    IN(2, float, given) IN(3, uint, paced) IN(4, int, ways) OUT(5, float, moved)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(flow_slide)
{
    int i = flow_pane_index(p.size, z, x, y);
    int stride = p.size + 2 * FLOW_MARGIN;
    float water = water_at(rg, i) - given_at(rg, i);
    for (int pace = 1; pace < FLOW_PACES; pace++) {
        int way = (z * FLOW_PACES + pace) * 2;
        int from = i - ways_at(rg, way + 1) * stride - ways_at(rg, way);
        water = water + (paced_at(rg, from) == rg_to_uint(pace) ? given_at(rg, from) : 0.0f);
    }
    moved_put(rg, i, water);
}
