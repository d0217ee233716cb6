// Sorts packed primitives of any DRAW program into bins (kernels/dialect/draw/bins.h): rg_bins_walk
// counts, rg_bins_scan finds each place in the list, rg_bins_walk again fills the list.
#include "kernels/dialect/draw/coverage.h"
#include "kernels/dialect/draw/bins.h"

typedef struct rg_tile_box {
    int first_x;
    int first_y;
    int last_x;
    int last_y;
} rg_tile_box;

// The tiles that meet the box of a primitive's corners; if there are none, a last one is below its
// first.
static inline rg_tile_box rg_tiles_of(rg_draw_state draw, rg_snapped s)
{
    int low_x = rg_imax((rg_ileast4(s.x0, s.x1, s.x2, s.x3) + 127) >> 8, draw.x0);
    int low_y = rg_imax((rg_ileast4(s.y0, s.y1, s.y2, s.y3) + 127) >> 8, draw.y0);
    int high_x = rg_imin((rg_imost4(s.x0, s.x1, s.x2, s.x3) - 128) >> 8, draw.x1 - 1);
    int high_y = rg_imin((rg_imost4(s.y0, s.y1, s.y2, s.y3) - 128) >> 8, draw.y1 - 1);
    rg_tile_box box;
    box.first_x = (low_x - draw.x0) / RG_TILE_PX;
    box.first_y = (low_y - draw.y0) / RG_TILE_PX;
    box.last_x = high_x < low_x ? -1 : (high_x - draw.x0) / RG_TILE_PX;
    box.last_y = high_y < low_y ? -1 : (high_y - draw.y0) / RG_TILE_PX;
    return box;
}

// Counts primitive i in a place, or, with `scatter`, puts it into the list.
static inline void rg_place(__global uint *place, __global uint *list, int i, int scatter)
{
    uint at = *place;
    if (scatter)
        list[at] = (uint)i;
    *place = at + 1;
}

// Places a primitive whose box meets several tiles into those that it really touches.
static inline void rg_place_large(rg_bins bins, rg_draw_state draw, rg_snapped s, rg_tile_box box,
                                  __global uint *places, __global uint *list, int i, int scatter)
{
    rg_triangle a = rg_triangle_make(draw, s.x0, s.y0, s.x1, s.y1, s.x2, s.y2);
    rg_triangle b = rg_triangle_make(draw, s.x0, s.y0, s.x2, s.y2, s.x3, s.y3);
    for (int y = box.first_y; y <= box.last_y; y++) {
        for (int x = box.first_x; x <= box.last_x; x++) {
            int px = draw.x0 + x * RG_TILE_PX;
            int py = draw.y0 + y * RG_TILE_PX;
            if (rg_triangle_touches(a, px, py, RG_TILE_PX, RG_TILE_PX) ||
                rg_triangle_touches(b, px, py, RG_TILE_PX, RG_TILE_PX))
                rg_place(&places[(y * bins.tiles_x + x) * bins.lanes], list, i, scatter);
        }
    }
}

// Runs one work item for each lane. Without `scatter`, places that were 0 become counts. What the list
// has no room for is not scattered.
__kernel void rg_bins_walk(rg_bins bins, rg_draw_state draw, int scatter, __global const int *prims,
                           __global const uint *args, __global uint *places, __global uint *list,
                           __global const uint *round)
{
    int lane = (int)get_global_id(0);
    if (lane >= bins.lanes || (scatter && round[RG_ROUND_PAIRS] > bins.capacity))
        return;
    int prim_count = rg_imax(rg_imin(bins.end_prim, (int)args[4]) - bins.first_prim, 0);
    int begin = bins.first_prim + (int)((long)prim_count * lane / bins.lanes);
    int end = bins.first_prim + (int)((long)prim_count * (lane + 1) / bins.lanes);
    for (int i = begin; i < end; i++) {
        __global const int *c = prims + (long)i * bins.prim_words;
        rg_snapped s = {c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]};
        if (bins.corners == 3) {
            s.x3 = s.x2;
            s.y3 = s.y2;
        }
        rg_tile_box box = rg_tiles_of(draw, s);
        if (box.first_x == box.last_x && box.first_y == box.last_y)
            rg_place(&places[(box.first_y * bins.tiles_x + box.first_x) * bins.lanes + lane], list,
                     i, scatter);
        else
            rg_place_large(bins, draw, s, box, places + lane, list, i, scatter);
    }
}

// Scans in one group: sums each part, then the parts before it, then sets each place. Tells the
// number of pairs, at most 2^32 - 1.
__attribute__((reqd_work_group_size(RG_SCAN_ITEMS, 1, 1)))
__kernel void rg_bins_scan(rg_bins bins, __global const uint *args, __global uint *places,
                           __global uint *round)
{
    __local ulong sums[RG_SCAN_ITEMS];
    int item = (int)get_local_id(0);
    int count = bins.tiles * bins.lanes;
    int part = (count + RG_SCAN_ITEMS - 1) / RG_SCAN_ITEMS;
    int begin = rg_imin(item * part, count);
    int end = rg_imin(begin + part, count);
    ulong sum = 0;
    for (int i = begin; i < end; i++)
        sum += places[i];
    sums[item] = sum;
    barrier(CLK_LOCAL_MEM_FENCE);
    ulong before = 0;
    for (int k = 0; k < item; k++)
        before += sums[k];
    for (int i = begin; i < end; i++) {
        uint here = places[i];
        places[i] = (uint)before;
        before += here;
    }
    if (item == RG_SCAN_ITEMS - 1) {
        round[RG_ROUND_PAIRS] = before > 0xffffffffu ? 0xffffffffu : (uint)before;
        round[RG_ROUND_PRIMS] = args[4];
    }
}
