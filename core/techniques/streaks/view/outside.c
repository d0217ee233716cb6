// The view from outside: a second camera looks at the rain space, or at the volume of rain around
// the observer, as in figures 4.1 to 4.15 of Creus's thesis. It shows the packets that the observer
// has selected.
#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/scene/matrix.h"
#include "core/scene/vector.h"
#include "core/techniques/streaks/instance.h"

// In the order of the parameters' choices.
enum { OUTSIDE_OFF, OUTSIDE_SPACE, OUTSIDE_VOLUME, OUTSIDE_FRUSTUM };
enum { MAP_NONE, MAP_DENSITY, MAP_DEPTH };

const struct streaks_observer *streaks_viewer(const struct streaks *s)
{
    return s->settings.outside ? &s->outside : &s->observer;
}

bool streaks_outside_open(struct streaks *s)
{
    if (!s->settings.far_layers && (!s->settings.outside || s->settings.outside_map != MAP_DENSITY))
        return true;
    return streaks_density_open(s);
}

void streaks_outside_close(struct streaks *s)
{
    rg_image_destroy(s->density);
}

// --- the rain space as a frustum ---

// Its camera is a quarter of the rain space's height above the top.
double streaks_narrowing(const struct streaks *s)
{
    const double camera_m = 1.25 * s->space.height_m;
    return s->settings.outside == OUTSIDE_FRUSTUM ? 1 / camera_m : 0;
}

void streaks_world_point(const struct streaks *s, const double rain[3], double world[3])
{
    const double wide = 1 - streaks_narrowing(s) * (s->space.height_m - rain[2]);
    const double narrowed[3] = {rain[0] * wide, rain[1] * wide, rain[2]};
    rg_rain_world_point(&s->space, narrowed, world);
}

// --- the second camera ---

// The corners, in the world, of the volume to look at.
static void find_corners(const struct streaks *s, double corners[8][3])
{
    const streaks_params *p = &s->params;
    const bool space = s->settings.outside == OUTSIDE_SPACE || !s->settings.limits;
    const double x = space ? 0 : (double)p->eye_x, y = space ? 0 : (double)p->eye_y;
    const double half_x = space ? s->space.half_x_m : (double)p->radius;
    const double half_y = space ? s->space.half_y_m : (double)p->radius;
    const double top = space ? 0 : (double)p->top;
    const double height = space ? s->space.height_m : (double)p->local_height;
    for (int k = 0; k < 8; k++) {
        const double rain[3] = {x + (k & 1 ? half_x : -half_x), y + (k & 2 ? half_y : -half_y),
                                top + (k & 4 ? height : 0)};
        streaks_world_point(s, rain, corners[k]);
    }
}

// The distance from the middle at which a camera sees a point that is `beside` its axis and `ahead`
// of the middle; `tangent` is that of half the angle of view.
static double distance_for(double beside, double ahead, double tangent)
{
    return fabs(beside) / tangent - ahead;
}

// Moves the camera back from the corners' middle until all corners are in the picture, with a
// margin.
static void step_back(struct rg_camera *camera, double corners[8][3], double aspect)
{
    const double margin = 0.94, tangent = margin * tan((double)camera->angle_deg / 360 * M_PI);
    const struct rg_camera_axes axes = rg_camera_axes(camera);
    double distance = 1, reach = 0;
    for (int k = 0; k < 8; k++) {
        double from[3];
        for (int i = 0; i < 3; i++)
            from[i] = corners[k][i] - (double)camera->target[i];
        const double ahead = rg_dot(from, axes.ahead);
        distance = fmax(distance, distance_for(rg_dot(from, axes.right), ahead, tangent * aspect));
        distance = fmax(distance, distance_for(rg_dot(from, axes.up), ahead, tangent));
        reach = fmax(reach, sqrt(rg_dot(from, from)));
    }
    for (int i = 0; i < 3; i++)
        camera->position[i] = camera->target[i] - (float)(axes.ahead[i] * distance);
    camera->near_plane = (float)fmax(0.01 * distance, distance - 4 * reach);
    camera->far_plane = (float)(distance + 4 * reach);
}

bool streaks_outside_look(struct streaks *s)
{
    const struct streaks_settings *set = &s->settings;
    const struct rg_image_desc *desc = &s->base.target->desc;
    const double turn = set->outside_turn_deg / 180 * M_PI,
                 rise = set->outside_rise_deg / 180 * M_PI;
    const double towards[3] = {cos(rise) * cos(turn), sin(rise), cos(rise) * sin(turn)};
    struct rg_camera camera = {.up = {0, 1, 0}, .angle_deg = 30, .near_plane = 1, .far_plane = 2};
    double corners[8][3];
    if (set->outside == OUTSIDE_OFF)
        return true;
    find_corners(s, corners);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 8; k++)
            camera.target[i] += (float)(corners[k][i] / 8);
        camera.position[i] = camera.target[i] + (float)towards[i];
    }
    step_back(&camera, corners, (double)desc->width / desc->height);
    return streaks_observer_of(&camera, desc->width, desc->height, &s->outside);
}

// --- drawing ---

// From outside a streak would be a speck, so marks are wide and long enough to be seen.
void streaks_outside_marks(const struct streaks *s, streaks_params *p)
{
    const double wide_px = 1.5, long_px = 6;
    const struct rg_camera *camera = &s->outside.camera;
    double away = 0;
    for (int i = 0; i < 3; i++)
        away = hypot(away, (double)camera->position[i] - (double)camera->target[i]);
    float to_clip[16];
    rg_rain_to_clip(&s->space, s->outside.world_to_clip, to_clip);
    p->to_clip = rg_m4_of(to_clip);
    p->thinnest_px = (float)wide_px;
    p->fall = (float)fmax((double)p->fall, long_px * away / (double)s->outside.focal_px);
}

static void in_world(const struct streaks *s, double x, double y, double world[3])
{
    const double rain[3] = {x, y, 0};
    streaks_world_point(s, rain, world);
}

bool streaks_outside_map(struct streaks *s)
{
    const streaks_params *p = &s->params;
    const bool density = s->settings.outside_map == MAP_DENSITY;
    if (s->settings.outside_map == MAP_NONE)
        return true;
    const double x = density ? -s->space.half_x_m : (double)p->map_x;
    const double y = density ? -s->space.half_y_m : (double)p->map_y;
    const double wide = density ? 2 * s->space.half_x_m : 1 / (double)p->map_per_x;
    const double deep = density ? 2 * s->space.half_y_m : 1 / (double)p->map_per_y;
    double corner[3], across[3], down[3];
    in_world(s, x, y, corner);
    in_world(s, x + wide, y, across);
    in_world(s, x, y + deep, down);
    const scenery_plate_params plate = {.to_clip = rg_m4_of(s->outside.world_to_clip),
                                        .corner_x = (float)corner[0],
                                        .corner_y = (float)corner[1],
                                        .corner_z = (float)corner[2],
                                        .across_x = (float)(across[0] - corner[0]),
                                        .across_y = (float)(across[1] - corner[1]),
                                        .across_z = (float)(across[2] - corner[2]),
                                        .down_x = (float)(down[0] - corner[0]),
                                        .down_y = (float)(down[1] - corner[1]),
                                        .down_z = (float)(down[2] - corner[2]),
                                        .white_at = density ? 1 : 0,
                                        .black_at = density ? 0 : 1};
    return scenery_overlay_plate(s->overlay, &plate, density ? s->density : s->map->depths,
                                 s->base.target, rg_asset_find(&s->base, "depth")->image);
}
