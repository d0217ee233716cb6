// The program's exit statuses, and their mapping from outcomes and errors.
#ifndef RG_HARNESS_CONSOLE_EXIT_H
#define RG_HARNESS_CONSOLE_EXIT_H

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
    RG_EXIT_UNSUPPORTED = 77, // not supported on this machine
    RG_EXIT_GIT_SKIP = 125,   // for `git bisect run` only: this commit cannot be tested
    RG_EXIT_SIGNALLED = 128,  // plus the signal's number: ended early on request
};

// The status of work with one outcome.
int rg_exit_of(enum rg_outcome outcome);
// Of work with so many of each outcome: a failure of any kind outweighs all, then a want of
// raingauge's own, then what proves nothing; then it passes where something was ok, and is
// unsupported where all was. Without any, nothing was measured.
int rg_exit_of_all(const int counts[RG_OUTCOME_COUNT]);
// The final status of a command that compares or measures `count` things: it passes only with at
// least one.
int rg_exit_with(int exit, int64_t count);
// Of work that the failure that was just met ended (rg_failure_take): bad usage where that is the
// user's.
int rg_exit_of_error(void);

// Logs that standard output cannot be written, and returns false, as rg_error does.
bool rg_stdout_error(void);

// Of two parts of a command. Bad usage outweighs a failure, a failure a want of raingauge's own,
// that what proves nothing, and an interruption all.
int rg_exit_worse(int a, int b);

#endif
