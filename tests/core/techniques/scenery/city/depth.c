// The scene of streaks, drawn: depth DEVICE. Culling removes nothing visible, and depth from above
// is the height of things there, by rays.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/device/work.h"
#include "kernels/scenery/openness_grid.h"
#include "tests/core/techniques/scenery/city/stage.h"
#include "tests/tools/expect.h"

enum { MAP_PX = 128 };

// Without geometry everything is horizon, to a half's last bit, and nothing hides later drawings.
static void without_geometry_all_is_horizon(void **state)
{
    struct stage stage;
    struct picture *picture = malloc(sizeof(*picture));
    const struct scenery_look look = scenery_night();
    const float due[4] = {look.sky.horizon_r, look.sky.horizon_g, look.sky.horizon_b, 1};
    struct scenery_view view;
    stage_open(*state, &(struct stage_settings){.time = SCENERY_NIGHT, .bare = true}, &stage);
    view = (struct scenery_view){.colour = stage.colour, .depth = stage.depth};
    assert_true(scenery_draw(stage.scene, &view, &look, stage.lights, false));
    assert_true(rg_image_read(stage.colour, 0, 0, picture->colour));
    assert_true(rg_image_read(stage.depth, 0, 0, picture->depth));
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const float one = 1;
        for (int c = 0; c < 4; c++) {
            const double drawn = stage_light(picture, i, c);
            assert_at_most(drawn, (double)due[c]);
            assert_above(drawn, (double)due[c] * (1 - 1.0 / 1024));
        }
        assert_memory_equal(&picture->depth[i], &one, sizeof(one));
    }
    free(picture);
    stage_close(&stage);
}

// --- what is left out ---

static int64_t bytes_of(struct rg_device *device, bool bare)
{
    const int64_t before = rg_device_work(device)->live_bytes;
    struct stage stage;
    stage_open(device, &(struct stage_settings){.bare = bare}, &stage);
    const int64_t bytes = rg_device_work(device)->live_bytes - before;
    stage_close(&stage);
    return bytes;
}

// Textures and the openness to the sky serve light alone, and do not exist without it.
static void what_is_never_lit_is_not_painted(void **state)
{
    struct stage stage;
    stage_open(*state, &(struct stage_settings){.bare = true}, &stage);
    const struct city *city = scenery_city(stage.scene);
    const int64_t texels = (int64_t)city->texture_px * city->texture_px * city->texture_count;
    stage_close(&stage);
    assert_at_least(bytes_of(*state, false) - bytes_of(*state, true),
                    4 * (texels + SCENERY_OPEN_WORDS));
}

static void culling_changes_no_pixel(void **state)
{
    struct stage stage;
    struct picture *pictures = malloc(2 * sizeof(*pictures));
    const struct scenery_look look = scenery_day();
    int drawn = 0, chunks = 0;
    stage_open(*state, &(struct stage_settings){.lights = 1}, &stage);
    for (int i = 0; i < 40; i++) {
        // between the views, and turning
        const int a = i % VIEWS, b = (i + 1 + i / VIEWS) % VIEWS;
        float position[3], target[3];
        for (int c = 0; c < 3; c++) {
            const float t = (float)(i / VIEWS) / 7;
            position[c] =
                stage_views[a][0][c] + t * (stage_views[b][0][c] - stage_views[a][0][c]) * 0.2f;
            target[c] = stage_views[a][1][c] + t * (stage_views[b][1][c] - stage_views[a][1][c]);
        }
        const struct rg_camera camera = stage_camera(position, target);
        stage_draw(&stage, &camera, &look, true, &pictures[0]);
        stage_draw(&stage, &camera, &look, false, &pictures[1]);
        drawn += scenery_last(stage.scene).chunks_drawn;
        chunks += scenery_last(stage.scene).chunks;
        assert_memory_equal(&pictures[0], &pictures[1], sizeof(pictures[0]));
    }
    assert_below(drawn * 2, chunks); // culling removes most
    free(pictures);
    stage_close(&stage);
}

// --- from above ---

// The height of the highest face at (x, z), seen from above.
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
    stage_open(*state, &(struct stage_settings){.lights = 1}, &stage);
    const struct rg_image_desc desc = {RG_D32F, MAP_PX, MAP_PX, 1, 1};
    const float farthest = 1, top = 240;
    struct rg_image *map = rg_image_create_with(*state, &desc, &farthest, "map");
    // x to the right, z down, depth 0 at the top and 1 on the ground.
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
        // An edge may be on either side of a pixel's centre, by the grid of 1/256 pixel.
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
    assert_between(above, 100, MAP_PX * MAP_PX / 37 - 100); // roofs, and streets between them
    rg_image_destroy(map);
    stage_close(&stage);
}

// --- from the streets ---

// The distance ahead of what a ray through a place of the picture meets; 0: nothing.
static double ahead(const struct scene *scene, const struct rg_camera *camera, double px, double py)
{
    const double from[3] = {(double)camera->position[0], (double)camera->position[1],
                            (double)camera->position[2]};
    double way[3], distance;
    stage_ray(camera, px, py, way);
    return scene_meet(scene, from, way, false, &distance) < 0 ? 0 : distance;
}

// Depth is right all over, also on faces of four corners.
static void depth_is_where_rays_end(void **state)
{
    struct stage stage;
    struct picture *picture = malloc(sizeof(*picture));
    const struct scenery_look look = scenery_day();
    stage_open(*state, &(struct stage_settings){.lights = 1}, &stage);
    const struct scene scene = stage_faces(&stage);
    int wrong = 0, met = 0;
    for (int i = 0; i < VIEWS; i++) {
        const struct rg_camera camera = stage_camera(stage_views[i][0], stage_views[i][1]);
        const double near = (double)camera.near_plane, far = (double)camera.far_plane;
        stage_draw(&stage, &camera, &look, false, picture);
        for (int k = 0; k < WIDTH * HEIGHT; k += 211) {
            float depth;
            memcpy(&depth, &picture->depth[k], sizeof(depth));
            const double drawn = depth < 1 ? near * far / (far - (double)depth * (far - near)) : 0;
            bool right = false;
            for (int j = 0; j < 5 && !right; j++) {
                const double x = k % WIDTH + 0.5 + (j == 1 ? 0.02 : j == 2 ? -0.02 : 0);
                const double y = (int)(k / WIDTH) + 0.5 + (j == 3 ? 0.02 : j == 4 ? -0.02 : 0);
                const double due = ahead(&scene, &camera, x, y);
                right = fabs(drawn - due) <= 1e-3 * due + 1e-5 * due * due;
            }
            wrong += right ? 0 : 1;
            met += drawn > 0 ? 1 : 0;
        }
    }
    assert_int_equal(wrong, 0);
    assert_above(met, 150);
    free(picture);
    stage_close(&stage);
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
        cmocka_unit_test(without_geometry_all_is_horizon),
        cmocka_unit_test(what_is_never_lit_is_not_painted),
        cmocka_unit_test(culling_changes_no_pixel),
        cmocka_unit_test(depth_from_above_is_the_height),
        cmocka_unit_test(depth_is_where_rays_end),
        cmocka_unit_test(an_absent_mesh_is_refused),
    };
    return raster_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
