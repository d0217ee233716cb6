// A progress bar with the time left, on stderr when that is a terminal, and nothing in a pipe.
#ifndef RG_HARNESS_PROGRESS_H
#define RG_HARNESS_PROGRESS_H

#include <stdbool.h>

struct rg_progress {
    const char *what;
    int done, total;
    double start_ms, drawn_ms;
    bool visible;
};

void rg_progress_begin(struct rg_progress *progress, const char *what, int total);
// One more of `total` is done.
void rg_progress_step(struct rg_progress *progress);
// Wipes the bar.
void rg_progress_end(struct rg_progress *progress);

#endif
