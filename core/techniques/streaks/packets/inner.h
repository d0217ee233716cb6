// Shared declarations of this folder's files; other folders include packets.h.
#ifndef RG_CORE_TECHNIQUES_STREAKS_PACKETS_INNER_H
#define RG_CORE_TECHNIQUES_STREAKS_PACKETS_INNER_H

#include "core/techniques/streaks/packets/packets.h"
#include "core/techniques/streaks/packets/scatter.h"

enum {
    STREAKS_LEVELS = 256,        // density levels of a grid, as in 8 bits; 0 is dry
    STREAKS_MAX_CELLS = 1 << 26, // of a grid, one byte each
    STREAKS_BUFFER_LIMIT = 512,  // 64 GiB, so that a tree's node indices also fit into 31 bits
    STREAKS_PARTICLE_BYTES = 12,
    STREAKS_BOUNDS_BYTES = 24, // of a block
    STREAKS_ID_BYTES = 4
};

// A tree's node, and its half-open rectangle of lattice points. The first child follows its parent;
// `second` is the other child's index. A leaf has a packet, a branch -1.
struct streaks_node {
    uint32_t left, top, right, bottom;
    int32_t second, packet;
};

// A leaf's particles: from slot `first` on, numbered through all buffers; where particles are
// stored by id and the tree is kd, from element `first` of `ids` on.
struct streaks_packet {
    int64_t first;
    int32_t count, node;
};

struct streaks_grid {
    int across, down;
    double step;     // particles in one level
    uint8_t *levels; // by cell, row by row
    int64_t cells_of[STREAKS_LEVELS];
    struct streaks_packet buckets[STREAKS_LEVELS];
};

// Boxes around the particles of each block, numbered through all buffers: x and y in the particles'
// coordinates, and start. None where particles are drawn by id.
struct streaks_bounds {
    float *memory;
    float *low[3], *high[3];
};

struct streaks_packets {
    double half_x_m, half_y_m;
    struct streaks_packets_settings settings;
    struct streaks_packets_info info;
    float *particles; // all buffers, one after the other
    int64_t slots;    // particles including padding, a multiple of STREAKS_BLOCK
    struct streaks_node *nodes;
    int64_t node_count, node_room;
    struct streaks_packet *packets; // leaves
    int64_t packet_room;
    uint32_t *ids; // leaf by leaf, where particles are stored by id and the tree is kd
    struct streaks_grid grid;
    struct streaks_bounds bounds;
};

// Whether particles are drawn in the order of their ids; the grid's have none.
bool streaks_by_id(const struct streaks_packets *packets);

static inline int64_t streaks_padded(int64_t count)
{
    return (count + STREAKS_BLOCK - 1) / STREAKS_BLOCK * STREAKS_BLOCK;
}

// The whole plane as a node.
static const struct streaks_node streaks_everywhere = {
    0, 0, 1u << STREAKS_LATTICE_BITS, 1u << STREAKS_LATTICE_BITS, -1, -1};

// A particle's coordinate along x (axis 0) or y, where particles are stored by id.
static inline uint32_t streaks_lattice(const struct streaks_packets *packets, int64_t id, int axis)
{
    return streaks_lattice_of(packets->particles[3 * id + axis]);
}

// --- trees ---
//
// They are built over particles that lie by id from slot 0 on. False, with one logged line, without
// memory.

// The number of leaves after halving `count` particles repeatedly.
int64_t streaks_kd_leaves(int64_t count, int size);
bool streaks_kd_build(struct streaks_packets *packets, int64_t count);
bool streaks_quad_build(struct streaks_packets *packets, int64_t count);

// --- the choice of a scheme: its packets and its memory, before memory is taken ---

struct streaks_plan {
    enum streaks_scheme scheme;
    int64_t packets, slots, peak_bytes;
};

// The number of particles in the local space; false, and one logged line, if the settings make no
// rain.
bool streaks_plan_amount(const struct rg_rain_space *space, const struct rg_density *density,
                         const struct streaks_packets_settings *settings, int64_t *total);
// Plans packets whose total is known. A plan for the grid is left in packets->grid. False, and one
// logged line with the numbers, if the chosen scheme, or every one, exceeds the memory.
bool streaks_plan(struct streaks_packets *packets, const struct rg_density *density,
                  const struct streaks_scatter *scatter, struct streaks_plan *plan);
// The bytes of a tree without its particles.
int64_t streaks_tree_bytes(int64_t nodes, int64_t packets);

// --- the grid ---

// Chooses cells and their levels. False if there would be more than STREAKS_MAX_CELLS, which sets
// `grid->across` to 0 and is not logged; or, with one logged line, when memory runs out.
bool streaks_grid_plan(const struct streaks_packets *packets, const struct rg_density *density,
                       double densest_m3, struct streaks_grid *grid);
int streaks_grid_buckets(const struct streaks_grid *grid); // used ones only
int streaks_bucket_count(const struct streaks_grid *grid, int level);
int64_t streaks_grid_total(const struct streaks_grid *grid);
// The particles of all used buckets, including padding.
int64_t streaks_grid_slots(const struct streaks_grid *grid);
bool streaks_grid_build(struct streaks_packets *packets);
// The lead of a cell's particles over the run position, in [0, 1).
double streaks_cell_turn(uint32_t seed, int64_t cell);

// --- blocks ---
//
// They are those of the packets in selection->selected. False, with one logged line, without
// memory.

bool streaks_list_by_packet(const struct streaks_packets *packets, const struct streaks_view *view,
                            struct streaks_selection *selection);
bool streaks_list_by_id(const struct streaks_packets *packets, const struct streaks_view *view,
                        struct streaks_selection *selection);

// Contiguous particles of one buffer, drawn with the same shift and turn.
struct streaks_run {
    int64_t slot; // of the first particle, numbered through all buffers
    int32_t count;
    float shift_x, shift_y, turn;
    int place;            // place of its bucket, which occurs at several
    int64_t first, block; // index of its first block, among all and among visible ones
};

static inline int64_t streaks_blocks_in(const struct streaks_run *run)
{
    return (run->count + STREAKS_BLOCK - 1) / STREAKS_BLOCK;
}

// --- bounds of blocks ---

// Sorts the particles of each packet so that blocks are small, and computes the blocks' boxes.
// False, with one logged line, when memory runs out.
bool streaks_bounds_make(struct streaks_packets *packets);

// A view, prepared for testing many blocks.
struct streaks_sight {
    float planes[4][4]; // the frustum's sides: a, b, c, d with ax + by + cs + d > 0 inside
    float half_x, half_y, across, above, below, top, height;
    bool apart;
};

void streaks_sight_of(const struct streaks_packets *packets, const struct streaks_view *view,
                      struct streaks_sight *sight);
// Finds the blocks of a run that the view can see, 1 or 0 each; returns their number.
int64_t streaks_bounds_seen(const struct streaks_packets *packets,
                            const struct streaks_sight *sight, const struct streaks_run *run,
                            uint8_t *seen);

// --- a view on the top plane ---

struct streaks_area {
    double left, top, right, bottom; // metres; empty unless left <= right
    int corner_count;                // of the hull; 0: no hull
    double corners[80][2];           // counterclockwise, x to the right and y up
    double margin;                   // added around the hull
    double prism[4];                 // the culling prism, as left, top, right, bottom
};

void streaks_area_of(const struct streaks_view *view, double half_x_m, double half_y_m,
                     double local_height_m, struct streaks_area *area);
// Whether a rectangle, including its borders, meets the area.
bool streaks_area_meets(const struct streaks_area *area, double left, double top, double right,
                        double bottom);

#endif
