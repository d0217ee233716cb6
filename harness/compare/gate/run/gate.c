#include "harness/compare/gate/run/gate.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/base/text/add.h"
#include "harness/compare/gate/cells/unused.h"
#include "harness/compare/gate/report/texts.h"
#include "harness/compare/gate/run/agree.h"
#include "harness/console/clock.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"
#include "harness/devices/names.h"
#include "harness/record/passport/driver.h"
#include "harness/record/passport/key.h"
#include "harness/record/passport/passport.h"

enum { MOST_SIDES = RG_SIDES * RG_MAX_DEVICES };

// A gate while it runs.
struct run {
    const struct rg_gate_request *asked;
    struct rg_gate *gate; // one case per cell that the filter selects
    // Of the pairs, two by two, A first. With a baseline A has no name.
    int side_count;
    struct rg_side sides[MOST_SIDES];
    struct rg_device_info infos[MOST_SIDES]; // of the sides that are there
    json_t *passport;                        // of the sides that are there
    // Of sides that run alone and are there.
    json_t *parts[MOST_SIDES]; // of their comparison keys
    bool same_key[MOST_SIDES]; // equal to the baseline's key
    struct rg_truth truth;
    struct rg_launches yardsticks[RG_YARDSTICKS];
    double start_ms, end_ms;         // of the pair that runs; end 0: no limit
    double first_ms;                 // when the first pair began
    double look_ms;                  // until a pair's first look, the longest of all pairs
    bool has_looked;                 // some case came as far as that, or ended without it
    struct rg_gate_journal *journal; // NULL: no journal
};

// --- choosing cells ---

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

// Whether the filter selects a case of this name, and the shard includes it.
static bool is_chosen(struct run *r, const char *name)
{
    char gtest[RG_GTEST_NAME];
    rg_gtest_name(name, gtest);
    return (!r->asked->filter || rg_gtest_matches(r->asked->filter, gtest)) &&
           r->gate->chosen++ % r->asked->shards.total == r->asked->shards.index;
}

// Adds a cell's case of a pair if it is chosen. False, and one logged line, without memory.
static bool add_case(struct run *r, const struct rg_gate_cell *cell, int pair)
{
    const struct rg_baseline *baseline = r->asked->baseline;
    struct rg_side *sides = &r->sides[pair * RG_SIDES];
    const char *device = sides[RG_SIDE_B].name;
    char *name = rg_gate_case_name(cell, device);
    if (!name || !is_chosen(r, name)) {
        free(name);
        return name != NULL;
    }
    struct rg_gate_case *c = &r->gate->cases[r->gate->case_count++];
    *c = (struct rg_gate_case){.cell = cell, .name = name, .expectation = -1};
    c->pair = baseline ? 0 : pair; // all devices of a baseline are timed together
    c->before = baseline ? rg_baseline_find(baseline, cell->name, device) : NULL;
    for (int side = 0; side < RG_SIDES; side++) {
        if (!sides[side].name)
            continue;
        c->sides[side] = &sides[side];
        c->devices[c->device_count++] = sides[side].name;
    }
    return true;
}

// All pairs become sides, even those without a chosen case.
static bool choose(struct run *r)
{
    const struct rg_gate_cells *cells = r->asked->cells;
    const struct rg_gate_pairs *pairs = r->asked->pairs;
    r->side_count = pairs->count * RG_SIDES;
    r->gate->cases =
        rg_alloc((size_t)(cells->count * pairs->count), sizeof(*r->gate->cases), "gate");
    bool ok = r->gate->cases;
    for (int i = 0; i < r->side_count; i++) {
        const char *name = pairs->all[i / RG_SIDES].names[i % RG_SIDES];
        r->sides[i].name = *name ? name : NULL;
    }
    for (int pair = 0; pair < pairs->count; pair++)
        for (int64_t i = 0; ok && i < cells->count; i++)
            ok = add_case(r, &cells->cells[i], pair);
    return ok;
}

// --- sides ---

