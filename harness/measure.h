// Measuring cells: a technique with parameters on a device, checked first and then timed.
//
// The time is wall clock between full syncs. Cells are visited in turn, a sample each, in an order
// that is shuffled every round, so that what disturbs the machine disturbs all alike. A cell whose
// image disagrees with the reference is never timed.
#ifndef RG_HARNESS_MEASURE_H
#define RG_HARNESS_MEASURE_H

#include "core/techniques/technique.h"
#include "harness/expected.h"
#include "harness/stats.h"

// Passes of so many names are told apart; what all others take is summed as "other".
enum { RG_MAX_CELL_PASSES = 32 };

enum rg_cell_status { RG_CELL_OK, RG_CELL_FAIL, RG_CELL_ERROR };
const char *rg_cell_status_name(enum rg_cell_status status); // "ok", "fail", ...

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
    // Found:
    struct rg_instance *instance;
    enum rg_cell_status status;
    char detail[200];      // why the status is not ok
    double create_ms;      // opening: buffers, inputs, and what the driver compiles then
    double first_frame_ms; // the first step and drawing, with what the driver compiles then
    int frames_a_sample, sample_count;
    double *samples_ms; // a frame
    struct rg_interval frame_ms;
    double api_over_wall; // the API's own clock by wall clock; trusted from 0.8 to 1.05
    int pass_count;
    struct rg_cell_pass passes[RG_MAX_CELL_PASSES]; // each name once, in the order of the frame
    // Of the first RG_CHECK_FRAMES frames:
    int counter_count;
    struct rg_counter counters[RG_MAX_COUNTERS];
    int fact_count;
    struct rg_fact facts[RG_MAX_FACTS];
};

struct rg_measure_options {
    int samples;                                       // a cell
    double sample_ms;                                  // least duration of a sample
    void (*progress)(int done, int total, void *user); // NULL: none
    void *user;
};

// Opens, checks and warms up a cell, and sets its status. A device that is no software must hold
// tier T1, by the rain mask where `expected` has the background.
void rg_cell_prepare(struct rg_cell *cell, const struct rg_expected *expected);

// Times all prepared cells whose status is ok.
void rg_cells_measure(struct rg_cell *cells, int count, const struct rg_measure_options *options);

// What all passes of a measured cell take together, in the run that syncs after every pass.
double rg_cell_passes_ms(const struct rg_cell *cell);

// Closes what prepare opened and frees the samples.
void rg_cell_close(struct rg_cell *cell);

#endif
