// streaks: the rain's particles, grouped in packets, and which of them a frame draws (Creus,
// sections 4.3.2, 4.3.3 and 4.4.1). docs/packets.md explains the choices.
//
// The local space holds as many particles as the density map asks for. A scheme cuts it, across the
// fall, into packets. `world`: one packet. `kd`: halves of equal numbers, across the longer side,
// until none exceeds the packet size. `quad`: quarters of equal size. These three hold the same
// particles, whose numbers (ids) follow a Morton curve over the top plane, so that neighbours are
// drawn together. `grid`: buckets of evenly spread particles, one for each density that occurs, set
// down at the places of a grid, each place with a fall of its own.
//
// A particle is 3 floats: x and y in the rain space's clip coordinates, -1 to 1, and oscillation
// (0 to 9) + start (in [0, 1), to 20 bits). A bucket's x and y are those of the grid's first place.
// Particles lie in buffers of at most STREAKS_BUFFER_PARTICLES. Each packet begins at a multiple of
// 32, and zeros fill up its last 32.
//
// A frame draws blocks of 32 particles of one buffer: STREAKS_BLOCK_WORDS words each, which are the
// first particle's place in the buffer, a mask of the particles that count (bit k: the k-th),
// shift_x and shift_y to add to x and y (float bits), and turn in [0, 1) (float bits): the particle
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
    STREAKS_BUFFER_PARTICLES = (128 << 20) / 12 / 32 * 32, // of 128 MiB, which every device takes
    STREAKS_DRAW_BLOCKS = 1 << 22 // a draw has at most, so that its blocks fit into 128 MiB, too
};

// As the parameter `packets` counts them. auto: the one of kd, quad and grid with the fewest
// packets (buckets, for the grid) of those that fit into memory; world where one packet holds all.
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
    double drops_m2_s;     // that fall where the map is 1
    double fall_speed_m_s; // together: drops a cubic metre
    double local_height_m;
    int packet_size; // particles a packet holds at most
    enum streaks_scheme scheme;
    // Particles are drawn in the order of their ids, whatever their packets: then the image does
    // not depend on the packets. The grid, whose particles have no ids, is drawn place by place
    // anyway.
    bool by_id;
    int64_t memory_bytes; // that making the particles may take at its peak, 64 GiB at most
    const char *amount;   // the parameter that decides how many drops there are, for messages
};

struct streaks_packets_info {
    enum streaks_scheme scheme; // what auto has chosen
    int64_t total_particles;    // in the local space
    int64_t packets;            // leaves; of the grid, the buckets
    int64_t places;           // where packets stand: leaves; of the grid, its cells, empty ones too
    int grid_x, grid_y;       // cells of the grid, else 0
    int64_t stored_particles; // without padding
    int64_t particle_bytes;   // of all buffers together
    int64_t host_bytes;       // that remain after streaks_packets_forget
    int64_t peak_bytes;       // that making them took
};

struct streaks_packets;

// Makes the particles. NULL, and one logged line with the numbers, if a setting makes no rain, or
// more particles than 2^31 - 1 or than memory. The map is needed only until it returns.
struct streaks_packets *streaks_packets_create(const struct rg_rain_space *space,
                                               const struct rg_density *density,
                                               const struct streaks_packets_settings *settings);
void streaks_packets_destroy(struct streaks_packets *packets); // accepts NULL

const struct streaks_packets_info *streaks_packets_info(const struct streaks_packets *packets);
// "world", "kd", "quad", "grid".
const char *streaks_scheme_name(enum streaks_scheme scheme);

// What goes into the device's buffers: `bytes` bytes (a multiple of 32 particles) for buffer
// `index`. They stay the packets', until streaks_packets_forget gives them up after the upload.
int streaks_packets_buffers(const struct streaks_packets *packets);
const float *streaks_packets_buffer(const struct streaks_packets *packets, int index,
                                    int64_t *bytes);
void streaks_packets_forget(struct streaks_packets *packets);

// Calls `visit` for each particle's number in its buffer, with how often it stands in the local
// space: the grid's stand in several cells.
void streaks_packets_each(const struct streaks_packets *packets,
                          void (*visit)(void *user, uint32_t number, int64_t times), void *user);

// How many particles a local space holds: the numbers alone, without making them; 0 for settings
// that are refused, which is not logged.
int64_t streaks_packets_total(const struct rg_rain_space *space, const struct rg_density *density,
                              const struct streaks_packets_settings *settings);

// --- selection ---

// Where the observer is and what is seen, in metres of the rain frame.
struct streaks_view {
    double eye[3];
    double corners[8][3]; // of the view frustum, as rg_rain_view_corners orders them
    double radius_m;      // half a side of the culling prism; INFINITY: no prism
    double top_m;         // of the local space (rg_rain_local_top)
    double run;           // rg_rain_run
    // How far a streak or splash may reach: across the fall from its particle's place; along the
    // fall above the local top and below the local ground. Above the top splashes last on surfaces
    // that a drop has passed, so above_m is a streak's length, the way of a drop while a splash
    // lasts, and a splash's height. No particle is left out whose streak or splash could touch the
    // frustum.
    double across_m, above_m, below_m;
    // Exact: the convex hull of what is seen of the local space within the prism. Else as Creus has
    // it: the bounding rectangles of prism and frustum on the top plane.
    bool hull;
    bool apart; // particles of a block fall at different speeds, and are anywhere along the fall
    bool whole; // all blocks of the packets are listed, whether the frustum can see them or not
    // Of those one in so many is listed, the same in each frame, and the others are left out; 0 and
    // 1: none is. Packets and their particles are counted as if all were.
    int sparse;
};

// Blocks of one buffer, one after the other.
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

// What a frame draws. Zero it before the first use; it is used again and again.
struct streaks_selection {
    int64_t particles; // that the selected packets hold, in blocks that are seen or not
    int packets;       // selected places that are not empty
    int *selected;     // their numbers, ascending, for streaks_packets_rectangle
    int draw_count;
    struct streaks_draw *draws;
    int64_t block_count;
    uint32_t *blocks; // STREAKS_BLOCK_WORDS each
    // For streaks_select alone: runs of particles; which particles of a block, and which blocks,
    // are drawn.
    struct streaks_run *runs;
    uint32_t *masks;
    uint8_t *seen;
    int64_t room[STREAKS_LIST_COUNT]; // how many elements each array can hold
};

// Selects the packets that meet prism and frustum, and lists their blocks that the frustum can see;
// with by_id, all of them. The world packet is selected whatever is seen. False, and one logged
// line, without memory, or if the view holds no numbers.
bool streaks_select(const struct streaks_packets *packets, const struct streaks_view *view,
                    struct streaks_selection *selection);
void streaks_selection_release(struct streaks_selection *selection); // zeroes it

// A packet's place, 0 to info->places - 1, on the top plane: least x and y, largest x and y, in
// metres of the rain frame. How many particles stand there.
void streaks_packets_rectangle(const struct streaks_packets *packets, int place,
                               double rectangle_m[4]);
int64_t streaks_packets_count(const struct streaks_packets *packets, int place);

#endif
