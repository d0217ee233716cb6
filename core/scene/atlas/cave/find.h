// The database's files, wherever they lie under a folder: whoever has pictures of it seldom has
// all, or in their own folders.
#ifndef RG_CORE_SCENE_ATLAS_CAVE_FIND_H
#define RG_CORE_SCENE_ATLAS_CAVE_FIND_H

#include "core/scene/atlas/cave/factors.h"

enum { RG_CAVE_PATH_SIZE = 1024 };

// A picture by its name: cv{V}_v{L}_h{P}_osc{K}.png, or cv{V}_osc{K}.png of light from everywhere.
struct rg_cave_found {
    bool env;
    int oscillation, view, light, phi; // as the atlas counts them; light and phi 0 of env
    int width;                         // pixels
    char path[RG_CAVE_PATH_SIZE];
};

struct rg_cave_files {
    int count;
    struct rg_cave_found *items; // in the order of the atlas; of each picture the widest alone
    char point_factors[RG_ATLAS_VIEWS][RG_CAVE_PATH_SIZE]; // dcam{NN}_point_max.txt; "": none
    char env_factors[RG_CAVE_PATH_SIZE];                   // normalized_env_max.txt; "": none
};

// Looks through a folder and those in it. False, and a sentence in `why`, when it cannot be read or
// holds no such picture. The caller frees `items`.
bool rg_cave_find(const char *folder, struct rg_cave_files *files, struct rg_cave_why *why);

#endif
