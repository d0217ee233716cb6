#include "harness/compare/gate/run/gate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/compare/gate/cells/unused.h"
#include "harness/compare/gate/run/running.h"
#include "harness/console/clock.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"
#include "harness/record/passport/driver.h"
#include "harness/record/passport/key.h"
#include "harness/record/passport/passport.h"

// --- sides ---

static bool was_open(const struct rg_side *side)
{
    return *side->info.name;
}

// Launches each side once. Names of pairs must be valid, the two of a pair distinct, and required
// devices there; any other missing side only ends its cases. Returns an enum rg_exit.
static int look_at_sides(struct rg_running_gate *r)
{
    struct rg_gate_target targets[RG_MAX_DEVICES];
    int target_count = 0;
    for (int i = 0; i < r->side_count && !rg_interrupted(); i++) {
        struct rg_side *side = &r->sides[i];
        const bool is_b = i % RG_SIDES == RG_SIDE_B;
        if (!side->name)
            continue;
        rg_side_look(side);
        rg_side_close(side);
        if (is_b)
            targets[target_count++] =
                (struct rg_gate_target){side->name, was_open(side) ? side->info.driver : NULL};
        if (!r->asked->baseline &&
            (!side->is_name || (is_b && was_open(side) && was_open(side - 1) &&
                                !rg_devices_are_apart(&side[-1].info, &side->info))))
            return RG_EXIT_USAGE;
    }
    if (rg_interrupted())
        return RG_EXIT_PASS;
    rg_gate_warn_of_unused_on(r->asked->known, r->asked->cells, targets, target_count);
    return rg_sides_have(r->sides, r->side_count, r->asked->require, &r->gate->report)
               ? RG_EXIT_PASS
               : RG_EXIT_FAIL;
}

// Describes the machine, and the sides that are present, on which the report's numbers depend.
static bool set_passport(struct rg_running_gate *r)
{
    struct rg_device_info there[RG_GATE_MOST_SIDES];
    int count = 0;
    for (int side = 0; side < r->side_count; side++)
        if (was_open(&r->sides[side]))
            there[count++] = r->sides[side].info;
    r->passport = rg_passport_json(there, count);
    if (r->asked->baseline)
        rg_key_libraries(r->passport, r->asked->baseline->passport, r->truth.libraries);
    char *text = r->passport ? json_dumps(r->passport, JSON_INDENT(1)) : NULL;
    const bool ok = text && rg_report_set_passport(&r->gate->report, text);
    free(text);
    return ok;
}

// Finds out whether the times of a side that runs alone can be compared with the baseline's, and
// writes the reason to `out`.
static void compare_key(const struct rg_running_gate *r, struct rg_side *side, FILE *out)
{
    const struct rg_baseline_device *was = rg_baseline_device(r->asked->baseline, side->name);
    json_t *device = rg_passport_device(&side->info);
    char now_key[RG_KEY_SIZE], was_key[RG_KEY_SIZE], text[RG_KEY_TEXT];
    side->parts = rg_key_parts(r->passport, device);
    side->same_key = json_equal(side->parts, was->parts);
    json_decref(device);
    rg_key_hash(side->parts, now_key);
    rg_key_hash(was->parts, was_key);
    rg_key_difference(side->parts, was->parts, text);
    if (side->same_key)
        fprintf(out, "%s: key %s, as the baseline's\n", was->name, now_key);
    else
        fprintf(out, "%s: key %s, and the baseline's is %s, so that times are advisory: %s\n",
                was->name, now_key, was_key, text);
}

// Notes which driver each side runs, to be printed above the results.
static bool note_sides(struct rg_running_gate *r)
{
    size_t size;
    char line[RG_DRIVER_LINE];
    FILE *out = open_memstream(&r->gate->note, &size);
    for (int i = 0; out && i < r->side_count; i++) {
        struct rg_side *side = &r->sides[i];
        if (!was_open(side))
            continue;
        rg_driver_line(&side->info, line);
        if (!r->asked->baseline)
            fprintf(out, "%c  ", "AB"[i % RG_SIDES]);
        fprintf(out, "%s\n", line);
        if (r->asked->baseline)
            compare_key(r, side, out);
    }
    if (!out || fclose(out) != 0)
        return rg_harness_error("gate: no memory for its devices' lines");
    return rg_report_set_drivers(&r->gate->report, r->gate->note);
}

