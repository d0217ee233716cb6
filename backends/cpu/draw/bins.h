// What a round of drawing leaves for its second step: primitives, and references to them by tile.
#ifndef RG_BACKENDS_CPU_DRAW_BINS_H
#define RG_BACKENDS_CPU_DRAW_BINS_H

#include "backends/cpu/draw/shapes.h"

enum { CPU_MOST_CHUNKS = 256 };

// A primitive in a tile.
struct cpu_ref {
    int prim;
    int place;     // of its mask: y << 16 | x; -1: its corners say what it covers
    uint64_t mask; // of the tile's pixels alone
};

// Targets are divided into tiles of 1 << log2_side pixels a side, row by row.
struct cpu_tiling {
    int log2_side;
    int across, down;
};

// A range of items, and the references that it left, by tile.
struct cpu_chunk {
    int begin, end; // the items that are done
    bool whole;     // all that were wanted; else there was no room for more
    int64_t pixels; // that are covered, about
};

// A thread's batch, and its chunk's references before they are sorted.
struct cpu_sorter {
    struct cpu_items items;
    struct cpu_shapes shapes;
    int count, room;
    int *tile;
    struct cpu_ref *ref;
    int *of_tile; // their number, by tile
};

// What a round leaves, in memory that grows with what runs ask for and stays with the device.
struct cpu_bins {
    struct cpu_tiling tiling;
    // Primitives, by number: their records, items, and corners where no mask serves.
    int prim_room, prim_limit, prim_count;
    size_t record_room; // in bytes
    struct cpu_records records;
    int *items;
    rg_snapped *corners;
    // References, each chunk's in one piece.
    int ref_room, ref_count;
    struct cpu_ref *refs;
    int chunk_count;
    struct cpu_chunk *chunks;
    int tile_room;
    int *firsts; // of each tile, and behind the last, the first reference of each chunk
    int sorter_count;
    struct cpu_sorter **sorters; // one a thread
    bool full;                   // the round ran out of room
    bool failed;                 // the machine ran out of memory
};

// Sees to room for a round of a run; false: there is no memory.
bool cpu_bins_prepare(struct cpu_bins *bins, const rg_draw_state *draw, size_t record_bytes,
                      int threads);
// Numbers for `count` primitives or references, the first one; -1: no room.
int cpu_bins_prims(struct cpu_bins *bins, int count);
int cpu_bins_refs(struct cpu_bins *bins, int count);
// Twice the room for references; false: no memory.
bool cpu_sorter_grow(struct cpu_sorter *sorter);
// Drops the references from number `count` on.
void cpu_sorter_drop(struct cpu_sorter *sorter, int count);
// Moves the references to the bins, a chunk's, sorted by tile; false: no room.
bool cpu_sorter_sort(struct cpu_sorter *sorter, struct cpu_bins *bins, int chunk);
void cpu_bins_destroy(struct cpu_bins *bins);

#endif
