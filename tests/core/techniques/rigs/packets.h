// For tests of rain in packets: a rain of a few settings, and its particles one by one.
#ifndef RG_TESTS_CORE_TECHNIQUES_RIGS_PACKETS_H
#define RG_TESTS_CORE_TECHNIQUES_RIGS_PACKETS_H

#include "core/techniques/streaks/packets/packets.h"

// A particle that a list of blocks draws.
struct rig_particle {
    int64_t slot; // its place, counted through all buffers
    float shift_x, shift_y;
    double x_m, y_m; // in the rain frame
    double fall;     // fract(start + turn), of the local space's height
    double start;    // as stored
    int oscillation;
};

struct rig_particles {
    int64_t count;
    struct rig_particle *all;
};

extern const struct rg_rain_space rig_space; // 400 m x 400 m, 230 m high, straight down

extern const enum streaks_scheme rig_schemes[4]; // STREAKS_WORLD first, STREAKS_GRID last

// Settings for so many particles in a local space of 20 m, in packets of 1000, worldwide.
struct streaks_packets_settings rig_settings(const struct rg_rain_space *space,
                                             const struct rg_density *density, double particles);

// Fails the test if making them fails.
struct streaks_packets *rig_packets(const struct rg_rain_space *space,
                                    const struct rg_density *density,
                                    const struct streaks_packets_settings *settings);

// A view that sees everything, from the rain space's middle, at this run position.
#define RIG_RUN 0.25
struct streaks_view rig_everywhere(const struct rg_rain_space *space, double local_height_m);

// Reads the blocks as a kernel does; the caller frees `all`. Fails the test if a block breaks a
// rule of its header: a particle outside its buffer, an empty mask, or draws that overlap or leave
// blocks out. More particles than the selection counts fail it as well.
struct rig_particles rig_read(const struct streaks_packets *packets,
                              const struct rg_rain_space *space,
                              const struct streaks_selection *selection);
// All particles, from a view of everything.
struct rig_particles rig_read_all(const struct streaks_packets *packets,
                                  const struct rg_rain_space *space, double local_height_m);

// Orders by slot, then shift. Comparable with qsort and bsearch.
int rig_compare(const void *a, const void *b);

// A map of width x height texels, row by row, unchanged; fails the test otherwise.
struct rg_density *rig_map(int width, int height, const float *texels);

// A map with black places and steep steps, whose sides are no powers of two.
enum { UNEVEN_X = 7, UNEVEN_Y = 5 };
extern const float rig_uneven[UNEVEN_X * UNEVEN_Y];
struct rg_density *rig_uneven_map(void);

// The probability with which a sound generator would fail. Seeds are fixed, so that a test that
// passes once always passes.
#define RIG_CHANCE 1e-3
// Fails the test if the chance of such an outcome is smaller.
void rig_expect_chance(double p, const char *what);

// Counts logged errors until rig_errors is called, and keeps them off stderr.
void rig_listen(void);
int rig_errors(void);

#endif
