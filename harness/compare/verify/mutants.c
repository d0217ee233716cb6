// Mutants: a comparison that accepts a slightly wrong model proves nothing. Each mutant is drawn on
// one device and compared with the true model's image. The tier is T1, the loosest that verify
// accepts, or a requested one.
//
// Mutants have a scene of their own, the proof's over the technique's defaults, regardless of the
// user's settings: on a pane without drops a mutant would survive. Their pictures are early ones:
// by step 1,000 a drop missing at the start would have run off the pane. Contrasts are mutants with
// their own scenes.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/image/compare/compare.h"
#include "harness/compare/verify/verify.h"
#include "harness/devices/frames/frame.h"

enum { MUTANT_STEPS = 100, SCENE_PX = 512 };

int64_t rg_verify_mutant_work(const struct rg_verify *v)
{
    int64_t runs = 1;
    while (v->technique->proof->mutants[runs - 1].about)
        runs++;
    for (const struct rg_contrast *c = v->technique->proof->contrasts; c && c->about; c++)
        runs += 2;
    return runs * MUTANT_STEPS;
}

struct verdicts {
    struct rg_mutants_told told;
    bool error;
    struct rg_failure failure; // the first
    char fault[400];           // the first fault of the list; "": none
};

static void note_error(struct verdicts *verdicts)
{
    if (!verdicts->error)
        verdicts->failure = rg_failure_take();
    verdicts->error = true;
}

// The parameter's value in the mutant. False if it is out of range or the model's own value: 1 %
// less of nothing is no mutant, so the technique's list is wrong.
static bool mutate(const struct rg_verify *v, const struct rg_mutant *mutant, char *text,
                   size_t size, struct verdicts *verdicts)
{
    const struct rg_param *param = rg_params_find(v->technique->params, mutant->param);
    char value[RG_PATH_SIZE];
    rg_params_text(param, v->settings, value, sizeof(value));
    const double own = strtod(value, NULL), mutated = own * mutant->factor + mutant->offset;
    snprintf(text, size, "%s=%.17g", mutant->param, mutated);
    const bool is_one = mutated != own && mutated >= param->min && mutated <= param->max;
    if (!is_one && !*verdicts->fault)
        snprintf(verdicts->fault, sizeof(verdicts->fault),
                 "'%s' is none: %s is %.10g in the model's scene and would be %.10g, of %.10g to "
                 "%.10g; mend the list of %s",
                 mutant->about, mutant->param, own, mutated, param->min, param->max,
                 v->technique->name);
    return is_one;
}

// Draws the scene with `assignments` applied.
static bool draw(struct rg_verify *v, const char *assignments, struct rg_picture *picture)
{
    void *settings = rg_settings_copy(v->technique, v->settings, assignments);
    struct rg_session *session =
        settings ? rg_verify_run(v, v->mutant_device, settings, MUTANT_STEPS) : NULL;
    const bool ok =
        session && rg_session_draw(session) && rg_session_read_picture(session, picture);
    rg_session_close(session);
    free(settings);
    return ok;
}

// Whether the tier notices the mutant: there is rain, and it differs from the model's.
static bool is_rejected(const struct rg_picture *truth, const struct rg_picture *other,
                        const struct rg_picture *dry, struct verdicts *verdicts)
{
    struct rg_comparison comparison;
    if (!rg_compare(truth, "the model", other, "the mutant", dry, &(struct rg_compare_options){0},
                    &comparison)) {
        note_error(verdicts);
        return false;
    }
    bool rejected = !comparison.tiers.of[verdicts->told.tier].holds && comparison.tiers.mask_pixels;
    rg_comparison_destroy(&comparison);
    return rejected;
}

static void judge(const char *about, const struct rg_picture *truth,
                  const struct rg_picture *mutated, const struct rg_picture *dry,
                  struct verdicts *verdicts)
{
    struct rg_mutants_told *told = &verdicts->told;
    told->run++;
    if (!is_rejected(truth, mutated, dry, verdicts) && told->alive_count < RG_MUTANTS_TOLD)
        told->alive[told->alive_count++] = about;
}

static void run_all(struct rg_verify *v, const struct rg_picture *truth,
                    const struct rg_picture *dry, struct verdicts *verdicts)
{
    for (const struct rg_mutant *m = v->technique->proof->mutants; m->about; m++) {
        char assignment[256];
        struct rg_picture mutated = {0};
        rg_progress_label(v->progress, "%s: mutant: %s", v->technique->name, m->about);
        if (!mutate(v, m, assignment, sizeof(assignment), verdicts))
            continue; // the verdicts report it
        if (draw(v, assignment, &mutated))
            judge(m->about, truth, &mutated, dry, verdicts);
        else
            note_error(verdicts);
        rg_verify_advance(v, MUTANT_STEPS);
        rg_picture_destroy(&mutated);
    }
}

