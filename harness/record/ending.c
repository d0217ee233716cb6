#include "harness/record/ending.h"

static const struct {
    const char *name;
    bool fails;
} endings[RG_ENDING_COUNT] = {
    [RG_ENDING_CRASH] = {"crash", true},
    [RG_ENDING_TIMEOUT] = {"timeout", true},
    [RG_ENDING_ERROR] = {"error", true},
    [RG_ENDING_SETUP] = {"set-up", true},
    [RG_ENDING_LACKING] = {"lacking", true},
    [RG_ENDING_DIFFERS] = {"differs", true},
    [RG_ENDING_UNEXPECTED_PASS] = {"unexpected pass", true},
    [RG_ENDING_NOTHING_MEASURED] = {"nothing measured", true},
    [RG_ENDING_REGRESSED] = {"regressed", true},
    [RG_ENDING_INCONCLUSIVE] = {"inconclusive", false},
    [RG_ENDING_FLAKE] = {"flake", false},
    [RG_ENDING_EXPECTED_FAILURE] = {"expected failure", false},
    [RG_ENDING_UNSUPPORTED] = {"unsupported", false},
    [RG_ENDING_SKIPPED] = {"skipped", false},
    [RG_ENDING_IMPROVED] = {"improved", false},
    [RG_ENDING_PASS] = {"pass", false},
};

enum rg_ending rg_ending_of(enum rg_outcome outcome)
{
    static const enum rg_ending of[RG_OUTCOME_COUNT] = {
        [RG_OK] = RG_ENDING_PASS,
        [RG_FAIL] = RG_ENDING_DIFFERS,
        [RG_UNSUPPORTED] = RG_ENDING_UNSUPPORTED,
        [RG_ERROR] = RG_ENDING_ERROR,
        [RG_CRASH] = RG_ENDING_CRASH,
        [RG_TIMEOUT] = RG_ENDING_TIMEOUT,
        [RG_NOTHING] = RG_ENDING_NOTHING_MEASURED,
        [RG_LACKING] = RG_ENDING_LACKING,
        [RG_SETUP] = RG_ENDING_SETUP,
    };
    return of[outcome];
}

const char *rg_ending_name(enum rg_ending ending)
{
    return endings[ending].name;
}

bool rg_ending_fails(enum rg_ending ending)
{
    return endings[ending].fails;
}
