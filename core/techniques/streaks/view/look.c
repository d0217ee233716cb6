// The observer's view of the current frame: the packets, and the view's parameters for kernels.
#include <math.h>

#include "core/scene/atlas/optics/drop.h"
#include "core/scene/atlas/splash.h"
#include "core/scene/matrix.h"
#include "core/techniques/streaks/instance.h"

// How far streaks and splashes of the largest and fastest drops reach from their particle, in
// metres.
static double splash_reach(const struct streaks *s)
{
    const double largest = 1.15; // size of the largest splash over the set size
    const struct streaks_settings *set = &s->settings;
    return set->splash_width_mm / 1000 * s->sizes.largest_m / RG_DROP_RADIUS_M * largest;
}

static double streak_length(const struct streaks *s)
{
    return s->sizes.fastest_m_s * s->settings.exposure_s;
}

static double reach_above(const struct streaks *s)
{
    const double splash = splash_reach(s), streak = streak_length(s) + 2 * s->sizes.largest_m;
    return streak + s->settings.splash_s * s->sizes.fastest_m_s + splash;
}

static bool select_packets(struct streaks *s, const double eye[3], double top_m)
{
    const struct streaks_settings *set = &s->settings;
    const struct rg_image_desc *desc = &s->base.target->desc;
    const double across_m = fmax(splash_reach(s), 2 * s->sizes.largest_m);
    struct streaks_view view = {
        .eye = {eye[0], eye[1], eye[2]},
        .radius_m = set->limits ? set->culling_radius_m : (double)INFINITY,
        .top_m = top_m,
        .run = streaks_sizes_differ(s)
                   ? 0
                   : rg_rain_run(set->fall_speed_m_s, set->step_s * (double)s->base.frame, top_m,
                                 set->local_height_m),
        .across_m = across_m,
        .above_m = reach_above(s),
        .below_m = across_m,
        .hull = set->select,
        .apart = streaks_sizes_differ(s),
        .whole = set->all_blocks || set->keeps_state,
        .sparse = set->sparse,
    };
    return rg_rain_view_corners(&s->space, &s->observer.camera, (double)desc->width / desc->height,
                                view.corners) &&
           streaks_select(s->rain->packets, &view, &s->selection);
}

// --- the kernels' parameters ---

static void set_looks(streaks_params *p, const struct streaks_settings *set,
                      const struct streaks_textures *textures)
{
    const double radius_m = set->drop_radius_mm / 1000;
    p->half_width = (float)(radius_m * RG_ATLAS_CELL_PX / (double)RG_ATLAS_DROP_PX);
    p->drop_radius = (float)radius_m;
    p->thinnest_px = set->points ? 0 : 1;
    const double fall_m = set->fall_speed_m_s * set->exposure_s;
    p->fall = (float)fall_m;
    p->behind = (float)(fall_m + radius_m);
    p->cycles = (float)(streaks_swings_a_second(radius_m) * set->exposure_s);
    p->cycles_per_m = (float)(streaks_swings_a_second(radius_m) / set->fall_speed_m_s);
    p->fall_speed = (float)set->fall_speed_m_s;
    p->splash_s = (float)set->splash_s;
    p->splash_width = (float)(set->splash_width_mm / 1000 * radius_m / RG_DROP_RADIUS_M);
    p->splash_height = p->splash_width * RG_SPLASH_HEIGHT_PX / RG_SPLASH_WIDTH_PX;
    p->splash_foot = (float)RG_SPLASH_FOOT_SHARE;
    p->follows = !set->splashes_upright;
    p->materials = set->splash_materials;
    p->drops = set->drops;
    p->splashes = set->splashes;
    p->paper_angles = set->absolute_views;
    p->first_level = textures->first_level;
    p->last_level = set->last_mip > textures->first_level ? set->last_mip : textures->first_level;
    p->gain = (float)set->streak_gain;
    p->opacity = (float)set->streak_opacity;
    p->splash_gain = (float)set->splash_gain;
    p->splash_opacity = (float)set->splash_opacity;
    p->splash_matt = set->splash_matt;
    const bool fades = set->limits && set->splash_fade > 0;
    p->splash_last = fades ? (float)(1 / set->splash_fade) : 1;
    p->splash_fade = fades ? (float)(1 / (set->splash_fade * set->culling_radius_m)) : 0;
}

// Sets the camera's matrix, rays and depth in the rain frame.
static void set_view(streaks_params *p, const struct rg_rain_space *space,
                     const struct streaks_observer *observer)
{
    const double near_m = (double)observer->camera.near_plane;
    const double far_m = (double)observer->camera.far_plane;
    float to_clip[16], rays[16], from_world[16];
    rg_rain_to_clip(space, observer->world_to_clip, to_clip);
    p->to_clip = rg_m4_of(to_clip);
    rg_rain_rays(space, observer->rays, rays);
    p->rays = rg_m4_of(rays);
    rg_rain_matrices(space, from_world, NULL);
    p->from_world = rg_m4_of(from_world);
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
    p->sizes = s->sizes.count;
    set_looks(p, set, s->textures);
}

// --- listing blocks ---

// The buffer begins with the size classes.
bool streaks_write_blocks(struct streaks *s, const struct streaks_draw *draw)
{
    const int64_t before = (int64_t)s->sizes.count * STREAKS_SIZE_WORDS;
    const int64_t words = (int64_t)draw->block_count * STREAKS_BLOCK_WORDS;
    const int64_t most = before + (int64_t)STREAKS_DRAW_BLOCKS * STREAKS_BLOCK_WORDS;
    const int64_t room = before + words + words / 2 < most ? before + words + words / 2 : most;
    const bool fits = s->blocks->buf && (int64_t)s->blocks->buf->size >= (before + words) * 4;
    return (fits || rg_make_room(&s->base, s->blocks, room)) &&
           rg_buf_write(s->blocks->buf, 0, s->sizes.words, before * 4) &&
           rg_buf_write(s->blocks->buf, before * 4,
                        s->selection.blocks + draw->first_block * STREAKS_BLOCK_WORDS, words * 4);
}

bool streaks_select_blocks(struct streaks *s, const double eye[3], double top_m)
{
    streaks_sizes_turn(s, top_m);
    return select_packets(s, eye, top_m) &&
           (s->selection.draw_count != 1 || streaks_write_blocks(s, &s->selection.draws[0]));
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
    if (!streaks_map_renew(s) || !streaks_select_blocks(s, eye, top_m) || !streaks_outside_look(s))
        return false;
    if (s->particles_told)
        s->particles_told->number = (double)s->selection.particles;
    return true;
}