static bool draw_dry(struct rg_verify *v, struct rg_picture *dry)
{
    return rg_frame_draw_dry(v->mutant_device,
                             &(struct rg_subject){v->technique, v->settings, v->width, v->height},
                             0, dry);
}

static void run_contrast(const struct rg_verify *scene, const struct rg_contrast *contrast,
                         struct verdicts *verdicts)
{
    struct rg_verify v = *scene;
    void *settings = rg_settings_copy(v.technique, v.settings, contrast->truth);
    struct rg_picture truth = {0}, dry = {0}, mutated = {0};
    rg_progress_label(v.progress, "%s: mutant: %s", v.technique->name, contrast->about);
    v.settings = settings;
    if (settings && draw(&v, "", &truth) && draw_dry(&v, &dry) &&
        draw(&v, contrast->mutant, &mutated))
        judge(contrast->about, &truth, &mutated, &dry, verdicts);
    else
        note_error(verdicts);
    rg_verify_advance(&v, 2 * MUTANT_STEPS);
    rg_picture_destroy(&truth);
    rg_picture_destroy(&dry);
    rg_picture_destroy(&mutated);
    free(settings);
}

static void report(struct rg_verify *v, const struct verdicts *verdicts)
{
    const char *technique = v->technique->name, *device = v->mutant_device->info.name;
    const struct rg_mutants_told *told = &verdicts->told;
    const int killed = told->run - told->alive_count;
    char alive[400];
    rg_mutants_text(told, alive, sizeof(alive));
    if (verdicts->error)
        rg_checks_add_failure(v->checks, technique, "mutants", device, &verdicts->failure);
    else if (*verdicts->fault)
        rg_checks_add(v->checks, technique, "mutants", device, RG_FAIL, "%s", verdicts->fault);
    else if (killed == told->run && told->run)
        rg_checks_add(v->checks, technique, "mutants", device, RG_OK, "killed %d/%d", killed,
                      told->run);
    else
        rg_checks_add(v->checks, technique, "mutants", device, RG_FAIL,
                      "killed %d/%d; T1 accepts: %s", killed, told->run,
                      *alive ? alive : "there are none");
}

// The settings of the proof's scene over the technique's defaults. NULL, and one logged line, on
// failure.
static void *scene_settings(const struct rg_technique *technique)
{
    const char *scene = technique->proof->mutant_scene;
    void *defaults = rg_settings_create(technique);
    void *settings = defaults ? rg_settings_copy(technique, defaults, scene ? scene : "") : NULL;
    free(defaults);
    return settings;
}

static void draw_all(const struct rg_verify *verify, struct verdicts *verdicts)
{
    struct rg_verify scene = *verify;
    void *settings = scene_settings(verify->technique);
    scene.settings = settings;
    scene.width = scene.height = SCENE_PX;
    struct rg_picture truth = {0}, dry = {0};
    // Stays open, so that data shared on a device is made once.
    struct rg_session *first =
        settings ? rg_verify_run(&scene, scene.mutant_device, settings, 0) : NULL;
    if (first && draw(&scene, "", &truth) && draw_dry(&scene, &dry)) {
        rg_verify_advance(&scene, MUTANT_STEPS);
        run_all(&scene, &truth, &dry, verdicts);
    } else {
        note_error(verdicts);
    }
    for (const struct rg_contrast *c = scene.technique->proof->contrasts;
         c && c->about && !verdicts->error; c++)
        run_contrast(&scene, c, verdicts);
    rg_picture_destroy(&truth);
    rg_picture_destroy(&dry);
    rg_session_close(first);
    free(settings);
}

void rg_verify_mutants(struct rg_verify *verify)
{
    struct verdicts verdicts = {.told.tier = RG_T1};
    rg_verify_begin(verify, rg_verify_mutant_work(verify));
    draw_all(verify, &verdicts);
    report(verify, &verdicts);
}

bool rg_verify_mutants_at(const struct rg_verify *verify, enum rg_tier tier,
                          struct rg_mutants_told *told)
{
    struct verdicts verdicts = {.told.tier = tier};
    draw_all(verify, &verdicts);
    *told = verdicts.told;
    if (!verdicts.error && *verdicts.fault)
        return rg_error("%s", verdicts.fault);
    return !verdicts.error;
}

void rg_mutants_text(const struct rg_mutants_told *told, char *text, size_t size)
{
    size_t used = 0;
    *text = 0;
    for (int i = 0; i < told->alive_count && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%s", i ? ", " : "", told->alive[i]);
}
