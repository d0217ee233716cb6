#include "harness/compare/gate/run/gate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/compare/gate/report/gtest.h"
#include "harness/compare/gate/report/texts.h"
#include "harness/compare/gate/run/agree.h"
#include "harness/compare/gate/cells/digest.h"
#include "harness/compare/gate/run/cases.h"
#include "harness/compare/gate/run/keep.h"
#include "harness/compare/gate/run/strays.h"
#include "harness/compare/gate/run/times.h"
#include "harness/console/clock.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"
#include "harness/devices/names.h"
#include "harness/record/passport/driver.h"
#include "harness/record/passport/passport.h"

char *rg_gate_case_name(const struct rg_gate_cell *cell, const char *device)
{
    const size_t size = strlen(cell->name) + strlen(device) + 2;
    char *name = rg_alloc(size, 1, "gate"), *clean;
    if (!name)
        return NULL;
    snprintf(name, size, "%s.%s", cell->name, device);
    clean = rg_texts_clean(name, true);
    free(name);
    return clean;
}

bool rg_gate_set_passport(struct rg_gate *gate, const json_t *passport)
{
    char *text = passport ? json_dumps(passport, JSON_INDENT(1)) : NULL;
    const bool ok = text && rg_report_set_passport(&gate->report, text);
    free(text);
    return ok;
}

// A gate while it runs.
struct run {
    const struct rg_gate_request *asked;
    struct rg_gate *gate; // a case a pair and cell that the filter lets through
    struct rg_device_info infos[RG_SIDES * RG_MAX_DEVICES]; // of all sides that are there
    int info_sides[RG_SIDES * RG_MAX_DEVICES];
    int info_count;
    // Of the pair that is held against each other now.
    const struct rg_gate_pair *pair;
    struct rg_side sides[RG_SIDES];
    struct rg_timed_cell *timed;
    int timed_count;
    const char **timed_names; // of their cases
    int first_case;
    double left_ms;             // of the budget, for this pair and those behind it
    struct rg_kept_times *kept; // NULL: nothing is
};

// --- cells are chosen ---

bool rg_gate_is_chosen(const struct rg_gate_request *asked, struct rg_gate *gate, const char *name)
{
    char gtest[RG_GTEST_NAME];
    rg_gtest_name(name, gtest);
    return (!asked->filter || rg_gtest_matches(asked->filter, gtest)) &&
           gate->chosen++ % asked->shards.total == asked->shards.index;
}

static bool add_case(struct run *r, const struct rg_gate_cell *cell)
{
    char *name = rg_gate_case_name(cell, r->pair->names[RG_SIDE_B]);
    if (name && rg_gate_is_chosen(r->asked, r->gate, name))
        r->gate->cases[r->gate->case_count++] =
            (struct rg_gate_case){.cell = cell,
                                  .name = name,
                                  .devices = {r->pair->names[RG_SIDE_A], r->pair->names[RG_SIDE_B]},
                                  .device_count = RG_SIDES,
                                  .expectation = -1};
    else
        free(name);
    return name != NULL;
}

static bool make_room(struct run *r)
{
    const size_t cells = (size_t)r->asked->cells->count;
    const size_t cases = cells * (size_t)r->asked->pairs->count;
    r->gate->cases = rg_alloc(cases, sizeof(*r->gate->cases), "gate");
    r->timed = rg_alloc(cells, sizeof(*r->timed), "gate");
    r->timed_names = rg_alloc(cells, sizeof(*r->timed_names), "gate");
    return r->gate->cases && r->timed && r->timed_names;
}

static bool choose(struct run *r)
{
    bool ok = true;
    r->first_case = r->gate->case_count;
    for (int64_t i = 0; ok && i < r->asked->cells->count; i++)
        ok = add_case(r, &r->asked->cells->cells[i]);
    return ok;
}

// --- both sides are compared ---

// Whether both sides are there; else what keeps one from it ends the case.
static bool launch_for(struct run *r, struct rg_gate_case *c)
{
    for (int side = 0; side < RG_SIDES; side++) {
        if (r->sides[side].device || rg_side_launch(&r->sides[side]))
            continue;
        c->agreement = (struct rg_agreement){.pixels = NAN, .difference = NAN};
        return rg_agreement_fails(&c->agreement, r->sides[side].name);
    }
    return true;
}

// What the report's numbers depend on: the machine, and the sides that are there.
static bool set_passport(struct run *r)
{
    json_t *json = rg_passport_json(r->infos, r->info_count);
    const bool ok = rg_gate_set_passport(r->gate, json);
    json_decref(json);
    return ok;
}

static void begin_pair(struct run *r, int pair)
{
    r->pair = &r->asked->pairs->all[pair];
    r->timed_count = 0;
    for (int side = 0; side < RG_SIDES; side++)
        r->sides[side].name = r->pair->names[side];
}

