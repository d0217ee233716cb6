// A viewer of rain, and the lights on it.
#ifndef RG_TESTS_ORACLE_STREAKS_VIEW_H
#define RG_TESTS_ORACLE_STREAKS_VIEW_H

#include <stdbool.h>

enum streak_light_kind { STREAK_LAMP, STREAK_SPOT, STREAK_SUN };

struct streak_light {
    enum streak_light_kind kind;
    double at[3], direction[3]; // direction: of length 1, the way of the light
    double colour[3];           // on a white matt surface that faces it, 1 m away
    double inner_deg, outer_deg;
};

struct streak_view {
    double eye[3], right[3], above[3], ahead[3]; // of length 1
    double focal_px;
    int width, height;
    double up[3]; // against the fall
    int taps, first_level, last_level;
    bool absolute; // views from below count as from above
    double gain, opacity, sky[3];
    const struct streak_light *lights;
    int light_count;
};

#endif
