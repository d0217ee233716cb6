#include "harness/compare/gate/run/running.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/text/add.h"
#include "harness/compare/gate/run/gate.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/devices/measure/serving/fixed_pairs.h"
#include "harness/devices/names.h"
#include "harness/record/passport/key.h"

// A device whose fixed functions are held against a baseline's, or against those of `a`.
struct held {
    struct rg_running_gate *run;
    const char *device, *driver;
    const char *others;    // whose they must be: "the baseline's"
    struct rg_side *a, *b; // a: NULL with a baseline
    const json_t *then;    // digests
    struct rg_fixed_left left_a, now;
    int same, allowed, other, undrawn;
};

bool rg_gate_has_fixed(const struct rg_baseline *baseline, const struct rg_gate_pair *pair)
{
    const char *a = pair->names[RG_SIDE_A], *b = pair->names[RG_SIDE_B];
    if (baseline)
        return rg_fixed_kept(baseline->passport, b);
    const struct rg_backend *backend = rg_backend_of(rg_device_name_full(b));
    return backend && backend->fixed_draw && rg_devices_choose_drivers(a, b);
}

// --- whether bits may be compared ---

// A copy of a device's name without LLVM's version: "llvmpipe (LLVM, 256 bits)". The vector width
// stays, and a driver may be built anew.
static json_t *hardware(const char *name)
{
    char text[RG_KEY_TEXT];
    const char *llvm = strstr(name, "LLVM ");
    const char *rest = llvm ? llvm + strlen("LLVM") : name;
    snprintf(text, sizeof(text), "%.*s%s", (int)(rest - name), name,
             rest + (llvm ? strspn(rest, " 0123456789.") : 0));
    return json_string(text);
}

// The parts of a comparison key on which the bits of one API may depend.
static json_t *parts_of_bits(json_t *parts)
{
    const char *device = json_string_value(json_object_get(parts, "device"));
    return json_pack("{sO?sO?sO?so}", "cpu", json_object_get(parts, "cpu"), "features",
                     json_object_get(parts, "features"), "variables",
                     json_object_get(parts, "variables"), "device", hardware(device ? device : ""));
}

// Why digests are not compared; "": they are. Two drivers run on one processor.
static void put_unlike(const struct held *h, char why[RG_KEY_TEXT])
{
    const struct rg_baseline *baseline = h->run->asked->baseline;
    json_t *then = h->a ? json_pack("{so}", "device", hardware(h->a->info.device))
                        : parts_of_bits(rg_baseline_device(baseline, h->device)->parts);
    json_t *now = h->a ? json_pack("{so}", "device", hardware(h->b->info.device))
                       : parts_of_bits(h->b->parts);
    rg_key_difference(now, then, why);
    if (!*why && h->a)
        rg_devices_settings(h->b->name, h->a->name, why, RG_KEY_TEXT);
    json_decref(now);
    json_decref(then);
}

// --- one fixed function ---

static const char *digest_of(const json_t *digests, int draw)
{
    return json_string_value(json_object_get(digests, rg_fixed_draws[draw].feature));
}

static bool add_case(const struct held *h, const char *cell, enum rg_ending ending,
                     bool is_compared, const char *message, double seconds)
{
    char *name = rg_gate_case_name(cell, h->device);
    const bool ok = name && rg_report_add(&h->run->gate->report,
                                          &(struct rg_report_case){.name = name,
                                                                   .technique = RG_GATE_FIXED,
                                                                   .devices = &h->device,
                                                                   .device_count = 1,
                                                                   .seconds = seconds,
                                                                   .ending = ending,
                                                                   .is_compared = is_compared,
                                                                   .message = message,
                                                                   RG_UNMEASURED});
    free(name);
    return ok;
}

// Whether digests of a draw may differ: both pictures are within the draw's bounds.
static bool is_allowed(const struct held *h, int draw)
{
    const bool was_within =
        h->a ? h->left_a.is_within[draw]
             : rg_fixed_kept_within(h->run->asked->baseline->passport, h->device, draw);
    return was_within && h->now.is_within[draw];
}

// Whether nothing is known of a draw, by a failure of the driver or of raingauge itself.
static bool is_undrawn(const struct held *h, int draw)
{
    const enum rg_outcome outcome = h->now.outcomes[draw];
    return rg_outcome_is_broken(outcome) || outcome == RG_NOTHING;
}

static void put_difference(const struct held *h, int draw, bool allowed, char *text, size_t size)
{
    const char *was = digest_of(h->then, draw), *is = digest_of(h->now.digests, draw);
    if (is_undrawn(h, draw))
        snprintf(text, size, "could not be drawn");
    else if (allowed)
        snprintf(text, size, "differs from %s, and both are within bounds", h->others);
    else
        snprintf(text, size, "%s and not %s, which is %s", is ? is : "leaves no digest", was,
                 h->others);
}

static struct rg_judged judge(struct held *h, int draw, int64_t row, bool holds)
{
    const struct rg_gate_request *asked = h->run->asked;
    struct rg_known_result *result = &h->run->gate->results[h->run->gate->result_count++];
    const bool is_left = holds || !is_undrawn(h, draw);
    const enum rg_outcome drawn = h->now.outcomes[draw];
    *result = (struct rg_known_result){
        .cell = rg_gate_fixed_cell(draw),
        .device = h->device,
        .driver = h->driver,
        .outcome = !is_left ? drawn
                   : holds  ? RG_OK
                            : RG_FAIL,
        .is_foreign = !is_left && (drawn == RG_NOTHING ? h->now.failed : drawn) == RG_LACKING,
        .pixels = NAN,
        .difference = NAN};
    return rg_known_judge(asked->known, row, result, rg_ending_of(result->outcome), asked->today);
}

