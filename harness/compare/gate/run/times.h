// Times of a gate's cells on both sides, as harness/compare/gate/decide/course.h asks for them.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_TIMES_H
#define RG_HARNESS_COMPARE_GATE_RUN_TIMES_H

#include "harness/compare/gate/cells/cells.h"
#include "harness/compare/gate/decide/course.h"
#include "harness/compare/gate/run/sides.h"
#include "harness/compare/gate/run/slot.h"

// A cell that is timed.
struct rg_timed_cell {
    const struct rg_gate_cell *cell;
    struct rg_slot slot;     // the same on both sides
    int side;                // whose turn it is, or was when it ended
    enum rg_outcome outcome; // why nothing more can be had of it; OK: it can
    bool is_ours;            // as of struct rg_agreement
    char why[256];
    double seconds; // that it took
};
// Ends a cell by what the last error comes to. It ran before, so that what is not there any more is
// an error, and nothing that is unsupported. False.
bool rg_timed_cell_fails(struct rg_timed_cell *timed);

struct rg_gate_times {
    struct rg_side *sides;       // RG_SIDES, which the launches open
    struct rg_timed_cell *cells; // one a row
    int cell_count;              // all of them end where a side cannot be launched
    double end_ms;               // by rg_now_ms, when no launch is begun any more; 0: never
};

// The functions of a struct rg_quad_source; `user` is a struct rg_gate_times. What disturbs them
// is time that the machine gave to others, as its kernel tells (steal in /proc/stat).
bool rg_times_launch(int number, void *user);
bool rg_times_take(int row, bool b_first, struct rg_quads *quads, void *user);
bool rg_times_are_over(void *user);

#endif
