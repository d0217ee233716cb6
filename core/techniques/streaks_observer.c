#include "core/techniques/streaks_observer.h"

#include <math.h>
#include <string.h>

#include "core/log.h"

static const double pi = 3.14159265358979323846;

struct axes {
    double ahead[3], right[3], up[3]; // of unit length
};

static void cross(const double a[3], const double b[3], double product[3])
{
    for (int i = 0; i < 3; i++)
        product[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void to_unit(double a[3])
{
    const double length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    for (int i = 0; i < 3; i++)
        a[i] /= length;
}

static struct axes axes_of(const struct rg_camera *camera)
{
    struct axes axes;
    double up[3];
    for (int i = 0; i < 3; i++) {
        axes.ahead[i] = (double)camera->target[i] - (double)camera->position[i];
        up[i] = (double)camera->up[i];
    }
    to_unit(axes.ahead);
    cross(axes.ahead, up, axes.right);
    to_unit(axes.right);
    cross(axes.right, axes.ahead, axes.up);
    return axes;
}

// A walk ahead on level ground, with steps that sway and bob and a head that turns.
static void walk(struct rg_camera *camera, double metres)
{
    const double stride_m = 1.5, sway_m = 0.1, bob_m = 0.15, turn_m = 2;
    const struct axes axes = axes_of(camera);
    const double level = hypot(axes.ahead[0], axes.ahead[2]), phase = 2 * pi * metres / stride_m;
    const double reach = hypot(level, axes.ahead[1]) * 40;
    if (metres == 0 || level == 0)
        return;
    for (int i = 0; i < 3; i++) {
        const double on = i == 1 ? 0 : axes.ahead[i] / level * metres;
        const double step =
            on + axes.right[i] * sway_m * sin(phase / 2) + (i == 1 ? bob_m * sin(phase) : 0);
        camera->position[i] += (float)step;
        camera->target[i] =
            camera->position[i] +
            (float)(axes.ahead[i] * reach + axes.right[i] * turn_m * sin(phase / 5) * reach / 10);
    }
}

static void find_rays(const struct axes *axes, double half_width, double half_height, int width,
                      int height, float rays[16])
{
    memset(rays, 0, 16 * sizeof(*rays));
    for (int i = 0; i < 3; i++) {
        rays[4 * i] = (float)(axes->right[i] * half_width * 2 / width);
        rays[4 * i + 1] = (float)(-axes->up[i] * half_height * 2 / height);
        rays[4 * i + 2] =
            (float)(axes->ahead[i] - axes->right[i] * half_width + axes->up[i] * half_height);
    }
}

bool streaks_observer_at(const struct streaks_settings *settings, const struct rg_camera *camera,
                         int width, int height, int64_t frame, struct streaks_observer *observer)
{
    struct rg_camera moved = *camera;
    walk(&moved, settings->walk_m_s * settings->step_s * (double)frame);
    if (!rg_camera_matrix(&moved, (float)width / (float)height, observer->world_to_clip))
        return false;
    if (moved.position[1] < 0)
        return rg_error("camera: its eye is %.3g m below the ground; raise eye_y_m",
                        -(double)moved.position[1]);
    const struct axes axes = axes_of(&moved);
    const double half_height = tan((double)moved.angle_deg / 360 * pi);
    const double half_width = half_height * width / height;
    observer->focal_px = (float)(height / (2 * half_height));
    find_rays(&axes, half_width, half_height, width, height, observer->rays);
    observer->camera = moved;
    return true;
}
