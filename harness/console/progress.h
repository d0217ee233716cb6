// A progress bar with the time left, on stderr, where that is a terminal; nothing in a pipe.
#ifndef RG_HARNESS_CONSOLE_PROGRESS_H
#define RG_HARNESS_CONSOLE_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

struct rg_progress {
    bool shown; // stderr is a terminal
    int64_t total, done;
    double start_ms, drawn_ms;
    char label[64];
};

// Starts a bar over `total` units of work of like length. While one is shown, messages go to the
// line above it. One bar at a time.
void rg_progress_start(struct rg_progress *progress, int64_t total);
// What is being done, at the bar's right.
void rg_progress_label(struct rg_progress *progress, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// So many units more are done. Cheap: it draws ten times a second at most.
void rg_progress_add(struct rg_progress *progress, int64_t units);
// Wipes the bar away.
void rg_progress_end(struct rg_progress *progress);

#endif
