// Draws shower: the scene or an even sky, then the rain.
#include <math.h>
#include <string.h>

#include "core/scene/matrix.h"
#include "core/techniques/shower/instance.h"
#include "kernels/dialect/image/format.h"

static bool draw_scene(struct shower *s, const struct scenery_look *look)
{
    const uint16_t sky[4] = {
        (uint16_t)rg_pack_half(look->sky.horizon_r), (uint16_t)rg_pack_half(look->sky.horizon_g),
        (uint16_t)rg_pack_half(look->sky.horizon_b), (uint16_t)rg_pack_half(1)};
    if (!s->scene)
        return rg_image_clear(s->layer.background->image, sky);
    struct scenery_view view = {.colour = s->layer.background->image,
                                .depth = rg_asset_find(&s->base, "depth")->image,
                                .to_clip = s->view.to_clip};
    memcpy(view.eye, s->camera.position, sizeof(view.eye));
    return scenery_draw(s->scene, &view, look, s->lights, true);
}

static bool set_view(struct shower *s, const struct scenery_look *look)
{
    const struct shower_settings *set = &s->settings;
    const struct rg_image_desc *d = &s->base.target->desc;
    float to_clip[16];
    if (!rg_camera_matrix(&s->camera, (float)d->width / (float)d->height, to_clip))
        return false;
    shower_view_params *v = &s->view;
    v->to_clip = rg_m4_of(to_clip);
    v->rain = s->params;
    v->half_width = (float)d->width / 2;
    v->half_height = (float)d->height / 2;
    v->focal_px = (float)(d->height / (2 * tan(set->view_angle_deg * M_PI / 360)));
    v->opacity = (float)set->opacity;
    v->r = (float)(set->light * (double)look->sky.zenith_r);
    v->g = (float)(set->light * (double)look->sky.zenith_g);
    v->b = (float)(set->light * (double)look->sky.zenith_b);
    return true;
}

bool shower_draw(struct rg_instance *instance)
{
    struct shower *s = (struct shower *)instance;
    const struct scenery_look look = scenery_day();
    if (!set_view(s, &look) || !draw_scene(s, &look))
        return false;
    instance->counters[SHOWER_COUNT_DRAWN].value += s->tally[SHOWER_ALIVE];
    return rg_layer_begin(&s->layer) && rg_stage(instance, s->first_stage + SHOWER_RUN_SEGMENTS) &&
           rg_stage(instance, s->first_stage + SHOWER_RUN_QUADS) && rg_layer_meet(&s->layer);
}
