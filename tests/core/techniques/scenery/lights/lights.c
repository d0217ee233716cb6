// The lights of a scene as streaks opens them: lights DEVICE.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "tests/core/techniques/scenery/lights/rig.h"
#include "tests/tools/expect.h"

static const struct city_lamp lamps[] = {
    {CITY_STREET_LAMP, {9, 8, 11}, {0, -1, 0}, {0}},
    {CITY_TRAFFIC_RED, {3, 2, 3}, {0.6f, 0, 0.8f}, {0}},
};

static struct scenery_lights_settings three_lights(void)
{
    struct scenery_lights_settings s = rig_bounds;
    static const float to_rain[16] = {1, 0, 0, 0, 0, 0, -1, 0, 0, -1, 0, 9, 0, 0, 0, 1};
    s.count = 3;
    s.lamps = lamps;
    s.lamp_count = 2;
    memcpy(s.world_to_frame, to_rain, sizeof(to_rain));
    return s;
}

// Rain falls along -y from a height of 9 m: (x, y, s) = (x, -z, 9 - y).
static void lights_open_in_both_frames(void **state)
{
    const struct scenery_lights_settings settings = three_lights();
    struct scenery_lights *lights = scenery_lights_open(*state, &settings);
    assert_non_null(lights);
    assert_int_equal(lights->count, 3);
    assert_int_equal(lights->map_count, 3);
    assert_int_equal(lights->shadows->desc.width, MAP_PX);
    assert_int_equal(lights->shadows->desc.layers, 3);
    scenery_light world[3], rain[3];
    assert_true(rg_buf_read(lights->in_world, 0, world, sizeof(world)) &&
                rg_buf_read(lights->in_frame, 0, rain, sizeof(rain)));
    assert_memory_equal(world, lights->world, sizeof(world));
    for (int i = 0; i < 3; i++) {
        assert_equals(rain[i].x, world[i].x);
        assert_equals(rain[i].y, -world[i].z);
        assert_float_equal(rain[i].z, 9 - world[i].y, 1e-6f);
        assert_equals(rain[i].dx, world[i].dx);
        assert_equals(rain[i].dy, -world[i].dz);
        assert_equals(rain[i].dz, -world[i].dy);
        assert_equals(rain[i].r, world[i].r);
        assert_equals(rain[i].shadow_layer, i);
    }
    scenery_lights_close(lights);
}

static void each_light_draws_its_own_layers(void **state)
{
    struct rig rig = rig_open(*state);
    const struct scenery_lights_settings settings = three_lights();
    struct scenery_lights *lights = scenery_lights_open(*state, &settings);
    float *texels = malloc(MAP_PX * MAP_PX * sizeof(float));
    for (int again = 0; again < 2; again++) // drawn again, maps hold the same
        assert_true(scenery_lights_shade(lights, rig_draw_scene, &rig));
    for (int layer = 0; layer < 3; layer++) {
        int drawn = 0;
        assert_true(rg_image_read(lights->shadows, layer, 0, texels));
        for (int i = 0; i < MAP_PX * MAP_PX; i++)
            drawn += texels[i] < 1;
        assert_above(drawn, MAP_PX * MAP_PX / 4);
    }
    free(texels);
    scenery_lights_close(lights);
    rig_close(&rig);
}

static void without_shadows_no_map_is_drawn(void **state)
{
    struct scenery_lights_settings settings = three_lights();
    settings.shadows = false;
    struct scenery_lights *lights = scenery_lights_open(*state, &settings);
    assert_non_null(lights);
    assert_int_equal(lights->map_count, 0);
    assert_int_equal(lights->shadows->desc.width, 1);
    for (int i = 0; i < 3; i++)
        assert_int_equal(lights->world[i].shadow_layer, -1);
    assert_true(scenery_lights_shade(lights, NULL, NULL));
    scenery_lights_close(lights);
}

static void no_lights_are_none(void **state)
{
    struct scenery_lights_settings settings = three_lights();
    for (int time = SCENERY_DAY; time <= SCENERY_NIGHT; time++) {
        settings.count = 0;
        settings.time = (enum scenery_time)time;
        struct scenery_lights *lights = scenery_lights_open(*state, &settings);
        assert_true(lights);
        assert_equals(lights->count, 0);
        assert_equals(lights->map_count, 0);
        assert_true(lights->in_world);
        assert_true(lights->in_frame);
        assert_true(lights->shadows);
        assert_above(lights->sky[0], 0);
        assert_true(scenery_lights_shade(lights, NULL, NULL));
        scenery_lights_close(lights);
    }
}

// As docs/lights.md has it: white ground 8 m below a street lamp has 2.6 by night, lamps are three
// times as bright as by day, and a street lamp shines 78 degrees to either side.
static void lamps_are_as_bright_and_as_wide_as_told(void **state)
{
    struct scenery_lights_settings settings = three_lights();
    scenery_light lamp[2][2];
    for (int night = 0; night < 2; night++) {
        settings.time = night ? SCENERY_NIGHT : SCENERY_DAY;
        struct scenery_lights *lights = scenery_lights_open(*state, &settings);
        assert_non_null(lights);
        memcpy(lamp[night], lights->world + 1 - night, sizeof(lamp[night])); // the sun is first
        scenery_lights_close(lights);
    }
    assert_below(fabs((double)lamp[1][0].r / (8 * 8) - 2.6), 0.05);
    for (int i = 0; i < 2; i++) {
        assert_float_equal(lamp[1][i].r, 3 * lamp[0][i].r, 1e-5f);
        assert_float_equal(lamp[1][i].g, 3 * lamp[0][i].g, 1e-5f);
        assert_float_equal(lamp[1][i].b, 3 * lamp[0][i].b, 1e-5f);
        assert_equals(lamp[1][i].cos_outer, lamp[0][i].cos_outer);
    }
    assert_float_equal(lamp[1][0].cos_outer, cos(78 * acos(-1) / 180), 1e-6f);
}

static void lights_that_cannot_be_are_refused(void **state)
{
    struct scenery_lights_settings settings = three_lights();
    settings.count = -2;
    assert_null(scenery_lights_open(*state, &settings));
    assert_non_null(strstr(rg_last_error(), "lights: -2 asked for"));
    settings.count = 17;
    assert_null(scenery_lights_open(*state, &settings));
    assert_non_null(strstr(rg_last_error(), "lights: 17 asked for"));
    settings.count = 3;
    settings.shadow_map_px = 15;
    assert_null(scenery_lights_open(*state, &settings));
    assert_non_null(strstr(rg_last_error(), "shadow_map_px: 15"));
    settings.shadow_map_px = 16384;
    assert_null(scenery_lights_open(*state, &settings));
    assert_non_null(strstr(rg_last_error(), "3 shadow maps of 16384 texels take 3072 MiB"));
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_open_in_both_frames),
        cmocka_unit_test(each_light_draws_its_own_layers),
        cmocka_unit_test(without_shadows_no_map_is_drawn),
        cmocka_unit_test(no_lights_are_none),
        cmocka_unit_test(lamps_are_as_bright_and_as_wide_as_told),
        cmocka_unit_test(lights_that_cannot_be_are_refused),
    };
    return raster_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