static void end_pair(struct run *r)
{
    for (int side = 0; side < RG_SIDES; side++)
        rg_side_close(&r->sides[side]);
}

// Launches each side once. Names must be such that a device could have them, and what is required
// must be there; another side that is not ends its cases. Returns an enum rg_exit.
static int look_at_sides(struct run *r)
{
    struct rg_side_seen seen[RG_SIDES * RG_MAX_DEVICES];
    struct rg_gate_target targets[RG_MAX_DEVICES];
    int count = 0;
    bool are_names = true, is_apart = true;
    for (int pair = 0; are_names && pair < r->asked->pairs->count; pair++) {
        begin_pair(r, pair);
        for (int side = 0; are_names && side < RG_SIDES; side++) {
            struct rg_device_info *info = &r->infos[r->info_count];
            seen[count] = rg_side_look(&r->sides[side], info);
            r->info_sides[r->info_count] = side;
            r->info_count += seen[count].is_open;
            // The other side's, where it is open, lies before it.
            is_apart =
                is_apart && (side != RG_SIDE_B || !seen[count].is_open ||
                             !seen[count - 1].is_open || rg_devices_are_apart(info - 1, info));
            if (side == RG_SIDE_B)
                targets[pair] = (struct rg_gate_target){seen[count].name,
                                                        seen[count].is_open ? info->driver : NULL};
            are_names = seen[count++].is_name;
        }
        end_pair(r);
    }
    if (!are_names || !is_apart)
        return RG_EXIT_USAGE;
    rg_gate_warn_of_strange(r->asked->known, r->asked->cells, targets, r->asked->pairs->count);
    const bool ok =
        rg_interrupted() || rg_sides_have(seen, count, r->asked->require, &r->gate->report);
    return ok ? RG_EXIT_PASS : RG_EXIT_FAIL;
}

// Which driver each side runs, above all that is found.
static bool note_drivers(struct run *r)
{
    size_t size;
    char line[RG_DRIVER_LINE];
    FILE *out = open_memstream(&r->gate->note, &size);
    for (int i = 0; out && i < r->info_count; i++) {
        rg_driver_line(&r->infos[i], line);
        fprintf(out, "%c  %s\n", "AB"[r->info_sides[i]], line);
    }
    return (out && fclose(out) == 0) || rg_harness_error("gate: no memory for its devices' lines");
}

static void compare(struct run *r, struct rg_gate_case *c)
{
    const double start_ms = rg_now_ms();
    const bool there = launch_for(r, c);
    rg_gate_case_expect(c, r->asked, r->sides[RG_SIDE_B].device);
    if (there && !c->is_skipped)
        rg_gate_agree(c->cell, r->sides, r->asked->pictures, c->name, &c->agreement);
    c->seconds = (rg_now_ms() - start_ms) / 1000;
    c->is_compared = there && !c->is_skipped;
    if (c->is_compared && c->agreement.outcome == RG_OK && !r->asked->pictures_only) {
        c->timed = r->timed_count;
        r->timed_names[r->timed_count] = c->name;
        r->timed[r->timed_count++] = (struct rg_timed_cell){.cell = c->cell};
        c->is_timed = true;
    }
}

// --- what agrees is timed ---

bool rg_gate_measure(struct rg_gate *gate, int first, const struct rg_gate_rule *rule,
                     const struct rg_quad_source *source, const struct rg_timed_cell *timed)
{
    struct rg_gate_row *rows = rg_alloc((size_t)rule->rows, sizeof(*rows), "gate");
    const bool ok = rows && rg_course_run(rule, source, RG_COURSE_SEED, rows);
    for (int i = first; ok && i < gate->case_count; i++) {
        struct rg_gate_case *c = &gate->cases[i];
        if (!c->is_timed)
            continue;
        c->row = rows[c->timed];
        c->rule = *rule;
        c->times = timed[c->timed];
        c->seconds += c->times.seconds;
    }
    free(rows);
    return ok;
}

static bool time_all(struct run *r)
{
    if (!r->timed_count || rg_interrupted())
        return true;
    struct rg_gate_rule rule = rg_gate_rule_of(r->timed_count);
    const int64_t pairs = r->asked->pairs->count - (r->pair - r->asked->pairs->all);
    const double start_ms = rg_now_ms();
    struct rg_gate_times times = {
        .sides = r->sides,
        .cells = r->timed,
        .cell_count = r->timed_count,
        .end_ms = r->asked->budget_s > 0 ? start_ms + fmax(r->left_ms, 0) / (double)pairs : 0};
    struct rg_quad_source source = {rg_times_launch, rg_times_take, rg_times_are_over, &times,
                                    NULL};
    const struct rg_quad_source fresh = source;
    for (int i = r->first_case; r->kept && i < r->gate->case_count; i++)
        rg_keep_expect(r->kept, &r->gate->cases[i]);
    if (r->kept)
        source = rg_kept_times_source(r->kept, &fresh, r->timed_names);
    rule.margin = r->asked->margin;
    rule.error /= r->asked->pairs->count;
    const bool ok = rg_gate_measure(r->gate, r->first_case, &rule, &source, r->timed);
    r->left_ms -= rg_now_ms() - start_ms;
    return ok;
}

