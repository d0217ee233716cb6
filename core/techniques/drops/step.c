// A step of drops (figure 1): running drops shed others and move, touching drops merge, resting
// drops are put back on the pane, water flattens and thins, and new drops land.
#include <float.h>
#include <math.h>

#include "core/techniques/drops/instance.h"
#include "kernels/dialect/rng.h"
#include "kernels/drops/sets/hot.h"

static bool run(struct drops *d, enum drops_stage stage, int width, int height)
{
    if (width <= 0)
        return true;
    return rg_stage_over(&d->base, stage, (struct rg_extent){0, 0, 0},
                         (struct rg_extent){width, height, 1});
}

// Items of stages over cells: kernels/drops/tiles/tiles.h.
static bool run_rows(struct drops *d, enum drops_stage stage)
{
    return run(d, stage, d->params.tile_columns, d->params.tile_rows * DROPS_TILE_ROWS);
}

static bool move(struct drops *d)
{
    bool ok = true;
    for (int i = 0; ok && i < d->params.substeps; i++) {
        d->params.substep = i;
        ok = run(d, DROPS_RUN_RUN, d->params.count, 1) &&
             run(d, DROPS_RUN_TRAIL, d->params.count, DROPS_ROWS_A_DROP);
    }
    return ok && run(d, DROPS_RUN_CLAIM, d->params.count, DROPS_ROWS_A_DROP);
}

// Turns drops whose water has merged into new ones.
static bool join(struct drops *d)
{
    const int count = d->params.count;
    d->base.counters[DROPS_MERGING].value++;
    d->params.has_joined = 1;
    d->params.slots = 3 * count;
    return run(d, DROPS_RUN_PART, count, 1) && run_rows(d, DROPS_RUN_LABEL) &&
           run_rows(d, DROPS_RUN_LINK) && run_rows(d, DROPS_RUN_SIDE) &&
           run(d, DROPS_RUN_LEAD, count, 1) && run(d, DROPS_RUN_GATHER, count, 1) &&
           run(d, DROPS_RUN_LOWEST, count, 1) && run(d, DROPS_RUN_MERGE, count, 1);
}

// Labels water on the whole pane, unless nothing can merge, as in many steps.
static bool merge(struct drops *d)
{
    uint32_t meets = 0;
    d->params.has_joined = 0;
    d->params.slots = 2 * d->params.count;
    if (!d->settings.merge)
        return true;
    return run_rows(d, DROPS_RUN_MEET) &&
           rg_buf_read(d->tally->buf, DROPS_MEETS * sizeof(meets), &meets, sizeof(meets)) &&
           (!meets || join(d));
}

// Compacts the list of surviving drops, and appends new ones.
static bool close_ranks(struct drops *d)
{
    drops_params *p = &d->params;
    if (!run(d, DROPS_RUN_SETTLE, p->slots, 1) ||
        !rg_scan_sum(d->scan, d->flags->buf, d->before->buf, p->slots) ||
        !run(d, DROPS_RUN_PACK, p->slots + p->arrivals, 1))
        return false;
    if (p->has_joined &&
        !(run_rows(d, DROPS_RUN_RECOLOUR) &&
          run(d, DROPS_RUN_DISBAND, p->count > DROPS_HOT_WORDS ? p->count : DROPS_HOT_WORDS, 1)))
        return false;
    rg_swap(d->drops, d->packed);
    return run(d, DROPS_RUN_COUNT, 1, 1);
}

static bool put_at_rest(struct drops *d)
{
    const int most = d->settings.max_drops, may_be = d->params.slots + d->params.arrivals;
    const int slots = may_be < most ? may_be : most;
    return run_rows(d, DROPS_RUN_CLEAR) && run(d, DROPS_RUN_PLACE, slots, DROPS_ROWS_A_DROP) &&
           run(d, DROPS_RUN_OWN, slots, DROPS_ROWS_A_DROP);
}

// The number of times that water flattens and thins in a step. By the paper's rules it is once; by
// physical rules it is as often a second as with the paper's steps.
static int passes_in(const struct drops_settings *s, int64_t step)
{
    const double rate = s->rules == DROPS_PHYSICAL ? s->step_s / DROPS_PAPER_STEP_S : 1;
    return (int)(floor((double)(step + 1) * rate + 1e-6) - floor((double)step * rate + 1e-6));
}

// kernels/drops/water/flattening.h. Smoothing rounds heights, so that a change of less than half a
// unit vanishes.
static bool flatten(struct drops *d)
{
    const struct drops_settings *s = &d->settings;
    drops_params *p = &d->params;
    p->does_smooth = p->does_spread = s->smooth;
    p->does_erode = s->erode;
    p->dry_mm = s->smooth ? fmaxf((float)s->erode_mm, 0.5f / DROPS_HEIGHTS_A_MM) : FLT_MIN;
    p->owned_mm = p->does_spread ? fmaxf((float)s->owned_mm, FLT_MIN) : FLT_MIN;
    bool ok = true;
    for (int i = passes_in(s, d->base.frame - 1); ok && i > 0; i--) {
        ok = run_rows(d, DROPS_RUN_FLATTEN) && run_rows(d, DROPS_RUN_FLATTEN_BEADS);
        rg_swap(d->height, d->next_height);
        rg_swap(d->ids, d->next_ids);
    }
    return ok;
}

// The number of drops that land in a step: each with a probability, as in the paper's program.
static int arrivals_at(const struct drops_settings *s, int64_t step)
{
    const double expected = s->drops_s * s->step_s, whole = floor(expected);
    const rg_uint4 words = rg_random((uint32_t)s->seed, 0, (uint32_t)step, DROPS_LAND_CHANCE);
    const double arrivals = whole + ((double)rg_uniform(words.x) < expected - whole);
    return arrivals > s->max_drops ? s->max_drops : (int)arrivals;
}

static bool is_removal(const struct drops *d)
{
    const struct drops_settings *s = &d->settings;
    const double now_s = (double)d->base.frame * s->step_s;
    return s->remove_s >= 0 && now_s <= s->remove_s && s->remove_s < now_s + s->step_s;
}

static bool begin(struct drops *d)
{
    uint32_t tally[DROPS_TALLY];
    if (!rg_buf_read(d->tally->buf, 0, tally, sizeof(tally)))
        return false;
    d->params.count = (int)tally[DROPS_COUNT];
    d->params.step = (uint32_t)d->base.frame;
    d->params.arrivals = arrivals_at(&d->settings, d->base.frame);
    d->params.is_removal = is_removal(d);
    d->base.frame++;
    d->base.counters[DROPS_STEPPED].value += d->params.count;
    d->base.counters[DROPS_CELLS].value +=
        (int64_t)(tally[DROPS_TILES] - d->tiles_before) * DROPS_TILE_COLUMNS * DROPS_TILE_ROWS;
    d->tiles_before = tally[DROPS_TILES];
    return true;
}

bool drops_step(struct rg_instance *instance)
{
    struct drops *d = (struct drops *)instance;
    return begin(d) && move(d) && merge(d) && close_ranks(d) && put_at_rest(d) && flatten(d) &&
           rg_stage(instance, DROPS_RUN_DOZE);
}
