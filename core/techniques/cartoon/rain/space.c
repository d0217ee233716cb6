// The parameters of the rain's kernels: the place where drops start, how long they live, how many
// there may be.
#include <math.h>

#include "core/base/log.h"
#include "core/scene/matrix.h"
#include "core/techniques/cartoon/rain/rain.h"

// Drops whose ground is hidden or outside the picture fall down to here.
#define FLOOR_M    (-0.5)
#define LAYER_M    1.0 // thickness of the layer where drops start, against sheets of drops
#define SLOWEST    0.8 // speed of the lightest drops over that of the heaviest
#define LEAST      0.4 // size of the lightest drops over that of the heaviest
#define LONGEST_S  60.0
#define MOST_BYTES 2e9

// Defaults as shares of the camera's distance, for settings that the user leaves to the scene.
#define DROP_SHARE   0.022
#define SPLASH_SHARE 0.030
#define BOUND_PX     2.5

int64_t cartoon_released_before(const struct cartoon_rain_settings *settings, int64_t step)
{
    return step * settings->drops_s / settings->steps_s;
}

static double focal_px(const struct cartoon_rain *r)
{
    return r->instance->target->desc.height / 2.0 /
           tan((double)r->scene.camera->angle_deg * M_PI / 360);
}

// --- a drop's way ---

struct way {
    int steps;
    double aside[2]; // drift by the wind, along x and z
};

// The fall of the slowest drop from a height to a lower one, in metres above the ground.
static struct way way_down(const cartoon_rain_params *p, double from_m, double to_m)
{
    struct way w = {0};
    const double dt = (double)p->step_s, push[2] = {(double)p->push_x, (double)p->push_z};
    double v[3] = {0, -(double)p->speed_m_s * (double)p->slow * (double)p->spread_cos, 0};
    for (double y = from_m; y >= to_m && w.steps * dt < LONGEST_S; w.steps++) {
        const double tx = v[0] - push[0], tz = v[2] - push[1];
        const double k = (double)p->drag_1_m * sqrt(tx * tx + v[1] * v[1] + tz * tz);
        const bool is_constant = p->drag == CARTOON_DRAG_CONSTANT;
        y += v[1] * dt;
        w.aside[0] += v[0] * dt;
        w.aside[1] += v[2] * dt;
        v[0] += (is_constant ? push[0] : -k * tx) * dt;
        v[1] += ((is_constant ? (double)p->drag_m_s2 : -k * v[1]) - (double)p->gravity_m_s2) * dt;
        v[2] += (is_constant ? push[1] : -k * tz) * dt;
    }
    return w;
}

// --- parameters ---

static cartoon_rain_params fixed_params(const struct cartoon_rain *r, int seed)
{
    const struct cartoon_rain_settings *s = r->settings;
    const double distance_m = r->scene.diorama->view.distance_m, step_s = 1.0 / s->steps_s;
    const double bound_m = s->bound_m > 0 ? s->bound_m : BOUND_PX * distance_m / focal_px(r);
    return (cartoon_rain_params){
        .seed = (uint32_t)seed,
        .wide_y = (float)LAYER_M,
        .speed_m_s = (float)s->speed_m_s,
        .slow = (float)SLOWEST,
        .spread_cos = (float)cos(s->spread_deg * M_PI / 180),
        .step_s = (float)step_s,
        .gravity_m_s2 = (float)s->gravity_m_s2,
        .drag = s->drag,
        .drag_m_s2 = (float)s->drag_m_s2,
        .drag_1_m = (float)s->drag_1_m,
        .floor_m = (float)FLOOR_M,
        .fade_steps = (int)fmax(lround(s->fade_s / step_s), 1),
        .spray_steps = (int)fmax(lround(s->splash_s / step_s), 1),
        .collide = s->collide,
        .least_samples = s->least_samples,
        .bound_m = (float)bound_m,
        .precision_m = (float)s->precision_m,
        .drop_m = (float)(s->drop_m > 0 ? s->drop_m : DROP_SHARE * distance_m),
        .splash_m = (float)(s->splash_m > 0 ? s->splash_m : SPLASH_SHARE * distance_m),
        .least = (float)LEAST,
        .cut = s->cut,
    };
}

// The height at which drops start: above the scene, and at least as far as a drop falls in a
// second.
static double top_m(const struct cartoon_rain *r, const cartoon_rain_params *p)
{
    const struct cartoon_rain_settings *s = r->settings;
    if (s->top_m > 0)
        return s->top_m;
    const double pull = (double)p->gravity_m_s2 - (double)p->drag_m_s2;
    return fmax((double)r->scene.diorama->mesh->high[1] + 1, s->speed_m_s + fmax(pull, 0) / 2);
}

