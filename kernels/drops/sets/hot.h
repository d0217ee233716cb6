// IDs whose water is about to merge ("hot"): a set that may contain more IDs than were put into it,
// never fewer. For kernels with the slots ids and hot.
#ifndef RG_KERNELS_DROPS_SETS_HOT_H
#define RG_KERNELS_DROPS_SETS_HOT_H

#include "kernels/drops/tiles/tiles.h"

#define DROPS_HOT_WORDS 2048

RG_FN uint hot_word(uint id)
{
    return (id >> 5) % rg_to_uint(DROPS_HOT_WORDS);
}

RG_FN uint hot_bit(uint id)
{
    return 1u << (id & 31u);
}

#endif
