// What would make a file of expectations true: edits of its lines.
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/array.h"
#include "core/base/log.h"
#include "harness/compare/gate/expected/inside.h"
#include "harness/compare/gate/text/date.h"

struct patch {
    const struct rg_known *expected;
    const struct rg_lines *lines;
    int file, today;
    const char *end; // of the file's lines
    const struct rg_known_result *results;
    int64_t count;
    int64_t *rows;    // by result
    enum rg_met *met; // by result
    struct rg_line_edit *edits;
    int64_t edit_count, room;
    bool ok;
};

// Takes over the text.
static void edit(struct patch *p, int64_t line, char *text)
{
    p->ok = p->ok && text &&
            rg_array_fit(&p->edits, &p->room, p->edit_count + 1, sizeof(*p->edits), "a patch");
    if (p->ok)
        p->edits[p->edit_count++] = (struct rg_line_edit){line, text};
    else
        free(text);
}

static void take_out(struct patch *p, int64_t line, int64_t count)
{
    for (int64_t i = line; i < line + count; i++)
        edit(p, i, strdup(""));
}

// --- what a row is to say ---

// Of the results that a row holds for.
struct summary {
    int64_t fixed, failing, wrong; // wrong: differ or have expired
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

static void count_result(struct summary *s, const struct rg_known_result *result, enum rg_met met)
{
    s->fixed += met == RG_MET_FIXED;
    s->wrong += met == RG_MET_DIFFERENT || met == RG_MET_EXPIRED;
    s->unknown += met == RG_MET_NOTHING || !result->driver;
    s->has_expired = s->has_expired || met == RG_MET_EXPIRED;
    if (result->outcome == RG_OK || result->outcome == RG_UNSUPPORTED || result->is_foreign)
        return;
    s->failing++;
    s->outcomes |= 1U << result->outcome;
    if (result->outcome != RG_FAIL)
        return;
    widen(&s->pixels, result->pixels);
    widen(&s->difference, result->difference);
}

// Whether a row expects to fail what another before it expected, and what is fixed: once that one
// is gone, this one would be what is not true.
static bool is_fixed_behind(const struct patch *p, int64_t row, int64_t result)
{
    const struct rg_expectation *r = &p->expected->rows[row];
    const struct rg_known_result *of = &p->results[result];
    return p->met[result] == RG_MET_FIXED && p->rows[result] < row && r->kind == RG_EXPECT_FAIL &&
           rg_known_holds(p->expected, r, of->cell, of->device, of->driver, p->today);
}

// Whether a row may be the one that holds for a result: which one does is not known of a driver
// without a name.
static bool is_of_row(const struct patch *p, int64_t row, int64_t result)
{
    const struct rg_known_result *of = &p->results[result];
    return p->rows[result] == row ||
           (!of->driver && rg_known_holds(p->expected, &p->expected->rows[row], of->cell,
                                          of->device, of->driver, p->today));
}

// Of result `only`, or of all with -1. Of what nothing is known of, what was expected still is.
static struct summary sum_up(const struct patch *p, int64_t row, int64_t only)
{
    const struct rg_expectation *r = &p->expected->rows[row];
    struct summary s = {.pixels = r->pixels, .difference = r->difference};
    for (int64_t i = 0; i < p->count; i++)
        if ((is_of_row(p, row, i) || is_fixed_behind(p, row, i)) && (only < 0 || i == only))
            count_result(&s, &p->results[i], p->met[i]);
    if (s.unknown)
        s.outcomes |= r->outcomes;
    return s;
}

// Whether a field is evidence of pictures in a row none of whose new outcomes compares them: such
// a row would be refused.
static bool is_idle(const struct rg_expectation *row, const struct summary *s, int field)
{
    const unsigned old = row->kind == RG_EXPECT_FLAKE || !s->outcomes ? row->outcomes : 0;
    return (field == RG_FIELD_PIXELS || field == RG_FIELD_DIFFERENCE) &&
           !((s->outcomes | old) & 1U << RG_FAIL);
}

// What a field is to say; false where it stays as it is.
static bool new_value(const struct patch *p, const struct rg_expectation *row,
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
        rg_date_write(p->today + RG_KNOWN_LEASE_DAYS, text);
        return s->has_expired;
    default:
        return false;
    }
}

