// A progress bar with the time left, on stderr if it is a terminal. Otherwise, long work is told in
// one line, after the first units show its duration, and again if that was off by more than half.
// With an expected time it is told at once, and the time left at every tenth.
#ifndef RG_HARNESS_CONSOLE_PROGRESS_H
#define RG_HARNESS_CONSOLE_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

struct rg_progress {
    bool shown; // stderr is a terminal
    int64_t total, done;
    double start_ms, drawn_ms;
    double first_ms;         // when the first units were done; 0: not yet
    int64_t first_done;      // their number
    double told_ms;          // total time last told; 0: none
    double told_after_ms;    // when it was told, since the start
    double expected_unit_ms; // expected time of a unit; 0: unknown
    int told_tenths;
    char label[64];
};

// Starts a bar over `total` units of similar duration. While it is shown, messages appear above it.
// Only one bar at a time.
void rg_progress_start(struct rg_progress *progress, int64_t total);
// The same with an expected time of a unit.
void rg_progress_start_expected(struct rg_progress *progress, int64_t total, double unit_ms);
// Changes the number of units by this many.
void rg_progress_grow(struct rg_progress *progress, int64_t units);
// Sets the text at the bar's right.
void rg_progress_label(struct rg_progress *progress, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// Advances the bar by this many units. Cheap: it draws at most ten times a second.
void rg_progress_add(struct rg_progress *progress, int64_t units);
// The total time in milliseconds, as far as known. The first units are slower than the others,
// because drivers compile in them. 0: unknown yet.
double rg_progress_all_ms(const struct rg_progress *progress, double now_ms);
// The time of a unit in milliseconds, from finished units and the expected time, which weighs as
// much as a tenth of all. 0: unknown.
double rg_progress_unit_ms(const struct rg_progress *progress, double now_ms);
// Whether the total exceeds `long_ms`, judged after a tenth of `long_ms`.
bool rg_progress_is_long(const struct rg_progress *progress, double now_ms, double long_ms);
// Whether the total is more than twice or less than half of what was told, and a correction is due:
// twice the time has passed since.
bool rg_progress_is_off(const struct rg_progress *progress, double now_ms);
// The duration has been told elsewhere, so that no bar of this process tells it.
void rg_progress_told(void);
// Hides the bar until the next progress, so that others can print.
void rg_progress_hide(const struct rg_progress *progress);
// Removes the bar.
void rg_progress_end(struct rg_progress *progress);

#endif
