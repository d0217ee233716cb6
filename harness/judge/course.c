#include "harness/judge/course.h"

#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/stats.h"
#include "kernels/dialect/rng.h"

// State of a row while it is measured.
struct row_course {
    double logs[RG_GATE_UNITS];        // of the launches that count
    double times_ms[2][RG_GATE_UNITS]; // A's and B's
    int count;
    int look;      // the next one
    bool is_again; // measured again, to confirm its verdict
    bool is_done;
};

struct gate {
    const struct rg_gate_rule *rule;
    const struct rg_quad_source *source;
    uint32_t seed;
    struct rg_gate_row *rows;
    struct row_course *courses;
    int *order;
    int launch; // the next one
};

// --- chance ---

static uint32_t draw(const struct gate *s, int what, int number)
{
    return rg_random(s->seed, (uint)what, (uint)s->launch, (uint)number).x;
}

static void shuffle(struct gate *s)
{
    for (int i = 0; i < s->rule->rows; i++)
        s->order[i] = i;
    for (int i = s->rule->rows - 1; i > 0; i--) {
        const int j = (int)(draw(s, 1, i) % (uint32_t)(i + 1));
        const int kept = s->order[i];
        s->order[i] = s->order[j];
        s->order[j] = kept;
    }
}

// --- verdicts ---

static struct rg_gate_decision decide(const struct gate *s, int row)
{
    const struct row_course *c = &s->courses[row];
    return s->source->before
               ? rg_gate_decide_apart(s->rule, &s->source->before[row], c->logs, c->count)
               : rg_gate_decide(s->rule, c->logs, c->count);
}

// The median of A's times; if they were taken earlier, of all of them.
static struct rg_interval a_ms_of(const struct gate *s, int row)
{
    if (!s->source->before)
        return rg_median(s->courses[row].times_ms[0], s->courses[row].count);
    struct rg_gate_sample sample = s->source->before[row];
    for (int i = 0; i < sample.count; i++)
        sample.logs[i] = exp(sample.logs[i]);
    return rg_median(sample.logs, sample.count);
}

static void end(struct gate *s, int row, enum rg_course_end why)
{
    struct row_course *c = &s->courses[row];
    struct rg_gate_row *found = &s->rows[row];
    c->is_done = true;
    found->end = why;
    if (why != RG_END_DECIDED)
        found->decision.verdict = RG_TWO_INCONCLUSIVE;
    if (!c->count)
        return;
    found->a_ms = a_ms_of(s, row);
    found->b_ms = rg_median(c->times_ms[1], c->count);
}

// Starts to measure a row again, from the first look, to confirm its verdict.
static void begin_again(struct gate *s, int row)
{
    struct row_course *c = &s->courses[row];
    s->rows[row].before = s->rows[row].decision;
    c->is_again = true;
    c->count = c->look = 0;
}

// Seeks a row's verdict at a look.
static void look(struct gate *s, int row)
{
    struct row_course *c = &s->courses[row];
    struct rg_gate_row *found = &s->rows[row];
    found->decision = decide(s, row);
    const enum rg_verdict_of_two verdict = found->decision.verdict;
    const bool is_last = c->look + 1 == s->rule->look_count;
    if (verdict == RG_TWO_INCONCLUSIVE && !is_last)
        c->look++;
    else if (c->is_again)
        end(s, row, verdict == found->before.verdict ? RG_END_DECIDED : RG_END_UNCONFIRMED);
    else if (verdict == RG_TWO_INCONCLUSIVE)
        end(s, row, RG_END_LOOKS);
    else if (verdict == RG_TWO_PASS)
        end(s, row, RG_END_DECIDED);
    else
        begin_again(s, row);
}

// --- launches ---

static void keep(struct gate *s, int row, const struct rg_quads *quads)
{
    struct row_course *c = &s->courses[row];
    s->rows[row].launches++;
    if (quads->is_disturbed) {
        s->rows[row].disturbed++;
        return;
    }
    c->times_ms[0][c->count] = quads->a_ms;
    c->times_ms[1][c->count] = quads->b_ms;
    c->logs[c->count++] = quads->log;
    if (c->count == s->rule->looks[c->look])
        look(s, row);
}

// Whether to give up a row most of whose launches are disturbed; it would go on for ever.
static bool is_hopeless(const struct rg_gate_row *row)
{
    return row->disturbed > 32 && row->disturbed > 3 * (row->launches - row->disturbed);
}

static void take(struct gate *s, int row)
{
    struct rg_quads quads = {.is_disturbed = false};
    if (!s->source->take(row, draw(s, 2, row) & 1, &quads, s->source->user))
        end(s, row, RG_END_BROKEN);
    else
        keep(s, row, &quads);
    if (!s->courses[row].is_done && is_hopeless(&s->rows[row]))
        end(s, row, RG_END_DISTURBED);
}

static bool any_is_left(const struct gate *s)
{
    bool any = false;
    for (int row = 0; row < s->rule->rows; row++)
        any = any || !s->courses[row].is_done;
    return any;
}

static void end_all(struct gate *s, enum rg_course_end why)
{
    for (int row = 0; row < s->rule->rows; row++) {
        if (s->courses[row].is_done)
            continue;
        s->rows[row].decision = decide(s, row);
        end(s, row, why);
    }
}

static void run(struct gate *s)
{
    const struct rg_quad_source *source = s->source;
    for (; any_is_left(s); s->launch++) {
        if (source->is_over && source->is_over(source->user)) {
            end_all(s, RG_END_OVER);
            return;
        }
        if (!source->launch(s->launch, source->user)) {
            end_all(s, RG_END_BROKEN);
            return;
        }
        shuffle(s);
        for (int i = 0; i < s->rule->rows; i++)
            if (!s->courses[s->order[i]].is_done)
                take(s, s->order[i]);
    }
}

bool rg_course_run(const struct rg_gate_rule *rule, const struct rg_quad_source *source,
                   uint32_t seed, struct rg_gate_row *rows)
{
    struct gate s = {.rule = rule, .source = source, .seed = seed, .rows = rows};
    s.courses = rg_alloc((size_t)rule->rows, sizeof(*s.courses), "gate");
    s.order = rg_alloc((size_t)rule->rows, sizeof(*s.order), "gate");
    const bool ok = s.courses && s.order;
    for (int row = 0; ok && row < rule->rows; row++)
        rows[row] = (struct rg_gate_row){.decision = rg_gate_decide(rule, NULL, 0)};
    if (ok)
        run(&s);
    free(s.order);
    free(s.courses);
    return ok;
}
