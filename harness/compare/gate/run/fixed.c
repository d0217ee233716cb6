#include "harness/compare/gate/run/fixed.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/compare/gate/run/gate.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/measure/serving/fixed.h"
#include "harness/record/passport/key.h"

// A device whose fixed functions are held.
struct held {
    struct rg_running_gate *run;
    const char *device, *driver;
    const json_t *then, *now; // digests
    int same, other;
};

// --- whether bits may be compared ---

// A copy of a device's name without LLVM's version: "llvmpipe (LLVM , 256 bits)". The vector width
// stays, and a driver may be built anew.
static json_t *hardware(const char *name)
{
    char text[RG_KEY_TEXT];
    const char *llvm = strstr(name, "LLVM ");
    const char *rest = llvm ? llvm + strlen("LLVM ") : name;
    snprintf(text, sizeof(text), "%.*s%s", (int)(rest - name), name,
             rest + (llvm ? strspn(rest, "0123456789.") : 0));
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

// Why digests are not compared; "": they are.
static void put_unlike(const struct rg_running_gate *r, int side, char why[RG_KEY_TEXT])
{
    const struct rg_baseline_device *was =
        rg_baseline_device(r->asked->baseline, r->sides[side].name);
    json_t *now = parts_of_bits(r->parts[side]), *then = parts_of_bits(was->parts);
    rg_key_difference(now, then, why);
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

static bool hold(struct held *h, int draw)
{
    const struct rg_gate_request *asked = h->run->asked;
    const char *was = digest_of(h->then, draw), *is = digest_of(h->now, draw);
    const char *cell = rg_gate_fixed_cell(draw);
    const bool same = was && is && !strcmp(was, is);
    const int64_t row = rg_known_row(asked->known, cell, h->device, h->driver, asked->today);
    char own[160] = "", message[200];
    h->same += same;
    h->other += was && !same;
    if (!was || (same && row < 0))
        return true;
    if (!same)
        snprintf(own, sizeof(own), "%s and not %s, which is the baseline's",
                 is ? is : "leaves no digest", was);
    struct rg_known_result *result = &h->run->gate->results[h->run->gate->result_count++];
    *result = (struct rg_known_result){.cell = cell,
                                       .device = h->device,
                                       .driver = h->driver,
                                       .outcome = same ? RG_OK : RG_FAIL,
                                       .pixels = NAN,
                                       .difference = NAN};
    const struct rg_judged judged =
        rg_known_judge(asked->known, row, result, rg_ending_of(result->outcome), asked->today);
    const char *word = rg_judged_word(&judged);
    snprintf(message, sizeof(message), "%s%s%s", word, *word && *own ? ": " : "", own);
    return add_case(h, cell, judged.ending, true, message, 0);
}

// --- a device ---

static bool skip(const struct held *h, enum rg_ending ending, const char *why)
{
    char message[RG_KEY_TEXT + 100];
    snprintf(message, sizeof(message), "%zu digests are not compared: %s",
             json_object_size(h->then), why);
    return add_case(h, RG_GATE_FIXED, ending, false, message, 0);
}

static bool hold_all(struct held *h, struct rg_side *side)
{
    const double start_ms = rg_now_ms();
    bool is_ours, ok = true;
    char why[RG_AGREEMENT_TEXT];
    if (!rg_side_launch(side)) {
        const enum rg_outcome outcome = rg_side_failure(&is_ours, why, sizeof(why));
        return add_case(h, RG_GATE_FIXED, rg_ending_of(outcome), false, why, 0);
    }
    int failed;
    json_t *now = rg_fixed_digests(side->device, &failed);
    h->now = now;
    for (int i = 0; ok && i < rg_fixed_count() && !rg_interrupted(); i++)
        ok = hold(h, i);
    json_decref(now);
    snprintf(why, sizeof(why), "%d digests are the baseline's", h->same);
    if (h->other)
        snprintf(why, sizeof(why), "%d digests are the baseline's, and %d are not", h->same,
                 h->other);
    return rg_interrupted() || (ok && add_case(h, RG_GATE_FIXED, RG_ENDING_PASS, true, why,
                                               (rg_now_ms() - start_ms) / 1000));
}

static bool hold_side(struct rg_running_gate *r, int side)
{
    struct held h = {.run = r,
                     .device = r->sides[side].name,
                     .driver = r->gate->drivers[side / RG_SIDES],
                     .then = rg_fixed_kept(r->asked->baseline->passport, r->sides[side].name)};
    char why[RG_KEY_TEXT];
    snprintf(r->gate->drivers[side / RG_SIDES], sizeof(r->gate->drivers[0]), "%s",
             r->infos[side].driver);
    if (!*r->infos[side].name)
        return skip(&h, RG_ENDING_UNSUPPORTED, "the device did not open");
    put_unlike(r, side, why);
    if (*why)
        return skip(&h, RG_ENDING_SKIPPED, why);
    if (rg_gate_is_over(r))
        return skip(&h, RG_ENDING_INCONCLUSIVE, "the time was over");
    return hold_all(&h, &r->sides[side]);
}

bool rg_gate_hold_fixed(struct rg_running_gate *r)
{
    bool ok = true;
    for (int side = 0; ok && side < r->side_count && !rg_interrupted(); side++)
        ok = !r->has_fixed[side] || hold_side(r, side);
    r->gate->is_told = ok;
    return ok;
}
