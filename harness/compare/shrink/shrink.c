#include "harness/compare/shrink/shrink.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/shrink/files.h"
#include "harness/compare/shrink/search.h"
#include "harness/console/exit.h"

enum { LEAST_PX = 16, FLOAT_HALVES = 4 };

static int64_t weight(const struct rg_search *s)
{
    return s->blame.first.weight;
}

static void *copy_of(const struct rg_search *s)
{
    return rg_settings_copy(s->best.subject.technique, s->best.subject.settings, "");
}

// --- frames and pixels ---

static void shrink_frames(struct rg_search *s)
{
    struct rg_digest_run run = s->best;
    run.frames = s->blame.first.frame > 1 ? (int)s->blame.first.frame : 1;
    if (run.frames == s->best.frames)
        return;
    run.subject.settings = copy_of(s);
    rg_search_try(s, run, weight(s));
}

static bool try_size(struct rg_search *s, int width, int height)
{
    struct rg_digest_run run = s->best;
    run.subject.width = width < run.subject.width ? width : run.subject.width;
    run.subject.height = height < run.subject.height ? height : run.subject.height;
    if (run.subject.width == s->best.subject.width && run.subject.height == s->best.subject.height)
        return false;
    run.subject.settings = copy_of(s);
    return rg_search_try(s, run, weight(s));
}

static void shrink_size(struct rg_search *s)
{
    if (try_size(s, LEAST_PX, LEAST_PX))
        return;
    for (int axis = 0; axis < 2; axis++) // halves each side while the difference remains
        while (try_size(s, axis ? s->best.subject.width : s->best.subject.width / 2,
                        axis ? s->best.subject.height / 2 : s->best.subject.height))
            ;
}

// --- numbers ---

static double value_of(const struct rg_search *s, const struct rg_param *param)
{
    char text[RG_PATH_SIZE];
    rg_params_text(param, s->best.subject.settings, text, sizeof(text));
    return strtod(text, NULL);
}

static bool try_number(struct rg_search *s, const struct rg_param *param, double value,
                       int64_t most)
{
    char text[64];
    snprintf(text, sizeof(text), param->kind == RG_PARAM_INT ? "%.0f" : "%.4g", value);
    return rg_search_value(s, param, text, most);
}

// Searches the smallest integer that keeps the difference and weighs less: its minimum, or else by
// bisection between that and its value.
static void shrink_count(struct rg_search *s, const struct rg_param *param)
{
    double low = param->min;
    if (value_of(s, param) <= low || try_number(s, param, low, weight(s) - 1))
        return;
    for (double high = value_of(s, param); high - low > 1;) {
        const double middle = floor((low + high) / 2);
        if (try_number(s, param, middle, weight(s) - 1))
            high = middle;
        else
            low = middle;
    }
}

// Reduces a real number to its minimum, or halves its distance from it repeatedly, while the run
// weighs less.
static void shrink_amount(struct rg_search *s, const struct rg_param *param)
{
    if (value_of(s, param) <= param->min || try_number(s, param, param->min, weight(s) - 1))
        return;
    for (int i = 0; i < FLOAT_HALVES; i++)
        if (!try_number(s, param, param->min + (value_of(s, param) - param->min) / 2,
                        weight(s) - 1))
            return;
}

// Halves the distance from the default while the difference remains.
static void approach(struct rg_search *s, const struct rg_param *param)
{
    for (int i = 0; i < FLOAT_HALVES; i++) {
        const double now = value_of(s, param), half = param->initial + (now - param->initial) / 2;
        if (!try_number(s, param, param->kind == RG_PARAM_INT ? trunc(half) : half, weight(s)))
            return;
    }
}

// --- words ---

static bool is_seed(const struct rg_param *param)
{
    return strstr(param->name, "seed") != NULL;
}

