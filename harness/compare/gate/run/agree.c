#include "harness/compare/gate/run/agree.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/image/compare/compare.h"
#include "harness/compare/blame/blame.h"
#include "harness/frames/frame.h"
#include "harness/record/record.h"

// A cell on both sides, while it is compared.
struct pair {
    const struct rg_gate_cell *cell;
    struct rg_side *sides;
    struct rg_subject subject;
    struct rg_session *sessions[RG_SIDES];
    struct rg_agreement *found;
};

static const struct rg_device_info *info_of(const struct pair *p, int side)
{
    return &p->sides[side].device->info;
}

static bool owe_bits(const struct pair *p)
{
    return rg_tier_owed(info_of(p, RG_SIDE_A), info_of(p, RG_SIDE_B)) == RG_T0;
}

// Ends it with what the last error comes to, on a side.
static bool fail_by_error(struct pair *p, int side)
{
    p->found->outcome = rg_outcome_of_error();
    p->found->device = p->sides[side].name;
    snprintf(p->found->message, RG_AGREEMENT_TEXT, "%s", rg_last_error());
    return false;
}

__attribute__((format(printf, 2, 3))) static bool differ(struct pair *p, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    p->found->outcome = RG_FAIL;
    vsnprintf(p->found->message, RG_AGREEMENT_TEXT, format, args);
    va_end(args);
    return false;
}

// --- pictures ---

static bool compare_pictures(struct pair *p, const struct rg_picture pictures[RG_SIDES])
{
    struct rg_picture dry = {0};
    struct rg_comparison c = {0};
    const enum rg_tier owed = rg_tier_owed(info_of(p, RG_SIDE_A), info_of(p, RG_SIDE_B));
    if (!rg_frame_draw_dry(p->sides[RG_SIDE_A].device, &p->subject, p->cell->frames, &dry))
        return fail_by_error(p, RG_SIDE_A);
    bool ok = rg_compare(&pictures[0], p->sides[0].name, &pictures[1], p->sides[1].name, &dry,
                         &(struct rg_compare_options){0}, &c);
    if (!ok) {
        fail_by_error(p, RG_SIDE_A);
    } else {
        p->found->pixels = (double)c.metrics.differing_pixels;
        p->found->difference = c.tiers.max_codes;
        ok = c.tiers.of[owed].holds || differ(p, "the picture differs: %s", c.tiers.of[owed].why);
    }
    rg_comparison_destroy(&c);
    rg_picture_destroy(&dry);
    return ok;
}

static bool have_alike_pictures(struct pair *p)
{
    struct rg_picture pictures[RG_SIDES] = {{0}, {0}};
    bool ok = true;
    for (int side = 0; ok && side < RG_SIDES; side++)
        ok = rg_session_read_picture(p->sessions[side], &pictures[side]) || fail_by_error(p, side);
    ok = ok && compare_pictures(p, pictures);
    for (int side = 0; side < RG_SIDES; side++)
        rg_picture_destroy(&pictures[side]);
    return ok;
}

// --- states ---

static bool have_alike_state(struct pair *p, int index)
{
    void *words[RG_SIDES] = {NULL, NULL};
    size_t sizes[RG_SIDES];
    struct rg_state layout;
    bool ok = true;
    for (int side = 0; ok && side < RG_SIDES; side++) {
        words[side] = rg_session_read_state(p->sessions[side], index, &layout, &sizes[side]);
        ok = words[side] || fail_by_error(p, side);
    }
    if (ok && (sizes[0] != sizes[1] || memcmp(words[0], words[1], sizes[0]) != 0))
        ok = differ(p, "the state '%s' differs behind %d frames", layout.name, p->cell->frames);
    free(words[0]);
    free(words[1]);
    return ok;
}

static bool have_alike_states(struct pair *p)
{
    bool ok = true;
    for (int i = 0; ok && i < rg_session_state_count(p->sessions[0]); i++)
        ok = have_alike_state(p, i);
    return ok;
}

// --- counters ---

static bool have_alike_counters(struct pair *p)
{
    struct rg_account told[RG_SIDES];
    for (int side = 0; side < RG_SIDES; side++)
        rg_session_tell(p->sessions[side], &told[side]);
    for (int i = 0; i < told[0].counter_count; i++) {
        const struct rg_counter *a = &told[0].counters[i], *b = &told[1].counters[i];
        if (a->value != b->value)
            return differ(p, "the counter '%s' is %lld and %lld", a->name, (long long)a->value,
                          (long long)b->value);
    }
    return true;
}

// The work of one frame more. How many dispatches that is, is an API's own; what a device cannot
// count is below 0.
static bool do_alike_work(struct pair *p)
{
    struct rg_tally tallies[RG_SIDES];
    for (int side = 0; side < RG_SIDES; side++)
        if (!rg_session_count(p->sessions[side], &tallies[side]))
            return fail_by_error(p, side);
    for (int i = 0; i < RG_TALLY_FIELDS; i++) {
        const struct rg_tally_field *field = &rg_tally_fields[i];
        int64_t counts[RG_SIDES];
        for (int side = 0; side < RG_SIDES; side++)
            memcpy(&counts[side], (const char *)&tallies[side] + field->offset, sizeof(int64_t));
        if (strcmp(field->name, "dispatches") && counts[0] >= 0 && counts[1] >= 0 &&
            counts[0] != counts[1])
            return differ(p, "a frame has %lld and %lld %s", (long long)counts[0],
                          (long long)counts[1], field->name);
    }
    return true;
}

// --- blame ---

// The first stage that leaves other bits on B than on A, and in what way.
static void name_first_stage(struct pair *p)
{
    const struct rg_digest_run run = {p->subject, p->cell->frames};
    struct rg_blame blame;
    if (rg_blame_find(&run, p->sides[RG_SIDE_B].device, p->sides[RG_SIDE_A].device, &blame) &&
        blame.found)
        snprintf(p->found->details, RG_AGREEMENT_TEXT, "%s", blame.text);
}

static bool tell_code(struct pair *p, struct rg_session_code code[RG_SIDES])
{
    bool ok = true;
    for (int side = 0; ok && side < RG_SIDES; side++)
        ok = rg_session_code(p->sessions[side], &code[side]);
    return ok;
}

void rg_gate_agree(const struct rg_gate_cell *cell, struct rg_side sides[RG_SIDES],
                   struct rg_agreement *agreement)
{
    struct pair p = {.cell = cell,
                     .sides = sides,
                     .subject = {cell->technique, cell->settings, cell->width, cell->height},
                     .found = agreement};
    *agreement = (struct rg_agreement){.pixels = NAN, .difference = NAN};
    bool ok = true;
    for (int side = 0; ok && side < RG_SIDES; side++) {
        p.sessions[side] = rg_session_run(sides[side].device, &p.subject, cell->frames);
        ok = p.sessions[side] || fail_by_error(&p, side);
    }
    ok = ok && have_alike_pictures(&p) && (!owe_bits(&p) || have_alike_states(&p)) &&
         have_alike_counters(&p) && do_alike_work(&p);
    if (ok || agreement->outcome == RG_FAIL)
        agreement->has_code = tell_code(&p, agreement->code);
    for (int side = 0; side < RG_SIDES; side++)
        rg_session_close(p.sessions[side]);
    if (agreement->outcome == RG_FAIL)
        name_first_stage(&p);
}
