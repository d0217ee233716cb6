#include "harness/compare/shrink/search.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/devices/workers/device.h"
#include "harness/record/named.h"

// Opens the best run on both devices, and closes the one that was open before.
static void hold_best(struct rg_search *s)
{
    struct rg_device *devices[2] = {s->asked->device, s->asked->truth};
    for (int i = s->fall.outcome ? 1 : 0; i < 2; i++) { // nothing is open on a device that fails
        struct rg_session *next = rg_session_open(devices[i], &s->best.subject);
        rg_session_close(s->held[i]);
        s->held[i] = next;
    }
}

// Whether the device fails in a run that the truth completes, and how. The blame then describes the
// truth's results at that stage.
static bool falls(struct rg_search *s, const struct rg_digest_run *run, struct rg_fall *fall,
                  struct rg_blame *blame)
{
    struct rg_digests now = {0}, due = {0};
    *fall = (struct rg_fall){.outcome = RG_OK};
    *blame = (struct rg_blame){.found = false};
    bool ok = rg_digests_take(run, s->asked->truth, &due) && due.count;
    if (ok && !rg_digests_take(run, s->asked->device, &now)) {
        snprintf(blame->text, sizeof(blame->text), "%.599s", rg_last_error());
        *fall = rg_fall_now(s->asked->device);
        blame->found = fall->outcome != RG_OK;
        blame->first = due.rows[rg_fall_row(fall, &due)];
        blame->expected = blame->first.hash;
    }
    rg_digests_free(&now);
    rg_digests_free(&due);
    return blame->found;
}

// Tries ever more frames, from one by doubling, until the device fails.
static bool find_fall(struct rg_search *s)
{
    struct rg_digest_run part = s->best;
    rg_worker_renew(rg_remote_worker(s->asked->device));
    for (part.frames = 1; !s->blame.found; part.frames *= 2) {
        part.frames = part.frames < s->best.frames ? part.frames : s->best.frames;
        if (falls(s, &part, &s->fall, &s->blame))
            s->best.frames = part.frames;
        if (part.frames == s->best.frames)
            break;
    }
    return s->blame.found;
}

// Finds the first difference. Lines are held, since a failure may turn out to be the difference.
static bool find_difference(struct rg_search *s)
{
    struct rg_device *device = s->asked->device, *truth = s->asked->truth;
    rg_log_hold(true);
    bool ok = rg_blame_find(&s->best, device, truth, &s->blame);
    const struct rg_failure failure = rg_failure_take();
    const bool is_broken =
        !ok && !rg_interrupted() && failure.fault == RG_FAULT_DRIVER && rg_remote_worker(device);
    if (is_broken)
        ok = find_fall(s);
    rg_log_hold(false);
    if (!ok && !rg_interrupted())
        rg_failure_tell(&failure);
    return ok;
}

bool rg_search_begin(struct rg_search *s, const struct rg_shrink_request *asked)
{
    const struct rg_subject *subject = &asked->run.subject;
    *s = (struct rg_search){
        .asked = asked, .best = asked->run, .end_ms = rg_now_ms() + 1000.0 * asked->seconds};
    s->best.subject.settings = rg_settings_copy(subject->technique, subject->settings, "");
    bool ok = s->best.subject.settings && find_difference(s);
    s->has_none = ok && (!s->blame.found || s->blame.is_alone);
    if (s->has_none && s->blame.is_alone)
        ok = rg_error("shrink: %s, which no smaller run explains; give another frame, size or "
                      "setting",
                      s->blame.text);
    else if (s->has_none)
        ok = rg_error("shrink: %s leaves the same bits as %s after every stage; give another "
                      "frame, size or setting",
                      asked->device->info.name, asked->truth->info.name);
    if (ok)
        hold_best(s);
    return ok;
}

void rg_search_end(struct rg_search *s)
{
    rg_session_close(s->held[0]);
    rg_session_close(s->held[1]);
}

// Whether the first difference of two runs is the one that is sought, and its weight small enough.
// This is checked before its kind, which takes more runs.
static bool is_sought(const struct rg_search *s, const struct rg_digests *now,
                      const struct rg_digests *due, int64_t most_weight)
{
    const int row = rg_blame_first(now, due);
    return row >= 0 && row < now->count && row < due->count &&
           now->rows[row].weight <= most_weight &&
           !strcmp(now->rows[row].stage, s->blame.first.stage) &&
           !strcmp(now->rows[row].asset, s->blame.first.asset);
}

// The same if the device fails: whether it fails in the same way.
static bool falls_alike(struct rg_search *s, const struct rg_digest_run *run, int64_t most_weight,
                        struct rg_blame *blame)
{
    struct rg_fall fall;
    return falls(s, run, &fall, blame) && rg_fall_is_same(&fall, &s->fall) &&
           blame->first.weight <= most_weight && !strcmp(blame->first.stage, s->blame.first.stage);
}

static bool is_alike(struct rg_search *s, const struct rg_digest_run *run, int64_t most_weight,
                     struct rg_blame *blame)
{
    struct rg_device *device = s->asked->device, *truth = s->asked->truth;
    struct rg_digests now = {0}, due = {0};
    bool ok = rg_digests_take(run, device, &now) && rg_digests_take(run, truth, &due);
    const bool is_near = ok && is_sought(s, &now, &due, most_weight);
    if (is_near)
        ok = rg_blame_row(run, device, truth, &now, &due, blame);
    // Settings that exclude each other are refused; this is no failure of a device.
    const struct rg_failure failure = rg_failure_take();
    if (!ok && failure.fault != RG_FAULT_INPUT && failure.fault != RG_FAULT_NONE) {
        s->is_over = true;
        rg_text_copy(s->why, sizeof(s->why), failure.line);
    }
    rg_digests_free(&now);
    rg_digests_free(&due);
    return ok && is_near && !blame->is_alone && blame->difference == s->blame.difference;
}

bool rg_search_try(struct rg_search *s, struct rg_digest_run run, int64_t most_weight)
{
    struct rg_blame blame = {0};
    bool keeps = false;
    if (run.subject.settings && !s->is_over && !rg_interrupted() && rg_now_ms() < s->end_ms) {
        s->tried++;
        keeps = s->fall.outcome ? falls_alike(s, &run, most_weight, &blame)
                                : is_alike(s, &run, most_weight, &blame);
    }
    free((void *)(uintptr_t)(keeps ? s->best.subject.settings : run.subject.settings));
    if (keeps) {
        s->best = run;
        s->blame = blame;
        hold_best(s);
    }
    return keeps;
}

bool rg_search_value(struct rg_search *s, const struct rg_param *param, const char *value,
                     int64_t most_weight)
{
    char assignment[RG_PATH_SIZE + 64], now[RG_PATH_SIZE];
    struct rg_digest_run run = s->best;
    rg_params_text(param, s->best.subject.settings, now, sizeof(now));
    if (!strcmp(now, value) || most_weight < 0)
        return false;
    void *settings = rg_settings_copy(run.subject.technique, run.subject.settings, "");
    snprintf(assignment, sizeof(assignment), "%s=%s", param->name, value);
    if (settings && !rg_params_set(run.subject.technique->params, settings, assignment)) {
        free(settings);
        settings = NULL;
    }
    run.subject.settings = settings;
    return rg_search_try(s, run, most_weight);
}
