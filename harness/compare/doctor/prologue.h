// Whether a machine may take cells now: what a job asks before it measures.
#ifndef RG_HARNESS_COMPARE_DOCTOR_PROLOGUE_H
#define RG_HARNESS_COMPARE_DOCTOR_PROLOGUE_H

#include <stdbool.h>
#include <stdint.h>

#include "harness/devices/measure/others.h"

struct rg_prologue {
    rg_watch *watch;   // reads the processors
    const char *root;  // of /sys: "" for this machine, or a folder with a copy in tests
    int64_t throttled; // how often Linux had slowed the processors when it began
};

// Watches the machine. False, and one logged line, if others use its processors.
bool rg_prologue_begin(struct rg_prologue *prologue);
// Looks at the processors again, after the devices were examined. False, and one logged line, if
// Linux slowed them meanwhile because they were hot, which most virtual machines do not tell.
bool rg_prologue_end(const struct rg_prologue *prologue);

#endif
