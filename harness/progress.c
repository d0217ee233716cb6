#include "harness/progress.h"

#include <stdio.h>
#include <unistd.h>

#include "harness/measure.h"

enum { BAR_WIDTH = 30, REDRAW_MS = 100 };

static void draw(struct rg_progress *p)
{
    const double elapsed_ms = rg_now_ms() - p->start_ms;
    const double left_s = p->done ? elapsed_ms * (p->total - p->done) / p->done / 1000 : 0;
    const int filled = p->total ? BAR_WIDTH * p->done / p->total : 0;
    static const char bar[] = "##############################";
    fprintf(stderr, "\r%s [%-*.*s] %d/%d", p->what, BAR_WIDTH, filled, bar, p->done, p->total);
    if (p->done)
        fprintf(stderr, ", %.0f s left  ", left_s);
    fflush(stderr);
}

void rg_progress_begin(struct rg_progress *p, const char *what, int total)
{
    *p = (struct rg_progress){.what = what, .total = total, .start_ms = rg_now_ms()};
    p->visible = isatty(STDERR_FILENO);
    if (p->visible)
        draw(p);
}

void rg_progress_step(struct rg_progress *p)
{
    p->done++;
    if (!p->visible || rg_now_ms() - p->drawn_ms < REDRAW_MS)
        return;
    p->drawn_ms = rg_now_ms();
    draw(p);
}

void rg_progress_end(struct rg_progress *p)
{
    if (p->visible)
        fprintf(stderr, "\r\033[K");
}