// Launches each side once. Names of pairs must be valid, the two of a pair distinct, and required
// devices there; any other missing side only ends its cases. Returns an enum rg_exit.
static int look_at_sides(struct run *r)
{
    struct rg_side_seen seen[MOST_SIDES];
    struct rg_gate_target targets[RG_MAX_DEVICES];
    const bool are_pairs = !r->asked->baseline;
    int count = 0, target_count = 0;
    for (int i = 0; i < r->side_count && !rg_interrupted(); i++) {
        const bool is_b = i % RG_SIDES == RG_SIDE_B;
        const struct rg_device_info *info = &r->infos[i];
        const struct rg_side_seen *saw = &seen[count];
        if (!r->sides[i].name)
            continue;
        seen[count++] = rg_side_look(&r->sides[i], &r->infos[i]);
        rg_side_close(&r->sides[i]);
        if (is_b)
            targets[target_count++] =
                (struct rg_gate_target){saw->name, saw->is_open ? info->driver : NULL};
        if (are_pairs && (!saw->is_name || (is_b && saw->is_open && saw[-1].is_open &&
                                            !rg_devices_are_apart(info - 1, info))))
            return RG_EXIT_USAGE;
    }
    if (rg_interrupted())
        return RG_EXIT_PASS;
    rg_gate_warn_of_unused_on(r->asked->known, r->asked->cells, targets, target_count);
    return rg_sides_have(seen, count, r->asked->require, &r->gate->report) ? RG_EXIT_PASS
                                                                           : RG_EXIT_FAIL;
}

// Describes what the report's numbers depend on: the machine, and the sides that are there.
static bool set_passport(struct run *r)
{
    struct rg_device_info there[MOST_SIDES];
    int count = 0;
    for (int side = 0; side < r->side_count; side++)
        if (*r->infos[side].name)
            there[count++] = r->infos[side];
    r->passport = rg_passport_json(there, count);
    char *text = r->passport ? json_dumps(r->passport, JSON_INDENT(1)) : NULL;
    const bool ok = text && rg_report_set_passport(&r->gate->report, text);
    free(text);
    return ok;
}

// Finds out whether the times of a side that runs alone can be compared with the baseline's, and
// writes the reason to `out`.
static void compare_key(struct run *r, int side, FILE *out)
{
    const struct rg_baseline_device *was =
        rg_baseline_device(r->asked->baseline, r->sides[side].name);
    json_t *device = rg_passport_device(&r->infos[side]);
    char now_key[RG_KEY_SIZE], was_key[RG_KEY_SIZE], text[RG_KEY_TEXT];
    r->parts[side] = rg_key_parts(r->passport, device);
    r->same_key[side] = json_equal(r->parts[side], was->parts);
    json_decref(device);
    rg_key_hash(r->parts[side], now_key);
    rg_key_hash(was->parts, was_key);
    rg_key_difference(r->parts[side], was->parts, text);
    if (r->same_key[side])
        fprintf(out, "%s: key %s, as the baseline's\n", was->name, now_key);
    else
        fprintf(out, "%s: key %s, and the baseline's is %s, so that times are advisory: %s\n",
                was->name, now_key, was_key, text);
}

// Notes which driver each side runs, to be printed above the results.
static bool note_sides(struct run *r)
{
    size_t size;
    char line[RG_DRIVER_LINE];
    FILE *out = open_memstream(&r->gate->note, &size);
    for (int side = 0; out && side < r->side_count; side++) {
        if (!*r->infos[side].name)
            continue;
        rg_driver_line(&r->infos[side], line);
        if (!r->asked->baseline)
            fprintf(out, "%c  ", "AB"[side % RG_SIDES]);
        fprintf(out, "%s\n", line);
        if (r->asked->baseline)
            compare_key(r, side, out);
    }
    return (out && fclose(out) == 0) || rg_harness_error("gate: no memory for its devices' lines");
}

// --- the journal ---

