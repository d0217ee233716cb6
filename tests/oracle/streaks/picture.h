// Pictures of streaks, pixel by pixel in double precision: the billboards of C. Creus, "Real-time
// realistic rain rendering", 2010, section 4.4.2 and figure 4.6, with the departures that
// docs/streaks.md names, and light by optics. They have nothing of kernels/. Lengths are in metres
// of the world, whose y may point anywhere; irradiance is pi times a light's colour.
#ifndef RG_TESTS_ORACLE_STREAKS_PICTURE_H
#define RG_TESTS_ORACLE_STREAKS_PICTURE_H

#include "tests/oracle/streaks/atlas.h"
#include "tests/oracle/streaks/view.h"

struct streak_drop {
    double end[3]; // its place when the exposure ends
    double fall_m; // during the exposure
    double cut_m;  // the streak is seen from this height above the end on
    double radius_m, weight;
    int oscillation;
    double turn;   // of its swing, when the exposure ends
    double cycles; // during the exposure
};

// A pixel: its light, and the largest change of any pixel by a streak that covers this one.
struct streak_pixel {
    double light[3];
    double peak;
    int streaks; // that cover the pixel
};

// Draws drops over the pixels' light, one after the other. Peaks and counts begin at 0.
void streak_picture_draw(const struct streak_view *view, const struct streak_atlas *atlas,
                         const struct streak_drop *drops, int count, struct streak_pixel *pixels);

#endif
