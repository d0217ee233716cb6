// The host's part of flow's drawing: the camera, and the drawing passes' parameters.
#include "core/techniques/flow/inputs/flow.h"

#include <math.h>

#include "core/scene/camera.h"
#include "core/scene/matrix.h"

enum { AMBIENT_PX = 8 }; // texels along a face of the ambient level

// The distance by which a drop displaces the picture seen through a pane, in heights of the view.
// It is for a normal parallel to the pane and a refraction_strength of 1.
#define LENS_REACH 0.2

static int level_of(const struct flow_settings *s, int px)
{
    int level = 0;
    while (s->environment_px >> (level + 1) >= px)
        level++;
    return level;
}

int flow_reflection_level(const struct flow_settings *s)
{
    return level_of(s, s->reflection_px);
}

static int ambient_level(const struct flow_settings *s)
{
    return level_of(s, AMBIENT_PX);
}

int flow_environment_levels(const struct flow_settings *s)
{
    const int reflection = flow_reflection_level(s), ambient = ambient_level(s);
    return (reflection > ambient ? reflection : ambient) + 1;
}

double flow_distance_mm(const struct flow_settings *s, int64_t frame)
{
    const double nearest = fmin(s->distance_mm, (sqrt(3) + 1) / 2 * s->pane_mm);
    return fmax(s->distance_mm + s->camera_mm_s * s->step_s * (double)frame, nearest);
}

int flow_texels(const struct flow_settings *s, int64_t frame, int height_px)
{
    if (s->texels_a_pixel <= 0)
        return s->resolution_px;
    // The pixels covered by a pane's side at the distance of the box's middle.
    const double half = tan(s->view_angle_deg * M_PI / 360);
    const double px = s->view == FLOW_BOX
                          ? height_px * s->pane_mm / (2 * flow_distance_mm(s, frame) * half)
                          : height_px;
    int texels = s->resolution_px;
    while (texels / 2 >= px * s->texels_a_pixel && texels / 2 >= 4 * FLOW_MARGIN)
        texels /= 2;
    return texels;
}

static void direction_of(double azimuth_deg, double elevation_deg, double d[3])
{
    const double a = azimuth_deg * M_PI / 180, e = elevation_deg * M_PI / 180;
    d[0] = sin(a) * cos(e);
    d[1] = sin(e);
    d[2] = cos(a) * cos(e);
}

// The matrix of rays through pixels: `right` and `down` are one pixel, `ahead` is the view's
// middle, all from the eye.
static m4 rays_of(double right[3], double down[3], double ahead[3], double eye[3], int width,
                  int height)
{
    float m[16] = {0};
    for (int i = 0; i < 3; i++) {
        m[4 * i] = (float)right[i];
        m[4 * i + 1] = (float)down[i];
        m[4 * i + 2] =
            (float)(ahead[i] - right[i] * (0.5 * width - 0.5) - down[i] * (0.5 * height - 0.5));
        m[4 * i + 3] = (float)eye[i];
    }
    return rg_m4_of(m);
}

// The view of one pane that fills the target, whatever its shape, seen along its normal.
static void see_pane(const struct flow_settings *s, int64_t frame, int width, int height,
                     flow_view_params *p)
{
    double axes[3][3], right[3], down[3], ahead[3], eye[3];
    flow_pane_frame(s, 0, frame, axes);
    const double pixel = 2 * tan(s->view_angle_deg * M_PI / 360) / height;
    float to_clip[16] = {[11] = 0.5f, [15] = 1};
    for (int i = 0; i < 3; i++) {
        to_clip[i] = (float)axes[0][i];
        to_clip[4 + i] = (float)axes[1][i];
        right[i] = pixel * axes[0][i];
        down[i] = pixel * axes[1][i];
        ahead[i] = -axes[2][i];
        eye[i] = 2 * axes[2][i];
    }
    p->to_clip = rg_m4_of(to_clip);
    p->rays = rays_of(right, down, ahead, eye, width, height);
}