// Everything that the times depend on, those of a baseline among it.
static json_t *key_of(const struct run *r)
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
    const struct rg_gtest_shards *shards = &asked->shards; // shards may use the same folder
    return json_pack("{s:o, s:o, s:o, s:O, s:f, s:s, s:i, s:i}", "cells", cells, "pairs", pairs,
                     "baseline", before, "passport", r->passport, "margin", asked->margin, "filter",
                     asked->filter ? asked->filter : "", "shard", shards->index, "shards",
                     shards->total);
}

static bool open_journal(struct run *r)
{
    if (!r->asked->folder || r->asked->pictures_only)
        return true;
    r->journal = rg_gate_journal_open(r->asked->folder, key_of(r), r->asked->fresh);
    return r->journal;
}

// --- comparing ---

// Makes the case's sides, and no others, run; a failure ends the case.
static bool launch_for(struct run *r, struct rg_gate_case *c)
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

static bool is_over(const struct run *r)
{
    return r->end_ms > 0 && rg_now_ms() >= r->end_ms;
}

static void compare(struct run *r, struct rg_gate_case *c)
{
    const double start_ms = rg_now_ms();
    const bool over = is_over(r), there = !over && launch_for(r, c);
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
        c->is_timed = r->same_key[c->sides[RG_SIDE_B] - r->sides];
        c->is_advised = !c->is_timed;
    }
}

// --- timing the cases that agree ---

// How many courses share the budget and the error: one with a baseline.
static int pairs_of(const struct run *r)
{
    return r->asked->baseline ? 1 : r->asked->pairs->count;
}

// Cases that are timed in one course.
struct lot {
    int count;
    struct rg_gate_case **cases;
    struct rg_timed_cell *cells;
    struct rg_gate_sample *before; // with a baseline
    struct rg_gate_row *rows;
};

static void free_lot(struct lot *lot)
{
    free(lot->cases);
    free(lot->cells);
    free(lot->before);
    free(lot->rows);
}

// Chooses the advised cases, or the timed ones, from `count` cases.
static bool make_lot(struct rg_gate_case *cases, int count, bool is_advice, struct lot *lot)
{
    const size_t room = (size_t)count;
    lot->cases = rg_alloc(room, sizeof(struct rg_gate_case *), "gate");
    lot->cells = rg_alloc(room, sizeof(*lot->cells), "gate");
    lot->before = rg_alloc(room, sizeof(*lot->before), "gate");
    lot->rows = rg_alloc(room, sizeof(*lot->rows), "gate");
    if (!lot->cases || !lot->cells || !lot->before || !lot->rows)
        return false;
    for (struct rg_gate_case *c = cases; c < cases + count; c++) {
        const int row = lot->count;
        if (is_advice ? !c->is_advised : !c->is_timed)
            continue;
        lot->count++;
        lot->cases[row] = c;
        lot->cells[row] = (struct rg_timed_cell){
            .cell = c->cell, .name = c->name, .sides = {c->sides[RG_SIDE_A], c->sides[RG_SIDE_B]}};
        if (!c->before)
            continue;
        lot->cells[row].side = RG_SIDE_B;
        lot->cells[row].slot = c->before->slot;
        lot->before[row] = rg_baseline_sample(&c->before->launches);
    }
    return true;
}

// Advice takes one look, and no change matters to it: it is reported and decides nothing.
static struct rg_gate_rule rule_of(const struct run *r, const struct lot *lot, bool is_advice)
{
    struct rg_gate_rule rule =
        r->asked->baseline ? rg_gate_rule_apart(lot->count) : rg_gate_rule_of(lot->count);
    rule.margin = is_advice ? INFINITY : r->asked->margin;
    if (is_advice)
        rule.look_count = 1;
    rule.error /= pairs_of(r);
    return rule;
}

enum { CODE = 512 };
// Describes the code that ran as a text that is equal for equal code.
static void describe_code(const struct rg_agreement *agreement, char code[CODE])
{
    *code = 0;
    for (int side = 0; side < RG_SIDES; side++) {
        const struct rg_session_code *of = &agreement->code[side];
        rg_text_add(code, CODE, ", ", "%s %016" PRIx64 " %016" PRIx64, of->program, of->libraries,
                    of->passes.hash);
    }
}

