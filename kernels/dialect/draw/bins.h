// Bins: for each tile of the target, the primitives of a draw that touch it, in order. For devices
// that rasterise in tiles; shared by the host and OpenCL C.
//
// The tiles lie over the scissor, row by row. The primitives fall into `lanes` ranges; one work
// item walks each. The array of places has one for each tile and lane. A place first counts the
// lane's primitives in the tile. After the scan it is the index at which they begin in the list;
// after the scatter, the index at which they end, and those of the next place begin.
#ifndef RG_KERNELS_DIALECT_DRAW_BINS_H
#define RG_KERNELS_DIALECT_DRAW_BINS_H

#include "kernels/dialect/lang.h"

#define RG_TILE_PX 16

// Work items of the one group that scans all places.
#define RG_SCAN_ITEMS 64

RG_STRUCT(rg_bins)
{
    int tiles_x; // tiles in a row
    int tiles;
    int lanes;
    int first_prim; // the primitives of this round: first_prim <= i < end_prim
    int end_prim;
    int prim_words; // of a packed primitive
    int corners;
    uint capacity; // pairs that the list holds
};
RG_STRUCT_SIZE(rg_bins, 8)

// Words that a round writes: pairs of a primitive and a tile, and primitives of the
// draw.
#define RG_ROUND_PAIRS 0
#define RG_ROUND_PRIMS 1
#define RG_ROUND_WORDS 2

#endif
