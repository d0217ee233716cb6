// Pictures of the original database beside those of an atlas.
#ifndef RG_CORE_SCENE_ATLAS_CAVE_COMPARE_H
#define RG_CORE_SCENE_ATLAS_CAVE_COMPARE_H

#include "core/scene/atlas/cave/find.h"

// How a picture of ours is laid beside one of the database. Copies differ in the side of the light,
// and a drop's swing to the left is the mirror image of one to the right.
enum rg_cave_way {
    RG_CAVE_AS_IT_IS,
    RG_CAVE_MIRRORED,   // left and right change places, of the drop and of the light
    RG_CAVE_OTHER_SIDE, // the light alone comes from the other side
    RG_CAVE_OTHER_DROP, // the drop alone swings to the other side
    RG_CAVE_WAYS
};

struct rg_cave_row {
    struct rg_cave_found found;
    bool flat;                        // one of the two pictures is even: there is no correlation
    double correlation[RG_CAVE_WAYS]; // of all pixels (Pearson); 0 where it is flat
    // Mean light, ours of the atlas' units, the database's in its own. 0: no factor is known.
    double ours, theirs;
};

struct rg_cave_comparison {
    int count;
    struct rg_cave_row *rows; // in the order of rg_cave_files
};

// Lays every picture of the database under a folder beside the atlas' own, at the width of the
// coarser of the two. `progress` may be NULL. False, and one logged line, when a file is not what
// it should be or there is none. The caller frees `rows`.
bool rg_cave_compare(const char *folder, const struct rg_atlas *atlas,
                     const struct rg_atlas_progress *progress,
                     struct rg_cave_comparison *comparison);

// Whether a folder has pictures of the database, as is found out before an atlas is made for them.
// False, and one logged line, where it has none or cannot be read.
bool rg_cave_has_pictures(const char *folder);

#endif
