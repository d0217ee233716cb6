// Ye, "Raining Simulation based on Improved Particle Systems algorithms". The paper prints no
// numbers: the table is ours, and tests its claims by measurement.
#include "harness/tables/papers/published.h"

#define RAIN        "geometry=off "
#define TRADITIONAL "system=traditional "

static const struct rg_table_row particles[] = {
    {RAIN "particles=1000", {1000}, NULL},       {RAIN "particles=10000", {10000}, NULL},
    {RAIN "particles=100000", {100000}, NULL},   {RAIN "particles=1000000", {1000000}, NULL},
    {RAIN "particles=4000000", {4000000}, NULL},
};

const struct rg_table rg_table_ye_1 = {
    .technique = "shower",
    .width = 1280,
    .height = 720,
    .check_frames = 5,
    .counted = {"particles_drawn", "particles_born", "particles_promoted"},
    .id = "ye-1",
    .about = "frame rate by the number of particles, of both systems and of each improvement alone",
    .columns = {"particles"},
    .key_count = 1,
    .quick = "geometry=off",
    .quick_rows = 2,
    .variants = {{"traditional", TRADITIONAL, NULL},
                 {"heap", TRADITIONAL "renewal=heap", NULL},
                 {"state", TRADITIONAL "state=compact", NULL},
                 {"segments", TRADITIONAL "shape=segments", NULL},
                 {"point", TRADITIONAL "crop=point", NULL},
                 {"uniform", TRADITIONAL "motion=uniform", NULL},
                 {"promotion", TRADITIONAL "renewal=promotion", NULL},
                 {"layers", TRADITIONAL "layers=on", NULL},
                 {"improved", "system=improved", NULL},
                 {"improved_city", "system=improved geometry=on", NULL}},
    .row_count = 5,
    .rows = particles,
    .note =
        "Nothing of this is in print: the paper says that its improvements make rain \"much "
        "faster\", and gives no number. traditional is its section II, improved its "
        "section III; between them stand the traditional system with one improvement each: place "
        "and speed alone (state), line segments, the test of a point, uniform motion, promotion, "
        "and layers of depth, which are there for the eye and not for speed. heap is the "
        "traditional system with particles that one thread of the host allocates and frees, "
        "whatever the device, which then draws them. All but improved_city are without geometry. "
        "Quick mode has the first two rows, and leaves "
        "the city out of improved_city.",
};
