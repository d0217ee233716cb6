// The order in which tables are measured within a budget: pure functions of the measured parts and
// the times that they took.
#ifndef RG_HARNESS_TABLES_RUNS_ORDER_H
#define RG_HARNESS_TABLES_RUNS_ORDER_H

#include "core/device/device.h"
#include "harness/tables/papers/published.h"

// Priorities, first to last. A turn has one step per table, or per device of a table.
enum rg_turn {
    RG_TURN_FIRST,    // each table on the first device: its needed rows, as far as its part of the
                      // time allows
    RG_TURN_NEEDED,   // the other needed rows
    RG_TURN_CLAIMED,  // tables with claims, on one more device each
    RG_TURN_DEVICES,  // the other tables
    RG_TURN_BETTER,   // larger pictures and all samples of quick mode, measured again
    RG_TURN_ROWS,     // all rows of quick mode
    RG_TURN_VARIANTS, // all variants
    RG_TURN_WORKS,    // all works
    RG_TURN_LAST,     // on the last devices
    RG_TURNS
};
// "all rows"
const char *rg_turn_about(enum rg_turn turn);
// Whether its steps add one device each.
bool rg_turn_is_of_devices(enum rg_turn turn);
// Whether a step counts only if all of its cells are measured, because a result has the same rows
// on each device.
bool rg_turn_is_whole(enum rg_turn turn);

// The devices of a command, as bits.
struct rg_order_devices {
    unsigned all;
    unsigned first; // one of them; every table is measured on it before any is on another
    unsigned last;  // some of them, used only after everything else is measured
};

// The part of a table that is measured.
struct rg_share {
    unsigned devices; // as bits; 0: nothing
    int divisor;      // of its width and height
    // false: the fewest samples, the needed rows and variants, and the printed work
    bool all_samples, all_rows, all_variants, all_works;
};

// Progress of a table.
struct rg_standing {
    const struct rg_table *table;
    bool has_claims;
    int needed_rows, quick_rows, needed_variants, variants, works; // of the whole table
    struct rg_share share;
    int rows; // measured so far
    // Seconds per cell on each device, including preparation; 0: unknown.
    double cell_s[RG_MAX_DEVICES];
    unsigned tried[RG_TURNS]; // devices, as bits, for which a turn was tried; all bits for turns
                              // without devices
};
// The state before anything of a table is measured.
struct rg_standing rg_standing_of(const struct rg_table *table);

struct rg_step {
    int table; // index among the standings
    enum rg_turn turn;
    unsigned devices;      // those to measure
    struct rg_share share; // the table's share after the step
    int cells;             // per device, the fewest that are useful
    double expected_s;     // for these cells, from earlier times; 0: unknown
};

// Finds the next step: in the first turn that has an untried one, the step with the least expected
// or guessed time, so that a large table does not keep small ones out. False if all steps are done
// or tried. The caller marks it as tried (rg_order_tried).
bool rg_order_next(const struct rg_standing *standings, int count,
                   const struct rg_order_devices *devices, double left_s, struct rg_step *step);
void rg_order_tried(struct rg_standing *standings, const struct rg_step *step);
// A table's part of the time in the first turn: the time left, divided by the number of waiting
// tables.
double rg_order_part_s(const struct rg_standing *standings, int count, double left_s);
// Updates the times per cell: a step took `seconds` for `cells` cells per device.
void rg_order_learn(struct rg_standing *standings, int count, const struct rg_step *step, int cells,
                    double seconds);

#endif
