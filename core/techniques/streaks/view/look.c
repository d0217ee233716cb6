// What the observer sees at the present frame: the packets, and what kernels are told of the view.
#include <math.h>

#include "core/scene/matrix.h"
#include "core/techniques/streaks/instance.h"

// How far streaks and splashes reach from their particle, in metres.
static double splash_reach(const struct streaks_settings *set)
{
    const double largest = 1.15; // of a splash, by the size that is set
    return set->splash_width_mm / 1000 * largest;
}

static double streak_length(const struct streaks_settings *set)
{
    return set->fall_speed_m_s * set->exposure_s;
}

// The margin around the drop in the atlas' pictures.
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

// --- the kernels' parameters ---

// Rayleigh's frequency of a drop of water; the second swing of the atlas is twice as fast.
static double swings_a_second(double radius_m)
{
    const double tension_n_m = 0.0728, density_kg_m3 = 1000;
    return sqrt(8 * tension_n_m / (density_kg_m3 * pow(radius_m, 3))) / (2 * M_PI);
}

static void set_looks(streaks_params *p, const struct streaks_settings *set,
                      const struct streaks_textures *textures)
{
    const double radius_m = set->drop_radius_mm / 1000;
    p->half_width = (float)(radius_m * RG_ATLAS_CELL_PX / (double)RG_ATLAS_DROP_PX);
    p->drop_radius = (float)radius_m;
    p->thinnest_px = set->points ? 0 : 1;
    p->fall = (float)streak_length(set);
    p->behind = (float)(streak_length(set) + radius_m);
    p->cycles = (float)(swings_a_second(radius_m) * set->exposure_s);
    p->cycles_per_m = (float)(swings_a_second(radius_m) / set->fall_speed_m_s);
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
    p->to_clip = rg_m4_of(to_clip);
    rg_rain_rays(space, observer->rays, rays);
    p->rays = rg_m4_of(rays);
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

// --- which blocks are drawn ---

bool streaks_write_blocks(struct streaks *s, const struct streaks_draw *draw)
{
    const int64_t words = (int64_t)draw->block_count * STREAKS_BLOCK_WORDS;
    const int64_t most = (int64_t)STREAKS_DRAW_BLOCKS * STREAKS_BLOCK_WORDS;
    const int64_t room = words + words / 2 < most ? words + words / 2 : most;
    const bool fits = s->blocks->buf && (int64_t)s->blocks->buf->size >= words * 4;
    return (fits || rg_make_room(&s->base, s->blocks, room)) &&
           rg_buf_write(s->blocks->buf, 0,
                        s->selection.blocks + draw->first_block * STREAKS_BLOCK_WORDS, words * 4);
}

bool streaks_select_blocks(struct streaks *s, const double eye[3], double top_m)
{
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
