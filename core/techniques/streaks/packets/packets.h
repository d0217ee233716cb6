// streaks: the rain's particles, grouped in packets, and the choice of those that a frame draws
// (Creus, sections 4.3.2, 4.3.3 and 4.4.1). docs/packets.md explains the choices.
//
// The local space holds as many particles as the density map asks for. A scheme cuts it, across the
// fall, into packets. `world`: one packet. `kd`: halves with equal numbers of particles, across the
// longer side, until none exceeds the packet size. `quad`: quarters of equal area. These three hold
// the same particles, whose ids follow a Morton curve over the top plane, so that neighbours are
// drawn together. `grid`: buckets of evenly spread particles, one for each density that occurs,
// repeated at the cells of a grid, each cell with its own offset of the fall.
//
// A particle is 3 floats: x and y in the rain space's clip coordinates, -1 to 1, and oscillation
// (0 to 9) + start (in [0, 1), to 20 bits). A bucket's x and y are those of the grid's first place.
// Particles lie in buffers of at most STREAKS_BUFFER_PARTICLES. Each packet begins at a multiple of
// 32, and zeros fill up its last 32.
//
// A frame draws blocks of 32 particles of one buffer. A block has STREAKS_BLOCK_WORDS words: the
// first particle's place in the buffer, a mask of the particles that count (bit k: the k-th),
// shift_x and shift_y to add to x and y (float bits), and turn in [0, 1) (float bits). A particle
// is at s = top + height * fract(start + turn).
//
// One struct of packets may serve several threads and instances: nothing changes it but
// streaks_packets_forget. Everything is the same for any number of threads.
#ifndef RG_CORE_TECHNIQUES_STREAKS_PACKETS_PACKETS_H
#define RG_CORE_TECHNIQUES_STREAKS_PACKETS_PACKETS_H

#include <stdbool.h>
#include <stdint.h>

#include "core/scene/density.h"
#include "core/scene/rain_space.h"
#include "kernels/streaks/params.h"

enum {
    STREAKS_BUFFER_PARTICLES = (128 << 20) / 12 / 32 * 32, // 128 MiB, which every device allows
    STREAKS_DRAW_BLOCKS = 1 << 22 // the most in a draw, so that its blocks also fit into 128 MiB
};

// In the order of the parameter `packets`. auto: the one of kd, quad and grid with the fewest
// packets (for the grid, buckets) that fits into memory; world if one packet holds all.
enum streaks_scheme {
    STREAKS_AUTO,
    STREAKS_WORLD,
    STREAKS_KD,
    STREAKS_QUAD,
    STREAKS_GRID,
};

// The density of the default rain is Creus's: the built-in map on 400 m x 400 m holds 54,978,100
// particles in a local space of 20 m (table 5.3) at 8.16 m/s.
#define STREAKS_DEFAULT_DROPS_M2_S 535.50222

struct streaks_packets_settings {
    uint32_t seed;
    double drops_m2_s;     // drops that fall where the map is 1
    double fall_speed_m_s; // with drops_m2_s gives drops a cubic metre
    double local_height_m;
    int packet_size; // the most particles in a packet
    enum streaks_scheme scheme;
    // Draws particles in the order of their ids, so that the image does not depend on the packets.
    // The grid's have no ids and are drawn cell by cell anyway.
    bool by_id;
    int64_t memory_bytes; // the most that making particles may take; 64 GiB or less
    const char *amount;   // the parameter that decides the number of drops, for messages
};

struct streaks_packets_info {
    enum streaks_scheme scheme; // chosen by auto
    int64_t total_particles;    // in the local space
    int64_t packets;            // leaves; for the grid, buckets
    int64_t places;             // occurrences of packets: leaves; for the grid, all its cells
    int grid_x, grid_y;         // cells of the grid; 0 for other schemes
    int64_t stored_particles;   // without padding
    int64_t particle_bytes;     // of all buffers together
    int64_t host_bytes;         // left after streaks_packets_forget
    int64_t peak_bytes;         // peak while making them
};

struct streaks_packets;

// Makes the particles. NULL, and one logged line with the numbers, if a setting makes no rain, or
// more particles than 2^31 - 1 or than fit into memory. The map is needed only until it returns.
struct streaks_packets *streaks_packets_create(const struct rg_rain_space *space,
                                               const struct rg_density *density,
                                               const struct streaks_packets_settings *settings);