// Drops journal times that were taken with other code.
static void expect_codes(struct run *r, const struct lot *lot)
{
    for (int i = 0; r->journal && i < lot->count; i++) {
        char code[CODE];
        describe_code(&lot->cases[i]->agreement, code);
        rg_gate_journal_expect(r->journal, lot->cells[i].name, code);
    }
}

static void tell_row(struct run *r, const struct lot *lot, int row, const struct rg_gate_rule *rule)
{
    struct rg_gate_case *c = lot->cases[row];
    const struct rg_gate_row *found = &lot->rows[row];
    struct rg_timed_cell *cell = &lot->cells[row];
    cell->is_over |= found->end == RG_END_OVER;
    if (found->end != RG_END_BROKEN)
        cell->outcome = RG_OK; // a side fell after it was decided
    r->has_looked |= !cell->is_over || found->launches - found->disturbed >= rule->looks[0];
    c->seconds += cell->seconds;
    c->row = *found;
    c->rule = *rule;
    c->times = *cell;
    if (c->is_advised)
        rg_gate_advise(&c->row, &c->times, r->asked->baseline->yardsticks, r->yardsticks,
                       &c->agreement);
}

static bool time_lot(struct run *r, const struct lot *lot, bool is_advice,
                     struct rg_gate_times *times)
{
    const struct rg_gate_rule rule = rule_of(r, lot, is_advice);
    const struct rg_quad_source source = {rg_times_launch, rg_times_take, rg_times_are_over, times,
                                          r->asked->baseline ? lot->before : NULL};
    times->cell_count = lot->count;
    times->cells = lot->cells;
    times->journal = is_advice ? NULL : r->journal; // advice is not kept
    times->failed = times->is_launched = false;
    times->launch = 0;
    times->first_look = rule.looks[0];
    if (!is_advice)
        expect_codes(r, lot);
    const bool ok = rg_course_run(&rule, &source, RG_COURSE_SEED, lot->rows);
    for (int i = 0; ok && i < lot->count; i++)
        tell_row(r, lot, i, &rule);
    return ok;
}

// Times the cases of a pair, or all that run alone.
static bool time_all(struct run *r, struct rg_gate_case *cases, int count)
{
    struct rg_yardstick_room room = {NULL};
    struct lot lots[2] = {{.count = 0}, {.count = 0}}; // timed cases, and advised ones
    struct rg_gate_times times = {.side_count = r->asked->baseline ? r->side_count : RG_SIDES,
                                  .sides = r->asked->baseline ? r->sides : cases->sides[RG_SIDE_A],
                                  .yardsticks = r->yardsticks,
                                  .end_ms = r->end_ms};
    bool ok = !rg_interrupted();
    for (int i = 0; ok && i < 2; i++)
        ok = make_lot(cases, count, i, &lots[i]);
    if (ok && r->asked->baseline && lots[0].count + lots[1].count) {
        ok = rg_yardsticks_open(&room);
        times.room = &room;
    }
    for (int i = 0; ok && i < 2; i++)
        ok = !lots[i].count || time_lot(r, &lots[i], i, &times);
    rg_yardsticks_close(&room);
    free_lot(&lots[0]);
    free_lot(&lots[1]);
    r->look_ms = fmax(r->look_ms, times.look_ms - r->start_ms);
    return ok || rg_interrupted();
}

// --- the budget ---

// Gives a pair its share of the time that is left.
static void begin_pair(struct run *r, int pair)
{
    const double now_ms = rg_now_ms();
    const double left_ms = r->asked->begin_ms + 1e3 * r->asked->budget_s - now_ms;
    r->start_ms = now_ms;
    r->end_ms = r->asked->budget_s > 0 ? now_ms + fmax(left_ms, 0) / (pairs_of(r) - pair) : 0;
}

static int first_look(const struct run *r)
{
    return (r->asked->baseline ? rg_gate_rule_apart(1) : rg_gate_rule_of(1)).looks[0];
}

