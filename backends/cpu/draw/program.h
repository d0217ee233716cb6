// The interface between cpu's drawing and a program: its stages, and their data. Programs include
// nothing else of the drawing code.
#ifndef RG_BACKENDS_CPU_DRAW_PROGRAM_H
#define RG_BACKENDS_CPU_DRAW_PROGRAM_H

#include <stddef.h>

#include "backends/cpu/kernels/call.h"
#include "kernels/dialect/draw/clip.h"

enum {
    CPU_LANES = 16,                     // elements processed together by loops
    CPU_BATCH = 256,                    // items in a batch
    CPU_PARTS = 64,                     // room for the parts of a batch's clipped items
    CPU_PLACES = CPU_BATCH + CPU_PARTS, // a multiple of CPU_LANES
    CPU_MOST_PARTS = RG_MOST_PRIMS(3),  // parts of one item
    CPU_FRAGMENTS = 256,                // pixels in a list
    CPU_MOST_WORDS = 64,                // of a record, with that of its first light
};

static inline int cpu_padded(int count)
{
    return (count + CPU_LANES - 1) & -CPU_LANES;
}

// A batch: items, their corners, and after these those of clipped parts.
struct cpu_items {
    int count;
    int item[CPU_BATCH];
    int fate[CPU_BATCH];
    int x[4][CPU_PLACES], y[4][CPU_PLACES];
};

// Pixels of several primitives, all different.
struct cpu_list {
    int count;
    int at[CPU_FRAGMENTS]; // y << 16 | x
    int prim[CPU_FRAGMENTS];
};

// The words of a list's records, by pixel: a column for each word of the item's record, then those
// of the first light's. The last lanes are room for whole vectors.
struct cpu_columns {
    uint words[CPU_MOST_WORDS][CPU_FRAGMENTS + CPU_LANES];
};

// The fragments of a list, or of neighbouring pixels of one primitive.
struct cpu_fragments {
    int count;
    float r[CPU_FRAGMENTS], g[CPU_FRAGMENTS], b[CPU_FRAGMENTS], a[CPU_FRAGMENTS];
    float depth[CPU_FRAGMENTS];
    int kept[CPU_FRAGMENTS];
};

// The records of primitives, by number: those of items, then, after all room for these, those of
// the first light, and so on. So the records that a loop gathers are a constant distance apart.
struct cpu_records {
    char *of_items;
    int room; // primitives
};

// The stages of a DRAW program. Each gets the call, whose parameters are its rg_draw_call.
struct cpu_program {
    int corners;        // RG_CORNERS
    size_t record_size; // of an item, in bytes
    size_t light_size;  // of the record of an item and a light; 0: none
    bool has_columns;   // `list` and `plain_list` need them

    // Computes fate and corners of a batch of the items from `begin` on, without those that report
    // that they are unseen. Returns the first item after the batch, at most `end`.
    int (*items)(const struct cpu_call *call, int begin, int end, struct cpu_items *items);
    // Clips an item into parts; returns their number.
    int (*clip)(const struct cpu_call *call, int item, rg_snapped parts[CPU_MOST_PARTS]);
    // Computes the records of items, from primitive `first` on, and which of them are plain: 0
    // or 1.
    void (*records)(const struct cpu_call *call, const int *items, int count,
                    struct cpu_records records, int first, uint8_t *plain);
    // Compute fragments: of a list, which is padded to a multiple of CPU_LANES; of a list that has
    // only plain records; and of `count` pixels from (x, y) on.
    void (*list)(const struct cpu_call *call, struct cpu_records records,
                 const struct cpu_list *list, const struct cpu_columns *columns,
                 struct cpu_fragments *fragments);
    void (*plain_list)(const struct cpu_call *call, struct cpu_records records,
                       const struct cpu_list *list, const struct cpu_columns *columns,
                       struct cpu_fragments *fragments);
    void (*row)(const struct cpu_call *call, struct cpu_records records, int prim, int x, int y,
                int count, struct cpu_fragments *fragments);
    // For programs with lights, else NULL: the number of lights; and variants of `list` and `row`
    // that compute depth and `kept` only.
    int (*lights)(const struct cpu_call *call);
    void (*list_depth)(const struct cpu_call *call, struct cpu_records records,
                       const struct cpu_list *list, struct cpu_fragments *fragments);
    void (*row_depth)(const struct cpu_call *call, struct cpu_records records, int prim, int x,
                      int y, int count, struct cpu_fragments *fragments);
};

#endif
