// Decides how a job is sampled from the time of a frame.
#ifndef RG_HARNESS_DEVICES_MEASURE_SAMPLING_H
#define RG_HARNESS_DEVICES_MEASURE_SAMPLING_H

#include <stdbool.h>

#include "harness/devices/measure/job.h"

struct rg_sampling {
    int frames_a_sample; // enough for a sample to be timed well
    bool has_run_up;     // an untimed frame precedes each sample
    int samples;
    double passes_ms; // limit of the run after the samples that times passes
};

// Whether the user asks for the fewest samples and timings, to try a script (RG_FEW_SAMPLES).
bool rg_sampling_few(void);

// Whether an untimed frame precedes a sample, so that another job's data in the caches does not
// slow the sample.
bool rg_sampling_has_run_up(double frame_ms);

// `window_frames` is as in struct rg_job: a window holds a sample and the frame before it.
struct rg_sampling rg_sampling_of(double frame_ms, int window_frames,
                                  const struct rg_measure_options *options);

// The time in milliseconds of the samples and of the run after them that times passes.
double rg_sampling_ms(const struct rg_sampling *sampling, double frame_ms);

#endif