static bool hold(struct held *h, int draw)
{
    const struct rg_gate_request *asked = h->run->asked;
    const char *was = digest_of(h->then, draw), *is = digest_of(h->now.digests, draw);
    const char *cell = rg_gate_fixed_cell(draw);
    const bool same = was && is && !strcmp(was, is);
    const bool allowed = was && is && !same && is_allowed(h, draw);
    const int64_t row = rg_known_row(asked->known, cell, h->device, h->driver, asked->today);
    char own[160] = "", message[200];
    h->same += same;
    h->allowed += allowed;
    h->undrawn += was && is_undrawn(h, draw);
    h->other += was && !same && !allowed && !is_undrawn(h, draw);
    if (!was || (same && row < 0))
        return true;
    if (!same)
        put_difference(h, draw, allowed, own, sizeof(own));
    const struct rg_judged judged = judge(h, draw, row, same || (allowed && !asked->strict));
    const char *word = rg_judged_word(&judged);
    snprintf(message, sizeof(message), "%s%s%s", word, *word && *own ? ": " : "", own);
    return add_case(h, cell, judged.ending, !is_undrawn(h, draw), message, 0);
}

// --- a device ---

static bool skip(const struct held *h, enum rg_ending ending, const char *why)
{
    char message[RG_KEY_TEXT + 100];
    snprintf(message, sizeof(message), "%zu digests are not compared: %s",
             h->a ? (size_t)rg_fixed_count() : json_object_size(h->then), why);
    return add_case(h, RG_GATE_FIXED, ending, false, message, 0);
}

static bool hold_all(struct held *h, double start_ms)
{
    char told[300];
    bool ok = true;
    rg_fixed_draw_all(h->b->device, &h->now);
    for (int i = 0; ok && i < rg_fixed_count() && !rg_interrupted(); i++)
        ok = hold(h, i);
    rg_fixed_left_free(&h->now);
    snprintf(told, sizeof(told), "%d %s %s", h->same, h->same == 1 ? "digest is" : "digests are",
             h->others);
    if (h->allowed)
        rg_text_add(told, sizeof(told), ", ", "%d %s as the APIs allow", h->allowed,
                    h->allowed == 1 ? "differs" : "differ");
    if (h->other)
        rg_text_add(told, sizeof(told), ", ", "and %d %s not", h->other,
                    h->other == 1 ? "is" : "are");
    if (h->undrawn)
        rg_text_add(told, sizeof(told), ", ", "%d could not be drawn", h->undrawn);
    const double seconds = (rg_now_ms() - start_ms) / 1000;
    return rg_interrupted() || (ok && add_case(h, RG_GATE_FIXED, RG_ENDING_PASS,
                                               h->same + h->allowed + h->other > 0, told, seconds));
}

static bool launch(struct held *h, struct rg_side *side, bool *ok)
{
    bool is_ours;
    char why[RG_AGREEMENT_TEXT];
    if (rg_side_launch(side))
        return true;
    const enum rg_outcome outcome = rg_side_failure(&is_ours, why, sizeof(why));
    *ok = add_case(h, RG_GATE_FIXED, rg_ending_of(outcome), false, why, 0);
    return false;
}

static bool launch_and_hold(struct held *h)
{
    const double start_ms = rg_now_ms();
    bool ok = true;
    if ((h->a && !launch(h, h->a, &ok)) || !launch(h, h->b, &ok))
        return ok;
    if (!h->a)
        return hold_all(h, start_ms);
    rg_fixed_draw_all(h->a->device, &h->left_a);
    h->then = h->left_a.digests;
    if (h->left_a.failed != RG_OK)
        ok = skip(h, rg_ending_of(h->left_a.failed), "A could not draw them");
    else if (!json_object_size(h->then))
        ok = skip(h, RG_ENDING_UNSUPPORTED, "A draws none of them");
    else
        ok = hold_all(h, start_ms);
    rg_fixed_left_free(&h->left_a);
    return ok;
}

static bool hold_pair(struct rg_running_gate *r, struct rg_side *sides, char driver[160])
{
    const struct rg_baseline *baseline = r->asked->baseline;
    struct rg_side *a = &sides[RG_SIDE_A], *b = &sides[RG_SIDE_B];
    char others[RG_DEVICE_NAME_SIZE + 8] = "the baseline's", why[RG_KEY_TEXT];
    struct held h = {.run = r,
                     .device = b->name,
                     .driver = driver,
                     .others = others,
                     .a = baseline ? NULL : a,
                     .b = b,
                     .then = baseline ? rg_fixed_kept(baseline->passport, b->name) : NULL};
    snprintf(driver, sizeof(r->gate->drivers[0]), "%s", b->info.driver);
    if (h.a)
        snprintf(others, sizeof(others), "%s's", a->name);
    if (!*b->info.name || (h.a && !*a->info.name))
        return skip(&h, RG_ENDING_UNSUPPORTED, "the device did not open");
    put_unlike(&h, why);
    if (*why)
        return skip(&h, RG_ENDING_SKIPPED, why);
    if (rg_gate_is_over(r))
        return skip(&h, RG_ENDING_INCONCLUSIVE, "the time was over");
    return launch_and_hold(&h);
}

bool rg_gate_hold_fixed(struct rg_running_gate *r)
{
    bool ok = true;
    for (int pair = 0; ok && pair < r->asked->pairs->count && !rg_interrupted(); pair++) {
        struct rg_side *sides = &r->sides[pair * RG_SIDES];
        ok = !sides[RG_SIDE_B].has_fixed || hold_pair(r, sides, r->gate->drivers[pair]);
    }
    r->gate->is_told = ok;
    return ok;
}
