// How a job is sampled, by what a frame of it takes: pure functions.
#ifndef RG_HARNESS_MEASURE_SAMPLING_H
#define RG_HARNESS_MEASURE_SAMPLING_H

#include <stdbool.h>

#include "harness/measure/job.h"

struct rg_sampling {
    int frames_a_sample; // so that a sample lasts long enough to be timed well
    bool has_run_up;     // a frame that is not timed comes before each
    int samples;
    double passes_ms; // the run behind them, in which passes are told apart, takes about so long
};

// Whether a frame that is not timed comes before a sample, so that what another job left in the
// caches does not slow the sample.
bool rg_sampling_has_run_up(double frame_ms);

// `window_frames` is as in struct rg_job: it holds a sample and the frame before it.
struct rg_sampling rg_sampling_of(double frame_ms, int window_frames,
                                  const struct rg_measure_options *options);

// What the samples take, in milliseconds, with the run behind them in which passes are told apart.
double rg_sampling_ms(const struct rg_sampling *sampling, double frame_ms);

#endif
