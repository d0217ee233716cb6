#include "harness/compare/verify/course.h"

// The steps of a technique on one device (NULL: a missing one, which another machine may have),
// with those of cpu:reference beside it.
static int64_t steps_on(const struct rg_verify_course *c, struct rg_device *device)
{
    const struct rg_devices one = {.count = 1, .devices = {device}};
    struct rg_verify v = c->verify;
    v.devices = &one;
    return c->stages ? rg_verify_stage_work(&v) : rg_verify_device_work(&v);
}

// cpu:reference runs beside all others, and is a unit only alone.
static bool list_units(struct rg_verify_course *c)
{
    bool ok = true;
    for (int s = 0; ok && s < c->count; s++) {
        const char *technique = c->subjects[s].technique->name;
        c->verify.technique = c->subjects[s].technique;
        for (int i = 0; ok && i < c->devices->count; i++)
            if (c->devices->devices[i] != c->verify.reference || c->devices->count == 1)
                ok = rg_units_add(&c->units, technique, c->devices->devices[i]->info.name,
                                  steps_on(c, c->devices->devices[i]));
        for (int i = 0; ok && i < c->devices->absent_count; i++)
            ok = rg_units_add(&c->units, technique, c->devices->absent[i].name, steps_on(c, NULL));
        if (ok && !c->stages)
            ok = rg_units_add(&c->units, technique, RG_UNIT_MUTANTS,
                              rg_verify_mutant_work(&c->verify));
    }
    return ok;
}

// Reports devices that are missing or failed.
static void note_absent(const struct rg_verify_course *c)
{
    for (int s = 0; s < c->count; s++)
        for (int i = 0; i < c->devices->absent_count; i++) {
            const struct rg_absent_device *absent = &c->devices->absent[i];
            const char *technique = c->subjects[s].technique->name;
            if (rg_units_have(&c->units, technique, absent->name))
                rg_checks_add(c->verify.checks, technique, "device", absent->name, absent->outcome,
                              "%s", absent->why);
        }
}

// The devices of a technique's units.
static struct rg_devices devices_of(const struct rg_verify_course *c, const char *technique)
{
    struct rg_devices part = {.count = 0};
    for (int i = 0; i < c->devices->count; i++)
        if (rg_units_have(&c->units, technique, c->devices->devices[i]->info.name))
            part.devices[part.count++] = c->devices->devices[i];
    return part;
}

// The steps of a technique's units.
static int64_t count_steps(const struct rg_verify_course *c,
                           const struct rg_verify_subject *subject)
{
    const struct rg_devices part = devices_of(c, subject->technique->name);
    struct rg_verify v = c->verify;
    int64_t steps = 0;
    v.technique = subject->technique;
    v.devices = &part;
    if (part.count)
        steps = c->stages ? rg_verify_stage_work(&v) : rg_verify_device_work(&v);
    if (rg_units_have(&c->units, subject->technique->name, RG_UNIT_MUTANTS))
        steps += rg_verify_mutant_work(&v);
    return steps;
}

static void verify_one(const struct rg_verify_course *c, const struct rg_verify_subject *subject,
                       struct rg_progress *progress)
{
    const struct rg_devices part = devices_of(c, subject->technique->name);
    struct rg_verify_phase phase = {0};
    struct rg_verify v = c->verify;
    v.technique = subject->technique;
    v.settings = subject->settings;
    v.devices = &part;
    v.progress = progress;
    v.phase = &phase;
    if (part.count && c->stages)
        rg_verify_stages(&v);
    else if (part.count)
        rg_verify_devices(&v);
    if (rg_units_have(&c->units, subject->technique->name, RG_UNIT_MUTANTS))
        rg_verify_mutants(&v);
}

bool rg_verify_choose(struct rg_verify_course *c, const struct rg_shard *shard)
{
    return list_units(c) && rg_units_cut(&c->units, shard);
}

void rg_verify_run_all(const struct rg_verify_course *c)
{
    struct rg_progress progress;
    int64_t steps = 0;
    for (int i = 0; i < c->count; i++)
        steps += count_steps(c, &c->subjects[i]);
    note_absent(c);
    rg_progress_start(&progress, steps);
    for (int i = 0; i < c->count; i++)
        verify_one(c, &c->subjects[i], &progress);
    rg_progress_end(&progress);
}
