#include "core/base/log.h"
#include "core/base/text/place.h"

#include <errno.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "core/base/text/plain.h"

enum { MOST_TOLD = 256 };

static rg_log_fn listener;
static void *listener_user;
static bool is_held;
static struct rg_failure last;
static const char *error_place;

void rg_log_listen(rg_log_fn fn, void *user)
{
    listener = fn;
    listener_user = user;
}

void rg_log_hold(bool holds)
{
    is_held = holds;
}

void rg_log_place(const char *place)
{
    error_place = place;
}

const char *rg_last_error(void)
{
    return last.line;
}

const char *rg_fault_name(enum rg_fault fault)
{
    static const char *const names[RG_FAULTS] = {
        [RG_FAULT_NONE] = "none",    [RG_FAULT_INPUT] = "input",   [RG_FAULT_HARNESS] = "harness",
        [RG_FAULT_SETUP] = "set-up", [RG_FAULT_DRIVER] = "driver",
    };
    return names[fault];
}

// A failure without a logged error is a lack of memory: none was left for the message.
struct rg_failure rg_failure_take(void)
{
    struct rg_failure now = last;
    if (now.outcome == RG_OK) {
        now.fault = RG_FAULT_HARNESS;
        now.outcome = RG_LACKING;
    }
    return now;
}

bool rg_is_want(int error)
{
    static const int wants[] = {ENOMEM, EMFILE, ENFILE,  EAGAIN, ENOSPC,
                                EDQUOT, EFBIG,  ENOBUFS, EIO};
    for (size_t i = 0; i < sizeof(wants) / sizeof(wants[0]); i++)
        if (error == wants[i])
            return true;
    return false;
}

bool rg_log_is_news(enum rg_log_level level, const char *line)
{
    static uint64_t told[MOST_TOLD];
    static int count;
    uint64_t hash = UINT64_C(0xcbf29ce484222325); // FNV-1a
    for (const unsigned char *c = (const unsigned char *)line; *c; c++)
        hash = (hash ^ *c) * UINT64_C(0x100000001b3);
    for (int i = 0; i < count; i++)
        if (told[i] == hash)
            return level == RG_LOG_INFO;
    if (count < MOST_TOLD)
        told[count++] = hash;
    return true;
}

static void log_line(enum rg_log_level level, const char *format, va_list args)
{
    char line[RG_LINE_SIZE] = "";
    if (error_place && level == RG_LOG_ERROR)
        snprintf(line, sizeof(line) / 2, "%s: ", error_place);
    const size_t used = strlen(line);
    vsnprintf(line + used, sizeof(line) - used, format, args);
    rg_plain(line);
    if (level == RG_LOG_ERROR)
        memcpy(last.line, line, sizeof(line));
    if (is_held)
        return;
    if (listener)
        listener(level, line, listener_user);
    else if (rg_log_is_news(level, line))
        fprintf(stderr, "raingauge: %s%s\n", level == RG_LOG_WARNING ? "warning: " : "", line);
}

#define LOG(level)                                                                                 \
    va_list args;                                                                                  \
    va_start(args, format);                                                                        \
    log_line(level, format, args);                                                                 \
    va_end(args)

#define ERROR(of, as, result)                                                                      \
    LOG(RG_LOG_ERROR);                                                                             \
    last.fault = of;                                                                               \
    last.outcome = as;                                                                             \
    return result

bool rg_error(const char *format, ...)
{
    ERROR(RG_FAULT_INPUT, RG_ERROR, false);
}

void *rg_error_null(const char *format, ...)
{
    ERROR(RG_FAULT_INPUT, RG_ERROR, NULL);
}

bool rg_unsupported(const char *format, ...)
{
    ERROR(RG_FAULT_NONE, RG_UNSUPPORTED, false);
}

void *rg_unsupported_null(const char *format, ...)
{
    ERROR(RG_FAULT_NONE, RG_UNSUPPORTED, NULL);
}

bool rg_driver_error(const char *format, ...)
{
    ERROR(RG_FAULT_DRIVER, RG_ERROR, false);
}

void *rg_driver_error_null(const char *format, ...)
{
    ERROR(RG_FAULT_DRIVER, RG_ERROR, NULL);
}

bool rg_harness_error(const char *format, ...)
{
    ERROR(RG_FAULT_HARNESS, RG_LACKING, false);
}

void *rg_harness_error_null(const char *format, ...)
{
    ERROR(RG_FAULT_HARNESS, RG_LACKING, NULL);
}

bool rg_system_error(int error, const char *format, ...)
{
    const bool is_want = rg_is_want(error);
    ERROR(is_want ? RG_FAULT_HARNESS : RG_FAULT_INPUT, is_want ? RG_LACKING : RG_ERROR, false);
}

bool rg_setup_error(const char *format, ...)
{
    ERROR(RG_FAULT_SETUP, RG_SETUP, false);
}

bool rg_crash_error(const char *format, ...)
{
    ERROR(RG_FAULT_DRIVER, RG_CRASH, false);
}

bool rg_timeout_error(const char *format, ...)
{
    ERROR(RG_FAULT_DRIVER, RG_TIMEOUT, false);
}

static void log_text(enum rg_log_level level, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static void log_text(enum rg_log_level level, const char *format, ...)
{
    LOG(level);
}

void rg_log_relay(enum rg_log_level level, enum rg_fault fault, enum rg_outcome outcome,
                  const char *line)
{
    log_text(level, "%s", line);
    if (level != RG_LOG_ERROR)
        return;
    last.fault = fault;
    last.outcome = outcome;
}

void rg_failure_tell(const struct rg_failure *failure)
{
    rg_log_relay(RG_LOG_ERROR, failure->fault, failure->outcome, failure->line);
}

void rg_warning(const char *format, ...)
{
    LOG(RG_LOG_WARNING);
}

void rg_info(const char *format, ...)
{
    LOG(RG_LOG_INFO);
}
