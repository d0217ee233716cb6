// A baseline: what cells did on devices earlier. It has digests in place of pictures; if a digest
// differs, cpu:reference draws the true picture anew.
#ifndef RG_HARNESS_COMPARE_GATE_BASELINE_BASELINE_H
#define RG_HARNESS_COMPARE_GATE_BASELINE_BASELINE_H

#include <stdio.h>

#include "harness/judge/decide.h"
#include "harness/compare/gate/sides/alike.h"
#include "harness/compare/gate/sides/times.h"
#include "harness/record/passport/key.h"

enum { RG_BASELINE_FORMAT = 1, RG_BASELINE_LAUNCHES = RG_SHIFT_SAMPLES };

// A cell on a device.
struct rg_baseline_row {
    char cell[RG_GATE_NAME_SIZE], technique[RG_NAME_SIZE], settings[RG_DIGEST_SIZE];
    char device[RG_DEVICE_NAME_SIZE];
    enum rg_outcome outcome; // fail: its picture differed from cpu:reference's
    bool is_ours;            // as in struct rg_agreement; not in the file
    char why[RG_AGREEMENT_TEXT];
    // Filled in only if the outcome is OK or fail.
    char picture[RG_DIGEST_SIZE]; // of its texels as the device stored them
    int state_count;
    struct rg_baseline_state {
        char name[RG_NAME_SIZE], digest[RG_DIGEST_SIZE];
    } states[RG_MAX_STATE];
    struct rg_counters counters; // of all frames
    struct rg_tally work;        // of the frame after them
    struct rg_session_code code; // that ran now; not in the file
    // Filled in only if the outcome is OK.
    struct rg_slot slot;         // used for timing; zeroed: not timed
    struct rg_launches launches; // of a frame
    double seconds;              // that all of it took; 0: unknown
};

struct rg_baseline_device {
    char name[RG_DEVICE_NAME_SIZE];
    json_t *parts; // of its comparison key (harness/record/passport/key.h); owned
};

// Zeroed: an empty baseline. The owner calls rg_baseline_free.
struct rg_baseline {
    json_t *passport; // with digests of fixed functions
                      // (harness/devices/measure/serving/fixed_pairs.h); owned
    int device_count;
    struct rg_baseline_device devices[RG_MAX_DEVICES];
    struct rg_launches yardsticks[RG_YARDSTICKS]; // taken between the launches
    int64_t count, room;
    struct rg_baseline_row *rows; // the cells of one device after the other
};

// Adds a zeroed row. NULL, and one logged line, without memory.
struct rg_baseline_row *rg_baseline_add(struct rg_baseline *baseline);
// NULL if there is none.
const struct rg_baseline_row *rg_baseline_find(const struct rg_baseline *baseline, const char *cell,
                                               const char *device);
// A row's digest of a state; NULL if it has no such state.
const char *rg_baseline_state(const struct rg_baseline_row *row, const char *name);
const struct rg_baseline_device *rg_baseline_device(const struct rg_baseline *baseline,
                                                    const char *name);
void rg_baseline_free(struct rg_baseline *baseline);

// --- files: docs/records.md ---

// Reads a file. False, and one logged line with the file, the place and the remedy, if it is
// missing, damaged, of another version or no baseline.
bool rg_baseline_read(struct rg_baseline *baseline, const char *path);
// Writes it with its checksum by renaming a temporary file. False, and one logged line, on failure.
bool rg_baseline_write(const struct rg_baseline *baseline, const char *path);

// Whether the baseline's cells equal those at hand, for the devices that `devices` names (names
// with commas; NULL or "all": all). Else logs one line with both files; `cells_name` names the
// cells at hand. Also false, with a line, if a device with variables (an '@') would run that
// `devices` does not name.
bool rg_baseline_fits(const struct rg_baseline *baseline, const char *path,
                      const struct rg_gate_cells *cells, const char *cells_name,
                      const char *devices);
// Whether `devices` includes a device.
bool rg_baseline_asks(const char *devices, const char *device);

// --- times of a row ---

// The sample for a decision.
struct rg_gate_sample rg_baseline_sample(const struct rg_launches *launches);
double rg_launches_median(const struct rg_launches *launches);
// The spread of launches: a robust relative standard deviation; 0.05 is 5 %.
double rg_baseline_scatter(const struct rg_launches *launches);

// --- running cells ---

// Runs a cell on a device and fills in all of a zeroed row but its times. The caller destroys the
// picture, which has texels only if the outcome is OK.
void rg_baseline_take(const struct rg_gate_cell *cell, struct rg_device *device,
                      struct rg_baseline_row *row, struct rg_picture *picture);

// cpu:reference, which draws the true pictures; opened on first use.
struct rg_truth {
    struct rg_device *device; // NULL: not opened yet
    // The host's libraries that are others than the baseline's (rg_key_libraries); "": none
    char libraries[RG_KEY_TEXT];
};
// False, and one logged line, if it cannot be opened.
bool rg_truth_open(struct rg_truth *truth);
// Whether a device's picture of a cell matches cpu:reference's by the tier that the device owes;
// else it ends the agreement.
bool rg_truth_holds(struct rg_truth *truth, const struct rg_gate_cell *cell,
                    struct rg_device *device, const struct rg_picture *picture,
                    struct rg_agreement *agreement);
// Closes it; false as for rg_device_close.
bool rg_truth_close(struct rg_truth *truth);

// --- making a baseline, and comparing it with the one that it replaces ---

struct rg_baseline_request {
    const struct rg_gate_cells *cells;
    int launches; // of each device, to time each cell; 0: nothing is timed
};

// What failed beside the rows, which tell their own failures.
struct rg_baseline_making {
    bool has_failed; // a device was closed badly, or failed a fixed function
    bool is_lacking; // raingauge itself lacked what a fixed function needs: the digest is not kept
};
// Runs all cells on all devices, which it closes, into a zeroed baseline. False, and one logged
// line, if it cannot be made or the user interrupts. The baseline is complete unless it is lacking.
bool rg_baseline_make(const struct rg_baseline_request *request, struct rg_devices *devices,
                      struct rg_baseline *baseline, struct rg_baseline_making *making);

// Prints one line per cell that has changed from `then` to `now`, and returns their number. Times
// have changed if a gate of the same cells would say so.
int rg_baseline_print_changes(const struct rg_baseline *then, const struct rg_baseline *now,
                              FILE *out);

#endif