void streaks_packets_destroy(struct streaks_packets *packets); // accepts NULL

const struct streaks_packets_info *streaks_packets_info(const struct streaks_packets *packets);
// "world", "kd", "quad", "grid".
const char *streaks_scheme_name(enum streaks_scheme scheme);

// The contents of the device's buffer `index`: `bytes` bytes (a multiple of 32 particles). The
// packets own them, and streaks_packets_forget frees them after the upload.
int streaks_packets_buffers(const struct streaks_packets *packets);
const float *streaks_packets_buffer(const struct streaks_packets *packets, int index,
                                    int64_t *bytes);
void streaks_packets_forget(struct streaks_packets *packets);

// Calls `visit` for each particle's number in its buffer, and the number of times it occurs in the
// local space: the grid's occur in several cells.
void streaks_packets_each(const struct streaks_packets *packets,
                          void (*visit)(void *user, uint32_t number, int64_t times), void *user);

// The number of particles in a local space, without making them; 0 for refused settings, without a
// message.
int64_t streaks_packets_total(const struct rg_rain_space *space, const struct rg_density *density,
                              const struct streaks_packets_settings *settings);

// --- selection ---

// The observer's place and view, in metres of the rain frame.
struct streaks_view {
    double eye[3];
    double corners[8][3]; // of the view frustum, in the order of rg_rain_view_corners
    double radius_m;      // half a side of the culling prism; INFINITY: no prism
    double top_m;         // of the local space (rg_rain_local_top)
    double run;           // rg_rain_run
    // The reach of a streak or splash from its particle's place: across the fall, above the local
    // top and below the local ground. Splashes outlast drops on surfaces that these have passed, so
    // that above_m is a streak's length, a drop's fall while a splash lasts, and a splash's height.
    // No particle is culled whose streak or splash could touch the frustum.
    double across_m, above_m, below_m;
    // If true, selection is exact: by the convex hull of the visible part of the local space within
    // the prism. If false, it is Creus's: by the bounding rectangles of prism and frustum on the
    // top plane.
    bool hull;
    bool apart; // a block's particles fall at different speeds, and are anywhere along the fall
    bool whole; // lists all blocks of the packets, whether visible or not
    // Lists only one in so many of these blocks, the same ones in each frame; 0 and 1: all. Counts
    // of packets and particles ignore this.
    int sparse;
};

// Consecutive blocks of one buffer.
struct streaks_draw {
    int buffer;
    int64_t first_block; // in streaks_selection.blocks
    int block_count;     // 1 to STREAKS_DRAW_BLOCKS
};

// The arrays of a selection.
enum streaks_list {
    STREAKS_SELECTED,
    STREAKS_DRAWS,
    STREAKS_BLOCKS,
    STREAKS_RUNS,
    STREAKS_MASKS,
    STREAKS_SEEN,
    STREAKS_LIST_COUNT
};

struct streaks_run; // inner.h

// The selection of a frame. Zero it before the first use, then reuse it.
struct streaks_selection {
    int64_t particles; // in the selected packets, including blocks out of view
    int packets;       // selected places that are not empty
    int *selected;     // their numbers, ascending, for streaks_packets_rectangle
    int draw_count;
    struct streaks_draw *draws;
    int64_t block_count;
    uint32_t *blocks; // STREAKS_BLOCK_WORDS each
    // Scratch of streaks_select: runs of particles, masks of drawn particles, and flags of drawn
    // blocks.
    struct streaks_run *runs;
    uint32_t *masks;
    uint8_t *seen;
    int64_t room[STREAKS_LIST_COUNT]; // capacity of each array, in elements
};

// Selects the packets that meet prism and frustum, and lists their visible blocks, or with by_id
// all blocks. The world packet is always selected. False, and one logged line, when memory runs out
// or the view holds NaN.
bool streaks_select(const struct streaks_packets *packets, const struct streaks_view *view,
                    struct streaks_selection *selection);
void streaks_selection_release(struct streaks_selection *selection); // zeroes it

// A packet's rectangle on the top plane, by its place 0 to info->places - 1: least x and y, largest
// x and y, in metres of the rain frame. And the number of particles at a place.
void streaks_packets_rectangle(const struct streaks_packets *packets, int place,
                               double rectangle_m[4]);
int64_t streaks_packets_count(const struct streaks_packets *packets, int place);

#endif
