// Sets of cells as trees: each cell's label is an earlier cell of its set; the first cell's label
// is itself. For kernels with the slot labels.
#ifndef RG_KERNELS_DROPS_SETS_SETS_H
#define RG_KERNELS_DROPS_SETS_SETS_H

#include "kernels/drops/params.h"

RG_FN uint first_of(rg_ctx rg, uint cell)
{
    uint at = cell;
    uint before = labels_load(rg, rg_to_int(at));
    while (before != at) {
        at = before;
        before = labels_load(rg, rg_to_int(at));
    }
    return at;
}

// Makes one set of two. Labels only ever fall, so that the sets are the same in whatever order
// items run.
RG_PROC void unite(rg_ctx rg, uint a, uint b)
{
    uint first_a = first_of(rg, a);
    uint first_b = first_of(rg, b);
    while (first_a != first_b) {
        uint low = first_a < first_b ? first_a : first_b;
        uint high = first_a < first_b ? first_b : first_a;
        uint was = labels_exchange_if(rg, rg_to_int(high), high, low);
        first_a = low;
        first_b = was == high ? low : first_of(rg, was);
    }
}

#endif
