// What of cpu's drawing depends on the program: its stages, and what passes between them and the
// rest. A program includes nothing else of it.
#ifndef RG_BACKENDS_CPU_DRAW_PROGRAM_H
#define RG_BACKENDS_CPU_DRAW_PROGRAM_H

#include <stddef.h>

#include "backends/cpu/kernels/call.h"
#include "kernels/dialect/draw/clip.h"

enum {
    CPU_LANES = 16,                     // what loops handle side by side
    CPU_BATCH = 256,                    // items
    CPU_PARTS = 64,                     // room for what clipped items of a batch fall into
    CPU_PLACES = CPU_BATCH + CPU_PARTS, // a multiple of CPU_LANES
    CPU_MOST_PARTS = RG_MOST_PRIMS(3),  // of one item
    CPU_FRAGMENTS = 256,                // a list of pixels holds
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

// The records of primitives, by number: those of their items; behind the room for these, those of
// their first light, and so on for each light. So what a loop gathers lies a constant apart.
struct cpu_records {
    char *of_items;
    int room; // primitives
};

// The stages of a DRAW program. All get the call, whose parameters are its rg_draw_call.
struct cpu_program {
    int corners;        // RG_CORNERS
    size_t record_size; // of an item, in bytes
    size_t light_size;  // of the record of an item and light; 0: there is none

    // The items from `begin` on: fate and corners.
    void (*items)(const struct cpu_call *call, int begin, int count, struct cpu_items *items);
    // The parts that an item falls into where it is clipped; returns their number.
    int (*clip)(const struct cpu_call *call, int item, rg_snapped parts[CPU_MOST_PARTS]);
    // The records of some items, from primitive `first` on.
    void (*records)(const struct cpu_call *call, const int *items, int count,
                    struct cpu_records records, int first);
    // The fragments of a list, whose pixels go on to a multiple of CPU_LANES, and of `count` pixels
    // from (x, y) on.
    void (*list)(const struct cpu_call *call, struct cpu_records records,
                 const struct cpu_list *list, struct cpu_fragments *fragments);
    void (*row)(const struct cpu_call *call, struct cpu_records records, int prim, int x, int y,
                int count, struct cpu_fragments *fragments);
    // Of programs with lights, else NULL: how many there are; and the same as `list` and `row`, but
    // depth and `kept` alone.
    int (*lights)(const struct cpu_call *call);
    void (*list_depth)(const struct cpu_call *call, struct cpu_records records,
                       const struct cpu_list *list, struct cpu_fragments *fragments);
    void (*row_depth)(const struct cpu_call *call, struct cpu_records records, int prim, int x,
                      int y, int count, struct cpu_fragments *fragments);
};

#endif
