// Keeps answers that are read a frame late by slot, because the next step lists the living anew.
// Drops without a query, which had hit or were out of sight, get CARTOON_UNASKED.
#include "kernels/cartoon/rain/params.h"

#define RG_PARAMS cartoon_rain_params
#define RG_SLOTS                                                                                   \
    IN(1, uint, living)                                                                            \
    IN(2, cartoon_raindrop, raindrops) IN(3, uint, counts) OUT(4, uint, answers)
#include "kernels/dialect/slots/slots.h"

#include "kernels/cartoon/rain/view.h"

#define CARTOON_UNASKED 0xffffffffu

RG_GRID_KERNEL(cartoon_keep)
{
    int slot = rg_to_int(living_at(rg, x));
    cartoon_raindrop d = raindrops_at(rg, slot);
    bool is_asked =
        d.state == CARTOON_DROP && cartoon_spot_of(p, v3_make(d.x, d.y, d.z)).inside != 0;
    answers_put(rg, slot, is_asked ? counts_at(rg, x) : CARTOON_UNASKED);
}
