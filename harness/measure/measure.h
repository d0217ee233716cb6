// Measuring prepared jobs.
//
// The time is wall clock between full syncs. Jobs are visited in turn, a sample each, in an order
// that is shuffled every round, so that what disturbs the machine disturbs all alike.
#ifndef RG_HARNESS_MEASURE_MEASURE_H
#define RG_HARNESS_MEASURE_MEASURE_H

#include "harness/measure/job.h"

// Times all prepared jobs whose records are ok. Ends between two samples when it is interrupted
// (harness/console/interrupt.h), with records that are not whole.
//
// With options->share, or where it was interrupted, a record keeps the samples that were taken, and
// how many are wanted; another call takes the others, also of jobs whose sessions were closed, and
// of records that came from a file.
void rg_jobs_measure(struct rg_job *jobs, int count, const struct rg_measure_options *options);
// What that would take, in milliseconds, by the last frame of their warm-up; without opening again.
double rg_jobs_expected_ms(const struct rg_job *jobs, int count,
                           const struct rg_measure_options *options);

// Tells what each pass takes, in a run of its own that syncs after every pass, of up to ten frames:
// it ends with the one in which it has taken so long. False on failure.
bool rg_job_time_passes(struct rg_job *job, double passes_ms);
// What that takes, in milliseconds, where a frame takes so long.
double rg_passes_expected_ms(double frame_ms, double passes_ms);

#endif
