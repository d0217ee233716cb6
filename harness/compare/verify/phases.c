// How long the rest of a verification takes.
#include "harness/compare/verify/verify.h"
#include "harness/console/clock.h"

void rg_verify_begin(const struct rg_verify *v, int64_t units)
{
    if (!v->phase)
        return;
    *v->phase = (struct rg_verify_phase){.left = units, .bar = v->progress->done};
    rg_progress_due(v->progress, -1);
}

// The time left follows from the phase's cases but the first. It is not told if the latest case is
// unlike the others, or if more than a third of what is left belongs to later phases.
void rg_verify_advance(const struct rg_verify *v, int64_t units)
{
    struct rg_verify_phase *phase = v->phase;
    if (!phase || units <= 0)
        return;
    // Devices that failed took fewer steps, which the bar counts all the same.
    const int64_t missing = units - (v->progress->done - phase->bar);
    if (missing > 0)
        rg_progress_add(v->progress, missing);
    phase->bar = v->progress->done;
    const double now_ms = rg_now_ms();
    double left_ms = -1;
    phase->left -= units;
    if (phase->first_ms > 0) {
        phase->done += units;
        const double pace = (now_ms - phase->first_ms) / (double)phase->done,
                     latest = (now_ms - phase->last_ms) / (double)units;
        const int64_t all = v->progress->total - v->progress->done;
        if (latest <= 2 * pace && pace <= 2 * latest && 2 * all <= 3 * phase->left)
            left_ms = pace * (double)all;
    } else {
        phase->first_ms = now_ms;
    }
    phase->last_ms = now_ms;
    rg_progress_due(v->progress, left_ms);
}
