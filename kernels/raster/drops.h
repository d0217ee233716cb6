// raster: the drops' first places, uniform in the box. All x, then all y, then all z, each 0 to 1,
// so that neighbouring drops are read side by side.
#include "kernels/raster/streaks_params.h"
#include "kernels/dialect/rng.h"

#define RG_PARAMS raster_drops_params
#define RG_SLOTS  OUT(1, float, drops)
#include "kernels/dialect/slots/slots.h"

#define RASTER_DROPS_STREAM 20u

RG_GRID_KERNEL(raster_drops)
{
    rg_uint4 r = rg_random(rg_to_uint(p.seed), rg_to_uint(x), 0u, RASTER_DROPS_STREAM);
    drops_put(rg, x, rg_uniform(r.x));
    drops_put(rg, p.count + x, rg_uniform(r.y));
    drops_put(rg, 2 * p.count + x, rg_uniform(r.z));
}
