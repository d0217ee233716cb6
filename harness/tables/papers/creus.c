// Creus, "Real-time realistic rain rendering" (2010), chapter 5. The numbers are those of
// results/published/creus-*.csv, which a test compares.
#include "harness/tables/papers/published.h"

// The thesis has the database's drops, of one size, and one splash for all surfaces, and draws thin
// streaks if they cover a pixel's middle.
#define POINTS                                                                                     \
    "spectrum=off swings=database thin_streaks=points splash_materials=off splash_up=vertical "    \
    "splash_s=0.15 splash_width_mm=40 splash_gain=0.35 splash_opacity=0.35 splash_light=matt "     \
    "splash_fade=0 far_layers=0"

// The thesis's machine and view.
#define RAIN                                                                                       \
    .technique = "streaks", .hardware = "Intel Core 2 Duo 3 GHz with NVIDIA GeForce GTX 280",      \
    .width = 1280, .height = 720, .check_frames = 2,                                               \
    .quick = "atlas=small city=small depth_map_px=2048", .smaller = {"sparse=16", "sparse=4"}
#define TIMED                                                                                      \
    RAIN, .variants = {{"full", POINTS, "fps"},                                                    \
                       {"no_geometry", POINTS " geometry=off", "fps_no_geometry"}}

// The thesis draws whole packets. It gives two different numbers of textures for a light.
#define WORKS                                                                                      \
    .works = {                                                                                     \
        {"paper", "blocks=all taps=2", "", .reading = "two textures a light (section 4.4.2)"},     \
        {"reading", "blocks=all taps=4", "", .reading = "four textures a light (section 5.2.4)"},  \
        {"ours", "blocks=seen taps=2",                                                             \
         "of the packets, only those blocks of 32 particles are drawn that the view sees"}}

// Errors show the limits at which rain is cut, and whole packets would reach beyond them.
#define LIMITED "sparse=1 cull=exact"

// Table 5.1: sizes of the atlases' levels.
static const struct rg_table_row rows_5_1[] = {
    {"", {0, 32, 3606}, "environment"}, {"", {1, 16, 1803}, "environment"},
    {"", {2, 8, 901}, "environment"},   {"", {3, 4, 450}, "environment"},
    {"", {4, 2, 225}, "environment"},   {"", {5, 1, 112}, "environment"},
    {"", {6, 1, 56}, "environment"},    {"", {7, 1, 28}, "environment"},
    {"", {8, 1, 14}, "environment"},    {"", {9, 1, 7}, "environment"},
    {"", {10, 1, 3}, "environment"},    {"", {11, 1, 1}, "environment"},
    {"", {0, 2880, 3606}, "point"},     {"", {1, 1440, 1803}, "point"},
    {"", {2, 720, 901}, "point"},       {"", {3, 360, 450}, "point"},
    {"", {4, 180, 225}, "point"},       {"", {5, 90, 112}, "point"},
    {"", {6, 45, 56}, "point"},         {"", {7, 22, 28}, "point"},
    {"", {8, 11, 14}, "point"},         {"", {9, 5, 7}, "point"},
    {"", {10, 2, 3}, "point"},          {"", {11, 1, 1}, "point"},
};

const struct rg_table rg_table_creus_5_1 = {
    RAIN,
    .id = "creus-5.1",
    .about = "sizes of the streak atlases, level by level (Creus, table 5.1)",
    .names = "atlas",
    .columns = {"level", "width_px", "height_px"},
    .key_count = 1,
    .variants = {{"full", "spectrum=off geometry=off", NULL}},
    .is_of_textures = true,
    .row_count = 24,
    .rows = rows_5_1,
    .note = "Each atlas is an image of ten layers, one an oscillation.",
};

// Table 5.2: sizes of a splash frame's levels.
static const struct rg_table_row rows_5_2[] = {
    {"", {0, 48, 32}, "splash"}, {"", {1, 24, 16}, "splash"}, {"", {2, 12, 8}, "splash"},
    {"", {3, 6, 4}, "splash"},   {"", {4, 3, 2}, "splash"},   {"", {5, 1, 1}, "splash"},
};

