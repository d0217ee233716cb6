// The scene of streaks, drawn: city DEVICE. Every byte is that of cpu:reference; what is
// culled is not missed; depth from above is the height of what stands there, by rays.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/techniques/scenery/scenery.h"
#include "tests/core/techniques/rigs/scene.h"

enum { WIDTH = 160, HEIGHT = 90, MAP_PX = 128 };

// A scene on a device, with lights and a target.
struct stage {
    struct rg_instance instance;
    struct scenery *scene;
    struct scenery_lights *lights;
    struct rg_image *colour, *depth;
};

static bool cast(void *user, const float to_clip[16], const struct rg_draw *onto)
{
    struct stage *stage = user;
    m4 m;
    memcpy(&m, to_clip, sizeof(m));
    return scenery_depth(stage->scene, m, onto);
}

static void open_stage(struct rg_device *device, const char *model, enum scenery_time time,
                       int lights, struct stage *stage)
{
    struct scenery_settings settings = {.city = {1, CITY_SMALL}};
    if (model)
        strcpy(settings.model, model);
    *stage = (struct stage){.instance = {.device = device}};
    assert_non_null(stage->scene = scenery_open(&stage->instance, &settings));
    struct scenery_lights_settings light = {
        .count = lights,
        .time = time,
        .shadows = true,
        .shadow_map_px = 256,
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

static void close_stage(struct stage *stage)
{
    scenery_lights_close(stage->lights);
    scenery_close(stage->scene);
    rg_stages_free(&stage->instance);
    rg_assets_free(&stage->instance);
    rg_image_destroy(stage->colour);
    rg_image_destroy(stage->depth);
}

struct picture {
    uint32_t colour[WIDTH * HEIGHT * 2], depth[WIDTH * HEIGHT];
};

static void draw(struct stage *stage, const struct rg_camera *camera,
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

static struct rg_camera camera_at(const float position[3], const float target[3])
{
    struct rg_camera camera = city_first_camera;
    memcpy(camera.position, position, sizeof(camera.position));
    memcpy(camera.target, target, sizeof(camera.target));
    return camera;
}

// Views of the streets, from roofs, along a wall, and of a single tower.
static const float views[][2][3] = {
    {{0, 1.7f, 20}, {0, 12, -60}},     {{-70, 3, 0}, {40, 30, 3}},  {{150, 120, 160}, {0, 20, 0}},
    {{-13.2f, 2, -150}, {-13, 8, 60}}, {{5, 90, -4}, {60, 60, 90}}, {{30, 2, 30}, {-80, 90, -40}},
};
enum { VIEWS = sizeof(views) / sizeof(views[0]) };

// --- drawing ---

static void compare_stages(struct rg_device *device, const char *model, enum scenery_time time,
                           int lights, int view_count)
{
    struct rg_device *reference = rg_device_open("cpu:reference");
    struct stage stages[2];
    struct picture *pictures = malloc(2 * sizeof(*pictures));
    const struct scenery_look look = time == SCENERY_DAY ? scenery_day() : scenery_night();
    open_stage(reference, model, time, lights, &stages[0]);
    open_stage(device, model, time, lights, &stages[1]);
    for (int i = 0; i < view_count; i++) {
        const struct rg_camera camera = camera_at(views[i][0], views[i][1]);
        for (int k = 0; k < 2; k++)
            draw(&stages[k], &camera, &look, false, &pictures[k]);
        assert_memory_equal(pictures[0].depth, pictures[1].depth, sizeof(pictures[0].depth));
        assert_memory_equal(pictures[0].colour, pictures[1].colour, sizeof(pictures[0].colour));
    }
    free(pictures);
    close_stage(&stages[0]);
    close_stage(&stages[1]);
    assert_true(rg_device_close(reference));
}

static void by_day_as_the_reference(void **state)
{
    compare_stages(*state, NULL, SCENERY_DAY, 1, VIEWS);
}

static void by_night_as_the_reference(void **state)
{
    compare_stages(*state, NULL, SCENERY_NIGHT, 5, 3);
}

static void a_mesh_as_the_reference(void **state)
{
    compare_stages(*state, "torus", SCENERY_DAY, 1, 3);
}

// Without geometry all is horizon, to the last bit that a half has, and nothing hides what is drawn
// later.
static void without_geometry_all_is_horizon(void **state)
{
    struct stage stage;
    struct picture *picture = malloc(sizeof(*picture));
    const struct scenery_look look = scenery_night();
    const float due[4] = {look.sky.horizon_r, look.sky.horizon_g, look.sky.horizon_b, 1};
    struct scenery_view view;
    open_stage(*state, NULL, SCENERY_NIGHT, 0, &stage);
    view = (struct scenery_view){.colour = stage.colour, .depth = stage.depth};
    assert_true(scenery_draw(stage.scene, &view, &look, stage.lights, false));
    assert_true(rg_image_read(stage.colour, 0, 0, picture->colour));
    assert_true(rg_image_read(stage.depth, 0, 0, picture->depth));
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const float one = 1;
        for (int c = 0; c < 4; c++) {
            const uint32_t half = picture->colour[2 * i + c / 2] >> 16 * (c % 2) & 0xffff;
            const float drawn = ldexpf((float)(half & 0x3ff) / 1024 + 1, (int)(half >> 10) - 15);
            assert_true(drawn <= due[c] && drawn > due[c] * (1 - 1.0f / 1024));
        }
        assert_memory_equal(&picture->depth[i], &one, sizeof(one));
    }
    free(picture);
    close_stage(&stage);
}

// --- what is left out ---

static void culling_changes_no_pixel(void **state)
{
    struct stage stage;
    struct picture *pictures = malloc(2 * sizeof(*pictures));
    const struct scenery_look look = scenery_day();
    int drawn = 0, chunks = 0;
    open_stage(*state, NULL, SCENERY_DAY, 1, &stage);
    for (int i = 0; i < 40; i++) {
        // between the views, and turning
        const int a = i % VIEWS, b = (i + 1 + i / VIEWS) % VIEWS;
        float position[3], target[3];
        for (int c = 0; c < 3; c++) {
            const float t = (float)(i / VIEWS) / 7;
            position[c] = views[a][0][c] + t * (views[b][0][c] - views[a][0][c]) * 0.2f;
            target[c] = views[a][1][c] + t * (views[b][1][c] - views[a][1][c]);
        }
        const struct rg_camera camera = camera_at(position, target);
        draw(&stage, &camera, &look, true, &pictures[0]);
        draw(&stage, &camera, &look, false, &pictures[1]);
        drawn += scenery_last(stage.scene).chunks_drawn;
        chunks += scenery_last(stage.scene).chunks;
        assert_memory_equal(&pictures[0], &pictures[1], sizeof(pictures[0]));
    }
    assert_true(drawn * 2 < chunks); // most is left out
    free(pictures);
    close_stage(&stage);
}

// --- from above ---

// The height of what is met from above at (x, z): the highest face over it.
static double height_at(const struct city_faces *f, double x, double z)
{
    double highest = 0;
    for (int i = 0; i < f->face_count; i++) {
        const float *c = f->corners + (size_t)i * SCENERY_FACE_WORDS;
        for (int k = 0; k < 2; k++) {
            const float *p[3] = {c, c + 3 + 3 * k, c + 6 + 3 * k};
            double side[3], all = 0, y = 0;
            for (int j = 0; j < 3; j++) {
                const float *a = p[(j + 1) % 3], *b = p[(j + 2) % 3];
                side[j] = ((double)a[0] - x) * ((double)b[2] - z) -
                          ((double)b[0] - x) * ((double)a[2] - z);
                all += side[j];
                y += side[j] * (double)p[j][1];
            }
            const bool within = (side[0] >= 0 && side[1] >= 0 && side[2] >= 0) ||
                                (side[0] <= 0 && side[1] <= 0 && side[2] <= 0);
            if (within && fabs(all) > 1e-9)
                highest = fmax(highest, y / all);
        }
    }
    return highest;
}

static void depth_from_above_is_the_height(void **state)
{
    struct stage stage;
    open_stage(*state, NULL, SCENERY_DAY, 1, &stage);
    const struct rg_image_desc desc = {RG_D32F, MAP_PX, MAP_PX, 1, 1};
    const float farthest = 1, top = 240;
    struct rg_image *map = rg_image_create_with(*state, &desc, &farthest, "map");
    // x to the right, z down, depth 0 at the top and 1 on the ground
    const m4 down = {1 / 200.0f, 0, 0, 0, 0, 0, 1 / 200.0f, 0, 0, -1 / top, 0, 1, 0, 0, 0, 1};
    float depth[MAP_PX * MAP_PX];
    assert_true(map && scenery_depth(stage.scene, down, &(struct rg_draw){.depth = map}));
    assert_true(rg_image_read(map, 0, 0, depth));
    const struct city_faces *faces = &scenery_city(stage.scene)->faces;
    int above = 0, wrong = 0;
    for (int i = 0; i < MAP_PX * MAP_PX; i += 37) {
        const double x = ((i % MAP_PX + 0.5) / MAP_PX - 0.5) * 400;
        const double z = ((int)(i / MAP_PX) + 0.5) / MAP_PX * 400 - 200;
        const double drawn = (1 - (double)depth[i]) * (double)top;
        // An edge may lie on either side of a pixel's centre, by the grid of 1/256 pixel.
        bool right = false;
        for (int k = 0; k < 5; k++)
            right |= fabs(height_at(faces,
                                    x + (k == 1   ? 0.02
                                         : k == 2 ? -0.02
                                                  : 0),
                                    z + (k == 3   ? 0.02
                                         : k == 4 ? -0.02
                                                  : 0)) -
                          drawn) < 2e-3;
        wrong += right ? 0 : 1;
        above += drawn > 10 ? 1 : 0;
    }
    assert_int_equal(wrong, 0);
    assert_in_range(above, 100, MAP_PX * MAP_PX / 37 - 100); // roofs, and streets between them
    rg_image_destroy(map);
    close_stage(&stage);
}

// --- from the streets ---

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void make_unit(double a[3])
{
    const double length = sqrt(dot(a, a));
    for (int i = 0; i < 3; i++)
        a[i] /= length;
}

// How far a ray goes before it meets a face, in lengths of `way`; 0 where it meets none.
static double reach(const struct city_faces *f, const float from[3], const double way[3])
{
    double nearest = 0;
    for (int i = 0; i < f->face_count; i++) {
        const float *c = f->corners + (size_t)i * SCENERY_FACE_WORDS;
        for (int k = 0; k < 2; k++) {
            double u[3], v[3], s[3], p[3], q[3];
            for (int j = 0; j < 3; j++) {
                u[j] = (double)c[3 + 3 * k + j] - (double)c[j];
                v[j] = (double)c[6 + 3 * k + j] - (double)c[j];
                s[j] = (double)from[j] - (double)c[j];
            }
            cross(way, v, p);
            cross(s, u, q);
            const double det = dot(u, p), x = dot(s, p) / det, y = dot(way, q) / det;
            const double t = dot(v, q) / det;
            if (det > 1e-12 && x >= 0 && y >= 0 && x + y <= 1 && t > 0 &&
                (nearest == 0 || t < nearest))
                nearest = t;
        }
    }
    return nearest;
}

// The distance ahead of what a place of the picture shows, by a ray.
static double ahead(const struct city_faces *f, const struct rg_camera *camera, double px,
                    double py)
{
    const double half = tan((double)camera->angle_deg / 2 * 3.141592653589793 / 180);
    const double x = (2 * px / WIDTH - 1) * half * WIDTH / HEIGHT, y = (1 - 2 * py / HEIGHT) * half;
    double forward[3], right[3], upward[3], way[3];
    for (int c = 0; c < 3; c++)
        forward[c] = (double)camera->target[c] - (double)camera->position[c];
    make_unit(forward);
    cross(forward, (const double[3]){0, 1, 0}, right);
    make_unit(right);
    cross(right, forward, upward);
    for (int c = 0; c < 3; c++)
        way[c] = forward[c] + right[c] * x + upward[c] * y;
    return reach(f, camera->position, way);
}

// Faces of four corners too are as far as they look, all over.
static void depth_is_where_rays_end(void **state)
{
    struct stage stage;
    struct picture *picture = malloc(sizeof(*picture));
    const struct scenery_look look = scenery_day();
    open_stage(*state, NULL, SCENERY_DAY, 1, &stage);
    const struct city_faces *faces = &scenery_city(stage.scene)->faces;
    int wrong = 0, met = 0;
    for (int i = 0; i < VIEWS; i++) {
        const struct rg_camera camera = camera_at(views[i][0], views[i][1]);
        const double near = (double)camera.near_plane, far = (double)camera.far_plane;
        draw(&stage, &camera, &look, false, picture);
        for (int k = 0; k < WIDTH * HEIGHT; k += 211) {
            float depth;
            memcpy(&depth, &picture->depth[k], sizeof(depth));
            const double drawn = depth < 1 ? near * far / (far - (double)depth * (far - near)) : 0;
            bool right = false;
            for (int j = 0; j < 5 && !right; j++) {
                const double x = k % WIDTH + 0.5 + (j == 1 ? 0.02 : j == 2 ? -0.02 : 0);
                const double y = (int)(k / WIDTH) + 0.5 + (j == 3 ? 0.02 : j == 4 ? -0.02 : 0);
                const double due = ahead(faces, &camera, x, y);
                right = fabs(drawn - due) <= 1e-3 * due + 1e-5 * due * due;
            }
            wrong += right ? 0 : 1;
            met += drawn > 0 ? 1 : 0;
        }
    }
    assert_int_equal(wrong, 0);
    assert_true(met > 150);
    free(picture);
    close_stage(&stage);
}

// --- a mesh ---

static void an_absent_mesh_is_refused(void **state)
{
    struct scenery_settings settings = {.model = "no/such/mesh.obj"};
    struct rg_instance instance = {.device = *state};
    assert_null(scenery_open(&instance, &settings));
    assert_non_null(strstr(rg_last_error(), "no/such/mesh.obj"));
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_day_as_the_reference),
        cmocka_unit_test(by_night_as_the_reference),
        cmocka_unit_test(a_mesh_as_the_reference),
        cmocka_unit_test(without_geometry_all_is_horizon),
        cmocka_unit_test(culling_changes_no_pixel),
        cmocka_unit_test(depth_from_above_is_the_height),
        cmocka_unit_test(depth_is_where_rays_end),
        cmocka_unit_test(an_absent_mesh_is_refused),
    };
    return raster_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
