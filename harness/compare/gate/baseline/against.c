#include "harness/compare/gate/baseline/against.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/compare/gate/baseline/compare.h"
#include "harness/compare/gate/cells/digest.h"
#include "harness/compare/gate/run/cases.h"
#include "harness/compare/gate/run/keep.h"
#include "harness/compare/gate/run/strays.h"
#include "harness/console/clock.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"
#include "harness/record/passport/key.h"
#include "harness/record/passport/driver.h"
#include "harness/record/passport/passport.h"

// Cells whose times are taken in one course.
struct lot {
    int count;
    struct rg_timed_cell *cells;
    int *side_of, *case_of;
    struct rg_gate_sample *before;
    const char **names; // of their cases
};

struct run {
    const struct rg_against *asked;
    struct rg_gate *gate;
    const struct rg_baseline_row **rows; // of each case, what it was
    int *side_of;                        // of each case
    int side_count;
    struct rg_side sides[RG_MAX_DEVICES];
    struct rg_device_info infos[RG_MAX_DEVICES]; // of those that were there
    json_t *passport;                            // of these
    json_t *parts[RG_MAX_DEVICES];               // of their keys; NULL: they were not
    bool same_key[RG_MAX_DEVICES];
    struct rg_truth truth;
    struct lot gated, advisory;
    struct rg_kept_times *kept; // of what is gated; NULL: nothing is
    struct rg_launches yardsticks[RG_YARDSTICKS];
    double end_ms;
};

// --- cells are chosen ---

static int find_side(struct run *r, const char *name)
{
    int side = 0;
    while (side < r->side_count && strcmp(r->sides[side].name, name) != 0)
        side++;
    if (side == r->side_count)
        r->sides[r->side_count++].name = name;
    return side;
}

static const struct rg_gate_cell *find_cell(const struct rg_gate_cells *cells, const char *name)
{
    const struct rg_gate_cell *cell = cells->cells;
    while (strcmp(cell->name, name) != 0) // rg_baseline_fits found it
        cell++;
    return cell;
}

static bool add_case(struct run *r, const struct rg_baseline_row *row)
{
    const struct rg_gate_cell *cell = find_cell(r->asked->request->cells, row->cell);
    char *name = rg_gate_case_name(cell, row->device);
    if (!name || !rg_gate_is_chosen(r->asked->request, r->gate, name)) {
        free(name);
        return name != NULL;
    }
    const int number = r->gate->case_count++;
    r->gate->cases[number] = (struct rg_gate_case){
        .cell = cell, .name = name, .devices = {row->device}, .device_count = 1, .expectation = -1};
    r->rows[number] = row;
    r->side_of[number] = find_side(r, row->device);
    return true;
}

static bool make_lot(struct lot *lot, size_t count)
{
    lot->cells = rg_alloc(count, sizeof(*lot->cells), "gate");
    lot->side_of = rg_alloc(count, sizeof(*lot->side_of), "gate");
    lot->case_of = rg_alloc(count, sizeof(*lot->case_of), "gate");
    lot->before = rg_alloc(count, sizeof(*lot->before), "gate");
    lot->names = rg_alloc(count, sizeof(*lot->names), "gate");
    return lot->cells && lot->side_of && lot->case_of && lot->before && lot->names;
}

static bool choose(struct run *r)
{
    const struct rg_baseline *baseline = r->asked->baseline;
    const size_t count = (size_t)baseline->count;
    r->gate->cases = rg_alloc(count, sizeof(*r->gate->cases), "gate");
    r->rows = rg_alloc(count, sizeof(const struct rg_baseline_row *), "gate");
    r->side_of = rg_alloc(count, sizeof(*r->side_of), "gate");
    bool ok = r->gate->cases && r->rows && r->side_of && make_lot(&r->gated, count) &&
              make_lot(&r->advisory, count);
    for (size_t i = 0; ok && i < count; i++)
        if (rg_baseline_asks(r->asked->devices, baseline->rows[i].device))
            ok = add_case(r, &baseline->rows[i]);
    return ok;
}

// --- keys ---

// Launches each device once. What is required must be there.
static bool look_at_sides(struct run *r)
{
    const struct rg_gate_request *request = r->asked->request;
    struct rg_side_seen seen[RG_MAX_DEVICES];
    struct rg_gate_target targets[RG_MAX_DEVICES];
    int count = 0;
    for (int side = 0; side < r->side_count && !rg_interrupted(); side++) {
        const struct rg_side_seen *saw = &seen[count];
        seen[count] = rg_side_look(&r->sides[side], &r->infos[side]);
        targets[count++] =
            (struct rg_gate_target){saw->name, saw->is_open ? r->infos[side].driver : NULL};
        rg_side_close(&r->sides[side]);
    }
    if (rg_interrupted())
        return true;
    rg_gate_warn_of_strange(request->known, request->cells, targets, count);
    return rg_sides_have(seen, count, request->require, &r->gate->report);
}

