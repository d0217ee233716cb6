// Draws a frame of flow: the water's surface, the picture behind the panes, the panes, the glow.
#include "core/techniques/flow/instance.h"

static bool draw_model(struct flow *flow)
{
    if (!rg_stage_runs(&flow->base, FLOW_MODEL))
        return true;
    flow->model_view = flow->view;
    flow_view_model(&flow->settings, flow->base.frame, flow->model_low, flow->model_high,
                    &flow->model_view);
    flow->base.counters[FLOW_TRIANGLES].value += flow->model_faces;
    return rg_stage(&flow->base, FLOW_MODEL);
}

// The paper's first pass draws everything that does not refract: the sky, dry mirrors, the model.
// Panes read this picture, and are drawn onto a copy of it. The model is in front of far panes,
// whose drops cannot show it, so these read a picture without the model.
static bool draw_behind(struct flow *flow)
{
    struct rg_instance *i = &flow->base;
    const struct rg_asset *depth = rg_asset_find(i, "depth");
    const float farthest = 1;
    return (!depth || rg_image_clear(depth->image, &farthest)) && rg_stage(i, FLOW_SKY) &&
           rg_stage(i, FLOW_DRY_MIRRORS) && rg_stage(i, FLOW_BEHIND_MODEL) && draw_model(flow) &&
           rg_stage(i, FLOW_COPY);
}

// Copies the lit panes to the target, and adds the glow of their bright parts.
static bool draw_glow(struct flow *flow)
{
    struct rg_instance *i = &flow->base;
    return rg_stage(i, FLOW_GLOW_BRIGHT) && rg_stage(i, FLOW_GLOW_ACROSS) &&
           rg_stage(i, FLOW_GLOW_DOWN) && rg_stage(i, FLOW_GLOW);
}

// The last pass. Far panes of glass come first, because they are visible through near ones. Mirrors
// are opaque, so only those that face the viewer are drawn.
static bool draw_final(struct flow *flow)
{
    struct rg_instance *i = &flow->base;
    const struct rg_image_desc *target = &i->target->desc;
    i->counters[FLOW_PIXELS].value += (int64_t)target->width * target->height;
    return draw_behind(flow) && rg_stage(i, FLOW_FAR_GLASS) && rg_stage(i, FLOW_NEAR_GLASS) &&
           rg_stage(i, FLOW_MIRRORS) && draw_glow(flow);
}

static bool draw_stage(struct flow *flow)
{
    const uint32_t black[2] = {0, 0x3c000000}; // opaque
    return rg_image_clear(flow->base.target, black) && rg_stage(&flow->base, FLOW_SHOW_STAGE);
}

bool flow_draw(struct rg_instance *instance)
{
    struct flow *flow = (struct flow *)instance;
    const struct rg_image_desc *target = &instance->target->desc;
    flow->movement = flow_params_at(&flow->settings, flow->noise_size, instance->frame);
    flow->surface = flow_normals_params_of(&flow->settings);
    if (!flow_view_params_at(&flow->settings, instance->frame, target->width, target->height,
                             &flow->view) ||
        !flow_turn_panes(flow) || !rg_stage(instance, FLOW_BLUR) ||
        !rg_stage(instance, FLOW_NORMALS) || !flow_survey(flow))
        return false;
    return flow->settings.stage == FLOW_STAGE_FINAL ? draw_final(flow) : draw_stage(flow);
}
