#include "harness/devices/measure/measure.h"

#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/devices/measure/calibration.h"
#include "harness/devices/measure/sampling.h"
#include "harness/devices/workers/device.h"
#include "kernels/dialect/rng.h"

// Decides how the job is sampled. Samples from an earlier visit or run have the same length.
static void calibrate(struct rg_job *job, const struct rg_measure_options *options)
{
    double ms = job->warm_frame_ms;
    if (job->record->wanted_samples)
        return;
    if (ms < options->sample_ms && rg_job_be_ready(job, 4))
        ms = fmin(rg_job_time(job, 2), rg_job_time(job, 2));
    if (rg_interrupted()) // fewer frames were run than asked for
        return;
    const struct rg_sampling sampling = rg_sampling_of(ms, job->window_frames, options);
    job->record->frames_a_sample = sampling.frames_a_sample;
    job->record->wanted_samples = sampling.samples;
}

// Shuffled by the project's own generator, so that the order is reproducible.
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

// Reads the API's clock. A device may lack one; one that has it and cannot read it fails.
static bool tell_time(struct rg_job *job, int64_t *time_ns)
{
    if (rg_session_time(job->session, time_ns))
        return true;
    const struct rg_failure failure = rg_failure_take();
    if (failure.outcome != RG_UNSUPPORTED)
        rg_record_end(job->record, failure.outcome, failure.line);
    return false;
}

// Takes a sample; the job's last one is also timed by the API's clock.
static void take_sample(struct rg_job *job)
{
    struct rg_record *record = job->record;
    const bool is_last = record->sample_count + 1 == record->wanted_samples;
    int64_t begin, end;
    if (!rg_job_be_ready(job, record->frames_a_sample + 1))
        return;
    if (rg_sampling_has_run_up(job->warm_frame_ms))
        rg_job_time(job, 1);
    const bool has_begun = is_last && tell_time(job, &begin);
    if (record->outcome != RG_OK)
        return;
    const double ms = rg_job_time(job, record->frames_a_sample);
    if (rg_interrupted()) // it may have fewer frames
        return;
    if (has_begun && tell_time(job, &end))
        record->api_over_wall =
            ((double)end - (double)begin) * 1e-6 / (ms * record->frames_a_sample);
    record->samples_ms[record->sample_count++] = ms;
}

// Whether a job takes a sample in this round: its samples are spread evenly over all rounds.
static bool takes_turn(const struct rg_job *job, int round, int rounds)
{
    const struct rg_record *record = job->record;
    const int due = (int)(((int64_t)round + 1) * record->wanted_samples / rounds);
    return record->outcome == RG_OK && record->sample_count < due;
}

// --- rounds ---

// State of measuring jobs in rounds.
struct rounds {
    struct rg_job *jobs;
    int *order, count; // indices of jobs
    bool *is_begun;    // by job: it has samples from an earlier visit
    int all;           // total number of rounds, which is the longest job's number of samples
    struct rg_calibration calibration;
    // A batch: samples between two readings of how much others take of the machine.
    rg_watch *watch;
    struct rg_processors before; // when it began
    int *first, *last;           // by job: its samples in the batch
    pid_t ours[RG_MAX_DEVICES];  // processes of the jobs' devices
    int our_count;
    double end_ms; // as in struct rg_measure_options
    int patience;  // disturbed batches left until none is taken again
};

// Decides how the measurable jobs are sampled.
static void begin(struct rounds *r, struct rg_job *jobs, int count,
                  const struct rg_measure_options *options)
{
    r->jobs = jobs;
    for (int i = 0; i < count; i++) {
        const struct rg_record *record = jobs[i].record;
        if (record->outcome != RG_OK || rg_interrupted())
            continue;
        calibrate(&jobs[i], options);
        if (!record->wanted_samples)
            continue;
        r->is_begun[i] = record->sample_count > 0;
        r->order[r->count++] = i;
        r->all = record->wanted_samples > r->all ? record->wanted_samples : r->all;
    }
}

// --- what others take ---

// Linux tells idle time to 10 ms, so a batch takes this much of the processors' time, or ends with
// the last round. A disturbed batch is taken again up to this many times. If the machine stays busy
// over some batches, none is taken again until one is undisturbed.
enum { BATCH_MS = 500, RETAKES = 2, PATIENCE = 3 };