// --- what is kept of it ---

// All that decides the times.
static json_t *key_of(const struct run *r)
{
    json_t *cells = json_object(), *pairs = json_array();
    for (int64_t i = 0; i < r->asked->cells->count; i++) {
        char digest[RG_DIGEST_SIZE];
        rg_digest_of_cell(&r->asked->cells->cells[i], digest);
        json_object_set_new(cells, r->asked->cells->cells[i].name, json_string(digest));
    }
    for (int i = 0; i < r->asked->pairs->count; i++)
        json_array_append_new(pairs, json_pack("[s, s]", r->asked->pairs->all[i].names[RG_SIDE_A],
                                               r->asked->pairs->all[i].names[RG_SIDE_B]));
    const struct rg_gtest_shards *shards = &r->asked->shards; // one may share another's folder
    return json_pack("{s:o, s:o, s:o, s:f, s:s, s:i, s:i}", "cells", cells, "pairs", pairs,
                     "passport", rg_passport_json(r->infos, r->info_count), "margin",
                     r->asked->margin, "filter", r->asked->filter ? r->asked->filter : "", "shard",
                     shards->index, "shards", shards->total);
}

// --- what came of it ---

// Of a cell that did not run on a device.
static struct rg_known_result unknown(const char *cell, const char *device)
{
    return (struct rg_known_result){.cell = cell,
                                    .device = device,
                                    .outcome = RG_UNSUPPORTED,
                                    .pixels = NAN,
                                    .difference = NAN};
}

static bool make_results(const struct rg_gate_request *asked, struct rg_gate *gate)
{
    const int64_t left = asked->left.count * asked->cells->count;
    const size_t count = (size_t)(gate->case_count + left);
    gate->results = rg_alloc(count ? count : 1, sizeof(*gate->results), "gate");
    for (int64_t i = 0; gate->results && i < left; i++)
        gate->results[gate->result_count++] =
            unknown(asked->cells->cells[i / asked->left.count].name,
                    asked->left.names[i % asked->left.count]);
    return gate->results;
}

// A device that is required, and of whose cells none was compared though none fails the gate,
// becomes a case as one that is missing does. What is unsupported does not pass anyway.
static void hold_required(struct rg_gate *gate, const char *name)
{
    bool any = false, is_told = false;
    for (int i = 0; i < gate->case_count; i++) {
        const struct rg_gate_case *c = &gate->cases[i];
        const enum rg_ending_kind kind = rg_ending_kind(gate->report.cases[i].ending);
        for (int d = 0; d < c->device_count; d++) {
            const bool is_of = rg_device_is_of(c->devices[d], name) &&
                               gate->report.cases[i].ending != RG_ENDING_UNSUPPORTED;
            any = any || is_of;
            is_told = is_told || (is_of && (rg_gate_case_was_compared(c) ||
                                            kind == RG_KIND_FAILURE || kind == RG_KIND_ERROR));
        }
    }
    if (!any || is_told)
        return;
    rg_driver_error("--require %s: none of its cells was compared", name);
    rg_side_is_missing(name, NULL, &gate->report);
}

bool rg_gate_report(const struct rg_gate_request *asked, struct rg_gate *gate)
{
    bool ok = make_results(asked, gate);
    for (int i = 0; ok && i < gate->case_count; i++) {
        struct rg_report_case told;
        struct rg_gate_case *c = &gate->cases[i];
        struct rg_known_result *result = &gate->results[gate->result_count++];
        rg_gate_case_tell(c, asked, &told, result);
        if (!c->is_compared && !c->is_skipped &&
            (result->outcome == RG_UNSUPPORTED || result->is_foreign))
            *result = unknown(c->cell->name, rg_gate_case_device(c));
        gate->report.idle_count +=
            (told.ending == RG_ENDING_FLAKE || told.ending == RG_ENDING_EXPECTED_FAILURE) &&
            !rg_gate_case_was_compared(c);
        ok = (c->details || rg_harness_error("gate: no memory for what a case tells")) &&
             rg_report_add(&gate->report, &told);
        if (asked->tell)
            asked->tell(&told, asked->user);
    }
    struct rg_device_name name;
    for (const char *rest = asked->require; ok && rest && *rest;)
        if ((ok = rg_device_name_read(&rest, &name)))
            hold_required(gate, name.name);
    gate->is_told = ok;
    return ok;
}

