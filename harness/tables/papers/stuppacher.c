// Stuppacher & Supan, "Rendering of Water Drops in Real-Time" (2007). The numbers are those of
// results/published/stuppacher-*.csv, which a test compares.
#include "harness/tables/papers/published.h"

// The box has six panes, each with a height map on which water moves. The paper does not say how
// many of them it simulated.
#define SIX_MAPS "six height maps are moved, one for each pane of the box"
#define OURS                                                                                       \
    {                                                                                              \
        "ours", "texels_a_pixel=1",                                                                \
            "height maps are no finer than the screen shows them, which changes the picture a "    \
            "little"                                                                               \
    }

// Table 1: frame rates of a mirror, and of glass in front of a model.
static const struct rg_table_row rows_1[] = {
    {"move=paper panes=mirror", {24, 6, 160}, "mirror"},
    {"move=paper panes=glass model=dragon", {93044, 100000, 120}, "glass with dragon"},
    {"move=paper panes=glass model=buddha", {92299, 100000, 120}, "glass with buddha"},
    {"move=paper panes=glass model=bunny", {36873, 69666, 125}, "glass with bunny"},
    {"move=paper panes=glass model=planck", {25445, 50801, 146}, "glass with planck"},
};

const struct rg_table rg_table_stuppacher_1 = {
    .id = "stuppacher-1",
    .technique = "flow",
    .about =
        "frame rate by the scene, a mirror or glass with a model (Stuppacher & Supan, table 1)",
    .hardware = "NVIDIA GeForce 7800",
    .names = "scene",
    .columns = {"vertices", "faces", "fps"},
    .variants = {{"full", "", "fps"}},
    .works = {{"paper", "", "", .reading = SIX_MAPS}, OURS},
    .width = 512,
    .height = 512,
    .row_count = 5,
    .rows = rows_1,
    .note = "Full frames in a 512x512 view (the paper does not say). The dragon, the buddha and "
            "Planck's bust are not free to ship: other models with the published numbers of faces "
            "stand in for them; the inputs above name them. A reading with one height map, as "
            "stuppacher-2 has it, shows no model, and is left out.",
};

// Table 2: frame rates with several texture resolutions, for a mirror.
static const struct rg_table_row rows_2[] = {
    {"move=paper panes=mirror resolution_px=128", {128, 480}, NULL},
    {"move=paper panes=mirror resolution_px=512", {512, 160}, NULL},
    {"move=paper panes=mirror resolution_px=1024", {1024, 65}, NULL},
};

const struct rg_table rg_table_stuppacher_2 = {
    .id = "stuppacher-2",
    .technique = "flow",
    .about = "frame rate by the height map's resolution, a mirror (Stuppacher & Supan, table 2)",
    .hardware = "NVIDIA GeForce 7800",
    .columns = {"texture_px", "fps"},
    .key_count = 1,
    .variants = {{"full", "", "fps"}},
    .works = {{"paper", "", "", .reading = SIX_MAPS},
              {"reading", "view=pane", "",
               .reading = "one height map is moved, of one pane, which fills the view"},
              OURS},
    .width = 512,
    .height = 512,
    .row_count = 3,
    .rows = rows_2,
    .note = "Full frames of a box of six mirror panes, each with a height map of this size, in a "
            "512x512 view (the paper does not say), the same seeded drops at every resolution.",
};

// The number of drops, which the paper says does not matter (section 6).
#define MIRROR "move=paper panes=mirror resolution_px=512 "
static const struct rg_table_row drops[] = {
    {MIRROR "drops=10", {10}, NULL},
    {MIRROR "drops=100", {100}, NULL},
    {MIRROR "drops=1000", {1000}, NULL},
    {MIRROR "drops=4000", {4000}, NULL},
};

const struct rg_table rg_table_stuppacher_drops = {
    .id = "stuppacher-drops",
    .technique = "flow",
    .about = "frame rate by the number of drops, a mirror (Stuppacher & Supan, section 6)",
    .columns = {"drops"},
    .key_count = 1,
    .variants = {{"full", "", NULL}},
    .works = {{"paper", "", "", .reading = SIX_MAPS}, OURS},
    .width = 512,
    .height = 512,
    .row_count = 4,
    .rows = drops,
    .note =
        "Nothing of this is in print but the sentence. Full frames as in stuppacher-2, with 512 "
        "texels; the drops of each pane at the start. As many more fall in every row.",
};
