#include "core/scene/camera.h"

#include <cglm/cglm.h>
#include <cglm/clipspace/persp_rh_zo.h>
#include <cglm/clipspace/view_rh_zo.h>
#include <math.h>
#include <string.h>

#include "core/base/log.h"
#include "core/scene/vector.h"

// cglm stores matrices by columns.
static void put_rows(mat4 columns, float rows[16])
{
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            rows[4 * i + j] = columns[j][i];
}

static void get_vector(const float from[3], vec3 to)
{
    memcpy(to, from, 3 * sizeof(float));
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

static void find_view(const struct rg_camera *camera, mat4 view)
{
    vec3 position, target, up;
    get_vector(camera->position, position);
    get_vector(camera->target, target);
    get_vector(camera->up, up);
    glm_lookat_rh_zo(position, target, up, view);
}

bool rg_camera_view(const struct rg_camera *camera, float matrix[16])
{
    if (!check(camera))
        return false;
    mat4 view;
    find_view(camera, view);
    put_rows(view, matrix);
    return true;
}

bool rg_camera_matrix(const struct rg_camera *camera, float aspect, float matrix[16])
{
    if (!check(camera))
        return false;
    if (!(aspect > 0 && isfinite(aspect)))
        return rg_error("camera: a picture %g times as wide as high; choose a size above 0",
                        (double)aspect);
    mat4 view, projection;
    find_view(camera, view);
    glm_perspective_rh_zo(glm_rad(camera->angle_deg), aspect, camera->near_plane, camera->far_plane,
                          projection);
    projection[1][1] = -projection[1][1]; // y down
    glm_mat4_mul(projection, view, projection);
    put_rows(projection, matrix);
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

void rg_place(const float low[3], const float high[3], const struct rg_placement *placement,
              float matrix[16])
{
    vec3 to_origin, position;
    double longest = 0;
    for (int c = 0; c < 3; c++) {
        longest = fmax(longest, (double)high[c] - (double)low[c]);
        to_origin[c] = (float)(-((double)low[c] + (double)high[c]) / 2);
    }
    get_vector(placement->position, position);
    mat4 place;
    glm_translate_make(place, position);
    glm_rotate_z(place, glm_rad(placement->turn_deg[2]), place);
    glm_rotate_y(place, glm_rad(placement->turn_deg[1]), place);
    glm_rotate_x(place, glm_rad(placement->turn_deg[0]), place);
    glm_scale_uni(place, (float)((double)placement->size / longest));
    glm_translate(place, to_origin);
    put_rows(place, matrix);
}
