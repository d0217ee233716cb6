// A drawing of flow: the water's surface, what lies behind the panes, the panes, the glow.
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

// The paper's first pass draws all that does not refract: the sky, dry mirrors, the model. Panes
// read this picture, and are drawn onto a copy of it. The model stands before far panes, whose
// drops cannot show it: these read the picture without.
static bool draw_behind(struct flow *flow)
{
    struct rg_instance *i = &flow->base;
    const struct rg_asset *depth = rg_asset_find(i, "depth");
    const float farthest = 1;
    return (!depth || rg_image_clear(depth->image, &farthest)) && rg_stage(i, FLOW_SKY) &&
           rg_stage(i, FLOW_DRY_MIRRORS) && rg_stage(i, FLOW_BEHIND_MODEL) && draw_model(flow) &&
           rg_stage(i, FLOW_COPY);
}

// Spreads some of the bright light of the lit panes on its way to the target.
static bool draw_glow(struct flow *flow)
{
    struct rg_instance *i = &flow->base;
    return rg_stage(i, FLOW_GLOW_BRIGHT) && rg_stage(i, FLOW_GLOW_ACROSS) &&
           rg_stage(i, FLOW_GLOW_DOWN) && rg_stage(i, FLOW_GLOW);
}

// The last pass. Of panes of glass the far ones are drawn first, for one sees through near ones.
// Of mirrors only those that face the viewer are drawn: nothing is seen through them.
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