// Computes the number of slots. A drop lives for at most life_steps and fades before its slot is
// free, and makes one splash.
static bool find_slots(const struct cartoon_rain_settings *s, cartoon_rain_params *p)
{
    const double a_step = (double)s->drops_s / s->steps_s;
    const double drops = ceil(a_step * (p->life_steps + p->fade_steps + 2)) + 1;
    const double sprays = ceil(a_step * (p->life_steps + p->spray_steps + 2)) + 1;
    const double bytes = drops * (sizeof(cartoon_raindrop) + sizeof(cartoon_surface) + 24) +
                         sprays * (sizeof(cartoon_spray) + 16);
    if (bytes > MOST_BYTES)
        return rg_error("drops_s: of %d drops a second %.3g are in the air, which take %.3g GB of "
                        "the %.3g GB that there may be; lower it",
                        s->drops_s, drops, bytes * 1e-9, MOST_BYTES * 1e-9);
    p->drop_slots = (int)drops;
    p->spray_slots = (int)sprays;
    return true;
}

bool cartoon_rain_fill(struct cartoon_rain *r, int seed)
{
    const struct cartoon_rain_settings *s = r->settings;
    cartoon_rain_params *p = &r->params;
    if (s->wind == CARTOON_WIND_SCRIPT && !cartoon_wind_read(s->wind_script, &r->script))
        return false;
    *p = fixed_params(r, seed);
    r->fall_m = top_m(r, p);
    p->life_steps = way_down(p, r->fall_m + LAYER_M, FLOOR_M).steps * 5 / 4;
    if (p->life_steps >= LONGEST_S * s->steps_s)
        return rg_error("speed_m_s: drops take more than %g s down from %.3g m; raise it, or lower "
                        "the drag",
                        LONGEST_S, r->fall_m);
    return find_slots(s, p);
}

// --- each frame ---

// With constant drag, the wind is a force that brings a drop to the wind's speed within wind_s.
static void blow(struct cartoon_rain *r, double time_s)
{
    const struct cartoon_rain_settings *s = r->settings;
    cartoon_rain_params *p = &r->params;
    double wind[2];
    cartoon_wind_at(s, &r->script, p->seed, time_s, wind);
    const double over = s->drag == CARTOON_DRAG_CONSTANT ? s->wind_s : 1;
    p->push_x = (float)(wind[0] / over);
    p->push_z = (float)(wind[1] / over);
}

// Places the area where drops start: over the scene, and as far upwind as drops drift while
// falling.
static void place(struct cartoon_rain *r)
{
    cartoon_rain_params *p = &r->params;
    const struct rg_mesh *mesh = r->scene.diorama->mesh;
    const struct way w = way_down(p, r->fall_m, 0);
    p->low_x = (float)((double)mesh->low[0] - fmax(w.aside[0], 0));
    p->low_y = (float)r->fall_m;
    p->low_z = (float)((double)mesh->low[2] - fmax(w.aside[1], 0));
    p->wide_x = (float)((double)mesh->high[0] - (double)mesh->low[0] + fabs(w.aside[0]));
    p->wide_z = (float)((double)mesh->high[2] - (double)mesh->low[2] + fabs(w.aside[1]));
}

static void look(struct cartoon_rain *r)
{
    cartoon_rain_params *p = &r->params;
    const struct rg_camera *camera = r->scene.camera;
    const struct rg_camera_axes axes = rg_camera_axes(camera);
    const double near_m = (double)camera->near_plane, far_m = (double)camera->far_plane;
    p->to_clip = *r->scene.to_clip;
    p->width = r->instance->target->desc.width;
    p->height = r->instance->target->desc.height;
    p->focal_px = (float)focal_px(r);
    p->depth_at = (float)(far_m / (far_m - near_m));
    p->depth_by = (float)(-far_m * near_m / (far_m - near_m));
    p->eye_x = camera->position[0];
    p->eye_y = camera->position[1];
    p->eye_z = camera->position[2];
    p->right_x = (float)axes.right[0];
    p->right_y = (float)axes.right[1];
    p->right_z = (float)axes.right[2];
    p->up_x = (float)axes.up[0];
    p->up_y = (float)axes.up[1];
    p->up_z = (float)axes.up[2];
}

void cartoon_rain_refill(struct cartoon_rain *r)
{
    const struct cartoon_rain_settings *s = r->settings;
    const int64_t step = r->instance->frame - 1; // the step being made
    const int64_t before = step >= 0 ? cartoon_released_before(s, step) : 0;
    const int64_t after = step >= 0 ? cartoon_released_before(s, step + 1) : 0;
    r->params.released = (int)(after - before);
    r->params.released_before = (uint32_t)before;
    blow(r, (double)r->instance->frame / s->steps_s);
    place(r);
    look(r);
}
