#include "core/techniques/scenery/environment.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/device/shared.h"
#include "core/scene/environment/blur.h"
#include "core/scene/environment/cube.h"
#include "core/scene/matrix.h"
#include "core/techniques/scenery/scenery.h"
#include "core/techniques/stages/assets.h"
#include "core/techniques/stages/stages.h"
#include "kernels/dialect/image/format.h"

enum { FACES = 6, LIGHTS = 8, SHADOW_MAP_PX = 1024 };

// The city on a device, with its draw targets.
struct stage {
    struct rg_instance instance;
    struct scenery *scene;
    struct scenery_lights *lights;
    struct rg_image *colour, *depth;
    struct scenery_look look;
};

static void close_stage(struct stage *stage)
{
    scenery_lights_close(stage->lights);
    scenery_close(stage->scene);
    rg_stages_free(&stage->instance);
    rg_assets_free(&stage->instance);
    rg_image_destroy(stage->colour);
    rg_image_destroy(stage->depth);
}

static bool open_stage(struct rg_device *device, enum scenery_time time, int size_px,
                       struct stage *stage)
{
    const struct scenery_settings settings = {.city = {.seed = 1, .size = CITY_FULL}};
    const struct scenery_lights_settings lights = {
        .count = time == SCENERY_NIGHT ? LIGHTS : 1,
        .time = time,
        .shadows = true,
        .shadow_map_px = SHADOW_MAP_PX,
        .world_to_frame = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    const struct rg_image_desc colour = {RG_RGBA16F, size_px, size_px, 1, 1},
                               depth = {RG_D32F, size_px, size_px, 1, 1};
    stage->instance.device = device;
    stage->look = time == SCENERY_NIGHT ? scenery_night() : scenery_day();
    return (stage->scene = scenery_open(&stage->instance, &settings)) &&
           (stage->lights = scenery_lit(stage->scene, device, &lights, &city_first_camera)) &&
           (stage->colour = rg_image_create(device, &colour, "environment")) &&
           (stage->depth = rg_image_create(device, &depth, "environment"));
}

// A camera that sees one face of the cube upright but mirrored, because cube faces are seen from
// outside.
static struct rg_camera camera_of(int face)
{
    const float ahead[FACES][3] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                   {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    const float up[FACES][3] = {{0, 1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}, {0, 1, 0}, {0, 1, 0}};
    struct rg_camera camera = city_first_camera;
    camera.angle_deg = 90;
    for (int i = 0; i < 3; i++)
        camera.target[i] = camera.position[i] + ahead[face][i];
    memcpy(camera.up, up[face], sizeof(camera.up));
    return camera;
}

// Copies a face's pixels into its texels.
static void put_face(struct rg_environment *environment, int face, const uint16_t *pixels)
{
    const int size = environment->size;
    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++)
            for (int c = 0; c < 3; c++)
                rg_environment_texel(environment, face, x, y)[c] = rg_unpack_half(
                    pixels[((size_t)y * (size_t)size + (size_t)(size - 1 - x)) * 4 + (size_t)c]);
}

static bool draw_face(struct stage *stage, int face, uint16_t *pixels,
                      struct rg_environment *environment)
{
    const struct rg_camera camera = camera_of(face);
    struct scenery_view view = {.colour = stage->colour, .depth = stage->depth};
    float to_clip[16];
    if (!rg_camera_matrix(&camera, 1, to_clip))
        return false;
    view.to_clip = rg_m4_of(to_clip);
    memcpy(view.eye, camera.position, sizeof(view.eye));
    if (!scenery_draw(stage->scene, &view, &stage->look, stage->lights, true) ||
        !rg_image_read(stage->colour, 0, 0, pixels))
        return false;
    put_face(environment, face, pixels);
    return true;
}

static bool draw_faces(struct stage *stage, struct rg_environment *environment)
{
    const size_t size = (size_t)environment->size;
    uint16_t *pixels = rg_alloc(size * size, 4 * sizeof(*pixels), "environment");
    bool ok = pixels != NULL;
    for (int face = 0; ok && face < FACES; face++)
        ok = draw_face(stage, face, pixels, environment);
    free(pixels);
    if (ok)
        rg_environment_close_borders(environment);
    return ok;
}

static struct rg_environment *draw_city(enum scenery_time time, int size_px,
                                        struct rg_device *device)
{
    struct stage stage = {.scene = NULL};
    struct rg_environment *environment =
        open_stage(device, time, size_px, &stage) ? rg_environment_create(size_px) : NULL;
    if (environment && !draw_faces(&stage, environment)) {
        rg_environment_destroy(environment);
        environment = NULL;
    }
    close_stage(&stage);
    return environment;
}

struct rg_environment *scenery_environment(const char *name, int size_px, struct rg_device *device)
{
    if (!strcmp(name, "city"))
        return draw_city(SCENERY_DAY, size_px, device);
    if (!strcmp(name, "city-night"))
        return draw_city(SCENERY_NIGHT, size_px, device);
    return rg_environment_load(name, size_px);
}

// --- the image, which instances share ---

static void *make_image(struct rg_device *device, const void *arg)
{
    const struct scenery_around *a = arg;
    struct rg_environment *sharp = scenery_environment(a->name, a->size_px, device);
    struct rg_environment *blurred =
        sharp && a->blur_rad > 0 ? rg_environment_blur(sharp, a->blur_rad) : NULL;
    const struct rg_environment *seen = a->blur_rad > 0 ? blurred : sharp;
    struct rg_image *image =
        seen ? rg_environment_upload(seen, a->size_px, a->levels, device) : NULL;
    rg_environment_destroy(blurred);
    rg_environment_destroy(sharp);
    return image;
}

static void destroy_image(void *thing)
{
    rg_image_destroy(thing);
}

void scenery_add_environment(struct rg_instance *instance, const struct scenery_around *around)
{
    static const struct rg_shared_kind kind = {"environment", make_image, destroy_image};
    char path[RG_ENVIRONMENT_PATH_SIZE], key[RG_ENVIRONMENT_PATH_SIZE + RG_PATH_SIZE + 128];
    struct stat file = {0};
    rg_environment_file(around->name, path);
    if (stat(path, &file)) // it is computed
        path[0] = 0;
    snprintf(key, sizeof(key), "%s %d %d %a %s %lld %lld.%09ld", around->name, around->size_px,
             around->levels, around->blur_rad, path, (long long)file.st_size,
             (long long)file.st_mtim.tv_sec, file.st_mtim.tv_nsec);
    struct rg_image *image = rg_shared_get(instance->device, key, &kind, around);
    rg_share_image(instance, "environment", image);
    rg_tell_texture(instance, "environment", image, 0);
}