// Tries each choice; the one that weighs least remains.
static void shrink_choice(struct rg_search *s, const struct rg_param *param)
{
    char choice[64];
    for (const char *c = param->text; *c; c += strcspn(c, " "), c += *c == ' ') {
        snprintf(choice, sizeof(choice), "%.*s", (int)strcspn(c, " "), c);
        rg_search_value(s, param, choice, weight(s) - 1);
    }
}

// Tries a model or map that weighs less: none, or fewer entries in the user's own file.
static void shrink_file(struct rg_search *s, const struct rg_param *param)
{
    char value[RG_PATH_SIZE];
    if (!rg_search_value(s, param, "", weight(s) - 1))
        rg_search_value(s, param, "none", weight(s) - 1);
    rg_params_text(param, s->best.subject.settings, value, sizeof(value));
    if (rg_file_is_own(value))
        rg_search_entries(s, param);
}

// --- all parameters ---

// Sets parameters back to their defaults if the difference remains; numbers as far as possible.
static void restore_defaults(struct rg_search *s)
{
    const struct rg_param_table *table = s->best.subject.technique->params;
    void *defaults = rg_settings_create(s->best.subject.technique);
    for (int i = 0; defaults && i < table->count; i++) {
        const struct rg_param *param = &table->rows[i];
        char initial[RG_PATH_SIZE], now[RG_PATH_SIZE];
        rg_params_text(param, defaults, initial, sizeof(initial));
        rg_params_text(param, s->best.subject.settings, now, sizeof(now));
        if (!strcmp(initial, now) || rg_search_value(s, param, initial, weight(s)))
            continue;
        if (param->kind == RG_PARAM_INT || param->kind == RG_PARAM_FLOAT)
            approach(s, param);
    }
    free(defaults);
}

static void shrink_kind(struct rg_search *s, enum rg_param_kind kind,
                        void (*shrink)(struct rg_search *s, const struct rg_param *param))
{
    const struct rg_param_table *table = s->best.subject.technique->params;
    for (int i = 0; i < table->count; i++) {
        const struct rg_param *param = &table->rows[i];
        const bool is_preset = table->preset && !strcmp(param->name, table->preset);
        if (param->kind == kind && !is_seed(param) && !is_preset)
            shrink(s, param);
    }
}

static void search(struct rg_search *s)
{
    shrink_frames(s);
    shrink_size(s);
    shrink_kind(s, RG_PARAM_FILE, shrink_file);
    restore_defaults(s);
    shrink_kind(s, RG_PARAM_CHOICE, shrink_choice);
    shrink_kind(s, RG_PARAM_INT, shrink_count);
    shrink_kind(s, RG_PARAM_FLOAT, shrink_amount);
    shrink_size(s);
    shrink_frames(s);
}

int rg_shrink_case(const struct rg_shrink_request *request, struct rg_case *found,
                   struct rg_blame *blame, int *tried)
{
    struct rg_search s;
    *found = (struct rg_case){0};
    const bool ok = rg_search_begin(&s, request);
    if (ok) {
        rg_log_hold(true); // of settings that are refused
        search(&s);
        rg_log_hold(false);
    }
    rg_search_end(&s);
    if (s.is_over)
        rg_warning("shrink: %s; the least until then is taken", s.why);
    *blame = s.blame;
    *tried = s.tried;
    found->run = s.best;
    found->stages_run = s.blame.first.stages_run;
    found->difference = s.blame.difference;
    found->fall = s.fall;
    found->expected = s.blame.expected;
    found->found = s.fall.outcome ? 0 : s.blame.first.hash;
    snprintf(found->stage, sizeof(found->stage), "%s", s.blame.first.stage);
    snprintf(found->asset, sizeof(found->asset), "%s", s.blame.first.asset);
    snprintf(found->device, sizeof(found->device), "%s", request->device->info.full);
    snprintf(found->truth, sizeof(found->truth), "%s", request->truth->info.full);
    return ok ? RG_EXIT_PASS : s.has_none ? RG_EXIT_FAIL : rg_exit_of_error();
}
