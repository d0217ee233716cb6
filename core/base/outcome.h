// How a piece of work on a device ended: one enum with one word each, from a child process that a
// driver brought down to the exit status. Bad usage and bad input are no outcomes, for no work
// began.
#ifndef RG_CORE_BASE_OUTCOME_H
#define RG_CORE_BASE_OUTCOME_H

#include <stdbool.h>

enum rg_outcome {
    RG_OK,
    RG_FAIL,        // it was done, and the result is wrong: another image, a law that does not hold
    RG_UNSUPPORTED, // the device or the machine lacks what was asked for
    RG_ERROR,       // it could not be done: a driver reported an error
    RG_CRASH,       // a driver ended the process that it ran in
    RG_TIMEOUT,     // a driver did not come back in time
    RG_NOTHING,     // it was done, and proves nothing: there was no rain to compare or to time
    RG_LACKING,     // it could not be done: raingauge itself lacked memory, a process, a descriptor
                    // or room for a file, which says nothing of a driver
};
enum { RG_OUTCOME_COUNT = RG_LACKING + 1 };

// "ok", "fail", "unsupported", "error", "crash", "timeout", "nothing": the words of all machine
// forms. RG_LACKING is an "error" there as well, which all readers know; its fault stands beside
// it.
const char *rg_outcome_name(enum rg_outcome outcome);
// The outcome of this name. False where there is none.
bool rg_outcome_find(const char *name, enum rg_outcome *outcome);

// Whether it kept the work from being done, and may pass by another time: an error, a crash, a
// timeout or a want of raingauge's own.
bool rg_outcome_is_broken(enum rg_outcome outcome);

#endif
