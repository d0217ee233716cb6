// The database's text files: the factors that each of its pictures was divided by.
#ifndef RG_CORE_SCENE_ATLAS_CAVE_FACTORS_H
#define RG_CORE_SCENE_ATLAS_CAVE_FACTORS_H

#include <stdarg.h>

#include "core/scene/atlas/atlas.h"

// A sentence that names the file; the function that asked for the pack logs it once.
struct rg_cave_why {
    char text[1400];
};

// Sets the sentence and returns false.
bool rg_cave_refuse(struct rg_cave_why *why, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

// The factors of one view.
struct rg_cave_factors {
    bool known[RG_ATLAS_LIGHTS][RG_ATLAS_PHIS];
    float factor[RG_ATLAS_LIGHTS][RG_ATLAS_PHIS][RG_ATLAS_OSCILLATIONS];
};

// Reads dcam{NN}_point_max.txt of a view; directions missing there stay unknown.
bool rg_cave_point_factors(const char *path, int view, struct rg_cave_factors *factors,
                           struct rg_cave_why *why);

// Reads normalized_env_max.txt, which must have every view.
bool rg_cave_env_factors(const char *path, float factors[RG_ATLAS_OSCILLATIONS][RG_ATLAS_VIEWS],
                         struct rg_cave_why *why);

#endif
