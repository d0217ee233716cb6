// The city as an environment map: around DEVICE. In each direction the map holds what a camera in
// its middle sees there.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/device/work.h"
#include "core/image/files/io.h"
#include "core/scene/environment/cube.h"
#include "core/techniques/scenery/environment.h"
#include "core/techniques/stages/assets.h"
#include "tests/core/techniques/scenery/city/stage.h"
#include "tests/oracle/flow/light.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"

enum { FACE_PX = 512, TILE = 10 };

// The faces without borders, as the oracle reads them.
static struct light_cube cube_of(const struct rg_environment *environment)
{
    const int n = environment->size;
    float *light = malloc((size_t)n * (size_t)n * 18 * sizeof(*light)), *to = light;
    for (int face = 0; face < 6; face++)
        for (int y = 0; y < n; y++)
            for (int x = 0; x < n; x++, to += 3)
                memcpy(to, rg_environment_texel(environment, face, x, y), 3 * sizeof(*to));
    return (struct light_cube){light, n};
}

// The light of a tile: as a camera's pixels see it, and as the map has it.
struct tile {
    double seen[3], read[3];
};

static struct tile tile_of(const struct light_cube *cube, const struct rg_camera *camera,
                           const struct picture *picture, int first, bool turned)
{
    struct tile tile = {{0}, {0}};
    for (int i = 0; i < TILE * TILE; i++) {
        const int pixel = first + i / TILE * WIDTH + i % TILE;
        double way[3], light[3];
        stage_ray(camera, pixel % WIDTH + 0.5, (int)(pixel / WIDTH) + 0.5, way);
        if (turned)
            way[0] = -way[0];
        light_from_cube(cube, way, light);
        for (int c = 0; c < 3; c++) {
            tile.seen[c] += stage_light(picture, pixel, c);
            tile.read[c] += light[c];
        }
    }
    return tile;
}

// The share of a camera's tiles whose light in the map is off by more than 10 %, with the map read
// mirrored or not. Single pixels are off where edges and texels are finer than a pixel.
static double share_off(const struct light_cube *cube, const struct rg_camera *camera,
                        const struct picture *picture, bool turned)
{
    int off = 0, tiles = 0;
    for (int y = 0; y < HEIGHT; y += TILE)
        for (int x = 0; x < WIDTH; x += TILE) {
            const struct tile tile = tile_of(cube, camera, picture, y * WIDTH + x, turned);
            bool differs = false;
            for (int c = 0; c < 3; c++)
                differs |= fabs(tile.read[c] - tile.seen[c]) > 0.1 * tile.seen[c];
            off += differs;
            tiles++;
        }
    return off / (double)tiles;
}

static void the_map_is_what_is_seen(void **state)
{
    static const float ways[][3] = {{0.3f, 0.1f, -1}, {1, 0.4f, 0.5f},  {-1, -0.3f, 0.2f},
                                    {0.5f, 1, -0.4f}, {-0.3f, 0.2f, 1}, {0.2f, -1, 0.3f}};
    struct stage stage;
    struct picture *picture = malloc(sizeof(*picture));
    const struct scenery_look look = scenery_day();
    struct rg_environment *environment = scenery_environment("city", FACE_PX, *state);
    assert_true(environment);
    assert_equals(environment->size, FACE_PX);
    const struct light_cube cube = cube_of(environment);
    stage_open(*state, &(struct stage_settings){.lights = 1, .whole = true}, &stage);
    for (size_t i = 0; i < sizeof(ways) / sizeof(ways[0]); i++) {
        float target[3];
        for (int c = 0; c < 3; c++)
            target[c] = city_first_camera.position[c] + ways[i][c];
        const struct rg_camera camera = stage_camera(city_first_camera.position, target);
        stage_draw(&stage, &camera, &look, false, picture);
        const double off = share_off(&cube, &camera, picture, false),
                     turned = share_off(&cube, &camera, picture, true);
        print_message("view %zu: %.1f %% off, turned %.1f %%\n", i, 100 * off, 100 * turned);
        assert_below(off, 0.03);
        assert_above(turned, 0.2);
    }
    free((float *)cube.light);
    free(picture);
    stage_close(&stage);
    rg_environment_destroy(environment);
}

static void other_names_are_loaded(void **state)
{
    struct rg_environment *sky = scenery_environment("sky", 64, *state);
    assert_non_null(sky);
    rg_environment_destroy(sky);
    assert_null(scenery_environment("no/such.ktx", 64, *state));
}

// --- instances share it ---

static void write_picture(const char *path, int height)
{
    struct rg_picture picture;
    assert_true(rg_picture_create(&picture, 2 * height, height, 3, path));
    for (int i = 0; i < 2 * height * height * 3; i++)
        picture.texels[i] = 1;
    assert_true(rg_picture_write(path, &picture, &(struct rg_write_options){0}));
    rg_picture_destroy(&picture);
}

static struct rg_image *added(struct rg_instance *instance, struct rg_device *device,
                              const char *name, double blur_rad)
{
    *instance = (struct rg_instance){.device = device};
    scenery_add_environment(instance, &(struct scenery_around){name, 32, 2, blur_rad});
    assert_false(instance->has_failed);
    assert_ptr_equal(instance->textures[0].image, rg_asset_find(instance, "environment")->image);
    return rg_asset_find(instance, "environment")->image;
}

static void instances_share_an_environment(void **state)
{
    struct rg_instance all[4];
    struct rg_device *device = *state;
    const int64_t before = rg_device_work(device)->live_bytes;
    struct rg_image *image = added(&all[0], device, "street", 0.1);
    const int64_t taken = rg_device_work(device)->live_bytes;
    assert_ptr_equal(added(&all[1], device, "street", 0.1), image);
    assert_int_equal(rg_device_work(device)->live_bytes, taken);
    assert_ptr_not_equal(added(&all[2], device, "street", 0), image);
    assert_ptr_not_equal(added(&all[3], device, "street-night", 0.1), image);
    rg_assets_free(&all[0]);
    assert_ptr_equal(added(&all[0], device, "street", 0.1), image);
    for (int i = 0; i < 4; i++)
        rg_assets_free(&all[i]);
    assert_int_equal(rg_device_work(device)->live_bytes, before);
}

static void a_file_that_has_changed_is_read_again(void **state)
{
    struct rg_instance all[3];
    const char *path = in_folder("around.exr");
    write_picture(path, 16);
    struct rg_image *image = added(&all[0], *state, path, 0);
    assert_ptr_equal(added(&all[1], *state, path, 0), image);
    write_picture(path, 32);
    assert_ptr_not_equal(added(&all[2], *state, path, 0), image);
    assert_int_equal(unlink(path), 0);
    for (int i = 0; i < 3; i++)
        rg_assets_free(&all[i]);
}

static void what_cannot_be_read_fails_the_instance(void **state)
{
    struct rg_instance instance = {.device = *state};
    scenery_add_environment(&instance, &(struct scenery_around){"no/such.ktx", 32, 1, 0});
    assert_true(instance.has_failed);
    assert_int_equal(instance.asset_count, 0);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_map_is_what_is_seen),
        cmocka_unit_test(other_names_are_loaded),
        cmocka_unit_test(instances_share_an_environment),
        cmocka_unit_test_setup_teardown(a_file_that_has_changed_is_read_again, make_folder,
                                        remove_folder),
        cmocka_unit_test(what_cannot_be_read_fails_the_instance),
    };
    return raster_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
