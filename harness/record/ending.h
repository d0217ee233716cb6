// The ending of a gate's case, as its record tells it.
#ifndef RG_HARNESS_RECORD_ENDING_H
#define RG_HARNESS_RECORD_ENDING_H

#include <stdbool.h>

#include "core/base/outcome.h"

// How a case ended, worst first, so that a reader of three lines sees the worst.
enum rg_ending {
    RG_ENDING_CRASH,
    RG_ENDING_TIMEOUT,
    RG_ENDING_ERROR,
    RG_ENDING_SETUP,           // a driver is installed, and its files or settings are broken
    RG_ENDING_LACKING,         // raingauge itself lacked memory, processes, descriptors or disk
    RG_ENDING_DIFFERS,         // other pictures, states or counters
    RG_ENDING_UNEXPECTED_PASS, // it was expected to fail
    RG_ENDING_NOTHING_MEASURED,
    RG_ENDING_REGRESSED,
    RG_ENDING_INCONCLUSIVE,
    RG_ENDING_FLAKE, // known to fail now and then
    RG_ENDING_EXPECTED_FAILURE,
    RG_ENDING_UNSUPPORTED,
    RG_ENDING_SKIPPED,
    RG_ENDING_IMPROVED,
    RG_ENDING_PASS,
};
enum { RG_ENDING_COUNT = RG_ENDING_PASS + 1 };

// The ending of a case without an expectation, when times decide nothing.
enum rg_ending rg_ending_of(enum rg_outcome outcome);
// "unexpected pass": all forms use these words.
const char *rg_ending_name(enum rg_ending ending);
// Whether it is a failure or an error.
bool rg_ending_fails(enum rg_ending ending);

#endif
