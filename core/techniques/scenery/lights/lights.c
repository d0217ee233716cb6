#include "core/techniques/scenery/lights/lights.h"

#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"

#define MOST_MAP_BYTES ((int64_t)1 << 30)

static bool check(const struct scenery_lights_settings *s)
{
    require(s->count >= SCENERY_USUAL_LIGHTS && s->count <= SCENERY_MAX_LIGHTS,
            "lights: %d asked for; choose from 0 to %d", s->count, SCENERY_MAX_LIGHTS);
    require(!s->shadows || (s->shadow_map_px >= 16 && s->shadow_map_px <= 16384),
            "shadow_map_px: %d; choose from 16 to 16384", s->shadow_map_px);
    return true;
}

// Converts the chosen lights, and gives each that casts shadows its layers.
static void put_lights(const struct scenery_lights_settings *s, const struct rg_lights *chosen,
                       struct scenery_lights *lights)
{
    const int map_px = s->shadows ? s->shadow_map_px : 1;
    lights->count = chosen->count;
    for (int c = 0; c < 3; c++)
        lights->sky[c] = chosen->sky[c];
    for (int i = 0; i < chosen->count; i++) {
        const bool casts = s->shadows && chosen->lights[i].shadows;
        lights->world[i] = scenery_light_of(&chosen->lights[i], s->low_m, s->high_m, map_px,
                                            casts ? lights->map_count : -1);
        lights->map_count += casts ? lights->world[i].shadow_faces : 0;
    }
}

// A buffer cannot be empty, so that it has one unused light when there are none.
static bool create_buffers(struct rg_device *device, const float world_to_frame[16],
                           struct scenery_lights *lights)
{
    scenery_light moved[SCENERY_MAX_LIGHTS] = {{0}};
    for (int i = 0; i < lights->count; i++)
        moved[i] = scenery_light_moved(&lights->world[i], world_to_frame);
    const int64_t bytes = (lights->count ? lights->count : 1) * (int64_t)sizeof(scenery_light);
    return (lights->in_world = rg_buf_create_with(device, lights->world, bytes, "lights")) &&
           (lights->in_frame = rg_buf_create_with(device, moved, bytes, "lights of the frame"));
}

static bool create_maps(struct rg_device *device, int map_px, struct scenery_lights *lights)
{
    static const float farthest = 1;
    const int64_t bytes = (int64_t)map_px * map_px * 4 * lights->map_count;
    require(
        bytes <= MOST_MAP_BYTES,
        "shadow_map_px: %d shadow maps of %d texels take %lld MiB, and %lld are the most; choose "
        "smaller maps, fewer lights, or no shadows of point lights, which have six maps each",
        lights->map_count, map_px, (long long)(bytes >> 20), (long long)(MOST_MAP_BYTES >> 20));
    const int size = lights->map_count ? map_px : 1, layers = lights->map_count;
    const struct rg_image_desc desc = {RG_D32F, size, size, layers ? layers : 1, 1};
    lights->shadows = rg_image_create_with(device, &desc, &farthest, "shadows");
    return lights->shadows;
}

struct scenery_lights *scenery_lights_open(struct rg_device *device,
                                           const struct scenery_lights_settings *settings)
{
    struct rg_lights chosen;
    if (!check(settings) || !scenery_lights_choose(settings, &chosen))
        return NULL;
    struct scenery_lights *lights = rg_alloc(1, sizeof(*lights), "lights");
    if (!lights)
        return NULL;
    put_lights(settings, &chosen, lights);
    if (!create_buffers(device, settings->world_to_frame, lights) ||
        !create_maps(device, settings->shadow_map_px, lights)) {
        scenery_lights_close(lights);
        return NULL;
    }
    return lights;
}

void scenery_lights_close(struct scenery_lights *lights)
{
    if (!lights)
        return;
    rg_buf_destroy(lights->in_world);
    rg_buf_destroy(lights->in_frame);
    rg_image_destroy(lights->shadows);
    free(lights);
}

bool scenery_lights_shade(struct scenery_lights *lights, scenery_depth_fn draw, void *user)
{
    static const float farthest = 1;
    if (!lights->map_count)
        return true;
    if (!rg_image_clear(lights->shadows, &farthest))
        return false;
    for (int i = 0; i < lights->count; i++) {
        const scenery_light *light = &lights->world[i];
        for (int face = 0; light->shadow_layer >= 0 && face < light->shadow_faces; face++) {
            const struct rg_draw onto = {.depth = lights->shadows,
                                         .layer = light->shadow_layer + face,
                                         .depth_mode = RG_DEPTH_WRITE};
            float to_clip[16];
            scenery_light_to_clip(light, face, to_clip);
            if (!draw(user, to_clip, &onto))
                return false;
        }
    }
    return true;
}
