// What cells did on devices, kept for later: a baseline. It holds no picture: a picture has a
// digest there, and where that is another, cpu:reference draws anew what it should be.
#ifndef RG_HARNESS_COMPARE_GATE_BASELINE_BASELINE_H
#define RG_HARNESS_COMPARE_GATE_BASELINE_BASELINE_H

#include <stdio.h>

#include "harness/compare/gate/decide/decide.h"
#include "harness/compare/gate/sides/alike.h"
#include "harness/compare/gate/sides/times.h"

enum { RG_BASELINE_FORMAT = 1, RG_BASELINE_LAUNCHES = RG_SHIFT_SAMPLES };

// A cell on a device.
struct rg_baseline_row {
    char cell[RG_GATE_NAME_SIZE], technique[RG_NAME_SIZE], settings[RG_DIGEST_SIZE];
    char device[RG_DEVICE_NAME_SIZE];
    enum rg_outcome outcome; // fail: its picture was not that of cpu:reference
    bool is_ours;            // as of struct rg_agreement; not kept
    char why[RG_AGREEMENT_TEXT];
    // Without an outcome OK or fail, nothing of what follows.
    char picture[RG_DIGEST_SIZE]; // its texels as the device had them
    int state_count;
    struct rg_baseline_state {
        char name[RG_NAME_SIZE], digest[RG_DIGEST_SIZE];
    } states[RG_MAX_STATE];
    struct rg_counters counters; // of all frames
    struct rg_tally work;        // of the frame behind them
    struct rg_session_code code; // that ran now; a file has none
    // Without an outcome OK, nothing of what follows.
    struct rg_slot slot;         // that was timed; zeroed: none was
    struct rg_launches launches; // of a frame
};

struct rg_baseline_device {
    char name[RG_DEVICE_NAME_SIZE];
    json_t *parts; // of its comparison key (harness/record/passport/key.h); owned
};

// Zeroed: none. The owner calls rg_baseline_free.
struct rg_baseline {
    json_t *passport; // owned
    int device_count;
    struct rg_baseline_device devices[RG_MAX_DEVICES];
    struct rg_launches yardsticks[RG_YARDSTICKS]; // taken between the launches
    int64_t count, room;
    struct rg_baseline_row *rows; // each device's cells
};

// Room for one more, zeroed. NULL, and one logged line, without memory.
struct rg_baseline_row *rg_baseline_add(struct rg_baseline *baseline);
// NULL where there is none.
const struct rg_baseline_row *rg_baseline_find(const struct rg_baseline *baseline, const char *cell,
                                               const char *device);
const struct rg_baseline_device *rg_baseline_device(const struct rg_baseline *baseline,
                                                    const char *name);
void rg_baseline_free(struct rg_baseline *baseline);

// --- as a file: docs/records.md ---

// Reads it. False, and one logged line that names the file, the place and the mend, where it is
// missing, damaged, another version's or no baseline.
bool rg_baseline_read(struct rg_baseline *baseline, const char *path);
// Writes it, with its checksum, by a temporary file that is renamed. False, and one logged line.
bool rg_baseline_write(const struct rg_baseline *baseline, const char *path);

// Whether its cells and those at hand are the same, of those devices that `devices` names (names
// with commas; NULL or "all": all). Else one line is logged, which names both files: `cells_name`
// is what the cells at hand are called. So is one where it would run a device with variables (an
// '@') that `devices` does not name.
bool rg_baseline_fits(const struct rg_baseline *baseline, const char *path,
                      const struct rg_gate_cells *cells, const char *cells_name,
                      const char *devices);
// Whether `devices` has a device.
bool rg_baseline_asks(const char *devices, const char *device);

// --- what is done with two ---

// A sample for a decision.
struct rg_gate_sample rg_baseline_sample(const struct rg_launches *launches);
double rg_launches_median(const struct rg_launches *launches);
// By how much a launch scatters: the standard deviation, by the median, robustly; 0.05 is 5 %.
double rg_baseline_scatter(const struct rg_launches *launches);

// --- what cells do now ---

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

// --- one is made, and held against the one that is to be replaced ---

struct rg_baseline_request {
    const struct rg_gate_cells *cells;
    int launches; // of each device, that time each cell; 0: nothing is timed
};

// Runs all cells on all devices, which it closes, into a zeroed baseline. False, and one logged
// line, where it cannot be made, or the user interrupts. `clean` is false where a device was closed
// badly, which takes nothing from the baseline.
bool rg_baseline_make(const struct rg_baseline_request *request, struct rg_devices *devices,
                      struct rg_baseline *baseline, bool *clean);

// Prints what is another in `now` than in `then`, a line a cell. Returns how many lines that were.
// Times are another where a gate of the same cells would find it.
int rg_baseline_print_changes(const struct rg_baseline *then, const struct rg_baseline *now,
                              FILE *out);

#endif