// Of each device that there is, so that it is known which times can be held against each other.
static bool find_keys(struct run *r)
{
    struct rg_device_info there[RG_MAX_DEVICES];
    int count = 0;
    for (int side = 0; side < r->side_count; side++)
        if (*r->infos[side].name)
            there[count++] = r->infos[side];
    json_t *passport = rg_passport_json(there, count);
    for (int side = 0; side < r->side_count; side++) {
        const struct rg_baseline_device *was =
            rg_baseline_device(r->asked->baseline, r->sides[side].name);
        if (!*r->infos[side].name)
            continue;
        json_t *device = rg_passport_device(&r->infos[side]);
        r->parts[side] = rg_key_parts(passport, device);
        r->same_key[side] = json_equal(r->parts[side], was->parts);
        json_decref(device);
    }
    r->passport = passport;
    return rg_gate_set_passport(r->gate, passport);
}

// What is printed of the keys, a line a device.
static bool note_keys(struct run *r)
{
    size_t size;
    FILE *out = open_memstream(&r->gate->note, &size);
    for (int side = 0; out && side < r->side_count; side++) {
        const struct rg_baseline_device *was =
            rg_baseline_device(r->asked->baseline, r->sides[side].name);
        char now_key[RG_KEY_SIZE], was_key[RG_KEY_SIZE], text[RG_KEY_TEXT], line[RG_DRIVER_LINE];
        if (!r->parts[side])
            continue;
        rg_driver_line(&r->infos[side], line);
        fprintf(out, "%s\n", line);
        rg_key_hash(r->parts[side], now_key);
        rg_key_hash(was->parts, was_key);
        rg_key_difference(r->parts[side], was->parts, text);
        if (r->same_key[side])
            fprintf(out, "%s: key %s, as the baseline's\n", was->name, now_key);
        else
            fprintf(out, "%s: key %s, and the baseline's is %s, so that times are advisory: %s\n",
                    was->name, now_key, was_key, text);
    }
    return (out && fclose(out) == 0) || rg_harness_error("gate: no memory for its devices' lines");
}

// --- what is the same every time ---

static struct rg_device *launch_for(struct run *r, struct rg_gate_case *c, int number)
{
    struct rg_side *side = &r->sides[r->side_of[number]];
    for (int other = 0; other < r->side_count; other++)
        if (&r->sides[other] != side)
            rg_side_close(&r->sides[other]);
    if (!side->device && !rg_side_launch(side)) {
        rg_agreement_fails(&c->agreement, side->name);
        rg_against_end(r->rows[number], &c->agreement);
        c->agreement.is_ours |= c->agreement.outcome == RG_FAIL; // no driver drew what is expected
    }
    return side->device;
}

static void add_to(struct lot *lot, const struct run *r, int number)
{
    const struct rg_gate_case *c = &r->gate->cases[number];
    lot->cells[lot->count] =
        (struct rg_timed_cell){.cell = c->cell, .slot = r->rows[number]->slot, .side = RG_SIDE_B};
    lot->side_of[lot->count] = r->side_of[number];
    lot->case_of[lot->count] = number;
    lot->before[lot->count++] = rg_baseline_sample(&r->rows[number]->launches);
}

static void compare(struct run *r, int number)
{
    struct rg_gate_case *c = &r->gate->cases[number];
    const double start_ms = rg_now_ms();
    c->agreement = (struct rg_agreement){
        .folder = r->asked->request->pictures, .name = c->name, .pixels = NAN, .difference = NAN};
    struct rg_device *device = launch_for(r, c, number);
    rg_gate_case_expect(c, r->asked->request, device);
    if (device && !c->is_skipped)
        rg_against_compare(c->cell, device, r->rows[number], &r->truth, &c->agreement);
    c->seconds = (rg_now_ms() - start_ms) / 1000;
    c->is_compared = device && !c->is_skipped;
    if (!c->is_compared || c->agreement.outcome != RG_OK || r->asked->request->pictures_only ||
        !r->rows[number]->launches.count)
        return;
    c->is_timed = r->same_key[r->side_of[number]];
    struct lot *lot = c->is_timed ? &r->gated : &r->advisory;
    c->timed = lot->count;
    add_to(lot, r, number);
}

// --- times ---

static struct rg_lone_times times_of(struct run *r, struct lot *lot, struct rg_yardstick_room *room)
{
    return (struct rg_lone_times){.side_count = r->side_count,
                                  .sides = r->sides,
                                  .cells = lot->cells,
                                  .side_of = lot->side_of,
                                  .room = room,
                                  .yardsticks = r->yardsticks,
                                  .end_ms = r->end_ms};
}

