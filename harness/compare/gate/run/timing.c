#include "harness/compare/gate/run/running.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/text/add.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"

int rg_gate_courses(const struct rg_running_gate *r)
{
    return r->asked->baseline ? 1 : r->asked->pairs->count;
}

bool rg_gate_is_over(const struct rg_running_gate *r)
{
    return r->end_ms > 0 && rg_now_ms() >= r->end_ms;
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

struct rg_gate_rule rg_gate_rule_in(const struct rg_running_gate *r, int course, int count,
                                    bool is_advice)
{
    const struct rg_gate_request *asked = r->asked;
    struct rg_gate_rule rule = asked->baseline ? rg_gate_rule_apart(count) : rg_gate_rule_of(count);
    if (asked->shard.count > 1 && !asked->is_apart)
        rule.error *= (double)count / r->family[course];
    rule.margin = is_advice ? INFINITY : asked->margin;
    if (is_advice)
        rule.look_count = 1;
    rule.error /= rg_gate_courses(r);
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
static void expect_codes(struct rg_running_gate *r, const struct lot *lot)
{
    for (int i = 0; r->journal && i < lot->count; i++) {
        char code[CODE];
        describe_code(&lot->cases[i]->agreement, code);
        rg_gate_journal_expect(r->journal, lot->cells[i].name, code);
    }
}

static void tell_row(struct rg_running_gate *r, const struct lot *lot, int row,
                     const struct rg_gate_rule *rule)
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

static bool time_lot(struct rg_running_gate *r, const struct lot *lot, bool is_advice,
                     struct rg_gate_times *times)
{
    const struct rg_gate_rule rule = rg_gate_rule_in(r, lot->cases[0]->pair, lot->count, is_advice);
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

bool rg_gate_time(struct rg_running_gate *r, struct rg_gate_case *cases, int count)
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
