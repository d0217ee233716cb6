// flow: water on panes of glass or mirror as a cellular automaton on height maps. Stuppacher &
// Supan, "Rendering of Water Drops in Real-Time" (2007). This file holds the order of the passes;
// formulas are in kernels/flow*.h, what the host computes in simulation.c and view.c, and
// docs/flow.md explains.
#include "core/techniques/flow/instance.h"
#include "kernels/flow/glow/params.h"

static bool run(struct flow *flow, enum flow_pass pass, struct rg_run run)
{
    return rg_instance_run(&flow->base, flow->passes[pass], &run);
}

// --- a step ---

static int clamp(double value, int low, int high)
{
    return value < low ? low : value > high ? high : (int)value;
}

// Runs the splat of one drop over the texels that it covers, if any.
static bool land_drop(struct flow *flow, const flow_splat_params *drop)
{
    const double reach = (double)drop->radius_px + 1;
    const int x0 = clamp((double)drop->centre_x - reach, 0, drop->size);
    const int y0 = clamp((double)drop->centre_y - reach, 0, drop->size);
    const int x1 = clamp((double)drop->centre_x + reach, 0, drop->size);
    const int y1 = clamp((double)drop->centre_y + reach, 0, drop->size);
    if (x0 >= x1 || y0 >= y1)
        return true;
    flow->base.counters[FLOW_DROPS].value++;
    return run(flow, FLOW_SPLAT,
               (struct rg_run){.params = drop,
                               .slots = {[1].buf = flow->water, [2].buf = flow->ledger},
                               .origin = {x0, y0, 0},
                               .extent = {x1 - x0, y1 - y0, 1}});
}

bool flow_land(struct flow *flow, int64_t frame, int count)
{
    for (int pane = 0; pane < flow->pane_count; pane++) {
        for (int i = 0; i < count; i++) {
            flow_splat_params drop = flow_drop(&flow->settings, pane, frame, i);
            if (!land_drop(flow, &drop))
                return false;
        }
    }
    return true;
}

// How the panes stand at the present frame.
static bool turn_panes(struct flow *flow)
{
    flow_pane panes[FLOW_MAX_PANES];
    flow_panes_at(&flow->settings, flow->noise_size, flow->base.frame, panes);
    return rg_buf_write(flow->panes, 0, panes, flow->pane_count * (int64_t)sizeof(flow_pane));
}

// What leaves each texel, and what leaves each pane.
static bool give(struct flow *flow, const flow_params *p)
{
    const int n = flow->settings.resolution_px;
    return run(flow, FLOW_GIVEN,
               (struct rg_run){.params = p,
                               .slots = {[1].buf = flow->water,
                                         [2].buf = flow->remainder,
                                         [3].buf = flow->noise,
                                         [4].buf = flow->given,
                                         [5].buf = flow->panes},
                               .extent = {n, n, flow->pane_count}}) &&
           run(flow, FLOW_DRAIN,
               (struct rg_run){.params = p,
                               .slots = {[1].buf = flow->water,
                                         [2].buf = flow->given,
                                         [3].buf = flow->ledger,
                                         [4].buf = flow->panes,
                                         [5].buf = flow->arriving},
                               .extent = {n, FLOW_STRIPS, flow->pane_count}});
}

static bool take(struct flow *flow, const flow_params *p)
{
    const int n = flow->settings.resolution_px;
    const struct rg_run moving = {.params = p,
                                  .slots = {[1].buf = flow->water,
                                            [2].buf = flow->given,
                                            [3].buf = flow->moved,
                                            [4].buf = flow->panes},
                                  .extent = {n, n, flow->pane_count}};
    return run(flow, FLOW_MOVE, moving) &&
           (!flow->passes[FLOW_REACH] || run(flow, FLOW_REACH, moving));
}

static bool move(struct flow *flow)
{
    const int n = flow->settings.resolution_px;
    const flow_params p = flow_params_at(&flow->settings, flow->noise_size, flow->base.frame);
    const struct rg_run arriving = {
        .params = &p,
        .slots = {[1].buf = flow->moved, [2].buf = flow->arriving, [3].buf = flow->ledger},
        .extent = {n, FLOW_STRIPS, flow->pane_count}};
    return give(flow, &p) && take(flow, &p) &&
           (!flow->passes[FLOW_ARRIVE] || run(flow, FLOW_ARRIVE, arriving));
}

