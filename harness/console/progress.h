// A progress bar with the time left, on stderr, where that is a terminal. In a pipe what lasts long
// is told in one line, once the first units show how long, and again where that was off by more
// than half; where what units take was expected beforehand, it is told at once, and with every
// tenth how long the rest takes.
#ifndef RG_HARNESS_CONSOLE_PROGRESS_H
#define RG_HARNESS_CONSOLE_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

struct rg_progress {
    bool shown; // stderr is a terminal
    int64_t total, done;
    double start_ms, drawn_ms;
    double first_ms;         // when the first units were done; 0: they are not
    int64_t first_done;      // how many they were
    double told_ms;          // how long all of it takes, as was told last; 0: it was not
    double told_after_ms;    // when that was, from the start
    double expected_unit_ms; // what a unit was to take; 0: nobody knows
    int told_tenths;
    char label[64];
};

// Starts a bar over `total` units of work of like length. While one is shown, messages go to the
// line above it. One bar at a time.
void rg_progress_start(struct rg_progress *progress, int64_t total);
// The same over units of which one is expected to take so long.
void rg_progress_start_expected(struct rg_progress *progress, int64_t total, double unit_ms);
// So many units more are to be done, or fewer, than was thought.
void rg_progress_grow(struct rg_progress *progress, int64_t units);
// What is being done, at the bar's right.
void rg_progress_label(struct rg_progress *progress, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// So many units more are done. Cheap: it draws ten times a second at most.
void rg_progress_add(struct rg_progress *progress, int64_t units);
// How long all of it takes, in milliseconds, as far as is known: the first units are slower than
// the others, for drivers compile in them. 0: it is not known yet.
double rg_progress_all_ms(const struct rg_progress *progress, double now_ms);
// What a unit takes, in milliseconds, by those that are done, and by what was expected, which
// counts as much as a tenth of all. 0: nothing is known.
double rg_progress_unit_ms(const struct rg_progress *progress, double now_ms);
// Whether all of it takes longer than `long_ms`, and a tenth of `long_ms` shows it.
bool rg_progress_is_long(const struct rg_progress *progress, double now_ms, double long_ms);
// Whether it takes more than twice as long as was told, or less than half, which is worth a line
// where twice the time has passed since the start.
bool rg_progress_is_off(const struct rg_progress *progress, double now_ms);
// How long has been told otherwise: no bar of this process tells it.
void rg_progress_told(void);
// Wipes the bar away until more is done, for others to print.
void rg_progress_hide(const struct rg_progress *progress);
// Wipes the bar away.
void rg_progress_end(struct rg_progress *progress);

#endif
