// Measuring cells: a technique with parameters on a device, checked first and then timed.
//
// The time is wall clock between full syncs. Cells are visited in turn, a sample each, in an order
// that is shuffled every round, so that what disturbs the machine disturbs all alike. A cell whose
// image disagrees with the reference is never timed.
#ifndef RG_HARNESS_MEASURE_MEASURE_H
#define RG_HARNESS_MEASURE_MEASURE_H

#include "core/base/outcome.h"
#include "core/techniques/technique.h"
#include "harness/measure/expected.h"
#include "harness/measure/stats.h"

// Passes of so many names are told apart; what all others take is summed as "other".
enum { RG_MAX_CELL_PASSES = 32 };

struct rg_cell_pass {
    const char *name;
    double ms; // a frame, in a run of its own that syncs after every pass
};

struct rg_cell {
    // Given:
    const struct rg_technique *technique;
    const void *settings; // not owned
    struct rg_device *device;
    int width, height; // of the image
    int check_frames;  // simulated and drawn before the image is compared, at least 1
    // Found:
    struct rg_instance *instance;
    enum rg_outcome status;
    char detail[200];      // why the status is not ok
    double create_ms;      // opening: buffers, inputs, and what the driver compiles then
    double first_frame_ms; // the first step and drawing, with what the driver compiles then
    double warm_frame_ms;  // the last frame of the warm-up
    int frames_a_sample, sample_count;
    int wanted_samples; // so many will be taken
    double *samples_ms; // a frame; owned
    struct rg_interval frame_ms;
    double api_over_wall; // the API's own clock by wall clock; trusted from 0.8 to 1.05
    int pass_frames;      // of the run in which passes are told apart
    int pass_count;
    struct rg_cell_pass passes[RG_MAX_CELL_PASSES]; // each name once, in the order of the frame
    // Of the first check_frames frames:
    int counter_count;
    struct rg_counter counters[RG_MAX_COUNTERS];
    int fact_count;
    struct rg_fact facts[RG_MAX_FACTS];
};

struct rg_measure_options {
    int most_samples, least_samples;                   // a cell
    double sample_ms;                                  // least duration of a sample
    double cell_ms;                                    // what a cell's samples may take together
    double warm_up_ms;                                 // likewise its warm-up
    void (*progress)(int done, int total, void *user); // NULL: none
    void *user;
};

// Preparing a cell is these three in turn. Each returns false when the cell cannot go on, and has
// set its status.
//
// Opens it and draws its check frames.
bool rg_cell_open(struct rg_cell *cell);
// Compares its image. A device that is no software must hold tier T1, by the rain mask where
// `expected` has the background.
bool rg_cell_check(struct rg_cell *cell, const struct rg_expected *expected);
bool rg_cell_warm_up(struct rg_cell *cell, const struct rg_measure_options *options);

// Times all prepared cells whose status is ok. Ends between two samples when it is interrupted
// (harness/console/interrupt.h), with cells that are not whole.
void rg_cells_measure(struct rg_cell *cells, int count, const struct rg_measure_options *options);

// Makes frame_ms of the samples. False, with the cell ended, without memory.
bool rg_cell_summarise(struct rg_cell *cell);

// What all passes of a measured cell take together, in the run that syncs after every pass.
double rg_cell_passes_ms(const struct rg_cell *cell);

// Ends a cell with a status other than ok, and says why. False.
bool rg_cell_end(struct rg_cell *cell, enum rg_outcome status, const char *detail);
// The same with the last error, which may be that something is unsupported.
bool rg_cell_end_by_error(struct rg_cell *cell);

// Closes its instance.
void rg_cell_close(struct rg_cell *cell);
// Frees its samples, and closes it where that has not been done.
void rg_cell_free(struct rg_cell *cell);

#endif
