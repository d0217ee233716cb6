// Rewrites a file of expectations so that it is true of a gate's results.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/compare/gate/expected/inside.h"
#include "harness/compare/gate/text/date.h"

struct mend {
    const struct rg_known *expected;
    const struct rg_lines *lines;
    enum rg_known_form form;
    int file, today;
    const char *end; // line end of the file
    const struct rg_known_result *results;
    int64_t count;
    int64_t *rows;            // by result
    struct rg_judged *judged; // by result
    FILE *out;                // into *text
    char **text;
    size_t *size;
};

// --- a row and its results ---

// The results that one row applies to.
struct summary {
    int64_t fixed, failing, wrong; // wrong: fail differently or have expired
    int64_t unknown;               // neither passed nor failed, or did not run
    bool has_expired;
    unsigned outcomes;
    struct rg_envelope pixels, difference;
};

static void widen(struct rg_envelope *envelope, double value)
{
    envelope->least = fmin(envelope->least, value);
    envelope->most = fmax(envelope->most, value);
}

static bool is_fixed(const struct rg_judged *judged)
{
    return judged->applies && !judged->is_expired && judged->ending == RG_ENDING_UNEXPECTED_PASS;
}

static void count_result(struct summary *s, const struct rg_known_result *result,
                         const struct rg_judged *judged)
{
    s->fixed += is_fixed(judged);
    s->wrong += judged->applies && !is_fixed(judged) && rg_ending_fails(judged->ending);
    s->unknown += !judged->applies || !result->driver;
    s->has_expired = s->has_expired || judged->is_expired;
    if (result->outcome == RG_OK || result->outcome == RG_UNSUPPORTED || result->is_foreign)
        return;
    s->failing++;
    s->outcomes |= 1U << result->outcome;
    if (result->outcome != RG_FAIL)
        return;
    widen(&s->pixels, result->pixels);
    widen(&s->difference, result->difference);
}

// Whether this row also expects a failure that is fixed, and only an earlier row was compared with
// the result. Once the earlier row is removed, this one would be wrong.
static bool is_fixed_behind(const struct mend *m, int64_t row, int64_t result)
{
    const struct rg_expectation *r = &m->expected->rows[row];
    const struct rg_known_result *of = &m->results[result];
    return is_fixed(&m->judged[result]) && m->rows[result] < row && r->kind == RG_EXPECT_FAIL &&
           rg_known_holds(m->expected, r, of->cell, of->device, of->driver, m->today);
}

// Whether a row may be the one that applies to a result. Without the driver's name any row that
// matches may be.
static bool is_of_row(const struct mend *m, int64_t row, int64_t result)
{
    const struct rg_known_result *of = &m->results[result];
    return m->rows[result] == row ||
           (!of->driver && rg_known_holds(m->expected, &m->expected->rows[row], of->cell,
                                          of->device, of->driver, m->today));
}

// Counts result `only`, or all with -1. For results that are unknown the row's old outcomes remain.
static struct summary sum_up(const struct mend *m, int64_t row, int64_t only)
{
    const struct rg_expectation *r = &m->expected->rows[row];
    struct summary s = {.pixels = r->pixels, .difference = r->difference};
    for (int64_t i = 0; i < m->count; i++)
        if ((is_of_row(m, row, i) || is_fixed_behind(m, row, i)) && (only < 0 || i == only))
            count_result(&s, &m->results[i], &m->judged[i]);
    if (s.unknown)
        s.outcomes |= r->outcomes;
    return s;
}

// Whether a field would hold evidence of pictures although none of the new outcomes compares any;
// the reader refuses such a row.
static bool is_idle(const struct rg_expectation *row, const struct summary *s, int field)
{
    const unsigned old = row->kind == RG_EXPECT_FLAKE || !s->outcomes ? row->outcomes : 0;
    return (field == RG_FIELD_PIXELS || field == RG_FIELD_DIFFERENCE) &&
           !((s->outcomes | old) & 1U << RG_FAIL);
}