const struct rg_table rg_table_creus_5_2 = {
    RAIN,
    .id = "creus-5.2",
    .about = "sizes of the splash frames, level by level (Creus, table 5.2)",
    .columns = {"level", "width_px", "height_px"},
    .key_count = 1,
    .variants = {{"full", "spectrum=off geometry=off", NULL}},
    .is_of_textures = true,
    .row_count = 6,
    .rows = rows_5_2,
    .note = "The animation is an image of 21 layers, one a frame.",
};

// Table 5.3: the local space's height, for two cameras. The last row of each has the whole rain
// space.
#define FIRST  "camera=first local_height_m="
#define SECOND "camera=second local_height_m="
static const struct rg_table_row rows_5_3[] = {
    {FIRST "5", {5, 1, 13744500, 430116, 37, 56}, NULL},
    {FIRST "10", {10, 1, 27489100, 426718, 35, 51}, NULL},
    {FIRST "15", {15, 1, 41233600, 518903, 32, 44}, NULL},
    {FIRST "20", {20, 1, 54978100, 776864, 25, 32}, NULL},
    {FIRST "25", {25, 1, 68722700, 987093, 21, 26}, NULL},
    {FIRST "30", {30, 1, 82467200, 1117591, 20, 24}, NULL},
    {FIRST "35", {35, 1, 96211700, 1218490, 18, 22}, NULL},
    {FIRST "40", {40, 1, 109956000, 1534222, 15, 18}, NULL},
    {FIRST "230", {230, 1, 625231000, 7612526, 4, 4.2}, NULL},
    {SECOND "5", {5, 2, 13744500, 643442, 33, 44}, NULL},
    {SECOND "10", {10, 2, 27489100, 472634, 36, 49}, NULL},
    {SECOND "15", {15, 2, 41233600, 786653, 28, 35}, NULL},
    {SECOND "20", {20, 2, 54978100, 985408, 23.5, 28}, NULL},
    {SECOND "25", {25, 2, 68722700, 1200496, 20.5, 24}, NULL},
    {SECOND "30", {30, 2, 82467200, 1426966, 18, 21}, NULL},
    {SECOND "35", {35, 2, 96211700, 1611413, 16.5, 18.5}, NULL},
    {SECOND "40", {40, 2, 109956000, 1956267, 13.5, 15}, NULL},
    {SECOND "230", {230, 2, 625231000, 10307565, 3, 3}, NULL},
};

const struct rg_table rg_table_creus_5_3 = {
    TIMED,
    WORKS,
    .id = "creus-5.3",
    .about = "frame rate by the local space's height, with two cameras (Creus, table 5.3)",
    .columns = {"local_height_m", "camera", "total_particles", "particles", "fps",
                "fps_no_geometry"},
    .key_count = 2,
    // Blocks do not change the picture, so both works share the truth.
    .truth = "limits=off blocks=seen",
    .shown = LIMITED,
    .row_count = 18,
    .rows = rows_5_3,
    .note = "Particles are those of the packets that a frame draws; total_particles those of the "
            "whole local space. The culling radius is 20 m in all rows.",
};

// Table 5.4: the culling radius.
static const struct rg_table_row rows_5_4[] = {
    {"culling_radius_m=5", {5, 70303, 60, 200}, NULL},
    {"culling_radius_m=10", {10, 198818, 53, 100}, NULL},
    {"culling_radius_m=15", {15, 395778, 40, 60}, NULL},
    {"culling_radius_m=20", {20, 784812, 27, 37}, NULL},
    {"culling_radius_m=25", {25, 1204536, 20, 25}, NULL},
    {"culling_radius_m=30", {30, 1659172, 16, 18}, NULL},
    {"culling_radius_m=35", {35, 2190468, 12.5, 14}, NULL},
    {"culling_radius_m=40", {40, 3133179, 9, 10}, NULL},
};

const struct rg_table rg_table_creus_5_4 = {
    TIMED,
    WORKS,
    .id = "creus-5.4",
    .about = "frame rate by the culling radius (Creus, table 5.4)",
    .columns = {"culling_radius_m", "particles", "fps", "fps_no_geometry"},
    .key_count = 1,
    // Without limits the radius has no effect, and blocks do not change the picture, so all rows
    // and works share the truth.
    .truth = "limits=off culling_radius_m=20 blocks=seen",
    .shown = LIMITED,
    .row_count = 8,
    .rows = rows_5_4,
    .note = "Particles are those of the packets that a frame draws. The local space is 20 m high; "
            "the first camera (the thesis does not say which).",
};

