#include "harness/compare/gate/run/running.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/base/text/add.h"
#include "harness/compare/blame/blame.h"

// A cell's result on a side, or in a baseline.
struct left {
    struct rg_baseline_row row;
    struct rg_picture picture;
};

// Appends a remark to the message.
#define SAY(agreement, ...) rg_text_add((agreement)->message, RG_AGREEMENT_TEXT, "; ", __VA_ARGS__)

// --- cells that did not run ---

static bool did_run(enum rg_outcome outcome)
{
    return outcome == RG_OK || outcome == RG_FAIL;
}

// Turns unsupported, for a missing device or a cell that it cannot run, into a difference if the
// cell ran when the baseline was made.
static void end_by(const struct rg_baseline_row *before, struct rg_agreement *agreement)
{
    char why[RG_AGREEMENT_TEXT];
    if (!before || agreement->outcome != RG_UNSUPPORTED || !did_run(before->outcome))
        return;
    memcpy(why, agreement->message, sizeof(why));
    rg_agreement_differs(agreement, "it ran when the baseline was made: %.500s", why);
}

void rg_gate_agree_fails(struct rg_gate_case *c, const char *device)
{
    rg_agreement_fails(&c->agreement, device);
    end_by(c->before, &c->agreement);
    c->agreement.is_ours |= c->agreement.outcome == RG_FAIL; // no driver drew a picture
}

static bool take(struct rg_gate_case *c, int side, struct left *left)
{
    struct rg_agreement *found = &c->agreement;
    rg_baseline_take(c->cell, c->sides[side]->device, &left->row, &left->picture);
    found->code[side] = left->row.code;
    if (left->row.outcome == RG_OK)
        return true;
    const bool is_as_before = c->before && c->before->outcome == left->row.outcome;
    found->outcome = left->row.outcome;
    found->is_ours = left->row.is_ours;
    found->device = c->before ? NULL : c->devices[side];
    snprintf(found->message, RG_AGREEMENT_TEXT, "%.600s%s", left->row.why,
             is_as_before ? ", as in the baseline" : "");
    end_by(c->before, found);
    return false;
}

// --- cells that ran ---

static const struct rg_device_info *info_of(const struct rg_gate_case *c, int side)
{
    return &c->sides[side]->device->info;
}

static enum rg_tier owed_by(const struct rg_gate_case *c)
{
    return rg_tier_owed(info_of(c, RG_SIDE_A), info_of(c, RG_SIDE_B));
}

// The baseline's picture was right, so a picture with equal bits is right too.
static bool has_its_picture(struct rg_gate_case *c, const struct left *now, struct rg_truth *truth)
{
    const bool is_same = !strcmp(c->before->picture, now->row.picture);
    if (is_same && c->before->outcome == RG_OK)
        return true;
    if (!rg_truth_holds(truth, c->cell, c->sides[RG_SIDE_B]->device, &now->picture, &c->agreement))
        return false;
    if (!is_same)
        SAY(&c->agreement,
            "the picture is another than the baseline's, and holds %s against cpu:reference as it "
            "draws now",
            rg_tier_name(rg_tier_owed(info_of(c, RG_SIDE_B), &truth->device->info)));
    return true;
}

static bool have_alike_pictures(struct rg_gate_case *c, const struct left *a, const struct left *b)
{
    const struct rg_drawn drawn[RG_SIDES] = {
        {c->devices[RG_SIDE_A], c->sides[RG_SIDE_A]->device, a->picture},
        {c->devices[RG_SIDE_B], c->sides[RG_SIDE_B]->device, b->picture}};
    return rg_alike_pictures(c->cell, &drawn[0], &drawn[1], &c->agreement);
}

static bool have_alike_states(struct rg_gate_case *c, const struct rg_baseline_row *before,
                              const struct rg_baseline_row *now)
{
    struct rg_agreement *found = &c->agreement;
    if (before->state_count != now->state_count)
        return rg_agreement_differs(found, "there are %d states, and there were %d",
                                    now->state_count, before->state_count);
    for (int i = 0; i < now->state_count; i++) {
        const struct rg_baseline_state *is = &now->states[i];
        const char *was = rg_baseline_state(before, is->name);
        if (!was)
            return rg_agreement_differs(found, "the state '%s' is new", is->name);
        if (!strcmp(was, is->digest))
            continue;
        return c->before ? rg_agreement_differs(found, "the state '%s' has digest %s, and had %s",
                                                is->name, is->digest, was)
                         : rg_agreement_differs(found, "the state '%s' differs after %d frames",
                                                is->name, c->cell->frames);
    }
    return true;
}

static bool have_alike_counters(const struct rg_counters *a, const struct rg_counters *b,
                                struct rg_agreement *agreement)
{
    if (a->count != b->count)
        return rg_agreement_differs(agreement, "there are %d and %d counters", a->count, b->count);
    for (int i = 0; i < a->count; i++) {
        const struct rg_count *one = &a->counters[i], *other = &b->counters[i];
        if (strcmp(one->name, other->name) != 0)
            return rg_agreement_differs(agreement, "a counter is '%s' and '%s'", one->name,
                                        other->name);
        if (one->value != other->value)
            return rg_agreement_differs(agreement, "the counter '%s' is %lld and %lld", one->name,
                                        (long long)one->value, (long long)other->value);
    }
    return true;
}