static bool flow_step(struct rg_instance *instance)
{
    struct flow *flow = (struct flow *)instance;
    const int n = flow->settings.resolution_px;
    const bool ok =
        turn_panes(flow) &&
        flow_land(flow, instance->frame, flow_drops_at(&flow->settings, instance->frame)) &&
        move(flow);
    struct rg_buf *moved = flow->moved;
    flow->moved = flow->water;
    flow->water = moved;
    instance->counters[FLOW_TEXELS].value += (int64_t)flow->pane_count * n * n;
    instance->frame++;
    flow_show_state(flow);
    return ok;
}

// --- drawing ---

static bool draw_surface(struct flow *flow)
{
    const int n = flow->settings.resolution_px;
    const flow_params p = flow_params_at(&flow->settings, flow->noise_size, flow->base.frame);
    const flow_normals_params normals = flow_normals_params_of(&flow->settings);
    const struct rg_run blurring = {.params = &p,
                                    .slots = {[1].buf = flow->water, [2].buf = flow->blurred},
                                    .extent = {n, n, flow->pane_count}};
    const struct rg_run deriving = {.params = &normals,
                                    .slots = {[1].buf = flow->blurred, [2].buf = flow->normals},
                                    .extent = {n, n, flow->pane_count}};
    return run(flow, FLOW_BLUR, blurring) && run(flow, FLOW_NORMALS, deriving);
}

static bool draw_model(struct flow *flow, const flow_view_params *view)
{
    flow_view_params model = *view;
    flow_view_model(&flow->settings, flow->base.frame, flow->model_low, flow->model_high, &model);
    flow->base.counters[FLOW_TRIANGLES].value += flow->model_faces;
    const struct rg_draw onto = {
        .colour = flow->behind,
        .depth = flow->depth,
        .depth_mode = RG_DEPTH_WRITE,
        .cull = flow->settings.model_sides == FLOW_FRONT_SIDES ? RG_CULL_BACK : RG_CULL_NONE};
    return run(flow, FLOW_MODEL,
               (struct rg_run){.params = &model,
                               .slots = {[1].buf = flow->positions,
                                         [2].buf = flow->model_normals,
                                         [3].buf = flow->indices,
                                         [4].image = flow->environment,
                                         [5].buf = flow->blurred},
                               .extent = {flow->model_faces, 1, 1},
                               .draw = &onto});
}

// What the panes are drawn onto.
static struct rg_image *canvas(struct flow *flow)
{
    return flow->lit ? flow->lit : flow->base.target;
}

static bool draw_sky(struct flow *flow, const flow_view_params *view, struct rg_image *onto)
{
    return run(flow, FLOW_SKY,
               (struct rg_run){.params = view,
                               .slots = {[1].image = flow->environment},
                               .extent = {1, 1, 1},
                               .draw = &(struct rg_draw){.colour = onto}});
}

// The paper's first pass: all that does not refract, as a picture for those that do; and a copy of
// it to draw the panes onto.
static bool draw_behind(struct flow *flow, const flow_view_params *view)
{
    const struct rg_image_desc *target = &flow->base.target->desc;
    const float farthest = 1;
    return rg_image_clear(flow->depth, &farthest) && draw_sky(flow, view, flow->behind) &&
           (!flow->passes[FLOW_MODEL] || draw_model(flow, view)) &&
           run(flow, FLOW_COPY,
               (struct rg_run){.params = view,
                               .slots = {[1].image = flow->behind, [2].image = canvas(flow)},
                               .extent = {target->width, target->height, 1}});
}

// The panes whose front or back is seen.
static bool draw_panes(struct flow *flow, const flow_view_params *view, enum rg_cull cull)
{
    const bool glass = flow->settings.panes == FLOW_GLASS;
    // Nothing stands before the near panes.
    const bool hidden = flow->behind && cull == RG_CULL_FRONT;
    const struct rg_draw onto = {.colour = canvas(flow),
                                 .depth = hidden ? flow->depth : NULL,
                                 .blend = glass ? RG_BLEND_OVER : RG_BLEND_OFF,
                                 .depth_mode = hidden ? RG_DEPTH_TEST : RG_DEPTH_OFF,
                                 .cull = cull};
    return run(flow, FLOW_PANES,
               (struct rg_run){.params = view,
                               .slots = {[1].buf = flow->normals,
                                         [2].image = flow->environment,
                                         [3].buf = flow->panes,
                                         [4].image = glass ? flow->behind : NULL},
                               .extent = {flow->pane_count, 1, 1},
                               .draw = &onto});
}

