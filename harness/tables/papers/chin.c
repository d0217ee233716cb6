// Chin, "Animating Raindrops on a Surface" (2016). The numbers are those of
// results/published/chin-timing.csv, which a test compares. The paper has one time; tables of our
// own divide it into its parts.
#include "harness/tables/papers/published.h"

enum { OFF, ON };

// The paper's program draws particles, and its trails do not break into beads.
#define VIEW "view=particles trail=hemispheres"
// Rain is so heavy that after `steps` the number of drops reaches its limit and water merges in
// every step. By the paper's rules drops at rest stay, and on a pane full of them nothing happens.
// Since water gathers, the 20 steps after these are timed.
#define PANE(picture_width, picture_height, steps)                                                 \
    .technique = "drops", .width = (picture_width), .height = (picture_height),                    \
    .check_frames = (steps), .window_frames = 20,                                                  \
    .counted = {"drops_stepped", "cells_stepped", "merging_steps"}

// Section 5: the time of a frame with the parameters of table 3.
static const struct rg_table_row timing[] = {
    {"drops_s=1500", {1000, 600, 0.5, 700, ON, ON, ON, ON, 14.8, 31.8}, NULL},
};

const struct rg_table rg_table_chin_timing = {
    PANE(1000, 600, 40),
    .id = "chin-timing",
    .about = "frame rate with the paper's parameters (Chin, section 5)",
    .hardware = "Intel Core i5-5200U, one thread",
    .columns = {"columns", "rows", "cell_mm", "max_particles", "erode", "smooth", "residual",
                "merge", "ms_per_frame_min", "ms_per_frame_max"},
    .key_count = 8,
    .has_choices = true,
    .variants = {{"full", VIEW, NULL}, {"light_rain", VIEW " drops_s=120", NULL}},
    .works = {{"paper", "sleep=off", ""},
              {"ours", "sleep=on", "tiles of the pane in which nothing changes are left out"}},
    .row_count = 1,
    .rows = timing,
    .note =
        "A frame is one step and its picture: the height map, a pixel a cell, with the drops over "
        "it, as in the paper's figure 2; timed are the 41st to the 60th, over and over, for water "
        "gathers. The paper does not say how many drops there were at 14.8 ms, and how many at "
        "31.8. In the full rain, 1500 drops a second, the pane has some 410 in these steps, and "
        "waters meet in each; light_rain, 120 a second, leaves most of the pane dry. The paper "
        "calls its program real-time, 30 frames "
        "a second on one thread; OMP_NUM_THREADS=1 measures cpu so.",
};

// The number of drops, on a pane with room for all.
#define SMALL_DROPS "columns=4000 rows=2400 critical_mass_mg=5 max_mass_mg=5 "
static const struct rg_table_row drops[] = {
    {SMALL_DROPS "max_drops=100 drops_s=600", {100}, NULL},
    {SMALL_DROPS "max_drops=1000 drops_s=6000", {1000}, NULL},
    {SMALL_DROPS "max_drops=10000 drops_s=60000", {10000}, NULL},
    {SMALL_DROPS "max_drops=30000 drops_s=180000", {30000}, NULL},
    {SMALL_DROPS "max_drops=100000 drops_s=600000", {100000}, NULL},
};

const struct rg_table rg_table_chin_drops = {
    PANE(250, 150, 20),
    .id = "chin-drops",
    .about = "frame rate by the number of drops, on a pane of 4000x2400 cells",
    .columns = {"max_drops"},
    .key_count = 1,
    .quick = "columns=1000 rows=600",
    .quick_rows = 3,
    .variants = {{"full", VIEW, NULL}},
    .row_count = 5,
    .rows = drops,
    .note = "Nothing of this is in print. Drops land with at most a twentieth of the paper's "
            "mass, so that 100,000 find room beside each other, and in rain that keeps the pane "
            "full. Where drops "
            "are few, most of the pane is dry, and is left out. Quick mode has the first three "
            "rows.",
};

// The number of cells, with the paper's number of drops for each area.
static const struct rg_table_row grid[] = {
    {"columns=250 rows=150 max_drops=44 drops_s=188", {37500, 250, 150, 44}, NULL},
    {"columns=500 rows=300 max_drops=175 drops_s=750", {150000, 500, 300, 175}, NULL},
    {"columns=1000 rows=600 max_drops=700 drops_s=3000", {600000, 1000, 600, 700}, NULL},
    {"columns=2000 rows=1200 max_drops=2800 drops_s=12000", {2400000, 2000, 1200, 2800}, NULL},
    {"columns=4000 rows=2400 max_drops=11200 drops_s=48000", {9600000, 4000, 2400, 11200}, NULL},
};

const struct rg_table rg_table_chin_grid = {
    PANE(250, 150, 30),
    .id = "chin-grid",
    .about = "frame rate by the cells of the pane, with as many drops an area",
    .columns = {"cells", "columns", "rows", "max_drops"},
    .key_count = 4,
    .quick_rows = 3,
    .variants = {{"full", VIEW, NULL}},
    .row_count = 5,
    .rows = grid,
    .note = "Nothing of this is in print; the paper says that several operations are done over "
            "the entire grid, so that a step costs the more the more cells there are (section "
            "5.1). Cells are 0.5 mm wide throughout: a larger grid is a larger pane. The small "
            "picture is the same in all rows. Quick mode has the first three.",
};

// The operations, as figure 7 switches them.
#define OPERATIONS "drops_s=1500 "
static const struct rg_table_row operations[] = {
    {OPERATIONS, {ON, ON, ON, ON}, "all"},
    {OPERATIONS "erode=off", {OFF, ON, ON, ON}, "no erosion"},
    {OPERATIONS "merge=off", {ON, OFF, ON, ON}, "no merging"},
    {OPERATIONS "residual=off", {ON, ON, OFF, ON}, "no residual drops"},
    {OPERATIONS "smooth=off", {ON, ON, ON, OFF}, "no smoothing"},
    {OPERATIONS "erode=off merge=off residual=off smooth=off", {OFF, OFF, OFF, OFF}, "none"},
};

const struct rg_table rg_table_chin_operations = {
    PANE(500, 300, 40),
    .id = "chin-operations",
    .about = "frame rate and picture with each operation switched off (Chin, figure 7)",
    .names = "operations",
    .columns = {"erode", "merge", "residual", "smooth"},
    .key_count = 4,
    .has_choices = true,
    .truth = "erode=on merge=on residual=on smooth=on",
    .quick = "columns=500 rows=300 max_drops=175 drops_s=375",
    .variants = {{"full", VIEW, NULL}},
    .row_count = 6,
    .rows = operations,
    .note =
        "The paper times no operation by itself; figure 7 shows pictures. By its text, erosion "
        "and smoothing make heights converge, merging lets regions of water move down that "
        "would stay where they are (7d and 7e), and several operations are done over the "
        "entire grid. What an operation costs is what a frame takes without it; what it does to "
        "the picture is the error.",
};