// --- the journal ---

// Everything that the times depend on, those of a baseline among it.
static json_t *key_of(const struct rg_running_gate *r)
{
    const struct rg_gate_request *asked = r->asked;
    json_t *cells = json_object(), *pairs = json_array(), *before = json_object();
    char digest[RG_DIGEST_SIZE];
    for (int64_t i = 0; i < asked->cells->count; i++) {
        rg_digest_of_cell(&asked->cells->cells[i], digest);
        json_object_set_new(cells, asked->cells->cells[i].name, json_string(digest));
    }
    for (int i = 0; i < asked->pairs->count; i++)
        json_array_append_new(pairs, json_pack("[s, s]", asked->pairs->all[i].names[RG_SIDE_A],
                                               asked->pairs->all[i].names[RG_SIDE_B]));
    for (int i = 0; asked->baseline && i < r->gate->case_count; i++) {
        const struct rg_launches *launches = &r->gate->cases[i].before->launches;
        rg_digest_of(launches->ms, (size_t)launches->count * sizeof(*launches->ms), digest);
        json_object_set_new(before, r->gate->cases[i].name, json_string(digest));
    }
    return json_pack("{s:o, s:o, s:o, s:O, s:f, s:s, s:i, s:i}", "cells", cells, "pairs", pairs,
                     "baseline", before, "passport", r->passport, "margin", asked->margin, "filter",
                     asked->filter ? asked->filter : "", "shard", asked->shard.number, "shards",
                     asked->shard.count); // shards may use the same folder
}

static bool open_journal(struct rg_running_gate *r)
{
    if (!r->asked->folder || r->asked->pictures_only)
        return true;
    r->journal = rg_gate_journal_open(r->asked->folder, key_of(r), r->asked->fresh);
    return r->journal;
}

// --- comparing ---

// Makes the case's sides, and no others, run; a failure ends the case.
static bool launch_for(struct rg_running_gate *r, struct rg_gate_case *c)
{
    for (int i = 0; i < r->side_count; i++)
        if (&r->sides[i] != c->sides[RG_SIDE_A] && &r->sides[i] != c->sides[RG_SIDE_B])
            rg_side_close(&r->sides[i]);
    for (int i = 0; i < RG_SIDES; i++) {
        struct rg_side *side = c->sides[i];
        if (!side || side->device || rg_side_launch(side))
            continue;
        c->agreement = (struct rg_agreement){.pixels = NAN, .difference = NAN};
        rg_gate_agree_fails(c, side->name);
        return false;
    }
    return true;
}

static void compare(struct rg_running_gate *r, struct rg_gate_case *c)
{
    const double start_ms = rg_now_ms();
    // The first is compared in any case, so that it is known how long that takes.
    const bool over = rg_gate_is_over(r) && c != r->gate->cases, there = !over && launch_for(r, c);
    rg_gate_case_expect(c, r->asked);
    c->is_compared = there && !c->is_skipped;
    c->is_over = over && !c->is_skipped;
    if (c->is_over)
        c->agreement = (struct rg_agreement){.outcome = RG_UNSUPPORTED,
                                             .pixels = NAN,
                                             .difference = NAN,
                                             .message = "the time was over before it was compared"};
    if (c->is_compared)
        rg_gate_agree(c, &r->truth, r->asked->pictures);
    c->seconds = (rg_now_ms() - start_ms) / 1000;
    if (!c->is_compared || c->agreement.outcome != RG_OK || r->asked->pictures_only)
        return;
    if (!c->before) {
        c->is_timed = true;
    } else if (c->before->launches.count) {
        c->is_timed = c->sides[RG_SIDE_B]->same_key;
        c->is_advised = !c->is_timed;
    }
}

// --- the budget ---

// Gives a pair its share of the time that is left.
static void begin_pair(struct rg_running_gate *r, int pair)
{
    const double now_ms = rg_now_ms();
    const double left_ms = r->asked->begin_ms + 1e3 * r->asked->budget_s - now_ms;
    r->start_ms = now_ms;
    r->end_ms =
        r->asked->budget_s > 0 ? now_ms + fmax(left_ms, 0) / (rg_gate_courses(r) - pair) : 0;
}

static int first_look(const struct rg_running_gate *r)
{
    return (r->asked->baseline ? rg_gate_rule_apart(1) : rg_gate_rule_of(1)).looks[0];
}

