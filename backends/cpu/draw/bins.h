// The data that a round of drawing passes to its second step: primitives, and references to them by
// tile.
#ifndef RG_BACKENDS_CPU_DRAW_BINS_H
#define RG_BACKENDS_CPU_DRAW_BINS_H

#include "backends/cpu/draw/shapes.h"

enum { CPU_MOST_CHUNKS = 256 };

// A primitive in a tile.
enum { CPU_PLAIN = 1 << 30 };
struct cpu_ref {
    int prim;      // its number, and CPU_PLAIN if its record is plain
    int place;     // of its mask: y << 16 | x; -1: no mask, the corners decide
    uint64_t mask; // pixels within the tile only
};

// A target is divided into tiles of 1 << log2_width by 1 << log2_height pixels, row by row.
struct cpu_tiling {
    int log2_width, log2_height;
    int across, down;
};

// A range of items, and its references by tile.
struct cpu_chunk {
    int begin, end; // the items that were processed
    bool whole;     // all wanted items; false when the room was full
    int64_t pixels; // approximate number of covered pixels
};

// A thread's batch of items, and its chunk's references before sorting.
struct cpu_sorter {
    struct cpu_items items;
    struct cpu_shapes shapes;
    int count, room;
    int *tile;
    struct cpu_ref *ref;
    int *of_tile; // number of references by tile
};

// The data of a round, in memory that grows on demand and stays with the device.
struct cpu_bins {
    struct cpu_tiling tiling;
    // Primitives by number: records, items, and corners if there is no mask.
    int prim_room, prim_limit, prim_count;
    size_t record_room; // in bytes
    struct cpu_records records;
    int *items;
    rg_snapped *corners;
    // References, contiguous for each chunk.
    int ref_room, ref_count;
    struct cpu_ref *refs;
    int chunk_count;
    struct cpu_chunk *chunks;
    int tile_room;
    int *firsts; // index of the first reference, by tile (and one more) and chunk
    int sorter_count;
    struct cpu_sorter **sorters; // one for each thread
    bool full;                   // the round's memory is full
    bool failed;                 // memory ran out
};

// Allocates memory for a round of a run; false when memory runs out.
bool cpu_bins_prepare(struct cpu_bins *bins, const rg_draw_state *draw, size_t record_bytes,
                      int threads);
// Allocate `count` primitives or references, and return the first number; -1: full.
int cpu_bins_prims(struct cpu_bins *bins, int count);
int cpu_bins_refs(struct cpu_bins *bins, int count);
// Doubles the memory for references; false when memory runs out.
bool cpu_sorter_grow(struct cpu_sorter *sorter);
// Drops the references from index `count` on.
void cpu_sorter_drop(struct cpu_sorter *sorter, int count);
// Moves a chunk's references to the bins, sorted by tile; false: full.
bool cpu_sorter_sort(struct cpu_sorter *sorter, struct cpu_bins *bins, int chunk);
void cpu_bins_destroy(struct cpu_bins *bins);

#endif
