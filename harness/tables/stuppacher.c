// Stuppacher & Supan, "Rendering of Water Drops in Real-Time" (2007). The numbers are those of
// results/published/stuppacher-*.csv, which a test compares.
#include "harness/tables/tables.h"

// Table 2: frame rates with different texture resolutions, a mirror.
static const struct rg_table_row rows_2[] = {
    {"128 x 128", "resolution_px=128", 128, 480},
    {"512 x 512", "resolution_px=512", 512, 160},
    {"1024 x 1024", "resolution_px=1024", 1024, 65},
};

const struct rg_table rg_table_stuppacher_2 = {
    .id = "stuppacher-2",
    .technique = "flow",
    .about = "frame rate by the height map's resolution, a mirror (Stuppacher & Supan, table 2)",
    .hardware = "NVIDIA GeForce 7800",
    .axis = "texture_px",
    .width = 512,
    .height = 512,
    .row_count = 3,
    .rows = rows_2,
    .note = "Full frames: sources, movement, blur, normals, lighting of one mirror pane that fills "
            "a 512x512 view (the paper does not say), the same seeded drops at every resolution.",
};