static bool see_box(const struct flow_settings *s, int64_t frame, int width, int height,
                    flow_view_params *p)
{
    double eye[3], right[3], down[3], ahead[3];
    direction_of(s->camera_azimuth_deg, s->camera_elevation_deg, eye);
    const double distance = flow_distance_mm(s, frame) * 2 / s->pane_mm;
    for (int i = 0; i < 3; i++)
        eye[i] *= distance;
    const struct rg_camera camera = {
        .position = {(float)eye[0], (float)eye[1], (float)eye[2]},
        .up = {0, 1, 0},
        .angle_deg = (float)s->view_angle_deg,
        .near_plane = 0.02f,
        .far_plane = (float)(distance + 8),
    };
    float view[16], to_clip[16];
    if (!rg_camera_matrix(&camera, (float)width / (float)height, to_clip) ||
        !rg_camera_view(&camera, view))
        return false;
    const double pixel = 2 * tan(s->view_angle_deg * M_PI / 360) / height;
    for (int i = 0; i < 3; i++) {
        right[i] = pixel * (double)view[i];
        down[i] = -pixel * (double)view[4 + i];
        ahead[i] = -(double)view[8 + i];
    }
    p->to_clip = rg_m4_of(to_clip);
    p->rays = rays_of(right, down, ahead, eye, width, height);
    return true;
}

bool flow_view_params_at(const struct flow_settings *s, int64_t frame, int width, int height,
                         flow_view_params *p)
{
    double lamp[3];
    direction_of(s->light_azimuth_deg, s->light_elevation_deg, lamp);
    const double pixel = 2 * tan(s->view_angle_deg * M_PI / 360) / height;
    *p = (flow_view_params){
        .size = s->resolution_px,
        .environment_size = s->environment_px,
        .reflection_level = flow_reflection_level(s),
        .reflection_size = s->environment_px >> flow_reflection_level(s),
        .ambient_level = ambient_level(s),
        .ambient_size = s->environment_px >> ambient_level(s),
        .fresnel_bias = (float)s->fresnel_bias,
        .fresnel_scale = (float)s->fresnel_scale,
        .fresnel_power = s->fresnel_power,
        .refraction_strength = (float)s->refraction_strength,
        .refraction_px = (float)(s->refraction_strength * LENS_REACH * height / pixel),
        .reflectivity = (float)s->reflectivity,
        .frame = s->view == FLOW_BOX ? (float)(s->frame_mm / s->pane_mm) : 0,
        .stage = s->stage,
        .model_grey = (float)s->model_grey,
        .light = (float)s->light,
        .light_x = (float)lamp[0],
        .light_y = (float)lamp[1],
        .light_z = (float)lamp[2],
        .drop_shadow = (float)s->drop_shadow,
        .wet_per_height = (float)(1 / s->wet_height),
    };
    if (s->view == FLOW_BOX)
        return see_box(s, frame, width, height, p);
    see_pane(s, frame, width, height, p);
    return true;
}

void flow_view_model(const struct flow_settings *s, int64_t frame, const float low[3],
                     const float high[3], flow_view_params *p)
{
    const struct rg_placement placement = {.size = (float)(2 * s->model_size)};
    float placed[16], turn[16] = {[15] = 1};
    double axes[3][3];
    rg_place(low, high, &placement, placed);
    // The model's x, y and z are the front pane's right, up and outwards.
    flow_pane_frame(s, 0, frame, axes);
    for (int i = 0; i < 3; i++) {
        turn[4 * i] = (float)axes[0][i];
        turn[4 * i + 1] = -(float)axes[1][i];
        turn[4 * i + 2] = (float)axes[2][i];
    }
    p->turn = rg_m4_of(turn);
    float to_clip[16];
    rg_m4_rows(&p->to_clip, to_clip);
    rg_matrix_multiply(turn, placed, placed);
    rg_matrix_multiply(to_clip, placed, to_clip);
    p->to_clip = rg_m4_of(to_clip);
}
