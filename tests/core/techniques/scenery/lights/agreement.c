// Streaks' lights at points, and their shadow maps: agreement DEVICE. Every byte is
// cpu:reference's.
#include <stdlib.h>

#include "tests/core/techniques/scenery/lights/rig.h"

static void all_bytes_are_those_of_the_reference(void **state)
{
    struct rg_device *reference = rg_device_open("cpu:reference");
    assert_non_null(reference);
    struct rig rigs[2] = {rig_open(*state), rig_open(reference)};
    float *points = rig_make_points(), *texels[2];
    test_streaks_lit *lit[2];
    for (int r = 0; r < 2; r++) {
        lit[r] = rig_light_points(&rigs[r], rigs[r].lights, LIGHTS, points, POINTS);
        texels[r] = malloc(MAP_PX * MAP_PX * sizeof(float));
    }
    assert_memory_equal(lit[0], lit[1], LIGHTS * POINTS * sizeof(*lit[0]));
    for (int layer = 0; layer < rigs[0].layers; layer++) {
        for (int r = 0; r < 2; r++)
            assert_true(rg_image_read(rigs[r].maps, layer, 0, texels[r]));
        assert_memory_equal(texels[0], texels[1], MAP_PX * MAP_PX * sizeof(float));
    }
    for (int r = 0; r < 2; r++) {
        free(lit[r]);
        free(texels[r]);
        rig_close(&rigs[r]);
    }
    free(points);
    assert_true(rg_device_close(reference));
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_bytes_are_those_of_the_reference),
    };
    return raster_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
