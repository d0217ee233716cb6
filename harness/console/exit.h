// The program's exit statuses, and their mapping from outcomes and errors.
#ifndef RG_HARNESS_CONSOLE_EXIT_H
#define RG_HARNESS_CONSOLE_EXIT_H

#include <jansson.h>
#include <stdint.h>

#include "core/base/outcome.h"

// docs/environment.md lists them. Functions return them as int, since 128 plus a signal's number is
// not in the enum.
enum rg_exit {
    RG_EXIT_PASS = 0,
    RG_EXIT_FAIL = 1,  // differs, regressed, not verified; a driver failed
    RG_EXIT_USAGE = 2, // bad usage or input
    RG_EXIT_INCONCLUSIVE = 3,
    RG_EXIT_NOTHING = 4,      // nothing was compared or measured
    RG_EXIT_HARNESS = 71,     // raingauge itself lacked memory, processes, descriptors or disk
    RG_EXIT_LATER = 75,       // this machine can measure nothing now (doctor --prologue)
    RG_EXIT_UNSUPPORTED = 77, // not supported on this machine
    RG_EXIT_GIT_SKIP = 125,   // for `git bisect run` only: this commit cannot be tested
    RG_EXIT_SIGNALLED = 128,  // plus the signal's number: ended early on request
};

// The status of work with one outcome.
int rg_exit_of(enum rg_outcome outcome);
// The status of work with these counts of outcomes. Any failure gives fail, else a lack in
// raingauge itself gives RG_EXIT_HARNESS, else an outcome of nothing gives RG_EXIT_NOTHING.
// Otherwise the work passes if something was ok, and is unsupported if all was. Without any
// outcome, nothing was measured.
int rg_exit_of_all(const int counts[RG_OUTCOME_COUNT]);
// The final status of a command that compares or measures `count` things: it passes only with at
// least one.
int rg_exit_with(int exit, int64_t count);
// The status of work that the last failure ended (rg_failure_take): bad usage if the user's input
// is at fault.
int rg_exit_of_error(void);

// The status that a record tells of its command's work; RG_EXIT_FAIL for all that is told of no
// work, such as a signal or a busy machine.
int rg_exit_of_record(const json_t *status);

// Logs that standard output cannot be written, and returns false, as rg_error does.
bool rg_stdout_error(void);

// The worse status of two parts of a command. From the worst: a signal, bad usage, a failure, a
// lack in raingauge itself, inconclusive, nothing compared, unsupported.
int rg_exit_worse(int a, int b);

#endif
