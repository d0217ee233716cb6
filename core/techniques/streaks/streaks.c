// streaks: rain as particles that fall through a scene, lit by a database of streaks (C. Creus,
// "Real-time rendering of rain", 2010). The order of the passes stands here; open.c makes
// what they run on, kernels/streaks/ is what they compute, and docs/streaks.md explains.
#include "core/techniques/streaks/streaks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/techniques/streaks/instance.h"

// --- where the observer is ---

// How far what a particle draws reaches from it, in metres.
static double splash_reach(const struct streaks_settings *set)
{
    const double largest = 1.15; // of a splash, by the size that is set
    return set->splash_width_mm / 1000 * largest;
}

static double streak_length(const struct streaks_settings *set)
{
    return set->fall_speed_m_s * set->exposure_s;
}

// What the atlas' pictures show beside the drop itself.
static double margin(const struct streaks_settings *set)
{
    return set->drop_radius_mm / 1000;
}

static bool select_packets(struct streaks *s, const double eye[3], double top_m)
{
    const struct streaks_settings *set = &s->settings;
    const struct rg_image_desc *desc = &s->base.target->desc;
    const double splash = splash_reach(set), streak = streak_length(set) + 2 * margin(set);
    struct streaks_view view = {
        .eye = {eye[0], eye[1], eye[2]},
        .radius_m = set->limits ? set->culling_radius_m : (double)INFINITY,
        .top_m = top_m,
        .run = rg_rain_run(set->fall_speed_m_s, set->step_s * (double)s->base.frame, top_m,
                           set->local_height_m),
        .across_m = fmax(splash, 2 * margin(set)),
        .above_m = streak + set->splash_s * set->fall_speed_m_s + splash,
        .below_m = fmax(2 * margin(set), splash),
        .hull = set->select,
        .whole = set->all_blocks || set->keeps_state,
    };
    return rg_rain_view_corners(&s->space, &s->observer.camera, (double)desc->width / desc->height,
                                view.corners) &&
           streaks_select(s->packets, &view, &s->selection);
}

// --- what kernels are told ---

static void set_looks(streaks_params *p, const struct streaks_settings *set,
                      const struct streaks_textures *textures)
{
    // The atlas' pictures are 32 / 23.744 drops wide, and as much longer than the way of a drop.
    const double wide = 2 * margin(set) * RG_ATLAS_CELL_PX / (double)RG_ATLAS_DROP_PX;
    p->half_width = (float)(wide / 2);
    p->ahead = (float)(wide / 2);
    p->behind = (float)(streak_length(set) + wide / 2);
    p->fall_speed = (float)set->fall_speed_m_s;
    p->splash_s = (float)set->splash_s;
    p->splash_width = (float)(set->splash_width_mm / 1000);
    p->splash_height = p->splash_width * 2 / 3;
    p->drops = set->drops;
    p->splashes = set->splashes;
    p->paper_angles = set->absolute_views;
    p->first_level = textures->first_level;
    p->last_level = set->last_mip > textures->first_level ? set->last_mip : textures->first_level;
    p->gain = (float)set->streak_gain;
    p->opacity = (float)set->streak_opacity;
    p->splash_gain = (float)set->splash_gain;
    p->splash_opacity = (float)set->splash_opacity;
}

// The camera's matrix, rays and depth in the rain frame.
static void set_view(streaks_params *p, const struct rg_rain_space *space,
                     const struct streaks_observer *observer)
{
    const double near_m = (double)observer->camera.near_plane;
    const double far_m = (double)observer->camera.far_plane;
    float to_clip[16], rays[16];
    rg_rain_to_clip(space, observer->world_to_clip, to_clip);
    memcpy(&p->to_clip, to_clip, sizeof(p->to_clip));
    rg_rain_rays(space, observer->rays, rays);
    memcpy(&p->rays, rays, sizeof(p->rays));
    p->depth_far = (float)(far_m / (far_m - near_m));
    p->depth_per_w = (float)(-near_m * far_m / (far_m - near_m));
    p->focal_px = observer->focal_px;
}

static void set_params(struct streaks *s, const double eye[3], double top_m)
{
    const struct streaks_settings *set = &s->settings;
    streaks_params *p = &s->params;
    const double up[3] = {0, 1, 0};
    double up_rain[3];
    rg_rain_direction(&s->space, up, up_rain);
    set_view(p, &s->space, &s->observer);
    p->half_x = (float)s->space.half_x_m;
    p->half_y = (float)s->space.half_y_m;
    p->top = (float)top_m;
    p->local_height = (float)set->local_height_m;
    p->eye_x = (float)eye[0];
    p->eye_y = (float)eye[1];
    p->eye_s = (float)eye[2];
    p->radius = (float)set->culling_radius_m;
    p->exact = set->exact && set->limits;
    p->up_x = (float)up_rain[0];
    p->up_y = (float)up_rain[1];
    p->up_s = (float)up_rain[2];
    p->lights = s->lights->count;
    p->sky_r = set->environment_light ? s->lights->sky[0] : 0;
    p->sky_g = set->environment_light ? s->lights->sky[1] : 0;
    p->sky_b = set->environment_light ? s->lights->sky[2] : 0;
    set_looks(p, set, s->textures);
}

