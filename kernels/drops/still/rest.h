// Drops at rest have maps of their own, with the water that they put back on the pane in each step.
// A tile in which drops at rest have come or gone is spoiled: it is cleared, and all drops at rest
// in it are placed anew. For kernels with the slot tiles.
#ifndef RG_KERNELS_DROPS_STILL_REST_H
#define RG_KERNELS_DROPS_STILL_REST_H

#include "kernels/drops/shape.h"
#include "kernels/drops/tiles/tiles.h"

RG_FN bool is_spoiled(rg_ctx rg, int tile)
{
    return (tiles_load(rg, tile) & DROPS_SPOILED) != 0u;
}

RG_FN drops_way at_rest(drops_params p, drops_drop d)
{
    return drops_way_of(p, d.mass, d.x, d.y, d.x, d.y);
}

// Whether any tile under a block of cells is spoiled.
RG_FN bool is_any_spoiled(rg_ctx rg, drops_params p, drops_block b)
{
    bool is_any = false;
    for (int row = b.top / DROPS_TILE_ROWS; row <= b.bottom / DROPS_TILE_ROWS; row++)
        for (int column = b.left / DROPS_TILE_COLUMNS; column <= b.right / DROPS_TILE_COLUMNS;
             column++)
            is_any = is_any || is_spoiled(rg, row * p.tile_columns + column);
    return is_any;
}

// The height to put into a cell for a drop at rest; 0: none, or the tile is not spoiled.
RG_FN float height_of(rg_ctx rg, drops_params p, drops_way w, int column, int row)
{
    float h = drops_height(p, w, 0, column, row);
    return h > 0.0f && is_spoiled(rg, drops_tile_of(p, column, row)) ? h : 0.0f;
}

#endif
