#include "harness/compare/gate/run/sides.h"

bool rg_side_launch(struct rg_side *side)
{
    rg_side_close(side);
    side->device = rg_devices_open_one(side->name);
    return side->device != NULL;
}

void rg_side_close(struct rg_side *side)
{
    rg_device_close(side->device);
    side->device = NULL;
}
