// Bins: which primitives of a draw touch which tile of the target, in order. For devices that
// rasterise in tiles; known to the host and to OpenCL C.
//
// The tiles lie over the scissor, row by row. The primitives fall into `lanes` ranges, each of
// which one work item walks; each tile has one place a lane in the array of places. First a place
// counts the lane's primitives in the tile; after the scan it says where they begin in the list;
// after the scatter, where they end, which is where those of the next place begin.
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
    int block_px; // a tile's work items shade block_px x block_px pixels each
};
RG_STRUCT_SIZE(rg_bins, 8)

// Words of what a round tells the host: pairs of a primitive and a tile, and primitives of the
// draw.
#define RG_ROUND_PAIRS 0
#define RG_ROUND_PRIMS 1
#define RG_ROUND_WORDS 2

#endif
