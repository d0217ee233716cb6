// What the files of streaks_packets share; nobody else includes it.
#ifndef RG_CORE_TECHNIQUES_STREAKS_PACKETS_INNER_H
#define RG_CORE_TECHNIQUES_STREAKS_PACKETS_INNER_H

#include "core/techniques/streaks_packets.h"
#include "core/techniques/streaks_packets_scatter.h"

enum {
    STREAKS_LEVELS = 256,         // of a grid's density, as an 8-bit map has; 0 is dry
    STREAKS_MAX_CELLS = 1 << 26,  // of a grid, a byte each
    STREAKS_MAX_BUFFERS = 1 << 10 // 128 GiB
};

// A tree's node, and its rectangle in lattice points, ends not included. The first child follows
// its parent; `second` is the other one's index. A leaf has a packet, a branch -1.
struct streaks_node {
    uint32_t left, top, right, bottom;
    int32_t second, packet;
};

// A leaf's particles: from slot `first` of the buffers, of all buffers counted through; where
// particles lie by id and the tree is kd, from `first` of `ids`.
struct streaks_packet {
    int64_t first;
    int32_t count, node;
};

struct streaks_grid {
    int across, down;
    double step;     // particles a level
    uint8_t *levels; // of each cell, row by row
    int64_t cells_of[STREAKS_LEVELS];
    struct streaks_packet buckets[STREAKS_LEVELS];
};

struct streaks_packets {
    double half_x_m, half_y_m;
    struct streaks_packets_settings settings;
    struct streaks_packets_info info;
    float *particles; // all buffers, one after the other
    int64_t slots;    // particles with padding, a multiple of STREAKS_BLOCK
    struct streaks_node *nodes;
    int64_t node_count, nodes_reserved;
    struct streaks_packet *packets; // leaves
    int64_t packets_reserved;
    uint32_t *ids; // leaf after leaf, where particles lie by id and the tree is kd
    struct streaks_grid grid;
};

static inline int64_t streaks_padded(int64_t count)
{
    return (count + STREAKS_BLOCK - 1) / STREAKS_BLOCK * STREAKS_BLOCK;
}

// --- trees: over particles that lie by id from slot 0; false, with one logged line, without memory
// ---

// How many leaves halving makes of `count` particles.
int64_t streaks_kd_leaves(int64_t count, int size);
bool streaks_kd_build(struct streaks_packets *packets, int64_t count);
bool streaks_quad_build(struct streaks_packets *packets, int64_t count);

// --- the grid ---

// Chooses its cells and their levels. False if there would be more than STREAKS_MAX_CELLS, which
// sets `grid->across` to 0 and is not logged; or, with one logged line, without memory for them.
bool streaks_grid_plan(const struct streaks_packets *packets, const struct rg_density *density,
                       double densest_m3, struct streaks_grid *grid);
int streaks_grid_buckets(const struct streaks_grid *grid); // that are used
int streaks_bucket_count(const struct streaks_grid *grid, int level);
int64_t streaks_grid_total(const struct streaks_grid *grid);
// Particles of all used buckets, padding included.
int64_t streaks_grid_slots(const struct streaks_grid *grid);
bool streaks_grid_build(struct streaks_packets *packets);
// How far ahead of the run position a cell's particles are, in [0, 1).
double streaks_cell_turn(uint32_t seed, int64_t cell);

// --- what a view sees of the top plane ---

struct streaks_area {
    double left, top, right, bottom; // metres; empty unless left <= right
    int corner_count;                // of the hull, 0 without one
    double corners[80][2];           // counterclockwise, x to the right and y up
    double margin;                   // that the hull lacks
    double prism[4];                 // as the first four, of the culling prism
};

void streaks_area_of(const struct streaks_view *view, double half_x_m, double half_y_m,
                     double local_height_m, struct streaks_area *area);
// Whether a rectangle, borders included, meets the area.
bool streaks_area_meets(const struct streaks_area *area, double left, double top, double right,
                        double bottom);

#endif
