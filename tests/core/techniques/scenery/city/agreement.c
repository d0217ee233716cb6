// The city drawn by day and by night, and a mesh in its place: agreement DEVICE. Every byte of
// colour and depth is cpu:reference's.
#include <stdlib.h>

#include "tests/core/techniques/scenery/city/stage.h"

static void compare_stages(struct rg_device *device, const char *model, enum scenery_time time,
                           int lights, int view_count)
{
    struct rg_device *reference = rg_device_open("cpu:reference");
    struct stage stages[2];
    struct picture *pictures = malloc(2 * sizeof(*pictures));
    const struct scenery_look look = time == SCENERY_DAY ? scenery_day() : scenery_night();
    const struct stage_settings settings = {.model = model, .time = time, .lights = lights};
    stage_open(reference, &settings, &stages[0]);
    stage_open(device, &settings, &stages[1]);
    for (int i = 0; i < view_count; i++) {
        const struct rg_camera camera = stage_camera(stage_views[i][0], stage_views[i][1]);
        for (int k = 0; k < 2; k++)
            stage_draw(&stages[k], &camera, &look, false, &pictures[k]);
        assert_memory_equal(pictures[0].depth, pictures[1].depth, sizeof(pictures[0].depth));
        assert_memory_equal(pictures[0].colour, pictures[1].colour, sizeof(pictures[0].colour));
    }
    free(pictures);
    stage_close(&stages[0]);
    stage_close(&stages[1]);
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

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_day_as_the_reference),
        cmocka_unit_test(by_night_as_the_reference),
        cmocka_unit_test(a_mesh_as_the_reference),
    };
    return raster_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
