#include "core/techniques/cartoon/cartoon.h"

#include <string.h>

#include "core/techniques/cartoon/instance.h"
#include "core/techniques/proof.h"

bool cartoon_step(struct rg_instance *instance)
{
    struct cartoon *c = (struct cartoon *)instance;
    instance->frame++;
    return cartoon_look(c, instance->frame) && cartoon_scene_find(c) &&
           cartoon_rain_step(&c->rain) && cartoon_water_step(&c->water);
}

bool cartoon_draw(struct rg_instance *instance)
{
    struct cartoon *c = (struct cartoon *)instance;
    struct cartoon_water_view view = {.from_pixel = c->view.from_pixel};
    memcpy(view.to_light, c->view.to_light, sizeof(view.to_light));
    memcpy(view.ink, c->settings.ink, sizeof(view.ink));
    return cartoon_scene_draw(c) && rg_layer_begin(&c->layer) &&
           cartoon_water_draw(&c->water, &view) && cartoon_rain_draw(&c->rain) &&
           rg_layer_meet(&c->layer);
}

static bool cartoon_make_textures(rg_take_texture *take, void *user)
{
    return cartoon_make_rain_textures(take, user) && cartoon_make_strokes(take, user);
}

const struct rg_technique rg_technique_cartoon = {
    .name = "cartoon",
    .paper = "feng",
    .about = "rain in cartoon style on scenes drawn as cartoons",
    .shown = {"preset=storm", 960, 640, 100, 1.0},
    .params = &cartoon_param_table,
    .proof = &cartoon_proof,
    .size = sizeof(struct cartoon),
    .settings = offsetof(struct cartoon, settings),
    .open = cartoon_open,
    .close = cartoon_close,
    .step = cartoon_step,
    .draw = cartoon_draw,
    .make_textures = cartoon_make_textures,
};
