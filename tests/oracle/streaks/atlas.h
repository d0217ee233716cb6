// The streak atlas as docs/atlas.md describes it, read in double precision without kernels/. Its
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

// Borrowed halves, by oscillation and level of the full size; NULL: the atlas lacks that level.
// Rows are 90 cells wide for points, and one for the sky.
struct streak_atlas {
    const uint16_t *points[STREAK_OSCILLATIONS][STREAK_LEVELS];
    const uint16_t *skies[STREAK_OSCILLATIONS][STREAK_LEVELS];
    double point_factors[STREAK_OSCILLATIONS][STREAK_VIEWS][STREAK_HEIGHTS][STREAK_AZIMUTHS];
    double sky_factors[STREAK_OSCILLATIONS][STREAK_VIEWS];
};

enum { STREAK_SKY = -1 }; // instead of a column

// A texture between its four nearest texels: u is 0 to 1 from left to right, `swing` is the drop's
// phase, 0 to 1. Beyond the exposure's ends the picture goes on like a longer one.
double streak_texture(const struct streak_atlas *atlas, int oscillation, int level, int view,
                      int column, double u, double swing);

// The share of the atlas' exposure in which a drop covers a place on its way, from an elevation
// between those of the atlas.
double streak_atlas_share(double view);

#endif
