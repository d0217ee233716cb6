// Light that reaches drops, and the pictures of the atlas for it (C. Creus, figure 4.6).
#ifndef RG_TESTS_ORACLE_STREAKS_LIGHT_H
#define RG_TESTS_ORACLE_STREAKS_LIGHT_H

#include <stdbool.h>

#include "tests/oracle/streaks/view.h"

// The share of a light's colour that reaches a place, and the direction to the light.
double streak_reach(const struct streak_light *light, const double at[3], double to_light[3]);

// The pictures of a view to blend, and the weight of each.
struct streak_cells {
    int columns[4];
    double parts[4];
    bool mirrored;
};

// The pictures for light from a direction of length 1 on a drop seen along a ray, from below or
// not.
struct streak_cells streak_cells_of(const struct streak_view *view, bool below, const double ray[3],
                                    const double to_light[3]);

#endif