static void find_ours(struct rounds *r)
{
    r->our_count = 0;
    for (int i = 0; i < r->count && r->our_count < RG_MAX_DEVICES; i++) {
        const struct rg_worker *worker = rg_remote_worker(r->jobs[r->order[i]].device);
        const pid_t process = worker ? rg_worker_process(worker) : 0;
        bool is_new = process;
        for (int k = 0; k < r->our_count; k++)
            is_new = is_new && r->ours[k] != process;
        if (is_new)
            r->ours[r->our_count++] = process;
    }
}

static void begin_batch(struct rounds *r)
{
    if (!r->watch)
        return;
    find_ours(r);
    for (int i = 0; i < r->count; i++)
        r->first[r->order[i]] = r->jobs[r->order[i]].record->sample_count;
    r->before = r->watch(r->ours, r->our_count);
}

// Notes in each sample of the batch how much others took during it. Returns whether that was too
// much.
static bool is_disturbed(struct rounds *r)
{
    const struct rg_processors now = r->watch(r->ours, r->our_count);
    const struct rg_taken taken = rg_taken_between(&r->before, &now);
    const double share = fmin(taken.stolen + taken.others, 1);
    for (int i = 0; i < r->count; i++) {
        struct rg_record *record = r->jobs[r->order[i]].record;
        record->is_watched = record->is_watched || now.count > 0;
        for (int k = r->first[r->order[i]]; k < record->sample_count; k++)
            record->taken[k] = share;
    }
    return share > RG_MOST_TAKEN;
}

// Takes the batch's samples again, in their places. If that is interrupted, the rest stay.
static void take_again(struct rounds *r)
{
    bool any = true;
    for (int i = 0; i < r->count; i++) {
        struct rg_record *record = r->jobs[r->order[i]].record;
        r->last[r->order[i]] = record->sample_count;
        record->retaken += record->sample_count - r->first[r->order[i]];
        record->sample_count = r->first[r->order[i]];
    }
    find_ours(r);
    r->before = r->watch(r->ours, r->our_count);
    while (any && !rg_interrupted()) {
        any = false;
        for (int i = 0; i < r->count && !rg_interrupted(); i++) {
            struct rg_job *job = &r->jobs[r->order[i]];
            if (job->record->outcome != RG_OK || job->record->sample_count >= r->last[r->order[i]])
                continue;
            take_sample(job);
            any = true;
        }
    }
    for (int i = 0; i < r->count && rg_interrupted(); i++)
        r->jobs[r->order[i]].record->sample_count = r->last[r->order[i]];
}

// Whether there is time to take the batch once more.
static bool has_time(const struct rounds *r)
{
    const double now_ms = rg_now_ms();
    return !rg_interrupted() && (!r->end_ms || now_ms + (now_ms - r->before.at_ms) <= r->end_ms);
}

static void end_batch(struct rounds *r)
{
    if (!r->watch)
        return;
    bool disturbed = is_disturbed(r);
    const bool is_patient = r->patience > 0;
    for (int i = 0; disturbed && is_patient && i < RETAKES && has_time(r); i++) {
        take_again(r);
        disturbed = is_disturbed(r);
    }
    r->patience = !disturbed ? PATIENCE : is_patient ? r->patience - 1 : 0;
    begin_batch(r);
}

static bool is_long(const struct rounds *r)
{
    return (rg_now_ms() - r->before.at_ms) * r->before.count >= BATCH_MS;
}

// False if no job took a sample.
static bool do_round(struct rounds *r, int round)
{
    bool any = false;
    shuffle(r->order, r->count, round);
    for (int i = 0; i < r->count && !rg_interrupted(); i++) {
        if (!takes_turn(&r->jobs[r->order[i]], round, r->all))
            continue;
        any = true;
        take_sample(&r->jobs[r->order[i]]);
        if (r->watch && is_long(r))
            end_batch(r);
    }
    return any;
}

// Writes the load's times into all records: at the beginning of the first visit, and now.
static void note_calibration(struct rounds *r)
{
    double begin_ms, end_ms;
    rg_calibration_take(&r->calibration);
    rg_calibration_tell(&r->calibration, &begin_ms, &end_ms);
    for (int i = 0; i < r->count; i++) {
        struct rg_record *record = r->jobs[r->order[i]].record;
        if (!r->is_begun[r->order[i]])
            record->calibration_begin_ms = begin_ms;
        record->calibration_end_ms = end_ms;
    }
}

static bool is_whole(const struct rg_record *record)
{
    return record->outcome == RG_OK && record->sample_count >= record->wanted_samples;
}

static void finish(struct rg_job *job, const struct rg_measure_options *options)
{
    if (!is_whole(job->record))
        return;
    if (!rg_job_time_passes(job, options->passes_ms))
        rg_record_end_by_error(job->record);
    rg_record_settle(job->record);
}

