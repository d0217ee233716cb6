// flow: a drop lands on the pane, as a cap of water whose profile is a half ellipse (figure 5).
// Each drop is a run over the texels that it covers.
#include "kernels/flow/water/water.h"
#include "kernels/flow/water/splat_params.h"

#define RG_PARAMS flow_splat_params
#define RG_SLOTS  INOUT(1, float, water) ATOMIC(2, uint, ledger)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(flow_splat)
{
    float dx = (rg_to_float(x) + 0.5f - p.centre_x) / p.radius_px;
    float dy = (rg_to_float(y) + 0.5f - p.centre_y) / p.radius_px;
    float inside = 1.0f - (dx * dx + dy * dy);
    float cap = p.height * rg_sqrt(rg_max(inside, 0.0f));
    int i = flow_pane_index(p.size, p.pane, x, y);
    float before = water_at(rg, i);
    float added = flow_whole_droplets(rg_max(rg_min(cap, p.capacity - before), 0.0f));
    if (added > 0.0f) {
        water_put(rg, i, before + added);
        ledger_add(rg, FLOW_LEDGER_SOURCED, rg_to_uint(added * FLOW_DROPLETS_PER_UNIT));
    }
}
