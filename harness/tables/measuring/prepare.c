// Prepares a row's cells for timing: the image that they must show, its error against the truth,
// and their jobs.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/device/device.h"
#include "core/image/compare/compare.h"
#include "harness/console/interrupt.h"
#include "harness/devices/frames/frame.h"
#include "harness/tables/measuring/batch.h"

// A row's variant while its jobs are prepared.
struct preparation {
    struct rg_kept *kept;
    const struct rg_table *table;
    struct rg_subject subject;
    struct rg_subject drawn; // same image, as cpu:reference draws it
    int check_frames;
    int count;           // number of devices
    struct rg_job *jobs; // one per device
    struct rg_expected expected;
    struct rg_truth_error truth_error;
};

static struct preparation begin(struct rg_batch *batch, struct rg_place at)
{
    const struct rg_table *table = batch->table;
    struct preparation p = {.kept = batch->kept,
                            .table = table,
                            .subject = {rg_technique_find(table->technique),
                                        rg_batch_settings(batch, at), table->width, table->height},
                            .check_frames = batch->result->check_frames,
                            .count = batch->result->device_count,
                            .jobs = batch->jobs + batch->job_count};
    p.drawn = p.subject;
    batch->job_count += p.count;
    for (at.device = 0; at.device < p.count; at.device++)
        p.jobs[at.device] = (struct rg_job){.subject = p.subject,
                                            .device = rg_batch_device(batch, at.device),
                                            .check_frames = p.check_frames,
                                            .window_frames = table->window_frames,
                                            .counted = table->counted,
                                            .record = rg_result_at(batch->result, at)};
    return p;
}

// --- the image ---

// Finds the settings by which cpu:reference draws a work that it cannot do itself; the caller frees
// *elsewhere.
static bool find_drawn(struct preparation *p, const struct rg_batch *batch, struct rg_place at,
                       void **elsewhere)
{
    const struct rg_table_work *work = rg_table_work_at(batch->result, batch->table, at);
    if (!work->elsewhere)
        return true;
    *elsewhere = rg_settings_copy(p->subject.technique, p->subject.settings, work->elsewhere);
    p->drawn.settings = *elsewhere;
    return *elsewhere != NULL;
}

// Gets cpu:reference's image: from its job if the table measures it with these settings, else from
// a session opened for this.
static bool draw_expected(struct preparation *p)
{
    struct rg_device *device = rg_kept_device(p->kept, "cpu:reference");
    const bool is_job = p->drawn.settings == p->subject.settings;
    for (int d = 0; device && is_job && d < p->count; d++)
        if (p->jobs[d].device == device)
            return rg_job_open(&p->jobs[d]) && rg_expected_read(&p->expected, p->jobs[d].session);
    struct rg_session *session = device ? rg_session_run(device, &p->drawn, p->check_frames) : NULL;
    if (!session)
        return false;
    const bool ok = rg_expected_read(&p->expected, session);
    rg_kept_put(p->kept, session);
    return ok;
}

static void end_error(struct rg_truth_error *error, enum rg_outcome outcome, const char *why)
{
    error->outcome = outcome;
    rg_text_copy(error->detail, sizeof(error->detail), why);
}

// Draws the background without rain, from which the rain mask is made. cpu draws the same as
// cpu:reference, and faster. The session is kept, so that a job on cpu does not make the scene
// again.
static bool draw_dry(struct preparation *p)
{
    struct rg_device *device = rg_kept_device(p->kept, "cpu");
    struct rg_session *session =
        device ? rg_frame_run_dry(device, &p->drawn, p->check_frames) : NULL;
    if (!session)
        return false;
    const bool ok = rg_session_read_picture(session, &p->expected.dry);
    rg_kept_put(p->kept, session);
    return ok;
}

// Ends all records if the image is the same without rain: a device that draws no rain would pass,
// and the timed work would be invisible. False without memory.
static bool fail_without_rain(struct preparation *p, bool *shows)
{
    static const char why[] = "its image is the same without rain: nothing of what it would time "
                              "can be seen";
    if (!rg_expected_shows_rain(&p->expected, shows))
        return false;
    for (int d = 0; !*shows && d < p->count; d++)
        rg_record_end(p->jobs[d].record, RG_NOTHING, why);
    if (!*shows)
        end_error(&p->truth_error, RG_NOTHING, why);
    return true;
}

