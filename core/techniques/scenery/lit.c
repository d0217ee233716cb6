// A scene's lights for a camera.
#include <math.h>
#include <string.h>

#include "core/scene/matrix.h"
#include "core/techniques/scenery/scenery.h"

// The place near which lamps are chosen: a distance ahead of the camera, on level ground, since
// lamps there light the view.
static void look_ahead(const struct rg_camera *camera, float place_m[3])
{
    const double ahead_m = 20, x = (double)camera->target[0] - (double)camera->position[0];
    const double z = (double)camera->target[2] - (double)camera->position[2];
    const double level = fmax(hypot(x, z), 1e-9);
    memcpy(place_m, camera->position, 3 * sizeof(*place_m));
    place_m[0] += (float)(x / level * ahead_m);
    place_m[2] += (float)(z / level * ahead_m);
}

// Draws the depth of shadow casters: scenery_lights_shade calls it for each map.
static bool draw_shadow(void *user, const float to_clip[16], const struct rg_draw *onto)
{
    return scenery_depth(user, rg_m4_of(to_clip), onto);
}

struct scenery_lights *scenery_lit(struct scenery *scene, struct rg_device *device,
                                   const struct scenery_lights_settings *settings,
                                   const struct rg_camera *camera)
{
    const struct city_faces *faces = &scenery_city(scene)->faces;
    struct scenery_lights_settings all = *settings;
    all.lamp_count = scenery_lamps(scene, &all.lamps);
    look_ahead(camera, all.about_m);
    memcpy(all.low_m, faces->low, sizeof(all.low_m));
    memcpy(all.high_m, faces->high, sizeof(all.high_m));
    struct scenery_lights *lights = scenery_lights_open(device, &all);
    if (lights && scenery_lights_shade(lights, draw_shadow, scene))
        return lights;
    scenery_lights_close(lights);
    return NULL;
}
