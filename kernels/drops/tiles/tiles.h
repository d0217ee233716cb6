// Items of stages over tiles: x is a column of tiles, y a row of cells. An item loops over the 32
// cells of its tile's row, several at once where compilers for processors vectorise.
#ifndef RG_KERNELS_DROPS_TILES_TILES_H
#define RG_KERNELS_DROPS_TILES_TILES_H

#include "kernels/drops/params.h"

RG_FN int drops_tile_of(drops_params p, int column, int row)
{
    return row / DROPS_TILE_ROWS * p.tile_columns + column / DROPS_TILE_COLUMNS;
}

// Processors give each thread a range of y. Even rows of tiles come first, so that a thread gets
// both dry rows, above, and wet ones, below.
RG_FN int drops_row_of(drops_params p, int y)
{
    int tile_row = y / DROPS_TILE_ROWS;
    int even = (p.tile_rows + 1) / 2;
    int taken = tile_row < even ? 2 * tile_row : 2 * (tile_row - even) + 1;
    return taken * DROPS_TILE_ROWS + y % DROPS_TILE_ROWS;
}

// The first cell of a row of a tile.
RG_FN int drops_first_in(drops_params p, int tile_column, int row)
{
    return drops_cell(p, tile_column * DROPS_TILE_COLUMNS, row);
}

#endif