// The last pass: through glass the far panes first; of mirrors only those that face the viewer.
static bool draw_final(struct flow *flow, const flow_view_params *view)
{
    const struct rg_image_desc *target = &flow->base.target->desc;
    flow->base.counters[FLOW_PIXELS].value += (int64_t)target->width * target->height;
    // Nothing is seen through mirrors: the sky around them is drawn where it is shown.
    const bool sky = flow->passes[FLOW_SKY] && !flow->behind;
    return (!sky || draw_sky(flow, view, canvas(flow))) &&
           (!flow->behind || draw_behind(flow, view)) &&
           (flow->settings.panes == FLOW_MIRROR || draw_panes(flow, view, RG_CULL_FRONT)) &&
           draw_panes(flow, view, RG_CULL_BACK);
}

static bool draw_stage(struct flow *flow, const flow_view_params *view)
{
    const uint32_t black[2] = {0, 0x3c000000}; // opaque
    return rg_image_clear(flow->base.target, black) &&
           run(flow, FLOW_SHOW_STAGE,
               (struct rg_run){
                   .params = view,
                   .slots = {[1].buf = flow->normals,
                             [2].buf = flow->water,
                             [3].buf = flow->panes,
                             [4].buf = flow->blurred},
                   .extent = {flow->pane_count, 1, 1},
                   .draw = &(struct rg_draw){.colour = flow->base.target, .cull = RG_CULL_BACK}});
}

static bool blur_glow(struct flow *flow, flow_glow_params p, int step_x, int step_y,
                      struct rg_image *from, struct rg_image *to)
{
    p.step_x = step_x;
    p.step_y = step_y;
    p.last_x = from->desc.width - 1;
    p.last_y = from->desc.height - 1;
    return run(flow, FLOW_GLOW_BLUR,
               (struct rg_run){.params = &p,
                               .slots = {[1].image = from, [2].image = to},
                               .extent = {to->desc.width, to->desc.height, 1}});
}

// Spreads some of the bright light of the lit panes on its way to the target.
static bool draw_glow(struct flow *flow)
{
    const struct rg_image_desc *target = &flow->base.target->desc, *small = &flow->bright->desc;
    const flow_glow_params p = {.threshold = (float)flow->settings.glow_threshold,
                                .strength = (float)flow->settings.glow,
                                .last_x = target->width - 1,
                                .last_y = target->height - 1};
    return run(flow, FLOW_GLOW_BRIGHT,
               (struct rg_run){.params = &p,
                               .slots = {[1].image = flow->lit, [2].image = flow->bright},
                               .extent = {small->width, small->height, 1}}) &&
           blur_glow(flow, p, 1, 0, flow->bright, flow->spread) &&
           blur_glow(flow, p, 0, 1, flow->spread, flow->bright) &&
           run(flow, FLOW_GLOW,
               (struct rg_run){.params = &p,
                               .slots = {[1].image = flow->lit,
                                         [2].image = flow->bright,
                                         [3].image = flow->base.target},
                               .extent = {target->width, target->height, 1}});
}

static bool flow_draw(struct rg_instance *instance)
{
    struct flow *flow = (struct flow *)instance;
    const struct rg_image_desc *target = &instance->target->desc;
    flow_view_params view;
    if (!flow_view_params_at(&flow->settings, instance->frame, target->width, target->height,
                             &view) ||
        !turn_panes(flow) || !draw_surface(flow))
        return false;
    if (flow->settings.stage != FLOW_STAGE_FINAL)
        return draw_stage(flow, &view);
    return draw_final(flow, &view) && (!flow->passes[FLOW_GLOW] || draw_glow(flow));
}

const struct rg_technique rg_technique_flow = {
    .name = "flow",
    .paper = "stuppacher",
    .about = "water flowing down panes of glass or mirror (Stuppacher & Supan 2007)",
    .params = &flow_param_table,
    .proof = &flow_proof,
    .create = flow_open,
    .destroy = flow_close,
    .step = flow_step,
    .draw = flow_draw,
};
