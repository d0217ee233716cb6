// The view of the scene: camera, light, and the kernels' parameters for them.
#include <math.h>

#include "core/base/log.h"
#include "core/scene/matrix.h"
#include "core/techniques/cartoon/instance.h"

// A direction turned about the upright axis from +z, and raised above the horizon.
static void direction_of(double turn_deg, double rise_deg, double direction[3])
{
    const double turn = turn_deg * M_PI / 180, rise = rise_deg * M_PI / 180;
    direction[0] = cos(rise) * sin(turn);
    direction[1] = sin(rise);
    direction[2] = cos(rise) * cos(turn);
}

static struct rg_camera camera_of(const struct cartoon *c, int64_t frame)
{
    const struct diorama_view *v = &c->diorama->view;
    const struct cartoon_settings *s = &c->settings;
    const double spun_deg = fmod((double)frame * s->spin_deg, 360);
    const double distance_m = v->distance_m / s->zoom;
    double towards[3];
    direction_of(v->turn_deg + s->turn_deg + spun_deg, v->rise_deg + s->rise_deg, towards);
    struct rg_camera camera = {
        .up = {0, 1, 0},
        .angle_deg = (float)v->angle_deg,
        .near_plane = (float)(distance_m / 50),
        .far_plane = (float)(distance_m * 20),
    };
    for (int i = 0; i < 3; i++) {
        camera.target[i] = (float)v->look_at_m[i];
        camera.position[i] = (float)(v->look_at_m[i] + towards[i] * distance_m);
    }
    return camera;
}

// The size in pixels of a thing as wide as its distance.
static double focal_px_of(const struct cartoon *c)
{
    const double half = (double)c->view.camera.angle_deg / 360 * M_PI;
    return c->base.target->desc.height / (2 * tan(half));
}

static cartoon_shade_params shade_of(const struct cartoon *c)
{
    const struct cartoon_settings *s = &c->settings;
    const struct cartoon_view *v = &c->view;
    const double focal_px = focal_px_of(c);
    const double tile_m = s->hatch_px * c->diorama->view.distance_m / focal_px;
    const float *sky = c->diorama->sky, *low = c->diorama->low_sky;
    return (cartoon_shade_params){
        .from_pixel = v->from_pixel,
        .eye_x = v->camera.position[0],
        .eye_y = v->camera.position[1],
        .eye_z = v->camera.position[2],
        .light_x = v->to_light[0],
        .light_y = v->to_light[1],
        .light_z = v->to_light[2],
        .height_px = (float)c->base.target->desc.height,
        .sky_r = sky[0],
        .sky_g = sky[1],
        .sky_b = sky[2],
        .low_r = low[0],
        .low_g = low[1],
        .low_b = low[2],
        .inked = c->edge_count > 0,
        .ink_r = (float)s->ink[0],
        .ink_g = (float)s->ink[1],
        .ink_b = (float)s->ink[2],
        .paper_r = (float)s->paper[0],
        .paper_g = (float)s->paper[1],
        .paper_b = (float)s->paper[2],
        .blue = (float)s->gooch_blue,
        .yellow = (float)s->gooch_yellow,
        .alpha = (float)s->gooch_alpha,
        .beta = (float)s->gooch_beta,
        .shadow_tone = (float)s->shadow_tone,
        .middle_tone = (float)s->middle_tone,
        .middle_from = (float)s->middle_from,
        .lit_from = (float)s->lit_from,
        .per_softness = (float)(1 / s->tone_softness),
        .glint_from = (float)s->glint_from,
        .shadow_blue = (float)s->shadow_blue,
        .lit = (float)s->hatch_lit,
        .ambient = (float)s->hatch_ambient,
        .wash = (float)s->hatch_wash,
        .per_tile = (float)(1 / tile_m),
        .lod = (float)log2(CARTOON_TILE_PX / (tile_m * focal_px)),
    };
}

static cartoon_ink_params outlines_of(const struct cartoon *c)
{
    const struct cartoon_settings *s = &c->settings;
    const struct rg_camera *camera = &c->view.camera;
    const struct rg_camera_axes axes = rg_camera_axes(camera);
    const double px = 1 / focal_px_of(c);
    const double near_plane = (double)camera->near_plane, far_plane = (double)camera->far_plane;
    return (cartoon_ink_params){
        .to_clip = c->view.to_clip,
        .eye_x = camera->position[0],
        .eye_y = camera->position[1],
        .eye_z = camera->position[2],
        .right_x = (float)(axes.right[0] * px),
        .right_y = (float)(axes.right[1] * px),
        .right_z = (float)(axes.right[2] * px),
        .down_x = (float)(-axes.up[0] * px),
        .down_y = (float)(-axes.up[1] * px),
        .down_z = (float)(-axes.up[2] * px),
        .depth_fall = (float)(far_plane * near_plane / (far_plane - near_plane)),
        .cos_crease = (float)cos(s->crease_deg * M_PI / 180),
        .contour_px = (float)(s->outline_px * c->diorama->view.pen),
        .crease_px = (float)(s->inner_px * c->diorama->view.pen),
        .full_m = (float)(c->diorama->view.distance_m),
        .count = c->edge_count,
    };
}

bool cartoon_look(struct cartoon *c, int64_t frame)
{
    const struct rg_image_desc *target = &c->base.target->desc;
    const struct cartoon_settings *s = &c->settings;
    struct cartoon_view *v = &c->view;
    float to_clip[16];
    double to_light[3];
    v->camera = camera_of(c, frame);
    if (!(v->camera.position[1] > 0))
        return rg_error("camera: its eye is %.3g m below the ground; raise rise_deg",
                        -(double)v->camera.position[1]);
    if (!rg_camera_matrix(&v->camera, (float)target->width / (float)target->height, to_clip) ||
        !rg_camera_view(&v->camera, v->to_eye))
        return false;
    v->to_clip = rg_m4_of(to_clip);
    if (!rg_matrix_from_pixel(&v->to_clip, target->width, target->height, &v->from_pixel))
        return rg_error("camera: its matrix maps space to less; change zoom");
    direction_of(c->diorama->view.turn_deg + s->light_turn_deg, s->light_rise_deg, to_light);
    for (int i = 0; i < 3; i++)
        v->to_light[i] = (float)to_light[i];
    c->solids = (cartoon_faces_params){v->to_clip, 0};
    c->thin = (cartoon_faces_params){v->to_clip, c->diorama->solid_faces};
    c->outlines = outlines_of(c);
    c->shade = shade_of(c);
    return true;
}
