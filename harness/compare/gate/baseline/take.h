// What cells do now: for a baseline, or to be held against one.
#ifndef RG_HARNESS_COMPARE_GATE_BASELINE_TAKE_H
#define RG_HARNESS_COMPARE_GATE_BASELINE_TAKE_H

#include "harness/compare/gate/baseline/baseline.h"
#include "harness/compare/gate/run/times.h"

// --- what is the same every time ---

// Runs a cell on a device, and fills in all of a zeroed row but its times. The picture is for the
// caller to destroy; it has no texels without an outcome OK.
void rg_baseline_take(const struct rg_gate_cell *cell, struct rg_device *device,
                      struct rg_baseline_row *row, struct rg_picture *picture);

// cpu:reference, which draws what a picture should be, and is opened when it is asked first.
struct rg_truth {
    struct rg_device *device; // NULL: not yet
};
// False, and one logged line, where it does not open.
bool rg_truth_open(struct rg_truth *truth);
// Whether a device's picture of a cell is that of cpu:reference, by the tier that the device owes;
// else it ends the agreement.
bool rg_truth_holds(struct rg_truth *truth, const struct rg_gate_cell *cell,
                    const struct rg_device *device, const struct rg_picture *picture,
                    struct rg_agreement *agreement);
// False as rg_device_close is.
bool rg_truth_close(struct rg_truth *truth);

// --- times ---

// Times of cells on devices, each for itself, as harness/compare/gate/decide/course.h asks for
// them.
struct rg_lone_times {
    int side_count;
    struct rg_side *sides;       // which the launches open
    struct rg_timed_cell *cells; // one a row
    const int *side_of;          // of each row, its side
    struct rg_yardstick_room *room;
    struct rg_launches *yardsticks; // RG_YARDSTICKS: what they took before each launch
    double end_ms;                  // by rg_now_ms, when no launch is begun any more; 0: never
};
// The functions of a struct rg_quad_source; `user` is a struct rg_lone_times.
bool rg_lone_launch(int number, void *user);
bool rg_lone_take(int row, bool b_first, struct rg_quads *quads, void *user);
bool rg_lone_are_over(void *user);

#endif
