// Streaks: pictures of a falling drop over an exposure, under many lights at once.
#ifndef RG_CORE_SCENE_ATLAS_STREAK_H
#define RG_CORE_SCENE_ATLAS_STREAK_H

#include <stdbool.h>

#include "core/scene/atlas/lights.h"

// Pictures of width x height, row 0 on top, tightly packed. The caller frees both arrays.
struct rg_streaks {
    int width, height;
    float *point; // for each lobe in turn: radiance for an irradiance of 1
    float *env;   // for radiance 1 from everywhere
};

// Traces the streaks of an oscillation seen from an elevation of 20 * view degrees, at the cell's
// size in a level of the full atlas. NULL arrays and one logged line when memory runs out.
bool rg_streaks_trace(int oscillation, int view, int level, const struct rg_streak_detail *detail,
                      const struct rg_lobes *lobes, struct rg_streaks *streaks);
// The factor that scales the light of all lobes, each as strong as an even sky is in its part of
// the sphere, to the light of that sky. The lights are 20 degrees apart, so that they miss what a
// drop does in between, and light that stays inside it for long.
float rg_streaks_balance(const struct rg_streaks *streaks);
void rg_streaks_free(struct rg_streaks *streaks);

#endif
