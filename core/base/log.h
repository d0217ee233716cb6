// What raingauge tells people: one line a message, to stderr, and to whoever listens.
//
// Every function that can fail returns false or NULL and has logged one line that says what failed,
// where, and how to mend it. Nothing else prints to stderr but the progress bar.
#ifndef RG_CORE_BASE_LOG_H
#define RG_CORE_BASE_LOG_H

#include <stdbool.h>

enum rg_log_level { RG_LOG_ERROR, RG_LOG_WARNING, RG_LOG_INFO };

// Receives each line, without a newline. `user` is what rg_log_listen was given.
typedef void (*rg_log_fn)(enum rg_log_level level, const char *line, void *user);

// Sends lines to `fn` instead of stderr; NULL restores stderr. Not thread-safe: call it at start.
void rg_log_listen(rg_log_fn fn, void *user);

// Logs one line, "raingauge: ..." on stderr. rg_error returns false and rg_error_null returns NULL,
// so that a failing function ends in `return rg_error("...")`. Line breaks inside become spaces.
bool rg_error(const char *format, ...) __attribute__((format(printf, 1, 2)));
void *rg_error_null(const char *format, ...) __attribute__((format(printf, 1, 2)));
void rg_warning(const char *format, ...) __attribute__((format(printf, 1, 2)));
void rg_info(const char *format, ...) __attribute__((format(printf, 1, 2)));

// An error that is nobody's fault: this device or machine lacks what was asked for. Tables show it
// as "unsupported".
bool rg_unsupported(const char *format, ...) __attribute__((format(printf, 1, 2)));
void *rg_unsupported_null(const char *format, ...) __attribute__((format(printf, 1, 2)));
// Whether the last error was one of those.
bool rg_is_unsupported(void);

// The last error's line, "" when there was none. Valid until the next error; records quote it.
const char *rg_last_error(void);

#endif
