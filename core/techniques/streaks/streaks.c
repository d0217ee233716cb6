// streaks: rain as particles that fall through a scene, lit by a database of streaks (C. Creus,
// "Real-time realistic rain rendering", 2010). This file has the order of the passes; open.c opens
// their stages, kernels/streaks/ has the computations, and docs/streaks.md explains.
#include "core/techniques/streaks/streaks.h"

#include <math.h>
#include <string.h>

#include "core/scene/matrix.h"
#include "core/techniques/streaks/instance.h"

// --- passes over the selected particles ---

// Runs a stage over a draw's particles. It uploads their blocks first, unless this is the only
// draw, whose blocks are on the device already.
static bool run_over(struct streaks *s, enum streaks_pass pass, const struct streaks_draw *draw)
{
    const struct rg_extent first = {0, 0, 0}, items = {draw->block_count * STREAKS_BLOCK, 1, 1};
    s->particles_now->buf = s->rain->particles[draw->buffer];
    return (s->selection.draw_count == 1 || streaks_write_blocks(s, draw)) &&
           rg_stage_over(&s->base, s->first_stage + (int)pass, first, items);
}

// Draws the whole selection, in a local space with this top.
static bool draw_rain_at(struct streaks *s, float top)
{
    const bool outside = s->settings.outside && !s->rain_alone;
    s->of_rain = s->params;
    s->of_rain.top = top;
    if (outside)
        streaks_outside_marks(s, &s->of_rain);
    for (int i = 0; i < s->selection.draw_count; i++) {
        const struct streaks_draw *draw = &s->selection.draws[i];
        s->base.counters[STREAKS_ITEMS].value += (int64_t)draw->block_count * STREAKS_BLOCK;
        if (!run_over(s, outside ? STREAKS_MARKS : STREAKS_RAIN, draw))
            return false;
    }
    return true;
}

// Draws the local space; without limits, every copy of it that reaches into the rain space, each
// with its own selection.
static bool draw_rain(struct streaks *s)
{
    const double height_m = s->settings.local_height_m;
    double top_m = (double)s->params.top, eye[3];
    if (s->settings.limits)
        return draw_rain_at(s, s->params.top);
    rg_rain_eye(&s->space, &s->observer.camera, eye);
    top_m -= ceil(top_m / height_m) * height_m;
    for (; top_m < s->space.height_m; top_m += height_m)
        if (!streaks_select_blocks(s, eye, top_m) || !draw_rain_at(s, (float)top_m))
            return false;
    return true;
}

// --- a frame ---

// Stores each particle's place and state, for `verify` to compare.
static bool keep_state(struct streaks *s)
{
    const int64_t items = s->selection.block_count * STREAKS_BLOCK;
    s->base.state_count = items ? 1 : 0;
    rg_empty(s->places); // it is as long as the state
    if (!rg_make_room(&s->base, s->places, items ? items * STREAKS_STATE_WORDS : 1))
        return false;
    s->of_rain = s->params;
    for (int i = 0; i < s->selection.draw_count; i++) {
        const struct streaks_draw *draw = &s->selection.draws[i];
        if (!run_over(s, STREAKS_STATES, draw))
            return false;
        s->of_rain.first_place += draw->block_count * STREAKS_BLOCK;
    }
    return true;
}

static bool streaks_step(struct rg_instance *instance)
{
    struct streaks *s = (struct streaks *)instance;
    instance->frame++;
    return streaks_look(s) && (!s->settings.keeps_state || keep_state(s));
}

// Distant rain is drawn before the rain, into the same layer. The view from outside has no distant
// rain.
static bool draw_layer(struct streaks *s)
{
    return rg_layer_begin(&s->layer) &&
           (s->rain_alone || s->settings.outside || streaks_draw_far(s)) && draw_rain(s) &&
           rg_layer_meet(&s->layer);
}

static bool draw_overlay(struct streaks *s)
{
    return s->rain_alone || ((!s->settings.outside || streaks_outside_map(s)) &&
                             (!s->settings.overlay || streaks_show(s)));
}

static bool streaks_draw(struct rg_instance *instance)
{
    struct streaks *s = (struct streaks *)instance;
    struct scenery_look look = s->settings.time == SCENERY_NIGHT ? scenery_night() : scenery_day();
    const struct streaks_observer *viewer = streaks_viewer(s);
    struct scenery_view view = {.colour = s->layer.background->image,
                                .depth = rg_asset_find(instance, "depth")->image,
                                .to_clip = rg_m4_of(viewer->world_to_clip)};
    memcpy(view.eye, viewer->camera.position, sizeof(view.eye));
    if (s->settings.outside)
        look.sky.haze_per_m = 0; // the camera is too far away to see through haze
    instance->counters[STREAKS_PARTICLES].value += s->selection.particles;
    instance->counters[STREAKS_PACKETS].value += s->selection.packets;
    return scenery_draw(s->scene, &view, &look, s->lights, s->settings.geometry) && draw_layer(s) &&
           draw_overlay(s);
}

const struct rg_technique rg_technique_streaks = {
    .name = "streaks",
    .paper = "creus",
    .about = "rain as particles that fall through a city, with streaks, splashes and lights",
    .shown = {"far_layers=8", 960, 540, 90, 1.0},
    .params = &streaks_param_table,
    .proof = &streaks_proof,
    .size = sizeof(struct streaks),
    .settings = offsetof(struct streaks, settings),
    .open = streaks_open,
    .close = streaks_close,
    .step = streaks_step,
    .draw = streaks_draw,
};
