// A step of flow: drops land, water moves.
#include "core/techniques/flow/instance.h"

// Runs the splat of one drop over the texels that it covers, if any.
static bool land_drop(struct flow *flow)
{
    const flow_splat_params *drop = &flow->drop;
    const double reach = (double)drop->radius_px + 1;
    const int x0 = flow_clamp((double)drop->centre_x - reach, 0, drop->size);
    const int y0 = flow_clamp((double)drop->centre_y - reach, 0, drop->size);
    const int x1 = flow_clamp((double)drop->centre_x + reach, 0, drop->size);
    const int y1 = flow_clamp((double)drop->centre_y + reach, 0, drop->size);
    if (x0 >= x1 || y0 >= y1)
        return true;
    flow->base.counters[FLOW_DROPS].value++;
    return rg_stage_over(&flow->base, FLOW_SPLAT, (struct rg_extent){x0, y0, 0},
                         (struct rg_extent){x1 - x0, y1 - y0, 1});
}

bool flow_splat_drops(struct flow *flow, int64_t frame, int count)
{
    for (int pane = 0; pane < flow->pane_count; pane++) {
        for (int i = 0; i < count; i++) {
            flow->drop = flow_drop(&flow->settings, pane, frame, i);
            if (!land_drop(flow))
                return false;
        }
    }
    return true;
}

bool flow_turn_panes(struct flow *flow)
{
    flow_pane panes[FLOW_MAX_PANES];
    flow_panes_at(&flow->settings, flow->noise_size, flow->base.frame, panes);
    return rg_buf_write(flow->panes->buf, 0, panes, flow->pane_count * (int64_t)sizeof(flow_pane));
}

static void swap(struct flow *flow)
{
    rg_swap(flow->water, flow->moved);
}

// Moves water: each texel gives, then takes, in one common direction or in its own; water that
// crosses a pane's edge arrives last.
static bool move(struct flow *flow)
{
    struct rg_instance *i = &flow->base;
    const bool ok = rg_stage(i, FLOW_GIVEN) && rg_stage(i, FLOW_DRAIN) && rg_stage(i, FLOW_MOVE) &&
                    rg_stage(i, FLOW_REACH) && rg_stage(i, FLOW_SWEPT_GIVEN) &&
                    rg_stage(i, FLOW_SWEPT_DRAIN) && rg_stage(i, FLOW_SWEPT_MOVE) &&
                    rg_stage(i, FLOW_ARRIVE);
    swap(flow);
    if (flow->kept)
        rg_swap(flow->kept, flow->heading);
    return ok;
}

enum { SPREADS = 6 }; // even, so that each group of panes ends in the same map

// Panes that one stage handles together, one group after the other.
struct group {
    struct flow *flow;
    int first, count;
};

static bool run(const struct group *g, enum flow_pass pass)
{
    struct rg_instance *i = &g->flow->base;
    const struct rg_extent all = i->stages[pass].over->items;
    return rg_stage_over(i, pass, (struct rg_extent){0, 0, g->first},
                         (struct rg_extent){all.width, all.height, g->count});
}

static bool spread(const struct group *g)
{
    bool ok = true;
    for (int i = 0; ok && i < SPREADS; i++) {
        ok = run(g, FLOW_SPREAD);
        rg_swap(g->flow->pace, g->flow->paces);
    }
    return ok;
}

// Smooths the lattice of heights: two runs for the pull of surrounding water, two more for its
// amount.
static bool look_around(const struct group *g)
{
    return run(g, FLOW_LEVEL) && run(g, FLOW_SMOOTH_ONCE) && run(g, FLOW_SMOOTH_TWICE) &&
           run(g, FLOW_CLOSE_ACROSS) && run(g, FLOW_WET_ROWS) && run(g, FLOW_WET) &&
           run(g, FLOW_PULL) && run(g, FLOW_SMOOTH_THRICE) && run(g, FLOW_SMOOTH_WIDE) &&
           run(g, FLOW_PACE) && spread(g) && run(g, FLOW_RIDGE_ACROSS);
}

static bool relax(const struct group *g)
{
    bool ok = true;
    const int count = flow_relax_runs(&g->flow->settings);
    for (int i = 0; ok && i < count; i++) {
        g->flow->sliding.reach = flow_relax_reach(&g->flow->settings, i);
        ok = run(g, g->flow->sliding.reach > 1 ? FLOW_RELAX_FAR : FLOW_RELAX);
        swap(g->flow);
    }
    return ok;
}

// Dries and levels the water of a group, and slides it to `moved`.
static bool slide_group(const struct group *g)
{
    return look_around(g) && relax(g) && run(g, FLOW_CLING) && run(g, FLOW_SLIDE_OFF) &&
           run(g, FLOW_SLIDE);
}

// A group has at most this many texels, so that a run's data stays in the processor's cache. Larger
// panes form groups of their own.
#define TEXELS_AT_ONCE (1 << 21)

static bool slide_panes(struct flow *flow)
{
    const int n = flow->settings.resolution_px, panes = flow->pane_count;
    const int at_once = panes * n * n <= TEXELS_AT_ONCE ? panes : 1;
    const bool is_odd = flow_relax_runs(&flow->settings) % 2;
    bool ok = true;
    for (int first = 0; ok && first < panes; first += at_once) {
        if (first > 0 && is_odd)
            swap(flow); // restores the maps that the first group saw
        ok = slide_group(&(struct group){flow, first, at_once});
    }
    return ok;
}

// Advances the time of a frame in several runs: water dries, levels and slides.
static bool slide(struct flow *flow)
{
    struct rg_instance *i = &flow->base;
    const int runs = flow_slide_runs(&flow->settings);
    bool ok = true;
    for (int part = 0; ok && part < runs; part++) {
        const int64_t run = i->frame * runs + part;
        int32_t ways[2 * FLOW_PACES * FLOW_MAX_PANES] = {0};
        flow->sliding = flow_slide_params_at(&flow->settings, run);
        flow_ways_at(&flow->settings, i->frame, run, ways);
        ok = rg_buf_write(flow->ways->buf, 0, ways, sizeof(ways)) && slide_panes(flow) &&
             rg_stage(i, FLOW_ARRIVE);
        swap(flow);
    }
    return ok;
}

bool flow_step(struct rg_instance *instance)
{
    struct flow *flow = (struct flow *)instance;
    if (!flow_follow_camera(flow))
        return false;
    const int n = flow->settings.resolution_px;
    flow->movement = flow_params_at(&flow->settings, flow->noise_size, instance->frame);
    const bool ok = flow_turn_panes(flow) &&
                    (flow->settings.move == FLOW_MOVE_PAPER
                         ? flow_splat_drops(flow, instance->frame,
                                            flow_drops_at(&flow->rain, instance->frame)) &&
                               move(flow)
                         : flow_land_rain(flow) && slide(flow));
    instance->counters[FLOW_TEXELS].value += (int64_t)flow->pane_count * n * n;
    instance->frame++;
    return ok;
}
