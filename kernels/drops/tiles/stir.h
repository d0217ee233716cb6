// Tells whether tiles are awake, and wakes them. For kernels with the slot tiles.
#ifndef RG_KERNELS_DROPS_TILES_STIR_H
#define RG_KERNELS_DROPS_TILES_STIR_H

#include "kernels/drops/shape.h"
#include "kernels/drops/tiles/tiles.h"

RG_FN bool is_awake(rg_ctx rg, drops_params p, int tile)
{
    return (tiles_load(rg, tile) & DROPS_AWAKE) != 0u || p.does_sleep == 0;
}

RG_FN bool is_awake_at(rg_ctx rg, drops_params p, int column, int row)
{
    return is_awake(rg, p, drops_tile_of(p, column, row));
}

// Most tiles are marked already; a load then saves the atomic.
RG_PROC void mark_tile(rg_ctx rg, int tile, uint bits)
{
    if ((tiles_load(rg, tile) & bits) != bits)
        tiles_or(rg, tile, bits);
}

// Marks the tiles that a change in a block of cells may reach in a step.
RG_PROC void mark(rg_ctx rg, drops_params p, drops_block b, uint bits)
{
    int left = rg_imax(b.left - drops_reach(p), 0) / DROPS_TILE_COLUMNS;
    int top = rg_imax(b.top - drops_reach(p), 0) / DROPS_TILE_ROWS;
    int right = rg_imin((b.right + drops_reach(p)) / DROPS_TILE_COLUMNS, p.tile_columns - 1);
    int bottom = rg_imin((b.bottom + drops_reach(p)) / DROPS_TILE_ROWS, p.tile_rows - 1);
    for (int row = top; row <= bottom; row++)
        for (int column = left; column <= right; column++)
            mark_tile(rg, row * p.tile_columns + column, bits);
}

RG_PROC void mark_row(rg_ctx rg, drops_params p, int row, int left, int right, uint bits)
{
    drops_block b;
    b.left = left;
    b.top = row;
    b.right = right;
    b.bottom = row;
    mark(rg, p, b, bits);
}

RG_PROC void mark_drop(rg_ctx rg, drops_params p, drops_drop d, uint bits)
{
    drops_block b = drops_block_around(p, d.x, d.y, d.x, d.y, drops_radius_mm(d.mass));
    if (b.left <= b.right && b.top <= b.bottom)
        mark(rg, p, b, bits);
}

// A drop's water at rest comes or goes, which changes the pane in this step.
RG_PROC void spoil(rg_ctx rg, drops_params p, drops_drop d)
{
    mark_drop(rg, p, d, DROPS_AWAKE | DROPS_STIRRED | DROPS_SPOILED);
}

#endif
