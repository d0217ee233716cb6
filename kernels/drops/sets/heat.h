// Finds water that is about to merge. For kernels with the slots ids, and hot as IN.
#ifndef RG_KERNELS_DROPS_SETS_HEAT_H
#define RG_KERNELS_DROPS_SETS_HEAT_H

#include "kernels/drops/sets/hot.h"

RG_FN bool is_hot(rg_ctx rg, int cell)
{
    uint id = drops_owner(ids_at(rg, cell));
    return id != 0u && (hot_at(rg, rg_to_int(hot_word(id))) & hot_bit(id)) != 0u;
}

// Values of the buffer `heat` for a row of a tile: no cell is hot, some are, or all are hot and
// have one owner, as in most rows of large waters.
#define DROPS_COLD    0u
#define DROPS_HOT     1u
#define DROPS_UNIFORM 2u

RG_FN int heat_of(drops_params p, int tile_column, int row)
{
    return row * p.tile_columns + tile_column;
}

#endif