// If the time is over before the first launch, a launch is taken to last as long as comparing did.
static void expect_look(struct rg_running_gate *r, const struct rg_gate_case *cases, int count)
{
    int compared = 0;
    for (int i = 0; i < count; i++)
        compared += !cases[i].is_over;
    const double compare_ms = (rg_now_ms() - r->start_ms) * count / fmax(compared, 1);
    if (rg_gate_is_over(r))
        r->look_ms = fmax(r->look_ms, compare_ms * (1 + first_look(r)));
}

// --- the whole gate ---

static bool run_all(struct rg_running_gate *r)
{
    struct rg_gate_case *cases = r->gate->cases;
    bool ok = true;
    r->first_ms = rg_now_ms();
    begin_pair(r, 0); // a shard may have fixed functions alone
    for (int i = 0, end; ok && i < r->gate->case_count && !rg_interrupted(); i = end) {
        begin_pair(r, cases[i].pair);
        for (end = i; end < r->gate->case_count && cases[end].pair == cases[i].pair; end++)
            if (!rg_interrupted())
                compare(r, &cases[end]);
        expect_look(r, &cases[i], end - i);
        ok = rg_gate_time(r, &cases[i], end - i);
    }
    return ok && (rg_interrupted() || (rg_gate_report(r->asked, r->gate) && rg_gate_hold_fixed(r)));
}

// The enum rg_exit of the findings. A budget in which no case came as far as its first look is
// refused, since nothing could be decided.
static int exit_of(const struct rg_running_gate *r)
{
    const struct rg_gate_request *asked = r->asked;
    const int exit = rg_gate_exit(asked, r->gate);
    if (exit != RG_EXIT_INCONCLUSIVE || !(asked->budget_s > 0) || r->has_looked)
        return exit;
    const double before_ms = r->first_ms - asked->begin_ms;
    const double needed_s = ceil((before_ms + rg_gate_courses(r) * r->look_ms) / 1000);
    rg_error("--budget: the first look, after %d launches, comes about %.0f s after the start, so "
             "that nothing is decided within %g s; give %.0fs or more, or gate fewer cells",
             first_look(r), needed_s, asked->budget_s, needed_s);
    return rg_exit_of_error();
}

// The enum rg_exit of how devices were ever closed, and of what opening them lacked.
static int close_all(struct rg_running_gate *r)
{
    bool clean = rg_truth_close(&r->truth), was_lacking = false;
    for (struct rg_side *side = r->sides; side < r->sides + r->side_count; side++) {
        rg_side_close(side);
        clean = clean && !side->was_closed_badly;
        was_lacking = was_lacking || side->was_lacking;
        json_decref(side->parts);
    }
    json_decref(r->passport);
    return rg_exit_worse(clean ? RG_EXIT_PASS : RG_EXIT_FAIL,
                         was_lacking ? RG_EXIT_HARNESS : RG_EXIT_PASS);
}

int rg_gate_run(const struct rg_gate_request *request, struct rg_gate *gate)
{
    struct rg_running_gate r = {.asked = request, .gate = gate};
    rg_interrupt_watch();
    const bool is_chosen = rg_gate_choose(&r);
    int found = is_chosen ? look_at_sides(&r) : rg_exit_of_error();
    const bool are_there = found == RG_EXIT_PASS;
    bool ok = is_chosen && found != RG_EXIT_USAGE && set_passport(&r) &&
              ((!are_there && !request->baseline) || note_sides(&r));
    gate->is_told = ok && !are_there && gate->report.case_count;
    ok = ok && are_there && open_journal(&r) && run_all(&r);
    if (are_there)
        found = !ok ? rg_exit_of_error() : rg_interrupted() ? RG_EXIT_PASS : exit_of(&r);
    const bool is_done = ok && !rg_interrupted() && found != RG_EXIT_USAGE;
    const int kept = rg_gate_journal_close(r.journal, is_done) ? RG_EXIT_PASS : rg_exit_of_error();
    if (rg_interrupted() && request->folder)
        rg_info("gate: interrupted; the same command goes on");
    gate->beyond = rg_exit_worse(kept, close_all(&r));
    if (rg_interrupted())
        return RG_EXIT_SIGNALLED + rg_interrupt_signal();
    return rg_exit_worse(found, gate->beyond);
}
