#include "harness/tables/runs/cell.h"

#include <math.h>

#include "core/image/compare/compare.h"
#include "harness/console/clock.h"
#include "harness/measure/expected.h"
#include "harness/measure/sampling.h"

int rg_budget_check_frames(const struct rg_table *table)
{
    return table->check_frames ? table->check_frames : RG_CHECK_FRAMES;
}

// Frames of a window of which no more are left: its instance is opened anew.
static double reopen_ms(const struct rg_table *table, double open_ms, double frame_ms,
                        double frames)
{
    if (!table->window_frames)
        return 0;
    return floor(frames / table->window_frames) *
           (open_ms + rg_budget_check_frames(table) * frame_ms);
}

double rg_budget_cell_ms(const struct rg_table *table, double open_ms, double frame_ms,
                         const struct rg_measure_options *o)
{
    const double ms = fmax(frame_ms, 1e-3);
    const struct rg_sampling sampling = rg_sampling_of(ms, table->window_frames, o);
    const double warm_up = fmax(4, fmin(20, o->warm_up_ms / ms) / 2);
    const double calibration = ms < o->sample_ms ? 4 : 0;
    const double frames = 1 + warm_up + calibration + rg_sampling_ms(&sampling, ms) / ms;
    return open_ms + (rg_budget_check_frames(table) + frames) * ms +
           reopen_ms(table, open_ms, ms, frames);
}

double rg_budget_compare_ms(void)
{
    enum { SIDE = 128 };
    struct rg_picture a = {0}, b = {0}, dry = {0};
    struct rg_comparison comparison = {0};
    double ms = 0;
    if (rg_picture_create(&a, SIDE, SIDE, 4, "probe") &&
        rg_picture_create(&b, SIDE, SIDE, 4, "probe") &&
        rg_picture_create(&dry, SIDE, SIDE, 4, "probe")) {
        for (int i = 0; i < SIDE * SIDE * 4; i++) {
            a.texels[i] = (float)(i % 7) / 7;
            b.texels[i] = (float)(i % 5) / 5;
            dry.texels[i] = 0;
        }
        const double start = rg_now_ms();
        rg_compare(&a, "a", &b, "b", &dry, &(struct rg_compare_options){0}, &comparison);
        ms = (rg_now_ms() - start) / (SIDE * SIDE);
    }
    rg_comparison_destroy(&comparison);
    rg_picture_destroy(&a);
    rg_picture_destroy(&b);
    rg_picture_destroy(&dry);
    return ms;
}
