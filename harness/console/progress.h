// A progress bar with the time left, on stderr, where that is a terminal; in a pipe what lasts long
// is told in a line now and then. A time is told only where it is likely to be right within three
// times: by what units of this run took, once a tenth of it is behind, and where those that were
// done last took no more than twice as long as all did, or half.
#ifndef RG_HARNESS_CONSOLE_PROGRESS_H
#define RG_HARNESS_CONSOLE_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

struct rg_progress {
    bool shown; // stderr is a terminal
    int64_t total, done;
    double start_ms, drawn_ms;
    // When the units done had doubled last, and the time before that: at least half of all units
    // that are done came behind the first of the two.
    struct rg_progress_mark {
        int64_t done;
        double ms;
    } marks[2];
    struct rg_progress_mark first; // when the first units were done, in which drivers compile
    double told_ms, told_at_ms;    // how long it takes, as was told last, and when; 0: it was not
    bool is_unlike;                // what is left is unlike what is done, so that nothing follows
    double due_ms; // when it ends, as who measures knows; -1: nobody does; 0: nobody said
    char label[64];
};

// Starts a bar over `total` units of similar duration. While it is shown, messages appear above it.
// Only one bar at a time.
void rg_progress_start(struct rg_progress *progress, int64_t total);
// So many units more are to be done, or fewer, than was thought.
void rg_progress_grow(struct rg_progress *progress, int64_t units);
// Sets the text at the bar's right.
void rg_progress_label(struct rg_progress *progress, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// Advances the bar by this many units. Cheap: it draws at most ten times a second.
void rg_progress_add(struct rg_progress *progress, int64_t units);
// Whether what is left is unlike what was done so far: then no time is told.
void rg_progress_unlike(struct rg_progress *progress, bool is_unlike);
// The rest takes so long from now on, by what is left to do, whatever units took; negative: what is
// done says nothing of it.
void rg_progress_due(struct rg_progress *progress, double left_ms);
// How long the rest takes, in milliseconds. 0: that is not known.
double rg_progress_left_ms(const struct rg_progress *progress, double now_ms);
// What a unit that is done took on average, in milliseconds. 0: none is done.
double rg_progress_unit_ms(const struct rg_progress *progress, double now_ms);
// How long has been told otherwise: no bar of this process tells it.
void rg_progress_told(void);
// Hides the bar until the next progress, so that others can print.
void rg_progress_hide(const struct rg_progress *progress);
// Removes the bar.
void rg_progress_end(struct rg_progress *progress);

#endif