// Draws the row's image with everything that the table shows.
static bool draw_shown(struct preparation *p, const void *settings, struct rg_picture *own)
{
    const struct rg_subject subject = {p->subject.technique, settings, p->subject.width,
                                       p->subject.height};
    struct rg_device *device = rg_kept_device(p->kept, "cpu");
    struct rg_session *session = device ? rg_session_run(device, &subject, p->check_frames) : NULL;
    if (!session)
        return false;
    const bool ok = rg_session_read_picture(session, own);
    rg_kept_put(p->kept, session);
    return ok;
}

static bool compare_with_truth(struct preparation *p, const void *shown, const void *settings)
{
    const struct rg_subject subject = {p->subject.technique, settings, p->subject.width,
                                       p->subject.height};
    const size_t size = p->subject.technique->params->settings_size;
    const bool is_expected = !memcmp(shown, p->subject.settings, size);
    struct rg_picture own = {0};
    struct rg_comparison c = {0};
    const struct rg_picture *truth = rg_kept_truth(p->kept, &subject, p->check_frames);
    const bool ok = truth && (is_expected || draw_shown(p, shown, &own)) &&
                    rg_compare(truth, "the truth", is_expected ? &p->expected.picture : &own,
                               p->table->id, &p->expected.dry, &(struct rg_compare_options){0}, &c);
    rg_picture_destroy(&own);
    p->truth_error = (struct rg_truth_error){.flip_mask_mean = c.flip.mask_mean,
                                             .flip_mean = c.flip.mean,
                                             .max_codes = c.tiers.max_codes};
    rg_comparison_destroy(&c);
    return ok;
}

// Measures how far the expected image is from the table's truth. Jobs are timed even if that fails.
static void measure_error(struct preparation *p)
{
    if (!p->table->truth || rg_interrupted())
        return;
    const char *over = p->table->shown ? p->table->shown : "";
    void *shown = rg_settings_copy(p->subject.technique, p->subject.settings, over);
    void *settings = shown ? rg_settings_copy(p->subject.technique, shown, p->table->truth) : NULL;
    if (!settings || !compare_with_truth(p, shown, settings)) {
        const struct rg_failure failure = rg_failure_take();
        end_error(&p->truth_error, failure.outcome, failure.line);
    }
    free(settings);
    free(shown);
}

// --- the jobs ---

// Ends the records of jobs that are not open, because there is no image to compare theirs with.
static void give_up(struct preparation *p)
{
    const struct rg_failure failure = rg_failure_take();
    char why[RG_DETAIL_SIZE];
    snprintf(why, sizeof(why), "no image to check it by: %.160s", failure.line);
    for (int d = 0; d < p->count; d++)
        if (p->jobs[d].record->outcome == RG_OK)
            rg_record_end(p->jobs[d].record, failure.outcome, why);
    end_error(&p->truth_error, failure.outcome, why);
}

static void prepare_jobs(struct preparation *p, const struct rg_measure_options *options)
{
    for (int d = 0; d < p->count && !rg_interrupted(); d++) {
        struct rg_job *job = &p->jobs[d];
        const bool is_open = job->session != NULL; // it drew the expected image
        if ((is_open || (rg_job_open(job) && rg_job_check(job, &p->expected))) && rg_job_count(job))
            rg_job_warm_up(job, options);
    }
}

void rg_batch_prepare(struct rg_batch *batch, struct rg_place at,
                      const struct rg_measure_options *options)
{
    struct preparation p = begin(batch, at);
    void *elsewhere = NULL;
    bool shows;
    if (!p.subject.settings || !find_drawn(&p, batch, at, &elsewhere) || !draw_expected(&p) ||
        !draw_dry(&p) || !fail_without_rain(&p, &shows)) {
        give_up(&p);
    } else if (shows) {
        measure_error(&p);
        prepare_jobs(&p, options);
    }
    free(elsewhere);
    for (int d = 0; d < p.count; d++)
        p.jobs[d].record->truth_error = p.truth_error;
    rg_expected_free(&p.expected);
}
