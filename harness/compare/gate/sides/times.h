// Times of a gate's cells, as harness/compare/gate/decide/course.h asks for them: on both sides in
// turn, or on B alone where A's were taken earlier.
#ifndef RG_HARNESS_COMPARE_GATE_SIDES_TIMES_H
#define RG_HARNESS_COMPARE_GATE_SIDES_TIMES_H

#include "harness/compare/gate/cells/cells.h"
#include "harness/compare/gate/decide/course.h"
#include "harness/compare/gate/sides/journal.h"
#include "harness/compare/gate/sides/sides.h"
#include "harness/measure/yardsticks.h"

// Times of launches that count, in the order in which they were taken.
struct rg_launches {
    int count;
    double ms[RG_SHIFT_SAMPLES];
};

// One time of a cell is a slot, in whatever order a gate takes several: so many timings, of so many
// frames each, of which the median counts. Zeroed: not settled yet.
enum { RG_SLOT_FRAMES = 1000, RG_SLOT_TIMINGS = 9 }; // at most
struct rg_slot {
    int frames, timings;
};

// A cell that is timed.
struct rg_timed_cell {
    const struct rg_gate_cell *cell;
    const char *name;                // of its row in the journal
    struct rg_side *sides[RG_SIDES]; // A's is NULL where its times were taken earlier
    struct rg_slot slot;             // the same on both sides
    int side;                        // whose turn it is, or was when it ended
    enum rg_outcome outcome;         // why nothing more can be had of it; OK: it can
    bool is_ours;                    // as of struct rg_agreement
    char why[256];
    double seconds; // that it took
};
// Ends a cell by what the last error comes to. It ran before, so that what is not there any more is
// an error, and nothing that is unsupported. False.
bool rg_timed_cell_fails(struct rg_timed_cell *timed);

struct rg_gate_times {
    int side_count;
    struct rg_side *sides; // which the launches start anew: those of a pair, or any that run
                           // alone
    int cell_count;
    struct rg_timed_cell *cells;    // one a row; all of a pair end where a side cannot be launched
    double end_ms;                  // by rg_now_ms, when no launch is begun any more; 0: never
    struct rg_yardstick_room *room; // NULL: no yardsticks are taken
    struct rg_launches *yardsticks; // RG_YARDSTICKS: what they took before each launch
    // What is kept is not timed again, and what is timed is kept, by the rows' names; NULL:
    // nothing.
    struct rg_gate_journal *journal;
    int launch;               // the course's
    bool is_launched, failed; // the sides are, or cannot be
};

// The functions of a struct rg_quad_source; `user` is a struct rg_gate_times. What disturbs them
// is time that the machine gave to others, as its kernel tells (steal in /proc/stat).
bool rg_times_launch(int number, void *user);
bool rg_times_take(int row, bool b_first, struct rg_quads *quads, void *user);
bool rg_times_are_over(void *user);

#endif