static void tell(const struct rg_measure_options *options, double done_ms, double all_ms)
{
    if (options->progress)
        options->progress(all_ms > 0 ? done_ms / all_ms : 1, options->user);
}

// The time in milliseconds of a job's samples up to this many of all rounds, and of timing its
// passes.
static double rounds_ms(const struct rg_job *job, int rounds, int all)
{
    const struct rg_record *record = job->record;
    // NOLINTNEXTLINE: there is a round
    const int due = (int)((int64_t)rounds * record->wanted_samples / all) - record->sample_count;
    const int frames = record->frames_a_sample + rg_sampling_has_run_up(job->warm_frame_ms);
    return due > 0 ? due * frames * job->warm_frame_ms : 0;
}

static double passes_ms(const struct rg_job *job, const struct rg_measure_options *options)
{
    return rg_passes_expected_ms(job->warm_frame_ms, options->passes_ms);
}

static void measure(struct rounds *r, const struct rg_measure_options *options)
{
    const int last = (int)ceil(r->all * (options->share > 0 ? options->share : 1) - 1e-9);
    double samples_ms = 0, all_ms = 0, done_ms;
    for (int i = 0; i < r->count; i++) {
        const struct rg_job *job = &r->jobs[r->order[i]];
        samples_ms += rounds_ms(job, last, r->all);
        all_ms += last == r->all ? passes_ms(job, options) : 0;
    }
    all_ms += samples_ms;
    r->calibration = (struct rg_calibration){.load = options->load};
    rg_calibration_take(&r->calibration);
    r->watch = options->watch;
    r->end_ms = options->end_ms;
    r->patience = rg_probe_ms() > 0 ? PATIENCE : 0;
    begin_batch(r);
    for (int round = 0; round < last && !rg_interrupted(); round++) {
        if (do_round(r, round))
            note_calibration(r);
        tell(options, samples_ms * (round + 1) / last, all_ms);
    }
    end_batch(r);
    done_ms = samples_ms;
    for (int i = 0; i < r->count && !rg_interrupted(); i++) {
        struct rg_job *job = &r->jobs[r->order[i]];
        done_ms += is_whole(job->record) ? passes_ms(job, options) : 0;
        finish(job, options);
        tell(options, done_ms, all_ms);
    }
}

void rg_jobs_measure(struct rg_job *jobs, int count, const struct rg_measure_options *options)
{
    struct rounds rounds = {.order = rg_alloc((size_t)count, sizeof(int), "jobs"),
                            .is_begun = rg_alloc((size_t)count, sizeof(bool), "jobs"),
                            .first = rg_alloc((size_t)count, sizeof(int), "jobs"),
                            .last = rg_alloc((size_t)count, sizeof(int), "jobs")};
    const bool ok = rounds.order && rounds.is_begun && rounds.first && rounds.last;
    for (int i = 0; !ok && i < count; i++)
        if (jobs[i].record->outcome == RG_OK)
            rg_record_end_by_error(jobs[i].record);
    if (ok) {
        begin(&rounds, jobs, count, options);
        measure(&rounds, options);
    }
    free(rounds.last);
    free(rounds.first);
    free(rounds.is_begun);
    free(rounds.order);
}

// Opening a session anew each time a window has no room for another sample, and once for passes.
// Its check frames count as drawn ones, though most are only simulated.
static double windows_ms(const struct rg_job *job, const struct rg_sampling *s)
{
    if (!job->window_frames)
        return 0;
    const int fit = job->window_frames / (s->frames_a_sample + s->has_run_up);
    const double open_ms = job->record->create_ms + job->check_frames * job->warm_frame_ms;
    return open_ms * (1 + (double)s->samples / (fit > 1 ? fit : 1));
}

double rg_jobs_expected_ms(const struct rg_job *jobs, int count,
                           const struct rg_measure_options *options)
{
    double ms = 0;
    for (int i = 0; i < count; i++) {
        const struct rg_record *record = jobs[i].record;
        if (record->outcome != RG_OK || !(jobs[i].warm_frame_ms > 0))
            continue;
        struct rg_sampling sampling =
            rg_sampling_of(jobs[i].warm_frame_ms, jobs[i].window_frames, options);
        if (record->wanted_samples)
            sampling.samples = record->wanted_samples - record->sample_count;
        ms += rg_sampling_ms(&sampling, jobs[i].warm_frame_ms) + windows_ms(&jobs[i], &sampling);
    }
    return ms;
}