// --- passes over the selected particles ---

static bool write_blocks(struct streaks *s, const struct streaks_draw *draw)
{
    const int64_t words = (int64_t)draw->block_count * STREAKS_BLOCK_WORDS;
    const int64_t most = (int64_t)STREAKS_DRAW_BLOCKS * STREAKS_BLOCK_WORDS;
    const int64_t room = words + words / 2 < most ? words + words / 2 : most;
    const bool fits = s->blocks->buf && (int64_t)s->blocks->buf->size >= words * 4;
    return (fits || rg_make_room(&s->base, s->blocks, room)) &&
           rg_buf_write(s->blocks->buf, 0,
                        s->selection.blocks + draw->first_block * STREAKS_BLOCK_WORDS, words * 4);
}

// What a local space of this top shows. A selection of one draw has its blocks on the device.
static bool select_blocks(struct streaks *s, const double eye[3], double top_m)
{
    return select_packets(s, eye, top_m) &&
           (s->selection.draw_count != 1 || write_blocks(s, &s->selection.draws[0]));
}

bool streaks_look(struct streaks *s)
{
    const struct streaks_settings *set = &s->settings;
    const struct rg_image_desc *desc = &s->base.target->desc;
    double eye[3];
    if (!streaks_observer_at(set, &s->camera, desc->width, desc->height, s->base.frame,
                             &s->observer))
        return false;
    rg_rain_eye(&s->space, &s->observer.camera, eye);
    const double top_m = rg_rain_local_top(eye[2], set->local_height_m);
    set_params(s, eye, top_m);
    if (!streaks_map_renew(s) || !select_blocks(s, eye, top_m))
        return false;
    if (s->particles_told)
        s->particles_told->number = (double)s->selection.particles;
    return true;
}

// Runs a stage over a draw's particles, whose blocks are on the device already where they are those
// of all draws.
static bool run_over(struct streaks *s, enum streaks_pass pass, const struct streaks_draw *draw)
{
    const struct rg_extent first = {0, 0, 0}, items = {draw->block_count * STREAKS_BLOCK, 1, 1};
    s->particles_now->buf = s->particles[draw->buffer];
    return (s->selection.draw_count == 1 || write_blocks(s, draw)) &&
           rg_stage_over(&s->base, s->first_stage + (int)pass, first, items);
}

// All that is selected, in a local space of this top.
static bool draw_rain_at(struct streaks *s, float top)
{
    s->of_rain = s->params;
    s->of_rain.top = top;
    for (int i = 0; i < s->selection.draw_count; i++) {
        const struct streaks_draw *draw = &s->selection.draws[i];
        s->base.counters[STREAKS_ITEMS].value += (int64_t)draw->block_count * STREAKS_BLOCK;
        if (!run_over(s, STREAKS_RAIN, draw))
            return false;
    }
    return true;
}

// The local space; without limits, all copies of it that reach into the rain space, each with what
// is seen of it.
static bool draw_rain(struct streaks *s)
{
    const double height_m = s->settings.local_height_m;
    double top_m = (double)s->params.top, eye[3];
    if (s->settings.limits)
        return draw_rain_at(s, s->params.top);
    rg_rain_eye(&s->space, &s->observer.camera, eye);
    top_m -= ceil(top_m / height_m) * height_m;
    for (; top_m < s->space.height_m; top_m += height_m)
        if (!select_blocks(s, eye, top_m) || !draw_rain_at(s, (float)top_m))
            return false;
    return true;
}

// --- a frame ---

// Each particle's place and state, for those who compare.
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

// What is drawn behind the rain, and over it.
static bool draw_far(struct streaks *s)
{
    return s->rain_alone || streaks_draw_far(s);
}

static bool draw_overlay(struct streaks *s)
{
    return s->rain_alone || !s->overlay || streaks_show(s);
}

static bool streaks_draw(struct rg_instance *instance)
{
    struct streaks *s = (struct streaks *)instance;
    const struct scenery_look look =
        s->settings.time == SCENERY_NIGHT ? scenery_night() : scenery_day();
    struct scenery_view view = {.colour = instance->target,
                                .depth = rg_asset_find(instance, "depth")->image};
    memcpy(&view.to_clip, s->observer.world_to_clip, sizeof(view.to_clip));
    memcpy(view.eye, s->observer.camera.position, sizeof(view.eye));
    instance->counters[STREAKS_PARTICLES].value += s->selection.particles;
    instance->counters[STREAKS_PACKETS].value += s->selection.packets;
    return scenery_draw(s->scene, &view, &look, s->lights, s->settings.geometry) && draw_far(s) &&
           draw_rain(s) && draw_overlay(s);
}

const struct rg_technique rg_technique_streaks = {
    .name = "streaks",
    .paper = "creus",
    .about = "rain as particles that fall through a city, with streaks, splashes and lights",
    .params = &streaks_param_table,
    .proof = &streaks_proof,
    .size = sizeof(struct streaks),
    .settings = offsetof(struct streaks, settings),
    .open = streaks_open,
    .close = streaks_close,
    .step = streaks_step,
    .draw = streaks_draw,
};