// If the time is over before the first launch, a launch is taken to last as long as comparing did.
static void expect_look(struct run *r, const struct rg_gate_case *cases, int count)
{
    int compared = 0;
    for (int i = 0; i < count; i++)
        compared += !cases[i].is_over;
    const double compare_ms = (rg_now_ms() - r->start_ms) * count / fmax(compared, 1);
    if (is_over(r))
        r->look_ms = fmax(r->look_ms, compare_ms * (1 + first_look(r)));
}

// --- the whole gate ---

static bool run_all(struct run *r)
{
    struct rg_gate_case *cases = r->gate->cases;
    bool ok = true;
    r->first_ms = rg_now_ms();
    for (int i = 0, end; ok && i < r->gate->case_count && !rg_interrupted(); i = end) {
        begin_pair(r, cases[i].pair);
        for (end = i; end < r->gate->case_count && cases[end].pair == cases[i].pair; end++)
            if (!rg_interrupted())
                compare(r, &cases[end]);
        expect_look(r, &cases[i], end - i);
        ok = time_all(r, &cases[i], end - i);
    }
    return ok && (rg_interrupted() || rg_gate_report(r->asked, r->gate));
}

// The enum rg_exit of what was found. A budget in which no case came as far as its first look is
// refused, since nothing could be decided.
static int exit_of(const struct run *r)
{
    const struct rg_gate_request *asked = r->asked;
    const int exit = rg_gate_exit(asked, r->gate);
    if (exit != RG_EXIT_INCONCLUSIVE || !(asked->budget_s > 0) || r->has_looked)
        return exit;
    const double before_ms = r->first_ms - asked->begin_ms;
    const double needed_s = ceil((before_ms + pairs_of(r) * r->look_ms) / 1000);
    rg_error("--budget: the first look, after %d launches, comes about %.0f s after the start, so "
             "that nothing is decided within %g s; give %.0fs or more, or gate fewer cells",
             first_look(r), needed_s, asked->budget_s, needed_s);
    return rg_exit_of_error();
}

// False if a device was ever closed badly.
static bool close_all(struct run *r)
{
    bool clean = rg_truth_close(&r->truth);
    for (int side = 0; side < r->side_count; side++) {
        rg_side_close(&r->sides[side]);
        clean = clean && !r->sides[side].was_closed_badly;
    }
    for (int i = 0; i < MOST_SIDES; i++)
        json_decref(r->parts[i]);
    json_decref(r->passport);
    return clean;
}

static bool was_lacking(const struct run *r)
{
    bool any = false;
    for (int side = 0; side < r->side_count; side++)
        any = any || r->sides[side].was_lacking;
    return any;
}

int rg_gate_run(const struct rg_gate_request *request, struct rg_gate *gate)
{
    struct run r = {.asked = request, .gate = gate};
    rg_interrupt_watch();
    const bool is_chosen = choose(&r);
    int found = is_chosen ? look_at_sides(&r) : rg_exit_of_error();
    const bool are_there = found == RG_EXIT_PASS;
    bool ok = is_chosen && found != RG_EXIT_USAGE && set_passport(&r) &&
              ((!are_there && !request->baseline) || note_sides(&r));
    gate->is_told = ok && !are_there && gate->report.case_count;
    ok = ok && are_there && open_journal(&r) && run_all(&r);
    if (are_there)
        found = !ok ? rg_exit_of_error() : rg_interrupted() ? RG_EXIT_PASS : exit_of(&r);
    const bool is_done = ok && !rg_interrupted() && found != RG_EXIT_USAGE;
    const bool is_kept = rg_gate_journal_close(r.journal, is_done);
    const int kept = is_kept ? RG_EXIT_PASS : rg_exit_of_error();
    if (rg_interrupted() && request->folder)
        rg_info("gate: interrupted; the same command goes on");
    if (!close_all(&r))
        found = rg_exit_worse(found, RG_EXIT_FAIL);
    if (rg_interrupted())
        return RG_EXIT_SIGNALLED + rg_interrupt_signal();
    return rg_exit_worse(rg_exit_worse(found, kept),
                         was_lacking(&r) ? RG_EXIT_HARNESS : RG_EXIT_PASS);
}