// The field's new value; false if the old one stays.
static bool new_value(const struct mend *m, const struct rg_expectation *row,
                      const struct summary *s, int field, char *text, size_t size)
{
    const struct rg_envelope *e = field == RG_FIELD_PIXELS ? &s->pixels : &s->difference;
    const struct rg_envelope *old = field == RG_FIELD_PIXELS ? &row->pixels : &row->difference;
    switch (field) {
    case RG_FIELD_OUTCOME:
        rg_known_write_outcomes(
            row->kind == RG_EXPECT_FLAKE ? row->outcomes | s->outcomes : s->outcomes, text, size);
        return s->outcomes && (row->kind == RG_EXPECT_FLAKE ? s->outcomes & ~row->outcomes
                                                            : s->outcomes != row->outcomes);
    case RG_FIELD_PIXELS:
    case RG_FIELD_DIFFERENCE:
        snprintf(text, size, "%.17g..%.17g", e->least, e->most);
        return e->least < old->least || e->most > old->most;
    case RG_FIELD_UNTIL:
        rg_date_write(m->today + RG_KNOWN_LEASE_DAYS, text);
        return s->has_expired;
    default:
        return false;
    }
}

// --- writing rows ---

static void copy(const struct mend *m, int64_t line, int64_t end)
{
    for (; line < end; line++)
        fwrite(m->lines->raw + m->lines->lines[line].at, 1, m->lines->lines[line].length, m->out);
}

// Writes a line of a row; if it holds a field, that may have a new value or be dropped.
static void write_line(const struct mend *m, const struct rg_expectation *row,
                       const struct summary *s, int64_t line)
{
    char value[256];
    int field = 0;
    while (field < RG_FIELD_COUNT && !(row->values[field] && row->at[field] == line))
        field++;
    const bool is_field = field < RG_FIELD_COUNT;
    if (is_field && is_idle(row, s, field))
        return;
    if (is_field && new_value(m, row, s, field, value, sizeof(value)))
        rg_known_write_field(m->out, field, value, m->end);
    else
        copy(m, line, line + 1);
}

// Writes a copy of a row that applies to one result only.
static void write_narrowed(const struct mend *m, int64_t index, int64_t result)
{
    const struct rg_expectation *row = &m->expected->rows[index];
    const struct summary s = sum_up(m, index, result);
    char value[256], outcomes[64];
    rg_known_write_outcomes(row->outcomes, outcomes, sizeof(outcomes));
    rg_known_write_head(m->out, row->kind, m->results[result].cell, m->end);
    for (int field = 0; field < RG_FIELD_COUNT; field++) {
        const char *old = field == RG_FIELD_DEVICE    ? m->results[result].device
                          : field == RG_FIELD_OUTCOME ? outcomes
                                                      : row->values[field];
        const bool is_new = new_value(m, row, &s, field, value, sizeof(value));
        if (old && !is_idle(row, &s, field) && (row->values[field] || field == RG_FIELD_DEVICE))
            rg_known_write_field(m->out, field, is_new ? value : old, m->end);
    }
}

// Whether a result gets a row of its own when the row is split.
static bool stays(const struct mend *m, int64_t row, int64_t result)
{
    const bool has_passed = is_fixed(&m->judged[result]) ||
                            (m->judged[result].is_expired && m->results[result].outcome == RG_OK);
    return is_of_row(m, row, result) && !has_passed;
}

// Some cells of the row now pass. Replaces it by a row for each that does not, or whose result is
// unknown.
static void write_split(const struct mend *m, int64_t index)
{
    const char *between = "";
    for (int64_t i = 0; i < m->count; i++) {
        if (!stays(m, index, i))
            continue;
        fputs(between, m->out);
        write_narrowed(m, index, i);
        between = m->end;
    }
}

// Writes a row of our own form; false if it is removed.
static bool write_own(const struct mend *m, int64_t index, const struct summary *s)
{
    const struct rg_expectation *row = &m->expected->rows[index];
    const bool is_over = !s->failing && s->fixed + s->has_expired;
    if (row->kind == RG_EXPECT_SKIP ? s->has_expired : is_over && !s->unknown)
        return false;
    if (s->fixed || is_over)
        write_split(m, index);
    else
        for (int64_t line = row->line; line < row->line + row->line_count; line++)
            write_line(m, row, s, line);
    return true;
}