// Why a gate that failed nothing proves nothing.
static void tell_nothing(const struct rg_gate_request *asked, const struct rg_gate *gate)
{
    const struct rg_gtest_shards *shards = &asked->shards;
    if (gate->case_count)
        rg_error("gate: none of %d cases was compared to its end; mend what their lines name",
                 gate->case_count);
    else if (gate->chosen)
        rg_error("gate: shard %d of %d has none of %d cases; set GTEST_TOTAL_SHARDS to %d at most",
                 shards->index + 1, shards->total, gate->chosen, gate->chosen);
    else
        rg_error("gate: no case has a name of --gtest_filter; --gtest_list_tests prints names");
}

int rg_gate_exit(const struct rg_gate_request *asked, const struct rg_gate *gate)
{
    const struct rg_report *report = &gate->report;
    int kinds[RG_KIND_SKIPPED + 1] = {0};
    for (int e = 0; e < RG_ENDING_COUNT; e++)
        kinds[rg_ending_kind((enum rg_ending)e)] += rg_report_count(report, (enum rg_ending)e);
    const int nothing = rg_report_count(report, RG_ENDING_NOTHING_MEASURED);
    const int lacking = rg_report_count(report, RG_ENDING_LACKING);
    const int compared = kinds[RG_KIND_PASS] + rg_report_count(report, RG_ENDING_FLAKE) +
                         rg_report_count(report, RG_ENDING_EXPECTED_FAILURE) - report->idle_count;
    if (kinds[RG_KIND_FAILURE] || kinds[RG_KIND_ERROR] > nothing + lacking)
        return RG_EXIT_FAIL;
    if (lacking)
        return RG_EXIT_HARNESS;
    if (rg_report_count(report, RG_ENDING_INCONCLUSIVE))
        return RG_EXIT_INCONCLUSIVE;
    if (nothing)
        return RG_EXIT_NOTHING;
    if (!compared && rg_report_count(report, RG_ENDING_UNSUPPORTED))
        return RG_EXIT_UNSUPPORTED;
    if (!compared)
        tell_nothing(asked, gate);
    return rg_exit_with(RG_EXIT_PASS, compared);
}

static bool run_pair(struct run *r, int pair)
{
    begin_pair(r, pair);
    bool ok = choose(r);
    for (int i = r->first_case; ok && i < r->gate->case_count && !rg_interrupted(); i++)
        compare(r, &r->gate->cases[i]);
    ok = ok && time_all(r);
    end_pair(r);
    return ok;
}

int rg_gate_run(const struct rg_gate_request *request, struct rg_gate *gate)
{
    struct run r = {.asked = request, .gate = gate, .left_ms = 1e3 * request->budget_s};
    rg_interrupt_watch();
    const int exit = look_at_sides(&r);
    if (exit != RG_EXIT_PASS) {
        gate->is_told = gate->report.case_count && set_passport(&r);
        return exit;
    }
    bool ok = make_room(&r) && set_passport(&r) && note_drivers(&r) &&
              rg_keep_open(request, key_of(&r), &r.kept);
    for (int pair = 0; ok && pair < request->pairs->count && !rg_interrupted(); pair++)
        ok = run_pair(&r, pair);
    ok = ok && (rg_interrupted() || rg_gate_report(request, gate));
    int found = ok ? RG_EXIT_PASS : rg_exit_of_error();
    const bool is_kept = rg_keep_close(request, r.kept, ok && !rg_interrupted());
    const int kept = is_kept ? RG_EXIT_PASS : rg_exit_of_error();
    free(r.timed);
    free(r.timed_names);
    if (rg_interrupted())
        return RG_EXIT_SIGNALLED + rg_interrupt_signal();
    for (int side = 0; side < RG_SIDES; side++)
        if (r.sides[side].was_closed_badly)
            found = rg_exit_worse(found, RG_EXIT_FAIL);
    found = found == RG_EXIT_PASS ? rg_gate_exit(request, gate) : found;
    const bool was_lacking = r.sides[0].was_lacking || r.sides[1].was_lacking;
    return rg_exit_worse(rg_exit_worse(found, kept), was_lacking ? RG_EXIT_HARNESS : RG_EXIT_PASS);
}

void rg_gate_free(struct rg_gate *gate)
{
    rg_report_free(&gate->report);
    for (int i = 0; i < gate->case_count; i++) {
        free(gate->cases[i].name);
        free(gate->cases[i].details);
        free(gate->cases[i].paths);
    }
    free(gate->cases);
    free(gate->results);
    free(gate->note);
    *gate = (struct rg_gate){.results = NULL};
}
