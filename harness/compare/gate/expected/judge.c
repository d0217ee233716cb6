#include <string.h>

#include "core/base/log.h"
#include "harness/compare/gate/expected/inside.h"
#include "harness/compare/gate/text/glob.h"

const char *rg_met_name(enum rg_met met)
{
    static const char *const names[] = {
        [RG_MET_NOTHING] = "none",    [RG_MET_EXPECTED] = "expected",
        [RG_MET_FIXED] = "fixed",     [RG_MET_DIFFERENT] = "fails differently",
        [RG_MET_EXPIRED] = "expired", [RG_MET_FLAKY] = "flaky",
        [RG_MET_SKIPPED] = "skipped",
    };
    return names[met];
}

bool rg_met_fails(enum rg_met met, enum rg_outcome outcome)
{
    if (met == RG_MET_NOTHING)
        return outcome == RG_FAIL || rg_outcome_is_broken(outcome);
    return met == RG_MET_FIXED || met == RG_MET_DIFFERENT || met == RG_MET_EXPIRED;
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

enum rg_met rg_known_judge(const struct rg_known *expected, int64_t index,
                           const struct rg_known_result *result, int today)
{
    if (index < 0)
        return RG_MET_NOTHING;
    const struct rg_expectation *row = &expected->rows[index];
    const bool is_over = today > row->until;
    if (row->kind == RG_EXPECT_SKIP && !is_over)
        return RG_MET_SKIPPED;
    if (result->outcome == RG_UNSUPPORTED) // neither passed nor failed
        return RG_MET_NOTHING;
    if (result->is_foreign) // of another driver than the device has
        return RG_MET_NOTHING;
    if (row->kind == RG_EXPECT_SKIP)
        return RG_MET_EXPIRED;
    if (row->kind == RG_EXPECT_FAIL && result->outcome == RG_OK)
        return RG_MET_FIXED;
    if (is_over)
        return RG_MET_EXPIRED;
    if (result->outcome != RG_OK && !is_as_expected(row, result))
        return RG_MET_DIFFERENT;
    return row->kind == RG_EXPECT_FLAKE ? RG_MET_FLAKY : RG_MET_EXPECTED;
}
