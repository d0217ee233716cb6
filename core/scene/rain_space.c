#include "core/scene/rain_space.h"

#include <math.h>
#include <string.h>

#include "core/base/log.h"
#include "core/scene/matrix.h"
#include "core/scene/vector.h"

static bool all_finite(const double *values, int count)
{
    for (int i = 0; i < count; i++)
        if (!isfinite(values[i]))
            return false;
    return true;
}

// x is the part of the world's x axis across the fall, or of its y axis if rain falls along the x
// axis.
static void make_axes(struct rg_rain_space *space, const double fall[3])
{
    memcpy(space->s, fall, sizeof(space->s));
    rg_to_unit(space->s);
    double along[3] = {1, 0, 0};
    if (fabs(space->s[0]) > 0.99) {
        along[0] = 0;
        along[1] = 1;
    }
    rg_cross(space->s, along, space->y);
    rg_to_unit(space->y);
    rg_cross(space->y, space->s, space->x);
}

bool rg_rain_space_make(const struct rg_rain_space_settings *settings, struct rg_rain_space *space)
{
    const double sizes[3] = {settings->width_m, settings->depth_m, settings->height_m};
    if (!all_finite(settings->ground_m, 3) || !all_finite(settings->fall, 3))
        return rg_error("rain space: its place or the direction of fall is no number");
    if (!all_finite(sizes, 3) || !(sizes[0] > 0 && sizes[1] > 0 && sizes[2] > 0))
        return rg_error("rain space: %g m x %g m, %g m high; each must be above 0", sizes[0],
                        sizes[1], sizes[2]);
    const double length = sqrt(rg_dot(settings->fall, settings->fall));
    if (!(length > 1e-12 && isfinite(length)))
        return rg_error("rain space: the fall has no direction; give it one, such as 0 -1 0");
    make_axes(space, settings->fall);
    space->half_x_m = settings->width_m / 2;
    space->half_y_m = settings->depth_m / 2;
    space->height_m = settings->height_m;
    for (int i = 0; i < 3; i++)
        space->origin_m[i] = settings->ground_m[i] - settings->height_m * space->s[i];
    return true;
}

void rg_rain_fall(double slant_deg, double azimuth_deg, double fall[3])
{
    const double slant = slant_deg * M_PI / 180, azimuth = azimuth_deg * M_PI / 180;
    fall[0] = sin(slant) * cos(azimuth);
    fall[1] = -cos(slant);
    fall[2] = sin(slant) * sin(azimuth);
}

void rg_rain_eye(const struct rg_rain_space *space, const struct rg_camera *camera, double rain[3])
{
    const double world[3] = {(double)camera->position[0], (double)camera->position[1],
                             (double)camera->position[2]};
    rg_rain_point(space, world, rain);
}

void rg_rain_direction(const struct rg_rain_space *space, const double world[3], double rain[3])
{
    const double turned[3] = {rg_dot(space->x, world), rg_dot(space->y, world),
                              rg_dot(space->s, world)};
    memcpy(rain, turned, sizeof(turned));
}

void rg_rain_point(const struct rg_rain_space *space, const double world[3], double rain[3])
{
    const double from[3] = {world[0] - space->origin_m[0], world[1] - space->origin_m[1],
                            world[2] - space->origin_m[2]};
    rg_rain_direction(space, from, rain);
}

void rg_rain_world_point(const struct rg_rain_space *space, const double rain[3], double world[3])
{
    const double at[3] = {rain[0], rain[1], rain[2]};
    for (int i = 0; i < 3; i++)
        world[i] =
            space->origin_m[i] + at[0] * space->x[i] + at[1] * space->y[i] + at[2] * space->s[i];
}

static struct rg_matrix to_rain(const struct rg_rain_space *space)
{
    const double *const axes[3] = {space->x, space->y, space->s};
    struct rg_matrix matrix = {{{0}}};
    for (int row = 0; row < 3; row++) {
        memcpy(matrix.rows[row], axes[row], 3 * sizeof(double));
        matrix.rows[row][3] = -rg_dot(axes[row], space->origin_m);
    }
    matrix.rows[3][3] = 1;
    return matrix;
}

static struct rg_matrix to_world(const struct rg_rain_space *space)
{
    struct rg_matrix matrix = {{{0}}};
    for (int row = 0; row < 3; row++) {
        matrix.rows[row][0] = space->x[row];
        matrix.rows[row][1] = space->y[row];
        matrix.rows[row][2] = space->s[row];
        matrix.rows[row][3] = space->origin_m[row];
    }
    matrix.rows[3][3] = 1;
    return matrix;
}

void rg_rain_matrices(const struct rg_rain_space *space, float world_to_rain[16],
                      float rain_to_world[16])
{
    const struct rg_matrix there = to_rain(space), back = to_world(space);
    if (world_to_rain)
        rg_matrix_round(&there, world_to_rain);
    if (rain_to_world)
        rg_matrix_round(&back, rain_to_world);
}

void rg_rain_to_clip(const struct rg_rain_space *space, const float world_to_clip[16],
                     float rain_to_clip[16])
{
    const struct rg_matrix clip = rg_matrix_of(world_to_clip), world = to_world(space);
    const struct rg_matrix product = rg_matrix_product(&clip, &world);
    rg_matrix_round(&product, rain_to_clip);
}

void rg_rain_rays(const struct rg_rain_space *space, const float world[16], float rain[16])
{
    const double *const axes[3] = {space->x, space->y, space->s};
    memset(rain, 0, 16 * sizeof(*rain));
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++) {
            const double ray[3] = {(double)world[column], (double)world[4 + column],
                                   (double)world[8 + column]};
            rain[4 * row + column] = (float)rg_dot(axes[row], ray);
        }
}

// --- the view ---

static double farthest_corner(const struct rg_rain_space *space, const double eye[3])
{
    double rain[3];
    rg_rain_point(space, eye, rain);
    const double x = fabs(rain[0]) + space->half_x_m, y = fabs(rain[1]) + space->half_y_m;
    const double s = fmax(fabs(rain[2]), fabs(rain[2] - space->height_m));
    return sqrt(x * x + y * y + s * s);
}

bool rg_rain_view_corners(const struct rg_rain_space *space, const struct rg_camera *camera,
                          double aspect, double corners[8][3])
{
    float checked[16];
    if (!rg_camera_matrix(camera, (float)aspect, checked) || !rg_camera_view(camera, checked))
        return false;
    const struct rg_camera_axes axes = rg_camera_axes(camera);
    double eye[3];
    for (int i = 0; i < 3; i++)
        eye[i] = (double)camera->position[i];
    const double tall = tan((double)camera->angle_deg * M_PI / 360);
    const double planes[2] = {(double)camera->near_plane,
                              fmax((double)camera->far_plane, farthest_corner(space, eye))};
    for (int i = 0; i < 8; i++) {
        const double z = planes[i / 4], y = (i & 2 ? z : -z) * tall, x = (i & 1 ? z : -z) * tall;
        double world[3];
        for (int k = 0; k < 3; k++)
            world[k] = eye[k] + z * axes.ahead[k] + y * axes.up[k] + x * aspect * axes.right[k];
        rg_rain_point(space, world, corners[i]);
    }
    return true;
}

// --- the local space ---

double rg_rain_local_top(double eye_s_m, double local_height_m)
{
    return eye_s_m - local_height_m / 2;
}

double rg_rain_run(double fall_speed_m_s, double time_s, double top_m, double local_height_m)
{
    const double turns = (fall_speed_m_s * time_s - top_m) / local_height_m;
    const double run = turns - floor(turns);
    return run < 1 ? run : 0;
}
