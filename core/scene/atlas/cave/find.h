// Finds the database's files anywhere under a folder, because copies are seldom complete or in
// their original folders.
#ifndef RG_CORE_SCENE_ATLAS_CAVE_FIND_H
#define RG_CORE_SCENE_ATLAS_CAVE_FIND_H

#include "core/scene/atlas/cave/factors.h"

enum { RG_CAVE_PATH_SIZE = 1024 };

// A picture identified by its name: cv{V}_v{L}_h{P}_osc{K}.png, or cv{V}_osc{K}.png for light from
// everywhere.
struct rg_cave_found {
    bool env;
    int oscillation, view, light, phi; // as the atlas counts them; light and phi are 0 for env
    int width;                         // pixels
    char path[RG_CAVE_PATH_SIZE];
};

struct rg_cave_files {
    int count;
    struct rg_cave_found *items; // in the order of the atlas; only the widest of each picture
    char point_factors[RG_ATLAS_VIEWS][RG_CAVE_PATH_SIZE]; // dcam{NN}_point_max.txt; "": none
    char env_factors[RG_CAVE_PATH_SIZE];                   // normalized_env_max.txt; "": none
};

// Searches a folder and its subfolders. False, and a sentence in `why`, when one cannot be read or
// there is no such picture. The caller frees `items`.
bool rg_cave_find(const char *folder, struct rg_cave_files *files, struct rg_cave_why *why);

#endif
