#include "core/techniques/streaks/observer.h"

#include <math.h>
#include <string.h>

#include "core/base/log.h"

// Moves the camera ahead on level ground, with steps that sway and bob and a turning head.
static void walk(struct rg_camera *camera, double metres)
{
    const double stride_m = 1.5, sway_m = 0.1, bob_m = 0.15, reach_m = 40, turn = 0.2;
    const struct rg_camera_axes axes = rg_camera_axes(camera);
    const double level = hypot(axes.ahead[0], axes.ahead[2]), phase = 2 * M_PI * metres / stride_m;
    if (metres == 0 || level == 0)
        return;
    for (int i = 0; i < 3; i++) {
        const double on = i == 1 ? 0 : axes.ahead[i] / level * metres;
        const double step =
            on + axes.right[i] * sway_m * sin(phase / 2) + (i == 1 ? bob_m * sin(phase) : 0);
        camera->position[i] += (float)step;
        camera->target[i] =
            camera->position[i] +
            (float)(reach_m * (axes.ahead[i] + axes.right[i] * turn * sin(phase / 5)));
    }
}

static void find_rays(const struct rg_camera_axes *axes, double half_width, double half_height,
                      int width, int height, float rays[16])
{
    memset(rays, 0, 16 * sizeof(*rays));
    for (int i = 0; i < 3; i++) {
        rays[4 * i] = (float)(axes->right[i] * half_width * 2 / width);
        rays[4 * i + 1] = (float)(-axes->up[i] * half_height * 2 / height);
        rays[4 * i + 2] =
            (float)(axes->ahead[i] - axes->right[i] * half_width + axes->up[i] * half_height);
    }
}

bool streaks_observer_of(const struct rg_camera *camera, int width, int height,
                         struct streaks_observer *observer)
{
    if (!rg_camera_matrix(camera, (float)width / (float)height, observer->world_to_clip))
        return false;
    const struct rg_camera_axes axes = rg_camera_axes(camera);
    const double half_height = tan((double)camera->angle_deg / 360 * M_PI);
    const double half_width = half_height * width / height;
    observer->focal_px = (float)(height / (2 * half_height));
    find_rays(&axes, half_width, half_height, width, height, observer->rays);
    observer->camera = *camera;
    return true;
}

bool streaks_observer_at(const struct streaks_settings *settings, const struct rg_camera *camera,
                         int width, int height, int64_t frame, struct streaks_observer *observer)
{
    struct rg_camera moved = *camera;
    walk(&moved, settings->walk_m_s * settings->step_s * (double)frame);
    if (!streaks_observer_of(&moved, width, height, observer))
        return false;
    if (moved.position[1] < 0)
        return rg_error("camera: its eye is %.3g m below the ground; raise eye_y_m",
                        -(double)moved.position[1]);
    return true;
}
