// Reads our own form: a line "fail PATTERN" with its fields on indented lines below.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/gate/expected/inside.h"
#include "harness/compare/gate/text/date.h"

static int find(const char *const words[], const char *word)
{
    for (int i = 0; words[i]; i++)
        if (!strcmp(words[i], word))
            return i;
    return -1;
}

static bool read_outcomes(const char *place, char *value, unsigned *outcomes)
{
    char *rest = NULL;
    *outcomes = 0;
    for (char *word = strtok_r(value, " \t", &rest); word; word = strtok_r(NULL, " \t", &rest)) {
        enum rg_outcome outcome;
        if (!rg_outcome_find(word, &outcome) || !(RG_KNOWN_ANY & 1 << outcome))
            return rg_error("%s: outcome '%.80s': write fail, error, crash or timeout", place,
                            word);
        *outcomes |= 1U << outcome;
    }
    return true;
}

// Accepts plain decimal numbers only; strtod alone would also take hexadecimal, blanks and words.
static bool read_number(const char *text, double *number)
{
    char *end;
    if (text[strspn(text, "0123456789.eE+-")])
        return false;
    *number = strtod(text, &end);
    return end != text && !*end && isfinite(*number) && *number >= 0;
}

// "10..40", or "10" for 10..10.
static bool read_envelope(const char *place, const char *field, const char *value,
                          struct rg_envelope *envelope)
{
    char least[64];
    const char *dots = strstr(value, "..");
    snprintf(least, sizeof(least), "%.*s", dots ? (int)(dots - value) : 63, value);
    return (read_number(least, &envelope->least) &&
            read_number(dots ? dots + 2 : least, &envelope->most) &&
            envelope->least <= envelope->most && strlen(value) < sizeof(least)) ||
           rg_error("%s: %s '%.80s': write LEAST..MOST, as in 10..40", place, field, value);
}

static bool read_day(const char *place, const char *field, const char *value, int *day)
{
    return rg_date_read(value, day) ||
           rg_error("%s: %s '%.80s': no day of the calendar; write YYYY-MM-DD, as in 2026-11-23",
                    place, field, value);
}

static bool read_value(const char *place, struct rg_expectation *row, int field, char *value)
{
    const char *name = rg_known_fields[field];
    switch (field) {
    case RG_FIELD_OUTCOME:
        return read_outcomes(place, value, &row->outcomes);
    case RG_FIELD_PIXELS:
        return read_envelope(place, name, value, &row->pixels);
    case RG_FIELD_DIFFERENCE:
        return read_envelope(place, name, value, &row->difference);
    case RG_FIELD_SINCE:
        return read_day(place, name, value, &row->since);
    case RG_FIELD_UNTIL:
        return read_day(place, name, value, &row->until);
    default:
        return true;
    }
}

static bool take_field(const char *place, struct rg_expectation *row, char *text, int64_t line)
{
    char *value = rg_line_cut(text);
    const int field = find(rg_known_fields, text);
    if (field < 0)
        return rg_error("%s: field '%.80s': unknown; write device, driver, outcome, pixels, "
                        "difference, reason, link, since or until",
                        place, text);
    if (row->values[field])
        return rg_error("%s: field '%s' stands twice; take one out", place, text);
    if (!*value)
        return rg_error("%s: field '%s' has no value; write one after it", place, text);
    row->values[field] = value;
    row->at[field] = line;
    row->line_count = line - row->line + 1;
    return read_value(place, row, field, value);
}

static bool begin(const char *place, struct rg_known *expected, char *text, int64_t line)
{
    char *cell = rg_line_cut(text);
    const int kind = find(rg_known_kinds, text);
    if (kind < 0)
        return rg_error("%s: '%.80s': write fail, flake or skip, and a pattern of cells; fields "
                        "stand indented below",
                        place, text);
    if (!*cell || cell[strcspn(cell, " \t")])
        return rg_error("%s: '%s' has %s; write one pattern of cells, as in streaks/*", place, text,
                        *cell ? "more than one word" : "no pattern");
    struct rg_expectation *row = rg_known_new(expected, (enum rg_known_kind)kind, line);
    if (row)
        row->cell = cell;
    return row;
}

// Rejects evidence of pictures if no expected outcome compares pictures.
static bool has_pictures(const char *name, const struct rg_expectation *row)
{
    static const int evidence[] = {RG_FIELD_PIXELS, RG_FIELD_DIFFERENCE};
    const bool are_compared = !row->values[RG_FIELD_OUTCOME] || row->outcomes & 1U << RG_FAIL;
    for (int i = 0; i < 2 && !are_compared; i++)
        if (row->values[evidence[i]])
            return rg_error("%s:%lld: '%s' is of outcome fail alone, and that is none of those "
                            "expected; take it out, or add the outcome",
                            name, (long long)row->at[evidence[i]] + 1,
                            rg_known_fields[evidence[i]]);
    return true;
}

// Rejects a row that lacks a required field; called once all its fields are read.
static bool is_whole(const char *name, const struct rg_expectation *row)
{
    static const int needed[] = {RG_FIELD_REASON, RG_FIELD_SINCE, RG_FIELD_UNTIL, RG_FIELD_OUTCOME};
    const long long line = row->line + 1;
    for (int i = 0; i < 3 + (row->kind == RG_EXPECT_FAIL); i++)
        if (!row->values[needed[i]])
            return rg_error("%s:%lld: %s %.80s: no field '%s'; add it, indented, below", name, line,
                            rg_known_kinds[row->kind], row->cell, rg_known_fields[needed[i]]);
    return row->since <= row->until ||
           rg_error("%s:%lld: %s %.80s: it ends before it begins; mend 'since' or 'until'", name,
                    line, rg_known_kinds[row->kind], row->cell);
}

static bool take_line(struct rg_known *expected, const char *place, int64_t first, int64_t line,
                      char *text)
{
    if (*text != ' ' && *text != '\t')
        return begin(place, expected, text, line);
    if (expected->count == first)
        return rg_error("%s: a field of nothing; begin with fail, flake or skip, not indented",
                        place);
    return take_field(place, &expected->rows[expected->count - 1], rg_line_skip(text), line);
}

bool rg_known_read_own(struct rg_known *expected)
{
    const struct rg_lines *lines = &expected->files[expected->file_count - 1].lines;
    const int64_t first = expected->count;
    char place[RG_LINES_PLACE], *text;
    bool ok = true;
    for (int64_t i = -1; ok && (text = rg_lines_next(lines, &i, place));)
        ok = take_line(expected, place, first, i, text);
    for (int64_t i = first; i < expected->count && ok; i++)
        ok = is_whole(lines->name, &expected->rows[i]) &&
             has_pictures(lines->name, &expected->rows[i]);
    return ok;
}
