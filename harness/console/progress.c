#include "harness/console/progress.h"

#include <math.h>
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
    wipe();
    fprintf(stderr, "[%s] %3d %%", bar, (int)(part * 100));
    const int left_s = (int)(rg_progress_left_ms(p, p->drawn_ms) * 1e-3 + 0.5);
    if (left_s)
        fprintf(stderr, "  %d:%02d left", left_s / 60, left_s % 60);
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

void rg_progress_start(struct rg_progress *p, int64_t total)
{
    *p = (struct rg_progress){
        .shown = isatty(STDERR_FILENO), .total = total, .start_ms = rg_now_ms()};
    p->marks[0].ms = p->marks[1].ms = p->start_ms;
    if (!p->shown)
        return;
    rg_log_listen(print_above, p);
    draw(p);
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

void rg_progress_unlike(struct rg_progress *p, bool is_unlike)
{
    p->is_unlike = is_unlike;
}

double rg_progress_unit_ms(const struct rg_progress *p, double now_ms)
{
    return p->done > 0 ? (now_ms - p->start_ms) / (double)p->done : 0;
}

void rg_progress_due(struct rg_progress *p, double left_ms)
{
    p->due_ms = left_ms < 0 ? -1 : rg_now_ms() + left_ms;
}

// Whether a tenth of the time has passed.
static bool is_well_begun(const struct rg_progress *p, double now_ms, double left_ms)
{
    return 10 * (now_ms - p->start_ms) >= now_ms - p->start_ms + left_ms;
}

// Estimates from the units done: from all but the first ones, and from the latest ones. 0 if one
// estimate is more than twice the other.
static double left_by_units_ms(const struct rg_progress *p, double now_ms)
{
    const struct rg_progress_mark *mark = &p->marks[0];
    const double left = (double)(p->total - p->done);
    if (!mark->done || p->done <= mark->done || p->done <= p->first.done)
        return 0;
    const double by_all_ms = left * (now_ms - p->first.ms) / (double)(p->done - p->first.done);
    const double by_last_ms = left * (now_ms - mark->ms) / (double)(p->done - mark->done);
    const double low_ms = fmin(by_all_ms, by_last_ms), high_ms = fmax(by_all_ms, by_last_ms);
    return high_ms <= 2 * low_ms && is_well_begun(p, now_ms, high_ms) ? sqrt(low_ms * high_ms) : 0;
}

double rg_progress_left_ms(const struct rg_progress *p, double now_ms)
{
    const double left_ms = fmax(p->due_ms - now_ms, 0);
    if (p->is_unlike || p->due_ms < 0)
        return 0;
    if (!(p->due_ms > 0))
        return left_by_units_ms(p, now_ms);
    return is_well_begun(p, now_ms, left_ms) ? left_ms : 0;
}

void rg_progress_told(void)
{
    is_told_otherwise = true;
}

// Logs the total time once, if it is long. Then logs the time left after every tenth of the total,
// but not within rg_long_s() of the last line.
static void tell(struct rg_progress *p, double now_ms)
{
    char text[RG_DURATION_TEXT];
    const double long_ms = rg_long_s() * 1e3, left_ms = rg_progress_left_ms(p, now_ms);
    const double all_ms = now_ms - p->start_ms + left_ms;
    if (!(left_ms > 0) || all_ms <= long_ms ||
        (p->told_ms > 0 && now_ms - p->told_at_ms < fmax(long_ms, all_ms / 10)))
        return;
    rg_info("about %s %s%s%s", rg_duration_text((p->told_ms > 0 ? left_ms : all_ms) / 1e3, text),
            p->told_ms > 0 ? "left" : "in all", *p->label ? "; now: " : "", p->label);
    p->told_ms = all_ms;
    p->told_at_ms = now_ms;
}

void rg_progress_add(struct rg_progress *p, int64_t units)
{
    const double now_ms = rg_now_ms();
    p->done += units;
    if (!p->marks[1].done)
        p->first = (struct rg_progress_mark){p->done, now_ms};
    if (p->done > 0 && p->done >= 2 * p->marks[1].done) {
        p->marks[0] = p->marks[1];
        p->marks[1] = (struct rg_progress_mark){p->done, now_ms};
    }
    if (!p->shown && !is_told_otherwise)
        tell(p, now_ms);
    if (p->shown && now_ms - p->drawn_ms > DRAW_EVERY_MS)
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