// Compares all counted work but the number of dispatches, which depends on the API. Work that a
// device cannot count is ignored.
static bool have_alike_work(const struct rg_tally *a, const struct rg_tally *b,
                            struct rg_agreement *agreement)
{
    for (int i = 0; i < RG_TALLY_FIELDS; i++) {
        const char *name = rg_tally_fields[i].name;
        const long long one = rg_tally_count(a, i), other = rg_tally_count(b, i);
        if (strcmp(name, "dispatches") && one >= 0 && other >= 0 && one != other)
            return rg_agreement_differs(agreement, "a frame has %lld and %lld %s", one, other,
                                        name);
    }
    return true;
}

static bool have_alike_counts(struct rg_gate_case *c, const struct rg_baseline_row *before,
                              const struct rg_baseline_row *now)
{
    return have_alike_counters(&before->counters, &now->counters, &c->agreement) &&
           have_alike_work(&before->work, &now->work, &c->agreement);
}

// Finds the first stage after which the device's bits differ from the truth's, and names it in the
// details. False if that could not be found out.
static bool find_stage(struct rg_gate_case *c, struct rg_device *truth)
{
    const struct rg_digest_run run = {c->cell->subject, c->cell->frames};
    struct rg_blame blame;
    const bool ok = rg_blame_find(&run, c->sides[RG_SIDE_B]->device, truth, &blame);
    if (ok && blame.found)
        snprintf(c->agreement.details, RG_AGREEMENT_TEXT, "%s", blame.text);
    return ok;
}

// A baseline has no stages, but cpu:reference can be run now. If it `holds` the device's picture, a
// difference from the baseline may come from what all devices compute, or from the host's
// libraries.
static void blame(struct rg_gate_case *c, struct rg_truth *truth, bool holds)
{
    struct rg_agreement *found = &c->agreement;
    if (rg_truth_open(truth) && find_stage(c, truth->device) && holds && !*found->details)
        snprintf(found->details, RG_AGREEMENT_TEXT,
                 "cpu:reference leaves the same bits after every stage now: what has changed is "
                 "%s%.400s, and not how the device does",
                 *truth->libraries ? "what the host computes with, " : "what raingauge computes",
                 truth->libraries);
}

static void hold_against_before(struct rg_gate_case *c, const struct left *now,
                                struct rg_truth *truth)
{
    const bool holds = has_its_picture(c, now, truth);
    if (!did_run(c->before->outcome))
        SAY(&c->agreement,
            "the baseline has it as %s, and no states, counters or times to hold it against; "
            "`raingauge baseline --update` has it anew",
            rg_outcome_name(c->before->outcome));
    else if (holds && have_alike_states(c, c->before, &now->row))
        have_alike_counts(c, c->before, &now->row);
    if (c->agreement.outcome == RG_FAIL)
        blame(c, truth, holds);
}

static void hold_against_a(struct rg_gate_case *c, const struct left *a, const struct left *b)
{
    struct rg_agreement *found = &c->agreement;
    const bool are_alike = have_alike_pictures(c, a, b) &&
                           (owed_by(c) != RG_T0 || have_alike_states(c, &a->row, &b->row)) &&
                           have_alike_counts(c, &a->row, &b->row);
    found->has_code = are_alike || found->outcome == RG_FAIL;
    if (found->outcome == RG_FAIL)
        find_stage(c, c->sides[RG_SIDE_A]->device);
}

void rg_gate_agree(struct rg_gate_case *c, struct rg_truth *truth, const char *folder)
{
    struct left a = {.row = {.outcome = RG_OK}}, b = a;
    c->agreement =
        (struct rg_agreement){.folder = folder, .name = c->name, .pixels = NAN, .difference = NAN};
    const bool ok =
        c->before || (rg_alike_has_room(c->cell, &c->agreement) && take(c, RG_SIDE_A, &a));
    if (ok && take(c, RG_SIDE_B, &b)) {
        if (c->before)
            hold_against_before(c, &b, truth);
        else
            hold_against_a(c, &a, &b);
    }
    rg_picture_destroy(&a.picture);
    rg_picture_destroy(&b.picture);
}

// --- advice ---

void rg_gate_advise(const struct rg_gate_row *row, const struct rg_timed_cell *timed,
                    const struct rg_launches *then, const struct rg_launches *now,
                    struct rg_agreement *agreement)
{
    double least = INFINITY, most = 0;
    if (timed->outcome != RG_OK) {
        agreement->outcome = timed->outcome;
        agreement->is_ours = timed->is_ours;
        snprintf(agreement->message, RG_AGREEMENT_TEXT, "%s", timed->why);
        return;
    }
    if (!row->decision.units) {
        if (row->launches)
            SAY(agreement, "advisory, and no time counts: of %d launches %d were disturbed",
                row->launches, row->disturbed);
        else
            SAY(agreement, "advisory: no time was taken");
        return;
    }
    for (int i = 0; i < RG_YARDSTICKS; i++) {
        const double slower = rg_launches_median(&now[i]) / rg_launches_median(&then[i]);
        const double ratio = row->decision.ratio / slower;
        if (!isfinite(ratio))
            continue;
        least = fmin(least, ratio);
        most = fmax(most, ratio);
        rg_text_add(agreement->details, RG_AGREEMENT_TEXT, "\n",
                    "%s takes %.2f times as long: %.2f by it",
                    rg_yardstick_name((enum rg_yardstick)i), slower, ratio);
    }
    if (most > 0)
        SAY(agreement,
            "advisory, for its key is another: a frame takes %.2f times as long (%.3g ms, %.3g ms "
            "in the baseline), and %.2f to %.2f times by the yardsticks",
            row->decision.ratio, row->b_ms.median, row->a_ms.median, least, most);
}
