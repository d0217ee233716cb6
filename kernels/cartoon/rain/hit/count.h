// Counts the visible samples of each living drop: one query for each that has not hit and is in the
// viewing frustum. The others get 0, without a query.
#include "kernels/cartoon/rain/params.h"

#define RG_PARAMS cartoon_rain_params
#define RG_SLOTS                                                                                   \
    IN(1, uint, living)                                                                            \
    IN(2, cartoon_raindrop, raindrops) IMAGE(3, D32F, depth_map) OUT(4, uint, counts)
#include "kernels/dialect/slots/slots.h"

#include "kernels/cartoon/rain/hit/samples.h"

RG_GRID_KERNEL(cartoon_count)
{
    cartoon_raindrop d = raindrops_at(rg, rg_to_int(living_at(rg, x)));
    cartoon_spot s = cartoon_spot_of(p, v3_make(d.x, d.y, d.z));
    bool is_asked = d.state == CARTOON_DROP && s.inside != 0;
    int count = 0;
    if (is_asked)
        count = cartoon_samples(rg, p, s);
    counts_put(rg, x, rg_to_uint(count));
}
