// In which order tables are measured until a time is over: pure functions of what is measured, and
// of what that took.
#ifndef RG_HARNESS_TABLES_RUNS_ORDER_H
#define RG_HARNESS_TABLES_RUNS_ORDER_H

#include "core/device/device.h"
#include "harness/tables/papers/published.h"

// What comes first. A turn has a step for each table, or for each device of a table.
enum rg_turn {
    RG_TURN_FIRST,    // each table on the first device: its needed rows, as far as its part of the
                      // time goes
    RG_TURN_NEEDED,   // the other needed rows
    RG_TURN_CLAIMED,  // tables that claims are about, each on one device more
    RG_TURN_DEVICES,  // the other tables
    RG_TURN_BETTER,   // larger pictures and all samples of quick mode, measured anew
    RG_TURN_ROWS,     // all rows of quick mode
    RG_TURN_VARIANTS, // all variants
    RG_TURN_WORKS,    // all works
    RG_TURN_LAST,     // on the last devices
    RG_TURNS
};
// "all rows"
const char *rg_turn_about(enum rg_turn turn);
// Whether a step of it is a device more.
bool rg_turn_is_of_devices(enum rg_turn turn);
// Whether a step of it is worth nothing unless all of its cells are measured: a result has the same
// rows on each device.
bool rg_turn_is_whole(enum rg_turn turn);

// The devices of a command, a bit each.
struct rg_order_devices {
    unsigned all;
    unsigned first; // one of them, on which each table is measured before any is on another
    unsigned last;  // some of them, which come when all else is measured
};

// What of a table is measured.
struct rg_share {
    unsigned devices;                                    // a bit each; 0: nothing
    int divisor;                                         // of its width and height
    bool all_samples, all_rows, all_variants, all_works; // else the fewest, those that are needed,
                                                         // and the work that was printed
};

// How far a table is.
struct rg_standing {
    const struct rg_table *table;
    bool has_claims;
    int needed_rows, quick_rows, needed_variants, variants, works; // that it has
    struct rg_share share;
    int rows; // that are measured
    // What a cell took on each device, with what was made for it, in seconds; 0: nobody knows.
    double cell_s[RG_MAX_DEVICES];
    unsigned tried[RG_TURNS]; // devices for which a turn was tried, or all bits
};
// A table of which nothing is measured.
struct rg_standing rg_standing_of(const struct rg_table *table);

struct rg_step {
    int table; // among the standings
    enum rg_turn turn;
    unsigned devices;      // that are measured
    struct rg_share share; // what there is once it is done
    int cells;             // a device, the least that is worth having
    double expected_s;     // that these take, by what was measured so far; 0: nobody knows
};

// The next step that was not tried: of the first turn that has one, of which the one that is
// expected to take least, or looks so, so that a large table keeps no small one out. False where
// all is measured, or was tried. The caller marks it as tried (rg_order_tried).
bool rg_order_next(const struct rg_standing *standings, int count,
                   const struct rg_order_devices *devices, double left_s, struct rg_step *step);
void rg_order_tried(struct rg_standing *standings, const struct rg_step *step);
// What a table's part of the time is, in the first turn: what is left, by those that wait for it.
double rg_order_part_s(const struct rg_standing *standings, int count, double left_s);
// Learns what cells take: a step took so long for so many cells a device.
void rg_order_learn(struct rg_standing *standings, int count, const struct rg_step *step, int cells,
                    double seconds);

#endif
