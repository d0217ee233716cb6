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
extern const struct rg_turn_row {
    const char *about; // "all rows"
    bool of_devices;   // its steps add one device each
    bool
        is_whole; // a step counts only with all of its cells: a result has the same rows everywhere
} rg_turns[RG_TURNS];

// The part of a table that is measured.
struct rg_share {
    unsigned devices;                          // as bits; 0: nothing
    int divisor;                               // of its width and height
    bool all_samples, all_variants, all_works; // false: the fewest, the needed, the printed one
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
    unsigned tried[RG_TURNS]; // devices for which a turn was tried; all for turns without devices
};
// The state before anything of a table is measured.
struct rg_standing rg_standing_of(const struct rg_table *table);

// The tables and devices of a command; devices are bits.
struct rg_order {
    struct rg_standing *tables;
    int count;
    unsigned all;
    unsigned first; // one of them; every table is measured on it before any is on another
    unsigned last;  // some of them, used only after everything else is measured
};

struct rg_step {
    int table; // index
    enum rg_turn turn;
    unsigned devices;      // those to measure
    struct rg_share share; // the table's share after the step
    int cells;             // per device, the fewest that are useful
    double expected_s;     // for these cells, from earlier times; 0: unknown
    double part_s;         // seconds of the time left that the step's rows may take
};

// Takes the next step, which counts as tried from then on. It is in the first turn that has an
// untried one. Among these it has the least expected or guessed time, so that a large table does
// not keep small ones out. False if all steps were tried.
bool rg_order_next(struct rg_order *order, double left_s, struct rg_step *step);
// Updates the times per cell: a step took `seconds` for `cells` cells per device.
void rg_order_learn(struct rg_order *order, const struct rg_step *step, int cells, double seconds);

#endif
