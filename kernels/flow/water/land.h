// flow: drops of a known volume land. A run over the texels that they cover, none of them twice:
// the index of each, and the droplets that it gets.
#include "kernels/flow/water/water.h"

#define RG_PARAMS flow_params
#define RG_SLOTS  IN(1, uint, landing) INOUT(2, float, water) ATOMIC(3, uint, ledger)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(flow_land)
{
    int i = rg_to_int(landing_at(rg, 2 * x));
    uint droplets = landing_at(rg, 2 * x + 1);
    if (droplets == 0u)
        return;
    water_put(rg, i, water_at(rg, i) + rg_to_float(droplets) * FLOW_DROPLET);
    ledger_add(rg, FLOW_LEDGER_SOURCED, droplets);
}