static bool time_gated(struct run *r, struct rg_yardstick_room *room)
{
    struct rg_lone_times times = times_of(r, &r->gated, room);
    struct rg_quad_source source = {rg_lone_launch, rg_lone_take, rg_lone_are_over, &times,
                                    r->gated.before};
    const struct rg_quad_source fresh = source;
    struct rg_gate_rule rule = rg_gate_rule_apart(r->gated.count);
    rule.margin = r->asked->request->margin;
    for (int i = 0; i < r->gated.count; i++) {
        const struct rg_gate_case *c = &r->gate->cases[r->gated.case_of[i]];
        r->gated.names[i] = c->name;
        rg_keep_expect(r->kept, c);
    }
    if (r->kept)
        source = rg_kept_times_source(r->kept, &fresh, r->gated.names);
    return !r->gated.count || rg_gate_measure(r->gate, 0, &rule, &source, r->gated.cells);
}

// One look, after which no change is worth a word: what comes of it is told, and decides nothing.
static bool time_advisory(struct run *r, struct rg_yardstick_room *room)
{
    struct rg_lone_times times = times_of(r, &r->advisory, room);
    const struct rg_quad_source source = {rg_lone_launch, rg_lone_take, rg_lone_are_over, &times,
                                          r->advisory.before};
    struct rg_gate_rule rule = rg_gate_rule_apart(r->advisory.count);
    rule.look_count = 1;
    rule.margin = INFINITY;
    if (!r->advisory.count)
        return true;
    struct rg_gate_row *rows = rg_alloc((size_t)rule.rows, sizeof(*rows), "gate");
    const bool ok = rows && rg_course_run(&rule, &source, RG_COURSE_SEED, rows);
    for (int i = 0; ok && i < r->advisory.count; i++) {
        struct rg_gate_case *c = &r->gate->cases[r->advisory.case_of[i]];
        c->seconds += r->advisory.cells[i].seconds;
        rg_against_advise(&rows[i], &r->advisory.cells[i], r->asked->baseline->yardsticks,
                          r->yardsticks, &c->agreement);
    }
    free(rows);
    return ok;
}

static bool time_all(struct run *r)
{
    struct rg_yardstick_room room = {NULL};
    const double budget_s = r->asked->request->budget_s;
    if ((!r->gated.count && !r->advisory.count) || rg_interrupted())
        return true;
    r->end_ms = budget_s > 0 ? rg_now_ms() + 1e3 * budget_s : 0;
    const bool ok = rg_yardsticks_open(&room) && time_gated(r, &room) && time_advisory(r, &room);
    rg_yardsticks_close(&room);
    return ok;
}

// --- what is kept of it ---

// All that decides the times that are gated: those of the baseline too.
static json_t *key_of(const struct run *r)
{
    json_t *was = json_object();
    for (int i = 0; i < r->gate->case_count; i++) {
        const struct rg_baseline_row *row = r->rows[i];
        char launches[RG_DIGEST_SIZE];
        rg_digest_of(row->launches.ms, (size_t)row->launches.count * sizeof(*row->launches.ms),
                     launches);
        json_object_set_new(was, r->gate->cases[i].name,
                            json_pack("[s, s]", row->settings, launches));
    }
    return json_pack("{s:o, s:O, s:f}", "baseline", was, "passport", r->passport, "margin",
                     r->asked->request->margin);
}

// --- all of it ---

static void free_lot(struct lot *lot)
{
    free(lot->cells);
    free(lot->side_of);
    free(lot->case_of);
    free(lot->before);
    free(lot->names);
}

// False where a device was closed badly, once.
static bool end(struct run *r)
{
    bool clean = rg_truth_close(&r->truth);
    for (int side = 0; side < r->side_count; side++) {
        rg_side_close(&r->sides[side]);
        clean = clean && !r->sides[side].was_closed_badly;
        json_decref(r->parts[side]);
    }
    json_decref(r->passport);
    free_lot(&r->gated);
    free_lot(&r->advisory);
    free(r->rows);
    free(r->side_of);
    return clean;
}

int rg_against_run(const struct rg_against *against, struct rg_gate *gate)
{
    struct run r = {.asked = against, .gate = gate};
    rg_interrupt_watch();
    bool ok = choose(&r), are_there = ok && look_at_sides(&r);
    ok = ok && find_keys(&r) && note_keys(&r);
    gate->is_told = ok && !are_there && gate->report.case_count;
    ok = ok && are_there && rg_keep_open(against->request, key_of(&r), &r.kept);
    for (int i = 0; ok && i < gate->case_count && !rg_interrupted(); i++)
        compare(&r, i);
    ok = ok && time_all(&r) && (rg_interrupted() || rg_gate_report(against->request, gate));
    int found = ok ? RG_EXIT_PASS : rg_exit_of_error();
    const bool is_kept = rg_keep_close(against->request, r.kept, ok && !rg_interrupted());
    const int kept = is_kept ? RG_EXIT_PASS : rg_exit_of_error();
    if (!end(&r))
        found = rg_exit_worse(found, RG_EXIT_FAIL);
    if (rg_interrupted())
        return RG_EXIT_SIGNALLED + rg_interrupt_signal();
    return rg_exit_worse(found == RG_EXIT_PASS ? rg_gate_exit(against->request, gate) : found,
                         kept);
}
