// How cpu draws, apart from cpu:reference, whose plain loops are in draw/reference_tmpl.h.
//
// A run goes in rounds of two steps, each on all cores:
//   1. Items, in chunks (draw/emit.c): a batch of items becomes snapped corners; those that cover
//      pixels become primitives, which have a number, a record and, for every tile of the target
//      that they touch, a reference. A chunk sorts its references by tile.
//   2. Tiles (draw/shade_tmpl.h): each walks the chunks in order, so that primitives meet a pixel
//      in the order of their items, whoever made them. Different pixels of many primitives are
//      listed, and their fragments computed, tested and blended side by side.
// A round ends where the room for primitives or references does (draw/bins.c).
//
// What depends on the program are five loops, and two more with lights (draw/stages_tmpl.h),
// compiled once a program and level. What does not, but is worth vectors, is in draw/raster.c,
// compiled once a level.
#ifndef RG_BACKENDS_CPU_DRAW_H
#define RG_BACKENDS_CPU_DRAW_H

#include <stddef.h>

#include "backends/cpu/call.h"
#include "kernels/dialect/draw/clip.h"

enum {
    CPU_LANES = 16,                     // what loops handle side by side
    CPU_BATCH = 256,                    // items
    CPU_PARTS = 64,                     // room for what clipped items of a batch fall into
    CPU_PLACES = CPU_BATCH + CPU_PARTS, // a multiple of CPU_LANES
    CPU_MOST_PARTS = RG_MOST_PRIMS(3),  // of one item
    CPU_FRAGMENTS = 256,                // a list of pixels holds
    CPU_BLOCK_PX = 64,                  // side of the block of pixels that spans are made for
    CPU_MASKS = 4,                      // of a shape
    CPU_MOST_CHUNKS = 256,
};

static inline int cpu_padded(int count)
{
    return (count + CPU_LANES - 1) & -CPU_LANES;
}

// Corners of a batch's items, each at its place; behind them those of clipped parts.
struct cpu_items {
    int fate[CPU_BATCH];
    int x[4][CPU_PLACES], y[4][CPU_PLACES];
};

// What covers pixels, perhaps: where its corners are, and which pixels it covers.
enum cpu_cover { CPU_COVERS_NONE, CPU_COVERS_MASK, CPU_COVERS_MORE };
struct cpu_shapes {
    int count;
    int place[CPU_PLACES]; // in cpu_items
    int item[CPU_PLACES];
    int cover[CPU_PLACES]; // enum cpu_cover
    // Where the pixels begin, and masks of eight by eight from there on, one below the other.
    // Bit 8 y + x.
    int x[CPU_PLACES], y[CPU_PLACES];
    int masks[CPU_PLACES];
    uint64_t mask[CPU_MASKS][CPU_PLACES];
};

// Pixels of several primitives, all different.
struct cpu_list {
    int count;
    int at[CPU_FRAGMENTS]; // y << 16 | x
    int prim[CPU_FRAGMENTS];
};

// Their fragments, or those of neighbouring pixels of one primitive.
struct cpu_fragments {
    int count;
    float r[CPU_FRAGMENTS], g[CPU_FRAGMENTS], b[CPU_FRAGMENTS], a[CPU_FRAGMENTS];
    float depth[CPU_FRAGMENTS];
    int kept[CPU_FRAGMENTS];
};

// The stages of a DRAW program. All get the call, whose parameters are its rg_draw_call.
struct cpu_program {
    int corners;        // RG_CORNERS
    size_t record_size; // in bytes

    // The items from `begin` on: fate and corners.
    void (*items)(const struct cpu_call *call, int begin, int count, struct cpu_items *items);
    // The parts that an item falls into where it is clipped; returns their number.
    int (*clip)(const struct cpu_call *call, int item, rg_snapped parts[CPU_MOST_PARTS]);
    // The records of some items.
    void (*records)(const struct cpu_call *call, const int *items, int count, void *records);
    // The fragments of a list, whose pixels go on to a multiple of CPU_LANES, and of `count` pixels
    // from (x, y) on.
    void (*list)(const struct cpu_call *call, const void *records, const struct cpu_list *list,
                 struct cpu_fragments *fragments);
    void (*row)(const struct cpu_call *call, const void *record, int x, int y, int count,
                struct cpu_fragments *fragments);
    // Of programs with lights, else NULL: how many there are; and the same as `list` and `row`, but
    // depth and `kept` alone.
    int (*lights)(const struct cpu_call *call);
    void (*list_depth)(const struct cpu_call *call, const void *records,
                       const struct cpu_list *list, struct cpu_fragments *fragments);
    void (*row_depth)(const struct cpu_call *call, const void *record, int x, int y, int count,
                      struct cpu_fragments *fragments);
};

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
    size_t record_room, record_size; // in bytes
    char *records;
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

// What drawing shares among programs, of one level.
struct cpu_raster {
    // Says of each shape what it covers. Shapes of three corners have their last one twice.
    void (*cover)(const rg_draw_state *draw, const struct cpu_items *items,
                  struct cpu_shapes *shapes);
    // Draws a tile.
    void (*shade)(const struct cpu_program *program, const struct cpu_call *call,
                  const struct cpu_bins *bins, int tile);
};

struct cpu_device;

// draw.c: a run of a program. False, and one logged line, where memory is missing.
bool cpu_draw(struct cpu_device *device, const char *name, const struct cpu_program *program,
              const struct cpu_call *call);

// draw/emit.c: what one thread does of a round's first step, a chunk.
struct cpu_emitter {
    const struct cpu_program *program;
    const struct cpu_raster *raster;
    const struct cpu_call *call;
    const rg_draw_state *draw;
    struct cpu_bins *bins;
    struct cpu_sorter *sorter;
};
void cpu_emit(const struct cpu_emitter *emitter, int chunk, int end);

// draw/bins.c: the memory behind it. Sees to room for a round of a run; false: there is no memory.
bool cpu_bins_prepare(struct cpu_bins *bins, const rg_draw_state *draw, size_t record_size,
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