// --- edits ---

static char *field_line(const struct patch *p, int field, const char *value)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    rg_known_write_field(out, field, value, p->end);
    fclose(out);
    return text;
}

static void edit_fields(struct patch *p, const struct rg_expectation *row, const struct summary *s)
{
    char value[256];
    for (int64_t line = row->line; line < row->line + row->line_count; line++)
        for (int field = 0; field < RG_FIELD_COUNT; field++)
            if (row->values[field] && row->at[field] == line && is_idle(row, s, field))
                take_out(p, line, 1);
            else if (row->values[field] && row->at[field] == line &&
                     new_value(p, row, s, field, value, sizeof(value)))
                edit(p, line, field_line(p, field, value));
}

// A row as it stands, narrowed to one result.
static void print_narrowed(const struct patch *p, int64_t index, int64_t result, FILE *out)
{
    const struct rg_expectation *row = &p->expected->rows[index];
    const struct summary s = sum_up(p, index, result);
    char value[256], outcomes[64];
    rg_known_write_outcomes(row->outcomes, outcomes, sizeof(outcomes));
    rg_known_write_head(out, row->kind, p->results[result].cell, p->end);
    for (int field = 0; field < RG_FIELD_COUNT; field++) {
        const char *old = field == RG_FIELD_DEVICE    ? p->results[result].device
                          : field == RG_FIELD_OUTCOME ? outcomes
                                                      : row->values[field];
        const bool is_new = new_value(p, row, &s, field, value, sizeof(value));
        if (old && !is_idle(row, &s, field) && (row->values[field] || field == RG_FIELD_DEVICE))
            rg_known_write_field(out, field, is_new ? value : old, p->end);
    }
}

// Whether a result needs a row of its own where not all that a row expects still is.
static bool stays(const struct patch *p, int64_t row, int64_t result)
{
    const bool has_passed = p->met[result] == RG_MET_FIXED || (p->met[result] == RG_MET_EXPIRED &&
                                                               p->results[result].outcome == RG_OK);
    return is_of_row(p, row, result) && !has_passed;
}

// Some of the cells of a row pass, and others do not, or are not known to: a row each for these.
static void split(struct patch *p, int64_t index)
{
    const struct rg_expectation *row = &p->expected->rows[index];
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out) {
        p->ok = rg_harness_error("%s: no memory for its patch", p->lines->name);
        return;
    }
    const char *between = "";
    for (int64_t i = 0; i < p->count; i++) {
        if (!stays(p, index, i))
            continue;
        fputs(between, out);
        print_narrowed(p, index, i, out);
        between = p->end;
    }
    fclose(out);
    edit(p, row->line, text);
    take_out(p, row->line + 1, row->line_count - 1);
}

// With the blank line behind it, so that none stand in pairs.
static void drop(struct patch *p, const struct rg_expectation *row)
{
    const int64_t next = row->line + row->line_count;
    const bool is_blank = p->expected->files[row->file].form == RG_FORM_OWN &&
                          next < p->lines->count && !*p->lines->lines[next].text;
    take_out(p, row->line, row->line_count + is_blank);
}

static void mend_own(struct patch *p, int64_t index, const struct summary *s)
{
    const struct rg_expectation *row = &p->expected->rows[index];
    const bool is_over = !s->failing && s->fixed + s->has_expired;
    if (row->kind == RG_EXPECT_SKIP ? s->has_expired : is_over && !s->unknown)
        drop(p, row);
    else if (s->fixed || is_over)
        split(p, index);
    else
        edit_fields(p, row, s);
}

// A line has one status: where a test passes here and fails there, none is true, and where nothing
// is known of it there, the line may be.
static void mend_mesa(struct patch *p, int64_t index, const struct summary *s)
{
    const struct rg_expectation *row = &p->expected->rows[index];
    if (s->unknown)
        return;
    if (s->fixed && !s->failing)
        drop(p, row);
    else if (s->wrong && !s->fixed)
        edit(p, row->line, rg_known_mesa_line(row->cell, s->outcomes, p->end));
}

// --- what nothing expects ---

