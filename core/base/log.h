// What raingauge tells people: one line a message, to stderr, and to whoever listens.
//
// Every function that can fail returns false or NULL and has logged one line that says what failed,
// where, and how to mend it. Nothing else prints to stderr but the progress bar.
#ifndef RG_CORE_BASE_LOG_H
#define RG_CORE_BASE_LOG_H

#include <stdbool.h>

#include "core/base/outcome.h"

enum rg_log_level { RG_LOG_ERROR, RG_LOG_WARNING, RG_LOG_INFO };
enum { RG_LOG_LEVELS = RG_LOG_INFO + 1 };

// Receives each line, without a newline. `user` is what rg_log_listen was given.
typedef void (*rg_log_fn)(enum rg_log_level level, const char *line, void *user);

// Sends lines to `fn` instead of stderr; NULL restores stderr. Not thread-safe: call it at start.
void rg_log_listen(rg_log_fn fn, void *user);

// Whether people are told a line: an error or a warning once, however many devices or cells meet
// its cause. It counts as told then. A listener hears every line; one that prints asks this.
bool rg_log_is_news(enum rg_log_level level, const char *line);

// Lines are dropped while this holds: what goes wrong then is expected, and said by who holds, who
// may ask for the last error.
void rg_log_hold(bool holds);

// Logs one line, "raingauge: ..." on stderr, where an error or a warning that was printed before is
// not printed again: several devices, cells and processes may meet one. rg_error returns false and
// rg_error_null returns NULL, so that a failing function ends in `return rg_error("...")`. Control
// characters inside are made plain (core/base/text/plain.h). Those two log what another usage or
// input mends; errors of other kinds have functions below.
bool rg_error(const char *format, ...) __attribute__((format(printf, 1, 2)));
void *rg_error_null(const char *format, ...) __attribute__((format(printf, 1, 2)));
void rg_warning(const char *format, ...) __attribute__((format(printf, 1, 2)));
void rg_info(const char *format, ...) __attribute__((format(printf, 1, 2)));

// An error that is nobody's fault: this device or machine lacks what was asked for. Records have it
// as "unsupported".
bool rg_unsupported(const char *format, ...) __attribute__((format(printf, 1, 2)));
void *rg_unsupported_null(const char *format, ...) __attribute__((format(printf, 1, 2)));

// An error of a driver: it refused or broke what it should have done. No other request of the user
// mends it, so that it is never bad usage.
bool rg_driver_error(const char *format, ...) __attribute__((format(printf, 1, 2)));
void *rg_driver_error_null(const char *format, ...) __attribute__((format(printf, 1, 2)));

// An error of raingauge itself: it lacks memory, a process, a descriptor, or room for a file.
bool rg_harness_error(const char *format, ...) __attribute__((format(printf, 1, 2)));
void *rg_harness_error_null(const char *format, ...) __attribute__((format(printf, 1, 2)));
// An error of a call of the system that set errno to `error`: raingauge's own where that tells of a
// want (rg_is_want), else the user's, who named a file that cannot be had.
bool rg_system_error(int error, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool rg_is_want(int error);

// An error of how this machine is set up: a driver that is there and broken.
bool rg_setup_error(const char *format, ...) __attribute__((format(printf, 1, 2)));

// Errors of a driver whose process has ended, or was ended because it did not come back.
bool rg_crash_error(const char *format, ...) __attribute__((format(printf, 1, 2)));
bool rg_timeout_error(const char *format, ...) __attribute__((format(printf, 1, 2)));

// Whose fault a failure was.
enum rg_fault {
    RG_FAULT_INPUT,   // the user's, bad usage or input: rg_error
    RG_FAULT_HARNESS, // raingauge's own: rg_harness_error
    RG_FAULT_SETUP,   // the machine's: rg_setup_error
    RG_FAULT_DRIVER,  // rg_driver_error, rg_crash_error, rg_timeout_error
    RG_FAULT_NONE,    // nobody's: rg_unsupported
};
enum { RG_FAULTS = RG_FAULT_NONE + 1 };
// "input", "harness", "set-up", "driver", "none": the words of machine forms.
const char *rg_fault_name(enum rg_fault fault);

enum { RG_LINE_SIZE = 1024 };

// A failure, as the function that met it said it.
struct rg_failure {
    enum rg_fault fault;
    enum rg_outcome outcome; // never RG_OK
    char line[RG_LINE_SIZE];
};

// The failure of the function that just returned false or NULL. Whoever catches one takes it once,
// before anything else can fail, and hands it on.
struct rg_failure rg_failure_take(void);

// Logs a line as another process logged it, or would have if it had lived: an error is of this
// fault and outcome. A warning that was logged so before is not logged again, for processes know
// nothing of each other.
void rg_log_relay(enum rg_log_level level, enum rg_fault fault, enum rg_outcome outcome,
                  const char *line);

// Says a failure that was met while lines were held.
void rg_failure_tell(const struct rg_failure *failure);

// The last error's line, "" when there was none. Valid until the next error; records quote it.
const char *rg_last_error(void);

#endif
