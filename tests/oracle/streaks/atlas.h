// The streak atlas as docs/atlas.md lays it out, read in double precision without kernels/. Its
// texels and factors are an input.
#ifndef RG_TESTS_ORACLE_STREAKS_ATLAS_H
#define RG_TESTS_ORACLE_STREAKS_ATLAS_H

#include <stdint.h>

enum {
    STREAK_OSCILLATIONS = 10,
    STREAK_VIEWS = 5,
    STREAK_HEIGHTS = 10,
    STREAK_AZIMUTHS = 9,
    STREAK_LEVELS = 6
};

// Borrowed halves: by oscillation and level of the full size, NULL where the atlas has no such
// level. Rows are 90 cells wide for points, and one for the sky.
struct streak_atlas {
    const uint16_t *points[STREAK_OSCILLATIONS][STREAK_LEVELS];
    const uint16_t *skies[STREAK_OSCILLATIONS][STREAK_LEVELS];
    double point_factors[STREAK_OSCILLATIONS][STREAK_VIEWS][STREAK_HEIGHTS][STREAK_AZIMUTHS];
    double sky_factors[STREAK_OSCILLATIONS][STREAK_VIEWS];
};

enum { STREAK_SKY = -1 }; // in place of a column

// A texture between its four nearest texels: u from left to right, 0 to 1, and where the drop is in
// its swing, 0 to 1. The picture goes on beyond the exposure's ends as in a longer one.
double streak_texture(const struct streak_atlas *atlas, int oscillation, int level, int view,
                      int column, double u, double swing);

// For how much of the atlas' exposure a drop covers a place on its way, seen from an elevation
// between those of the atlas.
double streak_atlas_share(double view);

#endif
