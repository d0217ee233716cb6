// Rain beyond a distance as the mean light of its drops, pixel by pixel in double precision (C.
// Creus, "Real-time realistic rain rendering", 2010, section 5.5, by docs/streaks.md). It has
// nothing of kernels/.
#ifndef RG_TESTS_ORACLE_STREAKS_FAR_H
#define RG_TESTS_ORACLE_STREAKS_FAR_H

#include "tests/oracle/streaks/atlas.h"
#include "tests/oracle/streaks/view.h"

// It rains between two squares about the eye, in fixed slabs, one behind the other. How much a slab
// hides of those behind it does not depend on the drops' places in it.
struct streak_far {
    double nearest_m, farthest_m; // half of the squares' sides
    double slab_m;
    double drops_m3, radius_m;
    double axes[2][3]; // the squares' sides, of length 1
    double eye[2];     // along them, from where slabs are counted
};

// The light of the sky and of each column of lights in a streak of the atlas, averaged over all
// oscillations and a whole swing.
struct streak_means {
    double skies[STREAK_VIEWS], points[STREAK_VIEWS][STREAK_HEIGHTS * STREAK_AZIMUTHS];
};
void streak_means_find(const struct streak_atlas *atlas, struct streak_means *means);

// Draws light over that of a pixel. Returns whether the cell of the atlas that is nearest to a
// light changes within a slab.
bool streak_far_draw(const struct streak_view *view, const struct streak_far *far,
                     const struct streak_means *means, int x, int y, double light[3]);

#endif
