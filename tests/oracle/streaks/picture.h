// Pictures of streaks, pixel by pixel in double precision: the billboards of C. Creus, "Real-time
// realistic rain rendering", 2010, section 4.4.2 and figure 4.6, with the departures that
// docs/streaks.md names, and light as optics has it. Nothing of kernels/ is in it. Everything is in
// metres of the world, y upwards or not; irradiance is pi times a light's colour.
#ifndef RG_TESTS_ORACLE_STREAKS_PICTURE_H
#define RG_TESTS_ORACLE_STREAKS_PICTURE_H

#include "tests/oracle/streaks/atlas.h"
#include "tests/oracle/streaks/view.h"

struct streak_drop {
    double end[3]; // where it is when the exposure ends
    double fall_m; // in the exposure
    double cut_m;  // its streak is seen from so far above the end on
    double radius_m, weight;
    int oscillation;
    double turn;   // of its swing when the exposure ends
    double cycles; // in the exposure
};

// What a pixel holds: its light, and the most that a streak that covers it adds to any of its
// pixels and hides of it.
struct streak_pixel {
    double light[3];
    double peak;
    int streaks; // that cover it
};

// Draws drops over what pixels hold, one after the other. Peaks and counts begin at 0.
void streak_picture_draw(const struct streak_view *view, const struct streak_atlas *atlas,
                         const struct streak_drop *drops, int count, struct streak_pixel *pixels);

#endif
