// Times a gate's cells for harness/judge/course.h: both sides in turn, or B alone if
// A's times were taken earlier.
#ifndef RG_HARNESS_COMPARE_GATE_SIDES_TIMES_H
#define RG_HARNESS_COMPARE_GATE_SIDES_TIMES_H

#include "harness/compare/gate/cells/cells.h"
#include "harness/devices/measure/yardsticks.h"
#include "harness/judge/course.h"
#include "harness/compare/gate/sides/journal.h"
#include "harness/compare/gate/sides/sides.h"

// Times of the launches that count, in the order in which they were taken.
struct rg_launches {
    int count;
    double ms[RG_SHIFT_SAMPLES];
};

// A slot is one time of a cell: the median of several timings, each of several frames. Zeroed: not
// chosen yet.
enum { RG_SLOT_FRAMES = 1000, RG_SLOT_TIMINGS = 9 }; // at most
struct rg_slot {
    int frames, timings;
};

// A cell that is timed.
struct rg_timed_cell {
    const struct rg_gate_cell *cell;
    const char *name;                // its row's name in the journal
    struct rg_side *sides[RG_SIDES]; // A's is NULL if its times were taken earlier
    struct rg_slot slot;             // the same on both sides
    int side;                        // the side being timed, or that was when the cell ended
    enum rg_outcome outcome;         // why the cell cannot be timed any further; OK: it can
    bool is_ours;                    // as in struct rg_agreement
    bool is_over;                    // the time that is left has no room for it
    char why[256];
    double seconds; // spent on it
};
// Ends a cell with the last error. It ran before, so a device that has vanished is an error, not
// unsupported. False.
bool rg_timed_cell_fails(struct rg_timed_cell *timed);

struct rg_gate_times {
    int side_count;
    struct rg_side *sides; // sides that each launch restarts: a pair's, or all that run alone
    int cell_count;
    struct rg_timed_cell *cells;    // one per row; all of a pair end if a side cannot be launched
    double end_ms;                  // by rg_now_ms, when all has to be done; 0: no limit
    int first_look;                 // launches up to the first verdict
    struct rg_yardstick_room *room; // NULL: no yardsticks are taken
    struct rg_launches *yardsticks; // RG_YARDSTICKS of them, their times before each launch
    // Times found here by a row's name are not taken again, and new times are added; NULL: no
    // journal.
    struct rg_gate_journal *journal;
    int launch;               // number in the course
    bool is_launched, failed; // whether the sides have been launched, and whether one failed to
    double began_ms;          // when they were
    int disturbed;            // how many of the last launches in a row were
    double look_ms;           // when the first look is to be expected
};

// The functions of a struct rg_quad_source; `user` is a struct rg_gate_times. A launch is disturbed
// if the kernel reports that the machine gave time to others (steal in /proc/stat).
bool rg_times_launch(int number, void *user);
bool rg_times_take(int row, bool b_first, struct rg_quads *quads, void *user);
// Whether the time has no room for another launch, or before the first look for all up to it. This
// depends on how long launches take, and not on which side took longer.
bool rg_times_are_over(void *user);

#endif
