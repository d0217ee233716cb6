// The outcome of work on a device: one enum with one word per value, used from a worker that
// crashed up to the exit status. Bad usage and bad input are no outcomes, because no work began.
#ifndef RG_CORE_BASE_OUTCOME_H
#define RG_CORE_BASE_OUTCOME_H

#include <stdbool.h>

enum rg_outcome {
    RG_OK,
    RG_FAIL,        // done, but the result is wrong: another image, a law that does not hold
    RG_UNSUPPORTED, // the device or the machine lacks a requested feature
    RG_ERROR,       // not done: a driver reported an error
    RG_CRASH,       // a driver ended the process in which it ran
    RG_TIMEOUT,     // a driver did not return in time
    RG_NOTHING,     // done, but proves nothing: there was no rain to compare or to time
    RG_LACKING, // not done: raingauge itself lacked memory, a process, a descriptor or disk space;
                // that is no fault of a driver
    RG_SETUP,   // not done: a driver is installed, and its files or settings are broken
};
enum { RG_OUTCOME_COUNT = RG_SETUP + 1 };

// "ok", "fail", "unsupported", "error", "crash", "timeout", "nothing": the words of all machine
// forms. RG_LACKING and RG_SETUP are also written "error", which all readers know, with their fault
// beside it.
const char *rg_outcome_name(enum rg_outcome outcome);
// Finds the outcome of this name. False if there is none.
bool rg_outcome_find(const char *name, enum rg_outcome *outcome);

// Whether the work was not done, and might succeed at another time: an error, crash, timeout, a
// lack of raingauge's own, or a broken set-up.
bool rg_outcome_is_broken(enum rg_outcome outcome);

#endif
