// Messages for people: one line each, to stderr or to a listener.
//
// Every function that can fail returns false or NULL after it has logged one line, which says what
// failed, where, and how to mend it. Only the progress bar also prints to stderr.
#ifndef RG_CORE_BASE_LOG_H
#define RG_CORE_BASE_LOG_H

#include <stdbool.h>

#include "core/base/outcome.h"

enum rg_log_level { RG_LOG_ERROR, RG_LOG_WARNING, RG_LOG_INFO };
enum { RG_LOG_LEVELS = RG_LOG_INFO + 1 };

// Receives each line, without a newline. `user` is rg_log_listen's.
typedef void (*rg_log_fn)(enum rg_log_level level, const char *line, void *user);

// Sends lines to `fn` instead of stderr; NULL restores stderr. Not thread-safe: call it at start.
void rg_log_listen(rg_log_fn fn, void *user);

// Whether a line should be printed: errors and warnings only once, however many devices or cells
// meet their cause. It counts as printed then. A listener hears every line, and asks this before it
// prints one.
bool rg_log_is_news(enum rg_log_level level, const char *line);

// Drops lines while `holds`. The caller expects failures meanwhile, and reports them itself; the
// last error is still kept.
void rg_log_hold(bool holds);

// Log one line, "raingauge: ..." on stderr. An error or a warning that was printed before is not
// printed again, since several devices, cells and processes may meet the same cause. rg_error
// returns false and rg_error_null NULL, so a function can fail with `return rg_error("...")`.
// Control characters become plain text (core/base/text/plain.h). These two are for errors that
// other usage or input mends; the other kinds of errors have functions below.
bool rg_error(const char *format, ...) __attribute__((format(printf, 1, 2)));
void *rg_error_null(const char *format, ...) __attribute__((format(printf, 1, 2)));
void rg_warning(const char *format, ...) __attribute__((format(printf, 1, 2)));
void rg_info(const char *format, ...) __attribute__((format(printf, 1, 2)));

// An error that is nobody's fault: this device or machine lacks a requested feature. Records call
// it "unsupported".
bool rg_unsupported(const char *format, ...) __attribute__((format(printf, 1, 2)));
void *rg_unsupported_null(const char *format, ...) __attribute__((format(printf, 1, 2)));

// An error of a driver, which refused or failed to do its work. The user cannot avoid it by another
// request, so it is never bad usage.
bool rg_driver_error(const char *format, ...) __attribute__((format(printf, 1, 2)));
void *rg_driver_error_null(const char *format, ...) __attribute__((format(printf, 1, 2)));

// An error of raingauge itself: it lacks memory, a process, a descriptor, or disk space.
bool rg_harness_error(const char *format, ...) __attribute__((format(printf, 1, 2)));
void *rg_harness_error_null(const char *format, ...) __attribute__((format(printf, 1, 2)));
// An error of a system call that set errno to `error`. It is raingauge's own if a resource was
// lacking (rg_is_want), else the user's, whose file cannot be used.
bool rg_system_error(int error, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool rg_is_want(int error);

// An error in this machine's set-up: a driver that is installed but broken.
bool rg_setup_error(const char *format, ...) __attribute__((format(printf, 1, 2)));

// Errors of a driver whose process crashed, or was ended because it did not return.
bool rg_crash_error(const char *format, ...) __attribute__((format(printf, 1, 2)));
bool rg_timeout_error(const char *format, ...) __attribute__((format(printf, 1, 2)));

// The party at fault in a failure.
enum rg_fault {
    RG_FAULT_INPUT,   // the user's, bad usage or input: rg_error
    RG_FAULT_HARNESS, // raingauge's own: rg_harness_error
    RG_FAULT_SETUP,   // the machine's: rg_setup_error
    RG_FAULT_DRIVER,  // rg_driver_error, rg_crash_error, rg_timeout_error
    RG_FAULT_NONE,    // nobody's: rg_unsupported
};
enum { RG_FAULTS = RG_FAULT_NONE + 1 };
// "input", "harness", "set-up", "driver", "none": the words in machine forms.
const char *rg_fault_name(enum rg_fault fault);

enum { RG_LINE_SIZE = 1024 };

// A failure as its function reported it.
struct rg_failure {
    enum rg_fault fault;
    enum rg_outcome outcome; // never RG_OK
    char line[RG_LINE_SIZE];
};

// The failure of the function that just returned false or NULL. Take it once, before anything else
// can fail, and pass it on.
struct rg_failure rg_failure_take(void);

// Logs a line of another process, or one on its behalf after it died. An error gets this fault and
// outcome. A warning that was relayed before is not logged again, because processes do not know
// each other's warnings.
void rg_log_relay(enum rg_log_level level, enum rg_fault fault, enum rg_outcome outcome,
                  const char *line);

// Logs a failure that was taken while lines were held.
void rg_failure_tell(const struct rg_failure *failure);

// The last error's line; "" if there was none. Valid until the next error; records quote it.
const char *rg_last_error(void);

// --- a check that refuses a call in one line ---

// Unless `check` holds, these make the enclosing function return false or NULL, after one logged
// line, which should name object and number.
#define require(check, ...)                                                                        \
    do {                                                                                           \
        if (!(check))                                                                              \
            return rg_error(__VA_ARGS__);                                                          \
    } while (0)
#define require_or_null(check, ...)                                                                \
    do {                                                                                           \
        if (!(check))                                                                              \
            return rg_error_null(__VA_ARGS__);                                                     \
    } while (0)

#endif