// Table 5.5: particles in a packet.
static const struct rg_table_row rows_5_5[] = {
    {"camera=second packet_size=100", {100, 895322, 22.5, 32}, NULL},
    {"camera=second packet_size=1000", {1000, 938875, 28, 36}, NULL},
    {"camera=second packet_size=5000", {5000, 938875, 26.5, 34}, NULL},
    {"camera=second packet_size=25000", {25000, 934112, 26.5, 33.5}, NULL},
    {"camera=second packet_size=50000", {50000, 999467, 25.5, 32}, NULL},
    {"camera=second packet_size=100000", {100000, 1055737, 24, 29.5}, NULL},
    {"camera=second packet_size=150000", {150000, 981267, 24.5, 33}, NULL},
    {"camera=second packet_size=200000", {200000, 1190512, 22.2, 30}, NULL},
    {"camera=second packet_size=250000", {250000, 2532449, 11.5, 13}, NULL},
    {"camera=second packet_size=500000", {500000, 3787474, 7, 7.5}, NULL},
    {"camera=second packet_size=1000000", {1000000, 5094436, 5, 5}, NULL},
};

const struct rg_table rg_table_creus_5_5 = {
    TIMED,
    WORKS,
    .id = "creus-5.5",
    .about = "frame rate by the particles of a packet (Creus, table 5.5)",
    .columns = {"packet_size", "particles", "fps", "fps_no_geometry"},
    .key_count = 1,
    .truth = "limits=off blocks=seen",
    .shown = "sparse=1",
    .row_count = 11,
    .rows = rows_5_5,
    .note = "Particles are those of the packets that a frame draws. The second camera, whose "
            "number of particles is nearest (the thesis does not say which). No place in a street "
            "gives the numbers of rows 7, 8, 10 and 11, which draw 1.56, 1.82, 0.57 and 0.59 times "
            "as many particles as printed.",
};

// Table 5.6: lights.
static const struct rg_table_row rows_5_6[] = {
    {"camera=second lights=1", {1, 1057872, 21.6, 24.5}, NULL},
    {"camera=second lights=2", {2, 1057872, 12.5, 13.7}, NULL},
    {"camera=second lights=3", {3, 1057872, 8.8, 8.8}, NULL},
    {"camera=second lights=4", {4, 1057872, 4.5, 4}, NULL},
    {"camera=second lights=5", {5, 1057872, 1.66, 1.36}, NULL},
    {"camera=second lights=6", {6, 1057872, 1.51, 1.34}, NULL},
};

const struct rg_table rg_table_creus_5_6 = {
    TIMED,
    WORKS,
    .id = "creus-5.6",
    .about = "frame rate by the number of lights (Creus, table 5.6)",
    .columns = {"lights", "particles", "fps", "fps_no_geometry"},
    .key_count = 1,
    .truth = "limits=off blocks=seen",
    .shown = "sparse=1",
    .row_count = 6,
    .rows = rows_5_6,
    .note = "Particles are those of the packets that a frame draws. The second camera, whose "
            "number of particles is nearest (the thesis does not say which).",
};

// Ways of packing, and bounds of the selection. Without packets all 55 million particles are drawn.
static const struct rg_table_row rows_packets[] = {
    {"camera=second packets=grid", {0}, "grid"},
    {"camera=second packets=quad", {0}, "quad-tree"},
    {"camera=second packets=kd", {0}, "kd-tree"},
};

const struct rg_table rg_table_creus_packets = {
    .technique = "streaks",
    .width = 1280,
    .height = 720,
    .check_frames = 2,
    .quick = "atlas=small city=small depth_map_px=2048",
    .smaller = {"sparse=16", "sparse=4"},
    .id = "creus-packets",
    .about = "frame rate by the way of packing, and the bounds of selection (Creus, section 4.3.3)",
    .names = "packets",
    .variants = {{"rect", POINTS " blocks=all taps=2 select=rect", NULL},
                 {"hull", POINTS " blocks=all taps=2 select=hull", NULL}},
    .row_count = 3,
    .rows = rows_packets,
    .note =
        "Nothing of this is in print. The thesis takes the way with the fewest packets, which is "
        "the grid here (231, 2,124 and 2,048), and selects them by the rectangles around view and "
        "culling radius (rect); their convex hulls are its future work (hull).",
};
