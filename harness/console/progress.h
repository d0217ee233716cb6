// A progress bar with the time left, on a terminal's stderr; in a pipe, a line now and then if the
// work takes long.
//
// A time is shown only if it is probably right within a factor of three. It follows from this run's
// units, once a tenth of the time has passed, if the latest units took between half of and twice
// the average.
#ifndef RG_HARNESS_CONSOLE_PROGRESS_H
#define RG_HARNESS_CONSOLE_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

struct rg_progress {
    bool shown; // stderr is a terminal
    int64_t total, done;
    double start_ms, drawn_ms;
    // Times at which the number of units done had doubled, the last and the one before. At least
    // half of the units done came after the first of them.
    struct rg_progress_mark {
        int64_t done;
        double ms;
    } marks[2];
    struct rg_progress_mark first; // when the first units were done, during which drivers compile
    double told_ms, told_at_ms;    // total time reported last, and when; 0: none
    bool is_unlike;                // the rest is unlike the work so far, so no time follows from it
    double due_ms; // when it ends, as set by rg_progress_due; -1: not known; 0: not set
    char label[64];
};

// Starts a bar over `total` units of similar duration. While it is shown, messages appear above it.
// Only one bar at a time.
void rg_progress_start(struct rg_progress *progress, int64_t total);
// Changes the total by this many units, which may be negative.
void rg_progress_grow(struct rg_progress *progress, int64_t units);
// Sets the text to the right of the bar.
void rg_progress_label(struct rg_progress *progress, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// Advances the bar by this many units. Cheap: it draws at most ten times a second.
void rg_progress_add(struct rg_progress *progress, int64_t units);
// Tells whether the rest is unlike the work so far; then no time is shown.
void rg_progress_unlike(struct rg_progress *progress, bool is_unlike);
// Sets how long the rest takes, regardless of the units; negative: the work so far does not tell.
void rg_progress_due(struct rg_progress *progress, double left_ms);
// The time left in milliseconds. 0: not known.
double rg_progress_left_ms(const struct rg_progress *progress, double now_ms);
// The average time of a finished unit in milliseconds. 0: none is finished.
double rg_progress_unit_ms(const struct rg_progress *progress, double now_ms);
// Says that the time is reported elsewhere; bars of this process then do not log it.
void rg_progress_told(void);
// Hides the bar until the next progress, so that others can print.
void rg_progress_hide(const struct rg_progress *progress);
// Removes the bar.
void rg_progress_end(struct rg_progress *progress);

#endif
