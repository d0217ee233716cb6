#include "tests/core/techniques/scenery/city/stage.h"

#include <math.h>
#include <string.h>

#include "tests/oracle/vectors.h"

static bool cast(void *user, const float to_clip[16], const struct rg_draw *onto)
{
    struct stage *stage = user;
    m4 m;
    memcpy(&m, to_clip, sizeof(m));
    return scenery_depth(stage->scene, m, onto);
}

void stage_open(struct rg_device *device, const struct stage_settings *settings,
                struct stage *stage)
{
    struct scenery_settings scene = {.city = {1, settings->whole ? CITY_FULL : CITY_SMALL}};
    scene.bare = settings->bare;
    if (settings->model)
        strcpy(scene.model, settings->model);
    *stage = (struct stage){.instance = {.device = device}};
    assert_non_null(stage->scene = scenery_open(&stage->instance, &scene));
    struct scenery_lights_settings light = {
        .count = settings->lights,
        .time = settings->time,
        .shadows = !settings->unshadowed,
        .shadow_map_px = 1024,
        .about_m = {0, 2, 60},
        .low_m = {-200, 0, -200},
        .high_m = {200, 230, 200},
        .world_to_frame = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
    };
    light.lamp_count = scenery_lamps(stage->scene, &light.lamps);
    assert_non_null(stage->lights = scenery_lights_open(device, &light));
    assert_true(scenery_lights_shade(stage->lights, cast, stage));
    stage->colour =
        rg_image_create(device, &(struct rg_image_desc){RG_RGBA16F, WIDTH, HEIGHT, 1, 1}, "colour");
    stage->depth =
        rg_image_create(device, &(struct rg_image_desc){RG_D32F, WIDTH, HEIGHT, 1, 1}, "depth");
    assert_true(stage->colour && stage->depth);
}

void stage_close(struct stage *stage)
{
    scenery_lights_close(stage->lights);
    scenery_close(stage->scene);
    rg_stages_free(&stage->instance);
    rg_assets_free(&stage->instance);
    rg_image_destroy(stage->colour);
    rg_image_destroy(stage->depth);
}

void stage_draw(struct stage *stage, const struct rg_camera *camera,
                const struct scenery_look *look, bool everything, struct picture *picture)
{
    struct scenery_view view = {
        .colour = stage->colour, .depth = stage->depth, .everything = everything};
    float to_clip[16];
    assert_true(rg_camera_matrix(camera, (float)WIDTH / HEIGHT, to_clip));
    memcpy(&view.to_clip, to_clip, sizeof(to_clip));
    memcpy(view.eye, camera->position, sizeof(view.eye));
    assert_true(scenery_draw(stage->scene, &view, look, stage->lights, true));
    assert_true(rg_image_read(stage->colour, 0, 0, picture->colour));
    assert_true(rg_image_read(stage->depth, 0, 0, picture->depth));
}

double stage_light(const struct picture *picture, int pixel, int c)
{
    const uint32_t half = picture->colour[2 * pixel + c / 2] >> 16 * (c % 2) & 0xffff;
    const int exponent = (int)(half >> 10 & 31);
    return ldexp((half & 0x3ff) / 1024.0 + (exponent ? 1 : 0), (exponent ? exponent : 1) - 15);
}

struct rg_camera stage_camera(const float position[3], const float target[3])
{
    struct rg_camera camera = city_first_camera;
    memcpy(camera.position, position, sizeof(camera.position));
    memcpy(camera.target, target, sizeof(camera.target));
    return camera;
}

const float stage_views[VIEWS][2][3] = {
    {{0, 1.7f, 20}, {0, 12, -60}},     {{-70, 3, 0}, {40, 30, 3}},  {{150, 120, 160}, {0, 20, 0}},
    {{-13.2f, 2, -150}, {-13, 8, 60}}, {{5, 90, -4}, {60, 60, 90}}, {{30, 2, 30}, {-80, 90, -40}},
};

// --- rays ---

void stage_ray(const struct rg_camera *camera, double px, double py, double way[3])
{
    const double half = tan((double)camera->angle_deg / 2 * 3.141592653589793 / 180);
    const double x = (2 * px / WIDTH - 1) * half * WIDTH / HEIGHT, y = (1 - 2 * py / HEIGHT) * half;
    double right[3], upward[3];
    for (int c = 0; c < 3; c++)
        way[c] = (double)camera->target[c] - (double)camera->position[c];
    make_unit(way);
    cross(way, (const double[3]){0, 1, 0}, right);
    make_unit(right);
    cross(right, way, upward);
    for (int c = 0; c < 3; c++)
        way[c] += right[c] * x + upward[c] * y;
}

struct scene stage_faces(const struct stage *stage)
{
    const struct city_faces *f = &scenery_city(stage->scene)->faces;
    return (struct scene){.face_count = f->face_count,
                          .corners = f->corners,
                          .surface_of = f->surface_of,
                          .surfaces = f->surfaces};
}