static bool is_new(const struct patch *p, int64_t i)
{
    return p->rows[i] < 0 && !p->results[i].is_foreign &&
           rg_met_fails(p->met[i], p->results[i].outcome);
}

static void print_new_of_form(struct patch *p, enum rg_known_form form, int64_t i, FILE *out)
{
    if (form == RG_FORM_OWN) {
        fputs(p->lines->count || ftell(out) ? p->end : "", out);
        rg_known_write_new(out, &p->results[i], p->today, p->end);
        return;
    }
    char *line = rg_known_mesa_line(p->results[i].cell, 1U << p->results[i].outcome, p->end);
    p->ok = p->ok && line;
    fputs(line ? line : "", out);
    free(line);
}

// Prints all that is new.
static void print_all_new(struct patch *p, FILE *out)
{
    const enum rg_known_form form = p->expected->files[p->file].form;
    for (int64_t i = 0; i < p->count; i++)
        if (is_new(p, i))
            print_new_of_form(p, form, i, out);
}

static bool has_new(const struct patch *p)
{
    int64_t i = 0;
    while (i < p->count && !is_new(p, i))
        i++;
    return i < p->count;
}

// Adds it behind the last line; an edit of that line takes it in, and one without an end gets one.
static void add_new(struct patch *p)
{
    const struct rg_lines *lines = p->lines;
    const int64_t last = lines->count - 1;
    struct rg_line_edit *there = p->edit_count ? &p->edits[p->edit_count - 1] : NULL;
    there = there && there->line == last ? there : NULL;
    const bool is_unended = lines->count && lines->raw[lines->size - 1] != '\n';
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    if (!out) {
        p->ok = rg_harness_error("%s: no memory for its patch", lines->name);
        return;
    }
    if (there)
        fputs(there->text, out);
    else if (is_unended)
        fprintf(out, "%s%s", lines->raw + lines->lines[last].at, p->end);
    print_all_new(p, out);
    fclose(out);
    if (!there) {
        edit(p, lines->count - is_unended, text);
        return;
    }
    free(there->text);
    there->text = text;
}

// --- all of it ---

static void judge_all(struct patch *p)
{
    for (int64_t i = 0; i < p->count; i++) {
        const struct rg_known_result *r = &p->results[i];
        p->rows[i] = rg_known_row(p->expected, r->cell, r->device, r->driver, p->today);
        p->met[i] = rg_known_judge(p->expected, p->rows[i], r, p->today);
    }
}

static void mend_rows(struct patch *p)
{
    const enum rg_known_form form = p->expected->files[p->file].form;
    for (int64_t row = 0; row < p->expected->count && p->ok; row++) {
        if (p->expected->rows[row].file != p->file)
            continue;
        const struct summary s = sum_up(p, row, -1);
        if (!s.fixed && !s.wrong)
            continue;
        if (form == RG_FORM_OWN)
            mend_own(p, row, &s);
        else
            mend_mesa(p, row, &s);
    }
}

bool rg_known_patch(const struct rg_known *expected, int file,
                    const struct rg_known_result *results, int64_t count, int today, bool adds_new,
                    FILE *out)
{
    const struct rg_lines *lines = &expected->files[file].lines;
    const enum rg_known_form form = expected->files[file].form;
    const bool has_cr = lines->count && strstr(lines->raw, "\r\n");
    struct patch p = {.expected = expected,
                      .lines = lines,
                      .file = file,
                      .today = today,
                      .end = has_cr ? "\r\n" : "\n",
                      .results = results,
                      .count = count,
                      .rows = rg_alloc((size_t)count, sizeof(*p.rows), "a patch"),
                      .met = rg_alloc((size_t)count, sizeof(*p.met), "a patch"),
                      .ok = true};
    p.ok = p.rows && p.met;
    if (p.ok) {
        judge_all(&p);
        mend_rows(&p);
        if (adds_new && has_new(&p) && (form == RG_FORM_OWN || form == RG_FORM_FAILS))
            add_new(&p);
    }
    p.ok = p.ok && rg_lines_diff(lines, p.edits, p.edit_count, out);
    for (int64_t i = 0; i < p.edit_count; i++)
        free(p.edits[i].text);
    free(p.edits);
    free(p.rows);
    free(p.met);
    return p.ok;
}
