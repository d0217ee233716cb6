// Measures prepared jobs.
//
// Times are wall clock between full syncs. Each round takes one sample of every job, in a newly
// shuffled order, so that disturbances of the machine affect all alike.
#ifndef RG_HARNESS_DEVICES_MEASURE_MEASURE_H
#define RG_HARNESS_DEVICES_MEASURE_MEASURE_H

#include "harness/devices/measure/job.h"

// Times all prepared jobs whose records are ok. An interruption (harness/console/interrupt.h) ends
// it between two samples, with incomplete records.
//
// With options->share, or after an interruption, a record keeps its samples and the number wanted.
// Another call takes the rest, even for jobs whose sessions were closed, and for records read from
// a file.
void rg_jobs_measure(struct rg_job *jobs, int count, const struct rg_measure_options *options);
// The expected duration of that call in milliseconds, from the last frame of each warm-up. It
// includes sessions that are opened anew for windows of frames, but not reopening closed ones.
double rg_jobs_expected_ms(const struct rg_job *jobs, int count,
                           const struct rg_measure_options *options);

// Times each pass in a separate run that syncs after every pass: up to ten frames, and no more
// after `passes_ms`. False on failure.
bool rg_job_time_passes(struct rg_job *job, double passes_ms);
// The expected duration of that run, in milliseconds.
double rg_passes_expected_ms(double frame_ms, double passes_ms);

#endif
