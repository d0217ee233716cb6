#include "harness/compare/shrink/search.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"

// Opens the best on both devices, and closes what was there before.
static void hold_best(struct rg_search *s)
{
    struct rg_device *devices[2] = {s->asked->device, s->asked->truth};
    for (int i = 0; i < 2; i++) {
        struct rg_session *next = rg_session_open(devices[i], &s->best.subject);
        rg_session_close(s->held[i]);
        s->held[i] = next;
    }
}

bool rg_search_begin(struct rg_search *s, const struct rg_shrink_request *asked)
{
    const struct rg_subject *subject = &asked->run.subject;
    *s = (struct rg_search){
        .asked = asked, .best = asked->run, .end_ms = rg_now_ms() + 1000.0 * asked->seconds};
    s->best.subject.settings = rg_settings_copy(subject->technique, subject->settings, "");
    bool ok =
        s->best.subject.settings && rg_blame_find(&s->best, asked->device, asked->truth, &s->blame);
    s->has_none = ok && (!s->blame.found || s->blame.is_alone);
    if (s->has_none)
        ok = rg_error("shrink: %s leaves in every asset behind every stage what %s does; give "
                      "another frame, size or setting",
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

// Whether the first difference of two runs is the one that is sought, and light enough: asked
// before what kind it is, which takes more runs.
static bool is_sought(const struct rg_search *s, const struct rg_digests *now,
                      const struct rg_digests *due, int64_t most_weight)
{
    const int row = rg_blame_first(now, due);
    return row >= 0 && row < now->count && row < due->count &&
           now->rows[row].weight <= most_weight &&
           !strcmp(now->rows[row].stage, s->blame.first.stage) &&
           !strcmp(now->rows[row].asset, s->blame.first.asset);
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
    // Settings that do not go together are refused, which is no failure of a device.
    if (!ok && rg_last_error_kind() != RG_ERROR_INPUT &&
        rg_last_error_kind() != RG_ERROR_UNSUPPORTED) {
        s->is_over = true;
        snprintf(s->why, sizeof(s->why), "%s", rg_last_error());
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
        keeps = is_alike(s, &run, most_weight, &blame);
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
