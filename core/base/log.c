#include "core/base/log.h"
#include "core/base/text/place.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "core/base/text/plain.h"

enum { LINE_SIZE = 1024, MOST_TOLD = 256 };

static rg_log_fn listener;
static void *listener_user;
static bool is_held;
static char last_error[LINE_SIZE];
static enum rg_error_kind last_kind;
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
    return last_error;
}

enum rg_error_kind rg_last_error_kind(void)
{
    return last_kind;
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
    char line[LINE_SIZE] = "";
    if (error_place && level == RG_LOG_ERROR)
        snprintf(line, sizeof(line) / 2, "%s: ", error_place);
    const size_t used = strlen(line);
    vsnprintf(line + used, sizeof(line) - used, format, args);
    rg_plain(line);
    if (level == RG_LOG_ERROR)
        memcpy(last_error, line, sizeof(line));
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

#define ERROR(kind, result)                                                                        \
    LOG(RG_LOG_ERROR);                                                                             \
    last_kind = kind;                                                                              \
    return result

bool rg_error(const char *format, ...)
{
    ERROR(RG_ERROR_INPUT, false);
}

void *rg_error_null(const char *format, ...)
{
    ERROR(RG_ERROR_INPUT, NULL);
}

bool rg_unsupported(const char *format, ...)
{
    ERROR(RG_ERROR_UNSUPPORTED, false);
}

void *rg_unsupported_null(const char *format, ...)
{
    ERROR(RG_ERROR_UNSUPPORTED, NULL);
}

bool rg_driver_error(const char *format, ...)
{
    ERROR(RG_ERROR_DRIVER, false);
}

void *rg_driver_error_null(const char *format, ...)
{
    ERROR(RG_ERROR_DRIVER, NULL);
}

bool rg_crash_error(const char *format, ...)
{
    ERROR(RG_ERROR_CRASH, false);
}

bool rg_timeout_error(const char *format, ...)
{
    ERROR(RG_ERROR_TIMEOUT, false);
}

static void log_text(enum rg_log_level level, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static void log_text(enum rg_log_level level, const char *format, ...)
{
    LOG(level);
}

void rg_log_relay(enum rg_log_level level, enum rg_error_kind kind, const char *line)
{
    log_text(level, "%s", line);
    if (level == RG_LOG_ERROR)
        last_kind = kind;
}

void rg_warning(const char *format, ...)
{
    LOG(RG_LOG_WARNING);
}

void rg_info(const char *format, ...)
{
    LOG(RG_LOG_INFO);
}
