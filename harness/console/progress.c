#include "harness/console/progress.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/duration.h"

static bool is_told_otherwise;

enum { BAR_COLUMNS = 24, DRAW_EVERY_MS = 100 };

static void wipe(void)
{
    fputs("\r\033[K", stderr);
}

static void draw(struct rg_progress *p)
{
    char bar[BAR_COLUMNS + 1];
    const double part = p->total > 0 ? (double)p->done / (double)p->total : 0;
    const int filled = (int)(part * BAR_COLUMNS);
    memset(bar, '.', BAR_COLUMNS);
    memset(bar, '#', (size_t)(filled > BAR_COLUMNS ? BAR_COLUMNS : filled));
    bar[BAR_COLUMNS] = 0;
    p->drawn_ms = rg_now_ms();
    const double passed_s = (p->drawn_ms - p->start_ms) * 1e-3;
    wipe();
    fprintf(stderr, "[%s] %3d %%", bar, (int)(part * 100));
    // The first moments do not predict the rest, unless a time was expected.
    if (p->expected_unit_ms > 0 || (part > 0.01 && passed_s > 1)) {
        const double left_ms = (double)(p->total - p->done) * rg_progress_unit_ms(p, p->drawn_ms);
        const int left_s = (int)(left_ms * 1e-3 + 0.5);
        fprintf(stderr, "  %d:%02d left", left_s / 60, left_s % 60);
    }
    fprintf(stderr, "  %s", p->label);
    fflush(stderr);
}

// Prints a message over the bar's line, and redraws the bar below it.
static void print_above(enum rg_log_level level, const char *line, void *user)
{
    if (!rg_log_is_news(level, line))
        return;
    wipe();
    fprintf(stderr, "raingauge: %s%s\n", level == RG_LOG_WARNING ? "warning: " : "", line);
    draw(user);
}

static void tell_all(const struct rg_progress *p, double ms)
{
    char text[RG_DURATION_TEXT];
    rg_info("about %s in all%s%s", rg_duration_text(ms / 1e3, text), *p->label ? "; now: " : "",
            p->label);
}

void rg_progress_start_expected(struct rg_progress *p, int64_t total, double unit_ms)
{
    *p = (struct rg_progress){.shown = isatty(STDERR_FILENO),
                              .total = total,
                              .start_ms = rg_now_ms(),
                              .expected_unit_ms = unit_ms};
    if (p->shown) {
        rg_log_listen(print_above, p);
        draw(p);
    } else if ((double)total * unit_ms > rg_long_s() * 1e3) {
        p->told_ms = (double)total * unit_ms;
        tell_all(p, p->told_ms);
    }
}

void rg_progress_start(struct rg_progress *p, int64_t total)
{
    rg_progress_start_expected(p, total, 0);
}

void rg_progress_grow(struct rg_progress *p, int64_t units)
{
    p->total += units;
}

void rg_progress_label(struct rg_progress *p, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(p->label, sizeof(p->label), format, args);
    va_end(args);
    if (p->shown)
        draw(p);
}

double rg_progress_all_ms(const struct rg_progress *p, double now_ms)
{
    const int64_t since = p->done - p->first_done;
    return p->first_ms > 0 && since > 0
               ? p->first_ms - p->start_ms +
                     (now_ms - p->first_ms) / (double)since * (double)(p->total - p->first_done)
               : 0;
}

double rg_progress_unit_ms(const struct rg_progress *p, double now_ms)
{
    const double passed_ms = now_ms - p->start_ms;
    const double prior = p->expected_unit_ms > 0 ? 0.1 * (double)p->total : 0;
    const double units = (double)p->done + prior;
    return units > 0 ? (passed_ms + prior * p->expected_unit_ms) / units : 0;
}

void rg_progress_told(void)
{
    is_told_otherwise = true;
}

bool rg_progress_is_long(const struct rg_progress *p, double now_ms, double long_ms)
{
    return rg_progress_all_ms(p, now_ms) > long_ms && now_ms - p->first_ms >= long_ms / 10;
}

bool rg_progress_is_off(const struct rg_progress *p, double now_ms)
{
    const double all_ms = rg_progress_all_ms(p, now_ms);
    return now_ms - p->start_ms >= 2 * p->told_after_ms &&
           (all_ms > 2 * p->told_ms || 2 * all_ms < p->told_ms);
}

static void tell_if_long(struct rg_progress *p)
{
    const double now_ms = rg_now_ms();
    if (p->first_ms <= 0) {
        p->first_ms = now_ms;
        p->first_done = p->done;
    } else if (p->told_ms > 0 ? rg_progress_is_off(p, now_ms)
                              : rg_progress_is_long(p, now_ms, rg_long_s() * 1e3)) {
        p->told_ms = rg_progress_all_ms(p, now_ms);
        p->told_after_ms = now_ms - p->start_ms;
        tell_all(p, p->told_ms);
    }
}

// With an expected time, tells the time left at every tenth.
static void tell_left(struct rg_progress *p)
{
    char text[RG_DURATION_TEXT];
    const int tenths = p->total > 0 ? (int)(10 * p->done / p->total) : 10;
    if (p->told_ms <= 0 || tenths <= p->told_tenths || tenths > 9)
        return;
    p->told_tenths = tenths;
    const double left_ms = (double)(p->total - p->done) * rg_progress_unit_ms(p, rg_now_ms());
    rg_info("about %s left%s%s", rg_duration_text(left_ms / 1e3, text), *p->label ? "; now: " : "",
            p->label);
}

void rg_progress_add(struct rg_progress *p, int64_t units)
{
    p->done += units;
    if (!p->shown && p->expected_unit_ms > 0)
        tell_left(p);
    else if (!p->shown && !is_told_otherwise)
        tell_if_long(p);
    if (p->shown && rg_now_ms() - p->drawn_ms > DRAW_EVERY_MS)
        draw(p);
}

void rg_progress_hide(const struct rg_progress *p)
{
    if (!p->shown)
        return;
    wipe();
    fflush(stderr);
}

void rg_progress_end(struct rg_progress *p)
{
    if (!p->shown)
        return;
    wipe();
    fflush(stderr);
    rg_log_listen(NULL, NULL);
    p->shown = false;
}
