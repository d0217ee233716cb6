// Rain beyond a distance as the mean light of the drops that are there, pixel by pixel in double
// precision (C. Creus, "Real-time realistic rain rendering", 2010, section 5.5, as docs/streaks.md
// has it). Nothing of kernels/ is in it.
#ifndef RG_TESTS_ORACLE_STREAKS_FAR_H
#define RG_TESTS_ORACLE_STREAKS_FAR_H

#include "tests/oracle/streaks/atlas.h"
#include "tests/oracle/streaks/view.h"

// It rains between two squares about the eye, in slabs that stand still, one behind the other: what
// a slab hides of the ones behind it does not depend on where in it the drops are.
struct streak_far {
    double nearest_m, farthest_m; // half of the squares' sides
    double slab_m;
    double drops_m3, radius_m;
    double axes[2][3]; // the squares' sides, of length 1
    double eye[2];     // along them, from where slabs are counted
};

// What a streak of the atlas shows of the sky and of each column of lights, in the mean over all
// oscillations and a whole swing.
struct streak_means {
    double skies[STREAK_VIEWS], points[STREAK_VIEWS][STREAK_HEIGHTS * STREAK_AZIMUTHS];
};
void streak_means_find(const struct streak_atlas *atlas, struct streak_means *means);

// Light of a pixel, over what it held. Returns how many slabs there were.
int streak_far_draw(const struct streak_view *view, const struct streak_far *far,
                    const struct streak_means *means, int x, int y, double light[3]);

#endif
