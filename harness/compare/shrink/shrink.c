#include "harness/compare/shrink/shrink.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/clock.h"

enum { LEAST_PX = 16 };

struct search {
    const struct rg_shrink_request *asked;
    struct rg_digest_run best; // its settings are owned
    struct rg_blame blame;     // of the best
    double end_ms;
    int tried;
    bool is_over; // a device has failed
};

static void *copy_of(const struct search *s, const char *assignment)
{
    return rg_settings_copy(s->best.subject.technique, s->best.subject.settings, assignment);
}

static bool is_alike(const struct rg_blame *a, const struct rg_blame *b)
{
    return a->found && !a->is_alone && a->difference == b->difference &&
           !strcmp(a->first.stage, b->first.stage) && !strcmp(a->first.asset, b->first.asset);
}

// Takes a run for the best if the difference is still the same. It owns the run's settings.
static bool attempt(struct search *s, struct rg_digest_run run)
{
    struct rg_blame blame = {0};
    bool keeps = false;
    if (run.subject.settings && !s->is_over && rg_now_ms() < s->end_ms) {
        s->tried++;
        // Settings that do not go together are refused, which is no failure of a device.
        if (rg_blame_find(&run, s->asked->device, s->asked->truth, &blame))
            keeps = is_alike(&blame, &s->blame);
        else
            s->is_over = rg_last_error_kind() != RG_ERROR_INPUT;
    }
    if (keeps) {
        free((void *)(uintptr_t)s->best.subject.settings);
        s->best = run;
        s->blame = blame;
    } else {
        free((void *)(uintptr_t)run.subject.settings);
    }
    return keeps;
}

static void shrink_frames(struct search *s)
{
    struct rg_digest_run run = s->best;
    run.frames = s->blame.first.frame > 1 ? (int)s->blame.first.frame : 1;
    run.subject.settings = copy_of(s, "");
    attempt(s, run);
}

static bool attempt_size(struct search *s, int width, int height)
{
    struct rg_digest_run run = s->best;
    run.subject.width = width < run.subject.width ? width : run.subject.width;
    run.subject.height = height < run.subject.height ? height : run.subject.height;
    if (run.subject.width == s->best.subject.width && run.subject.height == s->best.subject.height)
        return false;
    run.subject.settings = copy_of(s, "");
    return attempt(s, run);
}

static void shrink_size(struct search *s)
{
    if (attempt_size(s, LEAST_PX, LEAST_PX))
        return;
    for (int axis = 0; axis < 2; axis++) // halves each side as often as that keeps it
        while (attempt_size(s, axis ? s->best.subject.width : s->best.subject.width / 2,
                            axis ? s->best.subject.height / 2 : s->best.subject.height))
            ;
}

static bool attempt_value(struct search *s, const struct rg_param *param, const char *value)
{
    char assignment[RG_PATH_SIZE + 64], now[RG_PATH_SIZE];
    struct rg_digest_run run = s->best;
    rg_params_text(param, s->best.subject.settings, now, sizeof(now));
    if (!strcmp(now, value))
        return false;
    snprintf(assignment, sizeof(assignment), "%s=%s", param->name, value);
    run.subject.settings = copy_of(s, assignment);
    return attempt(s, run);
}

// Counts and sizes are integers; so are seeds, of which none is less than another.
static bool is_count(const struct rg_param *param)
{
    return param->kind == RG_PARAM_INT && !strstr(param->name, "seed");
}

// The least value, or else halves of the way to it, as often as that keeps the difference.
static void shrink_value(struct search *s, const struct rg_param *param)
{
    char text[RG_PATH_SIZE];
    rg_params_text(param, s->best.subject.settings, text, sizeof(text));
    if (strtod(text, NULL) <= param->min)
        return;
    bool keeps = true;
    for (double share = 0; keeps || share == 0; share = 0.5) {
        rg_params_text(param, s->best.subject.settings, text, sizeof(text));
        const double value = floor(param->min + (strtod(text, NULL) - param->min) * share);
        snprintf(text, sizeof(text), "%.0f", value);
        keeps = attempt_value(s, param, text);
        if (value <= param->min && (keeps || share > 0))
            break;
    }
}

static void shrink_settings(struct search *s)
{
    const struct rg_param_table *table = s->best.subject.technique->params;
    void *defaults = rg_settings_create(s->best.subject.technique);
    for (int i = 0; defaults && i < table->count; i++)
        if (is_count(&table->rows[i]))
            shrink_value(s, &table->rows[i]);
    for (int i = 0; defaults && i < table->count; i++) {
        char initial[RG_PATH_SIZE];
        rg_params_text(&table->rows[i], defaults, initial, sizeof(initial));
        if (!is_count(&table->rows[i]))
            attempt_value(s, &table->rows[i], initial);
    }
    free(defaults);
}

bool rg_shrink_case(const struct rg_shrink_request *request, struct rg_case *found,
                    struct rg_blame *blame, int *tried)
{
    struct search s = {
        .asked = request, .best = request->run, .end_ms = rg_now_ms() + 1000.0 * request->seconds};
    *found = (struct rg_case){0};
    s.best.subject.settings =
        rg_settings_copy(request->run.subject.technique, request->run.subject.settings, "");
    bool ok = s.best.subject.settings &&
              rg_blame_find(&s.best, request->device, request->truth, &s.blame);
    if (ok && (!s.blame.found || s.blame.is_alone))
        ok = rg_error("shrink: %s leaves in every asset behind every stage what %s does; give "
                      "another frame, size or setting",
                      request->device->info.name, request->truth->info.name);
    if (ok) {
        shrink_frames(&s);
        shrink_size(&s);
        shrink_settings(&s);
        shrink_frames(&s);
    }
    *blame = s.blame;
    *tried = s.tried;
    found->run = s.best;
    found->stages_run = s.blame.first.stages_run;
    found->difference = s.blame.difference;
    found->expected = s.blame.expected;
    found->found = s.blame.first.hash;
    snprintf(found->stage, sizeof(found->stage), "%s", s.blame.first.stage);
    snprintf(found->asset, sizeof(found->asset), "%s", s.blame.first.asset);
    snprintf(found->device, sizeof(found->device), "%s", request->device->info.name);
    snprintf(found->truth, sizeof(found->truth), "%s", request->truth->info.name);
    return ok;
}
