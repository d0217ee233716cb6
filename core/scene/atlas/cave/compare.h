// Compares pictures of the original database with those of an atlas.
#ifndef RG_CORE_SCENE_ATLAS_CAVE_COMPARE_H
#define RG_CORE_SCENE_ATLAS_CAVE_COMPARE_H

#include "core/scene/atlas/cave/find.h"

// The mirroring of our picture before it is compared. Copies of the database differ in the side of
// the light, and drops that swing left mirror those that swing right.
enum rg_cave_way {
    RG_CAVE_AS_IT_IS,
    RG_CAVE_MIRRORED,   // drop and light are both mirrored
    RG_CAVE_OTHER_SIDE, // only the light is mirrored
    RG_CAVE_OTHER_DROP, // only the drop is mirrored
    RG_CAVE_WAYS
};

struct rg_cave_row {
    struct rg_cave_found found;
    bool flat;                        // one of the two is constant: there is no correlation
    double correlation[RG_CAVE_WAYS]; // of all pixels (Pearson); 0 where flat
    // Mean light: ours in the atlas's units, theirs in the database's. 0: the factor is unknown.
    double ours, theirs;
};

struct rg_cave_comparison {
    int count;
    struct rg_cave_row *rows; // in the order of rg_cave_files
};

// Compares every picture of the database under a folder with the atlas's, at the width of the
// coarser of the two. `progress` may be NULL. False, and one logged line, when a file is invalid or
// there is none. The caller frees `rows`.
bool rg_cave_compare(const char *folder, const struct rg_atlas *atlas,
                     const struct rg_atlas_progress *progress,
                     struct rg_cave_comparison *comparison);

// Whether a folder has pictures of the database, to be asked before an atlas is made for them.
// False, and one logged line, where it has none or cannot be read.
bool rg_cave_has_pictures(const char *folder);

#endif
