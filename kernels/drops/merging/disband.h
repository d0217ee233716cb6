// Resets the buffers after waters have merged: no set of cells has a leader, no water is about to
// merge.
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS  IN(1, uint, joins) ATOMIC(2, uint, leaders) OUT(3, uint, hot)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/sets/hot.h"

RG_GRID_KERNEL(drops_disband)
{
    uint set = x < p.count ? joins_at(rg, x) : DROPS_NOBODY;
    if (set != DROPS_NOBODY)
        leaders_store(rg, rg_to_int(set), DROPS_NOBODY);
    if (x < DROPS_HOT_WORDS)
        hot_put(rg, x, 0u);
}
