// Lines and sheets of the overlay: agreement DEVICE. Every byte is cpu:reference's.
#include <math.h>
#include <stdlib.h>

#include "tests/core/techniques/scenery/overlay/rig.h"

static void fill(struct scenery_overlay *overlay)
{
    scenery_overlay_begin(overlay);
    for (uint32_t i = 0; i < 3000; i++) {
        const double size = exp((double)between(i, 0, -4, 9));
        float at[4][3];
        for (uint32_t k = 0; k < 4; k++)
            for (uint32_t c = 0; c < 3; c++)
                at[k][c] = between(i, 1 + c, -6, 6) + between(i, 4 + 3 * k + c, -size, size);
        const struct scenery_ink ink = {between(i, 20, 0, 1), between(i, 21, 0, 1),
                                        between(i, 22, 0, 1), between(i, 23, 0, 1),
                                        between(i, 24, 0, 20)};
        if (i % 5)
            scenery_overlay_line(overlay, at[0], i % 97 ? at[1] : at[0], &ink);
        else
            scenery_overlay_sheet(overlay, at, &ink, i % 10 ? 0.5f : 0);
    }
}

static void all_bytes_are_those_of_the_reference(void **state)
{
    static const enum rg_format formats[] = {RG_RGBA8, RG_RGBA16F, RG_RGBA32F};
    struct rg_device *devices[2] = {*state, rg_device_open("cpu:reference")};
    assert_non_null(devices[1]);
    float to_clip[16];
    overlay_look(to_clip);
    for (int f = 0; f < 3; f++) {
        const size_t bytes = (size_t)(WIDTH * HEIGHT * rg_format_size(formats[f]));
        void *texels[2];
        for (int d = 0; d < 2; d++) {
            struct rg_instance instance;
            struct scenery_overlay *overlay = open_overlay(devices[d], &instance);
            struct picture p = picture_make(devices[d], formats[f], 0.95f);
            texels[d] = malloc(bytes);
            fill(overlay);
            assert_true(scenery_overlay_draw(overlay, to_clip, p.colour, p.depth));
            assert_true(rg_image_read(p.colour, 0, 0, texels[d]));
            picture_free(&p);
            close_overlay(overlay, &instance);
        }
        assert_memory_equal(texels[0], texels[1], bytes);
        free(texels[0]);
        free(texels[1]);
    }
    assert_true(rg_device_close(devices[1]));
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_bytes_are_those_of_the_reference),
    };
    return raster_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
