#include "harness/compare/gate/baseline/compare.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

// Adds to what is to be known.
__attribute__((format(printf, 2, 3))) static void say(struct rg_agreement *agreement,
                                                      const char *format, ...)
{
    const size_t used = strlen(agreement->message), room = RG_AGREEMENT_TEXT - used;
    const int gap = used ? snprintf(agreement->message + used, room, "; ") : 0;
    va_list args;
    va_start(args, format);
    if ((size_t)gap < room)
        vsnprintf(agreement->message + used + gap, room - (size_t)gap, format, args);
    va_end(args);
}

// --- what is the same every time ---

static bool has_its_states(const struct rg_baseline_row *before, const struct rg_baseline_row *now,
                           struct rg_agreement *agreement)
{
    if (before->state_count != now->state_count)
        return rg_agreement_differs(agreement, "there are %d states, and there were %d",
                                    now->state_count, before->state_count);
    for (int i = 0; i < now->state_count; i++) {
        const struct rg_baseline_state *was = NULL, *is = &now->states[i];
        for (int k = 0; !was && k < before->state_count; k++)
            was = strcmp(before->states[k].name, is->name) ? NULL : &before->states[k];
        if (!was)
            return rg_agreement_differs(agreement, "the state '%s' is new", is->name);
        if (strcmp(was->digest, is->digest) != 0)
            return rg_agreement_differs(agreement, "the state '%s' has digest %s, and had %s",
                                        is->name, is->digest, was->digest);
    }
    return true;
}

// That of the baseline was what it should be, so one that is the same to the bit is too.
static bool has_its_picture(const struct rg_gate_cell *cell, const struct rg_device *device,
                            const struct rg_baseline_row *before, const struct rg_baseline_row *now,
                            const struct rg_picture *picture, struct rg_truth *truth,
                            struct rg_agreement *agreement)
{
    static const char *const tiers[] = {[RG_T0] = "T0", [RG_T1] = "T1", [RG_T2] = "T2"};
    const bool is_same = !strcmp(before->picture, now->picture);
    if (is_same && before->outcome == RG_OK)
        return true;
    if (!rg_truth_holds(truth, cell, device, picture, agreement))
        return false;
    if (!is_same)
        say(agreement,
            "the picture is another than the baseline's, and holds %s against cpu:reference as it "
            "draws now",
            tiers[rg_tier_owed(&device->info, &truth->device->info)]);
    return true;
}

static bool did_run(enum rg_outcome outcome)
{
    return outcome == RG_OK || outcome == RG_FAIL;
}

void rg_against_end(const struct rg_baseline_row *before, struct rg_agreement *agreement)
{
    char why[RG_AGREEMENT_TEXT];
    if (agreement->outcome != RG_UNSUPPORTED || !did_run(before->outcome))
        return;
    memcpy(why, agreement->message, sizeof(why));
    rg_agreement_differs(agreement, "it ran when the baseline was made: %.500s", why);
}

// What did not run has nothing that could be held against what did.
static void compare_ends(const struct rg_baseline_row *before, const struct rg_baseline_row *now,
                         struct rg_agreement *agreement)
{
    const char *as = before->outcome == now->outcome ? ", as in the baseline" : "";
    agreement->outcome = now->outcome;
    agreement->is_ours = now->is_ours;
    snprintf(agreement->message, RG_AGREEMENT_TEXT, "%.600s%s", now->why, as);
    rg_against_end(before, agreement);
}

// The baseline has no stages, but cpu:reference can be asked now. Where it `holds` the same picture
// as the device, what differs from the baseline may be what all devices compute.
static void blame(const struct rg_gate_cell *cell, struct rg_device *device, struct rg_truth *truth,
                  bool holds, struct rg_agreement *agreement)
{
    if (rg_truth_open(truth) && rg_agreement_blame(cell, device, truth->device, agreement) &&
        holds && !*agreement->details)
        snprintf(agreement->details, RG_AGREEMENT_TEXT,
                 "cpu:reference leaves the same bits behind every stage now: what has changed is "
                 "what raingauge computes, and not how the device does");
}

void rg_against_compare(const struct rg_gate_cell *cell, struct rg_device *device,
                        const struct rg_baseline_row *before, struct rg_truth *truth,
                        struct rg_agreement *agreement)
{
    struct rg_baseline_row now = {.outcome = RG_OK};
    struct rg_picture picture;
    rg_baseline_take(cell, device, &now, &picture);
    if (now.outcome != RG_OK) {
        compare_ends(before, &now, agreement);
        return;
    }
    agreement->code[RG_SIDE_B] = now.code;
    const bool holds = has_its_picture(cell, device, before, &now, &picture, truth, agreement);
    if (!did_run(before->outcome))
        say(agreement,
            "the baseline has it as %s, and no states, counters or times to hold it against; "
            "`raingauge baseline --update` has it anew",
            rg_outcome_name(before->outcome));
    else if (holds && has_its_states(before, &now, agreement) &&
             rg_alike_counters(&before->counters, &now.counters, agreement))
        rg_alike_work(&before->work, &now.work, agreement);
    rg_picture_destroy(&picture);
    if (agreement->outcome == RG_FAIL)
        blame(cell, device, truth, holds, agreement);
}

// --- advice ---

void rg_against_advise(const struct rg_gate_row *row, const struct rg_timed_cell *timed,
                       const struct rg_launches *then, const struct rg_launches *now,
                       struct rg_agreement *agreement)
{
    double least = INFINITY, most = 0;
    size_t used = 0;
    if (timed->outcome != RG_OK) {
        agreement->outcome = timed->outcome;
        agreement->is_ours = timed->is_ours;
        snprintf(agreement->message, RG_AGREEMENT_TEXT, "%s", timed->why);
        return;
    }
    for (int i = 0; i < RG_YARDSTICKS; i++) {
        const double slower = rg_launches_median(&now[i]) / rg_launches_median(&then[i]);
        const double ratio = row->decision.ratio / slower;
        if (!isfinite(ratio))
            continue;
        least = fmin(least, ratio);
        most = fmax(most, ratio);
        if (used < RG_AGREEMENT_TEXT)
            used += (size_t)snprintf(agreement->details + used, RG_AGREEMENT_TEXT - used,
                                     "%s%s takes %.2f times as long: %.2f by it", used ? "\n" : "",
                                     rg_yardstick_name((enum rg_yardstick)i), slower, ratio);
    }
    if (!row->decision.units)
        say(agreement, "advisory: no time was taken");
    else if (most > 0)
        say(agreement,
            "advisory, for its key is another: a frame takes %.2f times as long (%.3g ms, %.3g ms "
            "before), and %.2f to %.2f times by the yardsticks",
            row->decision.ratio, row->b_ms.median, row->a_ms.median, least, most);
}
