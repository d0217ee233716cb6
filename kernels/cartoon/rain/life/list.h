// Fills the lists: each slot is in the free list or in the living one.
#include "kernels/cartoon/rain/params.h"

#define RG_PARAMS cartoon_rain_params
#define RG_SLOTS  IN(1, uint, flags) IN(2, uint, before) OUT(3, uint, unused) OUT(4, uint, living)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(cartoon_list)
{
    bool is_drop = x < p.drop_slots;
    int first = is_drop ? 0 : p.drop_slots;
    int free_before = rg_to_int(before_at(rg, x) - (is_drop ? 0u : before_at(rg, p.drop_slots)));
    uint slot = rg_to_uint(x - first);
    if (flags_at(rg, x) != 0u)
        unused_put(rg, first + free_before, slot);
    else
        living_put(rg, x - free_before, slot);
}
