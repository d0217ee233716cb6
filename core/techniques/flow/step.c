// A step of flow: drops land, water moves.
#include "core/techniques/flow/instance.h"

static int clamp(double value, int low, int high)
{
    return value < low ? low : value > high ? high : (int)value;
}

// Runs the splat of one drop over the texels that it covers, if any.
static bool land_drop(struct flow *flow)
{
    const flow_splat_params *drop = &flow->drop;
    const double reach = (double)drop->radius_px + 1;
    const int x0 = clamp((double)drop->centre_x - reach, 0, drop->size);
    const int y0 = clamp((double)drop->centre_y - reach, 0, drop->size);
    const int x1 = clamp((double)drop->centre_x + reach, 0, drop->size);
    const int y1 = clamp((double)drop->centre_y + reach, 0, drop->size);
    if (x0 >= x1 || y0 >= y1)
        return true;
    flow->base.counters[FLOW_DROPS].value++;
    return rg_stage_over(&flow->base, FLOW_SPLAT, (struct rg_extent){x0, y0, 0},
                         (struct rg_extent){x1 - x0, y1 - y0, 1});
}

bool flow_land(struct flow *flow, int64_t frame, int count)
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

// Each texel gives, then takes; what crosses a pane's edge arrives last.
static bool move(struct flow *flow)
{
    struct rg_instance *i = &flow->base;
    const bool ok = rg_stage(i, FLOW_GIVEN) && rg_stage(i, FLOW_DRAIN) && rg_stage(i, FLOW_MOVE) &&
                    rg_stage(i, FLOW_REACH) && rg_stage(i, FLOW_ARRIVE);
    rg_swap(flow->water, flow->moved);
    return ok;
}

// Smooths the lattice of heights: two runs for the pull of the water around, two more for how much
// there is.
static bool look_around(struct rg_instance *i)
{
    return rg_stage(i, FLOW_LEVEL) && rg_stage(i, FLOW_SMOOTH_ONCE) &&
           rg_stage(i, FLOW_SMOOTH_TWICE) && rg_stage(i, FLOW_SMOOTH_THRICE) &&
           rg_stage(i, FLOW_SMOOTH_WIDE) && rg_stage(i, FLOW_PACE) && rg_stage(i, FLOW_PULL);
}

static bool relax(struct flow *flow)
{
    bool ok = true;
    for (int run = 0; ok && run < flow_relax_runs(&flow->settings); run++) {
        ok = rg_stage(&flow->base, FLOW_RELAX);
        rg_swap(flow->water, flow->moved);
    }
    return ok;
}

// The time of a frame, run by run: water dries, levels, and slides.
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
        ok = rg_buf_write(flow->ways->buf, 0, ways, sizeof(ways)) && look_around(i) &&
             relax(flow) && rg_stage(i, FLOW_CLING) && rg_stage(i, FLOW_SLIDE_OFF) &&
             rg_stage(i, FLOW_SLIDE) && rg_stage(i, FLOW_ARRIVE);
        rg_swap(flow->water, flow->moved);
    }
    return ok;
}

bool flow_step(struct rg_instance *instance)
{
    struct flow *flow = (struct flow *)instance;
    const int n = flow->settings.resolution_px;
    flow->movement = flow_params_at(&flow->settings, flow->noise_size, instance->frame);
    const bool ok =
        flow_turn_panes(flow) &&
        flow_land(flow, instance->frame, flow_drops_at(&flow->settings, instance->frame)) &&
        (flow->settings.move == FLOW_MOVE_PAPER ? move(flow) : slide(flow));
    instance->counters[FLOW_TEXELS].value += (int64_t)flow->pane_count * n * n;
    instance->frame++;
    return ok;
}
