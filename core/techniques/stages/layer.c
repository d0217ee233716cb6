#include "core/techniques/stages/layer.h"

#include "core/techniques/stages/assets.h"
#include "core/techniques/stages/stages.h"

bool rg_layer_open(struct rg_layer *layer, struct rg_instance *instance)
{
    static const struct rg_stage meet = {"layer_meet", .params = offsetof(struct rg_layer, params),
                                         .colour = "target"};
    const struct rg_image_desc *target = &instance->target->desc;
    layer->instance = instance;
    layer->light = rg_add_image(instance, RG_LAYER, RG_RGBA32F, target->width, target->height);
    layer->background =
        rg_add_image(instance, RG_BACKGROUND, RG_RGBA16F, target->width, target->height);
    layer->stage = rg_open_stages(instance, &meet, 1, layer, NULL);
    return layer->stage >= 0;
}

bool rg_layer_begin(const struct rg_layer *layer)
{
    static const float clear[4] = {0};
    return rg_image_clear(layer->light->image, clear);
}

bool rg_layer_meet(const struct rg_layer *layer)
{
    return rg_stage(layer->instance, layer->stage);
}
