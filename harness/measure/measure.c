#include "harness/measure/measure.h"

#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "harness/console/interrupt.h"
#include "harness/measure/calibration.h"
#include "kernels/dialect/rng.h"

// A frame that takes longer than this is not slowed by what the job before left in the caches.
#define LONG_FRAME_MS 100

// Whether a frame that is not timed comes before a sample, so that what another job left in the
// caches does not slow the sample.
static bool needs_run_up(double frame_ms)
{
    return frame_ms < LONG_FRAME_MS;
}

// The window holds a sample and the frame before it.
static int most_frames(const struct rg_job *job)
{
    return job->window_frames ? job->window_frames - 1 : 100000;
}

// Frames a sample, so that it lasts long enough to be timed well, and the number of samples.
static void calibrate(struct rg_job *job, const struct rg_measure_options *options)
{
    double ms = job->warm_frame_ms;
    if (ms < options->sample_ms && rg_job_stay_in_window(job, 4))
        ms = fmin(rg_job_time(job, 2), rg_job_time(job, 2));
    job->record->frames_a_sample =
        (int)fmin(fmax(ceil(options->sample_ms / ms), 1), most_frames(job));
    const double sample_ms = ms * (job->record->frames_a_sample + (needs_run_up(ms) ? 1 : 0));
    job->wanted_samples =
        (int)fmin(fmax(floor(options->job_ms / sample_ms), options->least_samples),
                  fmin(options->most_samples, RG_MAX_SAMPLES));
}

// Shuffled by the project's own generator, so that a run's order can be had again.
static void shuffle(int *order, int count, int round)
{
    for (int i = count - 1; i > 0; i--) {
        const uint bits = rg_random(1, (uint)i, (uint)round, 0).x;
        const int j = (int)(bits % (uint)(i + 1));
        const int kept = order[i];
        order[i] = order[j];
        order[j] = kept;
    }
}

// The last sample of a job is timed by the API's own clock, too. A device may have none.
static void take_sample(struct rg_job *job)
{
    struct rg_record *record = job->record;
    const bool is_last = record->sample_count + 1 == job->wanted_samples;
    int64_t begin, end;
    if (!rg_job_stay_in_window(job, record->frames_a_sample + 1))
        return;
    if (needs_run_up(job->warm_frame_ms))
        rg_job_time(job, 1);
    const bool has_begun = is_last && rg_session_time(job->session, &begin);
    const double ms = rg_job_time(job, record->frames_a_sample);
    if (has_begun && rg_session_time(job->session, &end))
        record->api_over_wall = (double)(end - begin) * 1e-6 / (ms * record->frames_a_sample);
    record->samples_ms[record->sample_count++] = ms;
}

// Whether a job takes a sample in this round: its own are spread evenly over all rounds.
static bool takes_turn(const struct rg_job *job, int round, int rounds)
{
    const int before = (int)((int64_t)round * job->wanted_samples / rounds);
    const int after = (int)(((int64_t)round + 1) * job->wanted_samples / rounds);
    return job->record->outcome == RG_OK && after > before;
}

static void finish(struct rg_job *job, const struct rg_calibration *calibration)
{
    rg_calibration_tell(calibration, &job->record->calibration_begin_ms,
                        &job->record->calibration_end_ms);
    if (!rg_job_time_passes(job))
        rg_record_end_by_error(job->record);
    rg_record_settle(job->record);
}

// Calibrates the jobs that can be measured, whose indices go into `order`. Returns their number.
static int calibrate_all(struct rg_job *jobs, int count, const struct rg_measure_options *options,
                         int *order)
{
    int ready = 0;
    for (int i = 0; i < count; i++) {
        if (jobs[i].record->outcome != RG_OK)
            continue;
        calibrate(&jobs[i], options);
        order[ready++] = i;
    }
    return ready;
}

void rg_jobs_measure(struct rg_job *jobs, int count, const struct rg_measure_options *options)
{
    int *order = rg_alloc((size_t)count, sizeof(int), "jobs"), rounds = 0;
    for (int i = 0; !order && i < count; i++)
        if (jobs[i].record->outcome == RG_OK)
            rg_record_end_by_error(jobs[i].record);
    const int ready = order ? calibrate_all(jobs, count, options, order) : 0;
    for (int i = 0; i < ready; i++)
        if (jobs[order[i]].wanted_samples > rounds)
            rounds = jobs[order[i]].wanted_samples;
    struct rg_calibration calibration = {.load = options->load};
    rg_calibration_take(&calibration);
    for (int round = 0; round < rounds && !rg_interrupted(); round++) {
        shuffle(order, ready, round);
        for (int i = 0; i < ready && !rg_interrupted(); i++)
            if (takes_turn(&jobs[order[i]], round, rounds))
                take_sample(&jobs[order[i]]);
        rg_calibration_take(&calibration);
        if (options->progress)
            options->progress(round + 1, rounds, options->user);
    }
    for (int i = 0; i < ready && !rg_interrupted(); i++)
        if (jobs[order[i]].record->outcome == RG_OK)
            finish(&jobs[order[i]], &calibration);
    free(order);
}
