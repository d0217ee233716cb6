// streaks: rain as particles that fall through a scene, lit by a database of streaks (C. Creus,
// "Real-time rendering of rain", 2010). The order of the passes stands here; open.c makes
// what they run on, kernels/streaks_*.h is what they compute, and docs/streaks.md explains.
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
        .run = streaks_run(set->fall_speed_m_s, set->step_s * (double)s->base.frame, top_m,
                           set->local_height_m),
        .across_m = fmax(splash, 2 * margin(set)),
        .above_m = streak + set->splash_s * set->fall_speed_m_s + splash,
        .below_m = fmax(2 * margin(set), splash),
        .hull = set->select,
        .whole = set->all_blocks || set->keeps_state,
    };
    return streaks_view_corners(&s->space, &s->observer.camera, (double)desc->width / desc->height,
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
static void set_view(streaks_params *p, const struct streaks_rain_space *space,
                     const struct streaks_observer *observer)
{
    const double near_m = (double)observer->camera.near_plane;
    const double far_m = (double)observer->camera.far_plane;
    float to_clip[16], rays[16];
    streaks_rain_to_clip(space, observer->world_to_clip, to_clip);
    memcpy(&p->to_clip, to_clip, sizeof(p->to_clip));
    streaks_rain_rays(space, observer->rays, rays);
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
    streaks_rain_direction(&s->space, up, up_rain);
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
    const int64_t bytes = (int64_t)draw->block_count * STREAKS_BLOCK_WORDS * 4;
    if (!s->blocks || (int64_t)s->blocks->size < bytes) {
        const int64_t most = (int64_t)STREAKS_DRAW_BLOCKS * STREAKS_BLOCK_WORDS * 4;
        const int64_t room = bytes + bytes / 2 < most ? bytes + bytes / 2 : most;
        rg_buf_destroy(s->blocks);
        s->blocks = rg_buf_create(s->base.device, room / 4 * 4, "blocks");
    }
    return s->blocks &&
           rg_buf_write(s->blocks, 0, s->selection.blocks + draw->first_block * STREAKS_BLOCK_WORDS,
                        bytes);
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
    streaks_rain_eye(&s->space, &s->observer.camera, eye);
    const double top_m = streaks_local_top(eye[2], set->local_height_m);
    set_params(s, eye, top_m);
    if (!streaks_map_renew(s) || !select_blocks(s, eye, top_m))
        return false;
    s->base.facts[STREAKS_FACT_PARTICLES].number = (double)s->selection.particles;
    return true;
}

static struct rg_run run_over(const struct streaks *s, const struct streaks_draw *draw,
                              const streaks_params *p)
{
    return (struct rg_run){.params = p,
                           .slots = {[1].buf = s->particles[draw->buffer],
                                     [2].buf = s->blocks,
                                     [3].image = s->map->depths,
                                     [10].image = s->map->numbers,
                                     [11].buf = scenery_surfaces(s->scene)},
                           .extent = {draw->block_count * STREAKS_BLOCK, 1, 1}};
}

static bool draw_blocks(struct streaks *s, const struct streaks_draw *draw, const streaks_params *p)
{
    const struct rg_draw onto = {.colour = s->base.target,
                                 .depth = s->depth,
                                 .blend = RG_BLEND_OVER,
                                 .depth_mode = RG_DEPTH_TEST};
    struct rg_run run = run_over(s, draw, p);
    run.draw = &onto;
    run.slots[4].image = s->textures->points;
    run.slots[5].image = s->textures->skies;
    run.slots[6].image = s->textures->crowns;
    run.slots[7].buf = s->textures->factors;
    run.slots[8].buf = s->lights->in_frame;
    run.slots[9].image = s->lights->shadows;
    s->base.counters[STREAKS_ITEMS].value += run.extent.width;
    return rg_instance_run(&s->base, s->rain, &run);
}

static bool ready_blocks(struct streaks *s, const struct streaks_draw *draw)
{
    return s->selection.draw_count == 1 || write_blocks(s, draw);
}

// All that is selected, in a local space of this top.
static bool draw_rain_at(struct streaks *s, float top)
{
    streaks_params p = s->params;
    p.top = top;
    for (int i = 0; i < s->selection.draw_count; i++) {
        const struct streaks_draw *draw = &s->selection.draws[i];
        if (!ready_blocks(s, draw) || !draw_blocks(s, draw, &p))
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
    streaks_rain_eye(&s->space, &s->observer.camera, eye);
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
    rg_buf_destroy(s->places);
    s->base.state_count = 0;
    s->places =
        rg_buf_create(s->base.device, items ? items * STREAKS_STATE_WORDS * 4 : 4, "places");
    if (!s->places || !items)
        return s->places;
    streaks_params p = s->params;
    for (int i = 0; i < s->selection.draw_count; i++) {
        const struct streaks_draw *draw = &s->selection.draws[i];
        struct rg_run run = run_over(s, draw, &p);
        run.slots[4].buf = s->places;
        if (!ready_blocks(s, draw) || !rg_instance_run(&s->base, s->state, &run))
            return false;
        p.first_place += run.extent.width;
    }
    s->base.state_count = 1;
    s->base.state[0] = (struct rg_state){
        .name = "places", .buf = s->places, .is_float = true, .row = STREAKS_STATE_WORDS};
    return true;
}

static bool streaks_step(struct rg_instance *instance)
{
    struct streaks *s = (struct streaks *)instance;
    instance->frame++;
    return streaks_look(s) && (!s->state || keep_state(s));
}

static bool streaks_draw(struct rg_instance *instance)
{
    struct streaks *s = (struct streaks *)instance;
    const struct scenery_look look =
        s->settings.time == SCENERY_NIGHT ? scenery_night() : scenery_day();
    struct scenery_view view = {.colour = instance->target, .depth = s->depth};
    memcpy(&view.to_clip, s->observer.world_to_clip, sizeof(view.to_clip));
    memcpy(view.eye, s->observer.camera.position, sizeof(view.eye));
    instance->counters[STREAKS_PARTICLES].value += s->selection.particles;
    instance->counters[STREAKS_PACKETS].value += s->selection.packets;
    return scenery_draw(s->scene, instance, &view, &look, s->lights, s->settings.geometry) &&
           (!s->far || streaks_draw_far(s)) && draw_rain(s) && (!s->overlay || streaks_show(s));
}

const struct rg_technique rg_technique_streaks = {
    .name = "streaks",
    .paper = "creus",
    .about = "rain as particles that fall through a city, with streaks, splashes and lights",
    .params = &streaks_param_table,
    .proof = &streaks_proof,
    .create = streaks_open,
    .destroy = streaks_close,
    .step = streaks_step,
    .draw = streaks_draw,
};
