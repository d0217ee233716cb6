#include "core/scene/camera.h"

#include <math.h>
#include <string.h>

#include "core/base/log.h"
#include "core/scene/matrix.h"
#include "core/scene/vector.h"

// Matrices are computed in floats, each operation rounded in the order written here, so that no
// library and no processor changes them. Angles alone need a function of the C library: in double
// precision, rounded once, since its functions of floats differ between versions.
static const float pi = (float)M_PI;

static double radians(float degrees)
{
    return (double)(degrees * pi / 180);
}

static float dot(const float a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const float a[3], const float b[3], float product[3])
{
    for (int i = 0; i < 3; i++)
        product[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void to_unit(float a[3])
{
    const float by = 1 / sqrtf(dot(a, a));
    for (int i = 0; i < 3; i++)
        a[i] *= by;
}

// The part of `up` at right angles to the view, from 0 (along it) to 1; not above 0 if the view or
// `up` has no direction.
static double upright(const struct rg_camera *camera)
{
    double view[3], cross2 = 0, view2 = 0, up2 = 0;
    const float *up = camera->up;
    for (int c = 0; c < 3; c++)
        view[c] = (double)camera->target[c] - (double)camera->position[c];
    for (int c = 0; c < 3; c++) {
        const int d = (c + 1) % 3, e = (c + 2) % 3;
        const double cross = view[d] * (double)up[e] - view[e] * (double)up[d];
        cross2 += cross * cross;
        view2 += view[c] * view[c];
        up2 += (double)up[c] * (double)up[c];
    }
    return sqrt(cross2 / (view2 * up2));
}

static bool check(const struct rg_camera *camera)
{
    if (!(upright(camera) > 1e-4)) // also catches NaN
        return rg_error("camera at (%g, %g, %g): it must look at another point, and not along its "
                        "up; move the target",
                        (double)camera->position[0], (double)camera->position[1],
                        (double)camera->position[2]);
    if (!(camera->angle_deg > 0 && camera->angle_deg < 180))
        return rg_error("camera: an angle of view of %g degrees; choose one between 0 and 180",
                        (double)camera->angle_deg);
    if (!(camera->near_plane > 0 && camera->near_plane < camera->far_plane &&
          isfinite(camera->far_plane)))
        return rg_error("camera: planes at %g and %g; choose 0 < near < far",
                        (double)camera->near_plane, (double)camera->far_plane);
    return true;
}

static void find_view(const struct rg_camera *camera, float view[16])
{
    float ahead[3], right[3], up[3];
    for (int c = 0; c < 3; c++)
        ahead[c] = camera->target[c] - camera->position[c];
    to_unit(ahead);
    cross(ahead, camera->up, right);
    to_unit(right);
    cross(right, ahead, up);
    for (int c = 0; c < 3; c++) {
        view[c] = right[c];
        view[4 + c] = up[c];
        view[8 + c] = -ahead[c];
        view[12 + c] = 0;
    }
    view[3] = -dot(right, camera->position);
    view[7] = -dot(up, camera->position);
    view[11] = dot(ahead, camera->position);
    view[15] = 1;
}

// From the camera's space to clip space.
static void find_projection(const struct rg_camera *camera, float aspect, float projection[16])
{
    const float near = camera->near_plane, far = camera->far_plane, depth = 1 / (near - far);
    const float focus = 1 / (float)tan(radians(camera->angle_deg) / 2);
    memset(projection, 0, 16 * sizeof(float));
    projection[0] = focus / aspect;
    projection[5] = -focus; // y down
    projection[10] = far * depth;
    projection[11] = near * far * depth;
    projection[14] = -1;
}

bool rg_camera_view(const struct rg_camera *camera, float matrix[16])
{
    if (!check(camera))
        return false;
    find_view(camera, matrix);
    return true;
}

bool rg_camera_matrix(const struct rg_camera *camera, float aspect, float matrix[16])
{
    if (!check(camera))
        return false;
    if (!(aspect > 0 && isfinite(aspect)))
        return rg_error("camera: a picture %g times as wide as high; choose a size above 0",
                        (double)aspect);
    float view[16], projection[16];
    find_view(camera, view);
    find_projection(camera, aspect, projection);
    rg_matrix_multiply(projection, view, matrix);
    return true;
}

struct rg_camera_axes rg_camera_axes(const struct rg_camera *camera)
{
    struct rg_camera_axes axes;
    double up[3];
    for (int i = 0; i < 3; i++) {
        axes.ahead[i] = (double)camera->target[i] - (double)camera->position[i];
        up[i] = (double)camera->up[i];
    }
    rg_to_unit(axes.ahead);
    rg_cross(axes.ahead, up, axes.right);
    rg_to_unit(axes.right);
    rg_cross(axes.right, axes.ahead, axes.up);
    return axes;
}

// matrix * the rotation about axis c.
static void turn(float matrix[16], int c, float degrees)
{
    const double angle = radians(degrees);
    const int from = (c + 1) % 3, to = (c + 2) % 3;
    float rotation[16] = {[0] = 1, [5] = 1, [10] = 1, [15] = 1};
    rotation[5 * from] = rotation[5 * to] = (float)cos(angle);
    rotation[4 * to + from] = (float)sin(angle);
    rotation[4 * from + to] = -rotation[4 * to + from];
    rg_matrix_multiply(matrix, rotation, matrix);
}

void rg_place(const float low[3], const float high[3], const struct rg_placement *placement,
              float matrix[16])
{
    float to_origin[3];
    double longest = 0;
    for (int c = 0; c < 3; c++) {
        longest = fmax(longest, (double)high[c] - (double)low[c]);
        to_origin[c] = (float)(-((double)low[c] + (double)high[c]) / 2);
    }
    memcpy(matrix, (const float[16]){[0] = 1, [5] = 1, [10] = 1, [15] = 1}, 16 * sizeof(float));
    for (int c = 2; c >= 0; c--)
        turn(matrix, c, placement->turn_deg[c]);
    const float scale = (float)((double)placement->size / longest);
    for (int c = 0; c < 3; c++) {
        float *row = matrix + 4 * c;
        for (int k = 0; k < 3; k++)
            row[k] *= scale;
        const float position = placement->position[c];
        row[3] =
            row[0] * to_origin[0] + (row[1] * to_origin[1] + (row[2] * to_origin[2] + position));
    }
}