// A line of Mesa's has one status for all devices. If the test passes on one and fails on another,
// no status is true; if a result is unknown, the old status may still be. Both keep the line.
static bool write_mesa(const struct mend *m, int64_t index, const struct summary *s)
{
    const struct rg_expectation *row = &m->expected->rows[index];
    if (!s->unknown && s->fixed && !s->failing)
        return false;
    if (s->unknown || s->fixed)
        copy(m, row->line, row->line + 1);
    else
        rg_known_write_mesa(m->out, row->cell, s->outcomes, m->end);
    return true;
}

// Writes a row and returns the line after it. A removed row also drops the blank line after it, so
// that no two blank lines meet.
static int64_t write_row(const struct mend *m, int64_t index)
{
    const struct rg_expectation *row = &m->expected->rows[index];
    const struct summary s = sum_up(m, index, -1);
    const int64_t next = row->line + row->line_count;
    const bool is_own = m->form == RG_FORM_OWN;
    if (!s.fixed && !s.wrong)
        copy(m, row->line, next);
    else if (!(is_own ? write_own(m, index, &s) : write_mesa(m, index, &s)))
        return next + (is_own && next < m->lines->count && !*m->lines->lines[next].text);
    return next;
}

// --- unexpected failures ---

static bool is_new(const struct mend *m, int64_t i)
{
    const enum rg_outcome outcome = m->results[i].outcome;
    return m->rows[i] < 0 && !m->results[i].is_foreign &&
           (outcome == RG_FAIL || rg_outcome_is_broken(outcome));
}

// Appends them after the last line.
static void write_new(const struct mend *m)
{
    for (int64_t i = 0; i < m->count; i++) {
        if (!is_new(m, i))
            continue;
        if (m->form != RG_FORM_OWN) {
            rg_known_write_mesa(m->out, m->results[i].cell, 1U << m->results[i].outcome, m->end);
            continue;
        }
        fputs(ftell(m->out) > 0 ? m->end : "", m->out);
        rg_known_write_new(m->out, &m->results[i], m->today, m->end);
    }
}

// --- the whole file ---

static bool judge_all(struct mend *m)
{
    m->rows = rg_alloc((size_t)m->count, sizeof(*m->rows), "expectations");
    m->judged = rg_alloc((size_t)m->count, sizeof(*m->judged), "expectations");
    for (int64_t i = 0; m->rows && m->judged && i < m->count; i++) {
        const struct rg_known_result *r = &m->results[i];
        m->rows[i] = rg_known_row(m->expected, r->cell, r->device, r->driver, m->today);
        m->judged[i] =
            rg_known_judge(m->expected, m->rows[i], r, rg_ending_of(r->outcome), m->today);
    }
    return m->rows && m->judged;
}

static void write_all(const struct mend *m, bool adds_new)
{
    int64_t line = 0;
    for (int64_t row = 0; row < m->expected->count; row++) {
        if (m->expected->rows[row].file != m->file)
            continue;
        copy(m, line, m->expected->rows[row].line);
        line = write_row(m, row);
    }
    copy(m, line, m->lines->count);
    bool any = false;
    for (int64_t i = 0; adds_new && i < m->count && !any; i++)
        any = is_new(m, i);
    fflush(m->out);
    if (any && *m->size && (*m->text)[*m->size - 1] != '\n')
        fputs(m->end, m->out);
    if (any)
        write_new(m);
}

bool rg_known_mend(const struct rg_known *expected, int file, const struct rg_known_result *results,
                   int64_t count, int today, bool adds_new, char **text)
{
    const struct rg_lines *lines = &expected->files[file].lines;
    struct mend m = {.expected = expected,
                     .lines = lines,
                     .form = expected->files[file].form,
                     .file = file,
                     .today = today,
                     .end = lines->count && strstr(lines->raw, "\r\n") ? "\r\n" : "\n",
                     .results = results,
                     .count = count};
    *text = NULL;
    if (m.form != RG_FORM_OWN && m.form != RG_FORM_FAILS)
        return true;
    size_t size = 0;
    m.text = text;
    m.size = &size;
    bool ok = judge_all(&m);
    if (ok && (m.out = open_memstream(text, &size)))
        write_all(&m, adds_new);
    ok = ok && ((m.out && !fclose(m.out)) ||
                rg_harness_error("%s: no memory to mend it; close other programs", lines->name));
    free(m.rows);
    free(m.judged);
    if (!ok || (size == lines->size && !memcmp(*text, lines->raw, size))) {
        free(*text);
        *text = NULL;
    }
    return ok;
}
