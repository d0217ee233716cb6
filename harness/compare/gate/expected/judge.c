#include <string.h>

#include "core/base/log.h"
#include "harness/compare/gate/expected/inside.h"
#include "harness/compare/gate/text/glob.h"

const char *rg_judged_word(const struct rg_judged *judged)
{
    return !judged->applies                               ? ""
           : judged->is_expired                           ? "expired"
           : judged->ending == RG_ENDING_SKIPPED          ? "skipped"
           : judged->ending == RG_ENDING_FLAKE            ? "flaky"
           : judged->ending == RG_ENDING_EXPECTED_FAILURE ? "expected"
           : judged->ending == RG_ENDING_UNEXPECTED_PASS  ? "fixed"
                                                          : "fails differently";
}

static bool is_of(const char *pattern, const char *text)
{
    return !pattern || rg_glob(pattern, text);
}

bool rg_known_holds(const struct rg_known *expected, const struct rg_expectation *row,
                    const char *cell, const char *device, const char *driver, int today)
{
    if (today < row->since)
        return false;
    if (row->regex)
        return rg_regex_search(row->regex, cell) == RG_REGEX_FOUND;
    if (expected->files[row->file].form == RG_FORM_FAILS)
        return !strcmp(row->cell, cell);
    return rg_glob(row->cell, cell) && is_of(row->values[RG_FIELD_DEVICE], device) &&
           (!driver || is_of(row->values[RG_FIELD_DRIVER], driver));
}

bool rg_known_can_search(const struct rg_known *expected, const char *cell)
{
    for (int64_t i = 0; i < expected->count; i++) {
        const struct rg_expectation *row = &expected->rows[i];
        if (row->regex && rg_regex_search(row->regex, cell) == RG_REGEX_TOO_LONG)
            return rg_error("%s:%lld: regular expression: takes too long to be searched for in "
                            "'%.80s'; write fewer repetitions in one another "
                            "(docs/expectations.md)",
                            expected->files[row->file].lines.name, (long long)row->line + 1, cell);
    }
    return true;
}

int64_t rg_known_row(const struct rg_known *expected, const char *cell, const char *device,
                     const char *driver, int today)
{
    int64_t found = -1;
    for (int64_t i = 0; i < expected->count; i++) {
        const struct rg_expectation *row = &expected->rows[i];
        if ((found < 0 || row->kind < expected->rows[found].kind) &&
            rg_known_holds(expected, row, cell, device, driver, today))
            found = i;
    }
    return found;
}

bool rg_known_skips(const struct rg_known *expected, int64_t row, int today)
{
    return row >= 0 && expected->rows[row].kind == RG_EXPECT_SKIP &&
           today <= expected->rows[row].until;
}

// False for NAN.
static bool is_in(const struct rg_envelope *envelope, double value)
{
    return value >= envelope->least && value <= envelope->most;
}

static bool is_as_expected(const struct rg_expectation *row, const struct rg_known_result *result)
{
    if (!(row->outcomes & 1U << result->outcome))
        return false;
    if (result->outcome != RG_FAIL) // there is no picture to compare
        return true;
    return (!row->values[RG_FIELD_PIXELS] || is_in(&row->pixels, result->pixels)) &&
           (!row->values[RG_FIELD_DIFFERENCE] || is_in(&row->difference, result->difference));
}

struct rg_judged rg_known_judge(const struct rg_known *expected, int64_t index,
                                const struct rg_known_result *result, enum rg_ending own, int today)
{
    const struct rg_judged alone = {own, false, false};
    // An expired expectation fails even if the case is faster or inconclusive.
    const enum rg_ending fails = rg_ending_fails(own) ? own : RG_ENDING_UNEXPECTED_PASS;
    if (index < 0)
        return alone;
    const struct rg_expectation *row = &expected->rows[index];
    const bool is_over = today > row->until;
    if (row->kind == RG_EXPECT_SKIP && !is_over)
        return (struct rg_judged){RG_ENDING_SKIPPED, true, false};
    if (result->outcome == RG_UNSUPPORTED) // neither passed nor failed
        return alone;
    if (result->is_foreign) // the failure is not of the device's driver
        return alone;
    if (row->kind == RG_EXPECT_FAIL && result->outcome == RG_OK)
        return (struct rg_judged){RG_ENDING_UNEXPECTED_PASS, true, false};
    if (is_over)
        return (struct rg_judged){fails, true, true};
    if (result->outcome != RG_OK && !is_as_expected(row, result))
        return (struct rg_judged){fails, true, false};
    return (struct rg_judged){
        row->kind == RG_EXPECT_FLAKE ? RG_ENDING_FLAKE : RG_ENDING_EXPECTED_FAILURE, true, false};
}
