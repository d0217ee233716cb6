// Pictures in memory: limits, alpha, half the size, and the codes on either side of each threshold.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "core/image/disc.h"
#include "core/image/picture.h"
#include "core/image/srgb.h"
#include "tests/tools/expect.h"

// The first float at which a code begins, and the last before it, by IEC 61966-2-1's own formula.
static void test_codes(void **state)
{
    (void)state;
    for (int c = 1; c < 256; c++) {
        const double encoded = (c - 0.5) / 255;
        const double begins =
            encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
        float first = (float)begins;
        if ((double)first < begins)
            first = nextafterf(first, 2);
        assert_int_equal(rg_srgb_code(rg_srgb(), first), c);
        assert_int_equal(rg_srgb_code(rg_srgb(), nextafterf(first, 0)), c - 1);
    }
}

static void test_limits(void **state)
{
    (void)state;
    struct rg_picture picture;
    char why[256];
    assert_false(rg_picture_allocate(&picture, 65536, 32768, 4, why, sizeof(why))); // 32 GiB
    assert_non_null(strstr(why, "above the limit"));
    assert_false(rg_picture_allocate(&picture, 65537, 1, 1, why, sizeof(why)));
    assert_false(rg_picture_allocate(&picture, 1, 0, 1, why, sizeof(why)));
    assert_false(rg_picture_allocate(&picture, 1, 1, 5, why, sizeof(why)));
    assert_null(picture.texels);
    assert_true(rg_picture_allocate(&picture, 65536, 1, 1, why, sizeof(why)));
    rg_picture_destroy(&picture);
}

// Alpha is dropped only if all of it is 1.
static void test_alpha(void **state)
{
    (void)state;
    for (int channels = 1; channels <= 4; channels++)
        for (int clear = 0; clear <= 3; clear++) { // the texel that is not opaque; 3: none
            struct rg_picture picture;
            assert_true(rg_picture_create(&picture, 3, 1, channels, "a picture"));
            const int colours = rg_picture_colours(&picture);
            for (int i = 0; i < 3 * channels; i++) {
                const bool is_alpha = i % channels >= colours;
                picture.texels[i] = !is_alpha ? (float)i : i / channels == clear ? 0.5f : 1.0f;
            }
            rg_picture_drop_opaque_alpha(&picture);
            const int kept = clear == 3 ? colours : channels;
            assert_int_equal(picture.channels, kept);
            for (int i = 0; i < 3; i++)
                for (int c = 0; c < colours; c++)
                    assert_equals(picture.texels[i * kept + c], (float)(i * channels + c));
            rg_picture_destroy(&picture);
        }
}

// Odd sizes lose the last row and column; the flag `decoded` is kept.
static void test_half(void **state)
{
    (void)state;
    for (int decoded = 0; decoded < 2; decoded++) {
        struct rg_picture picture;
        assert_true(rg_picture_create(&picture, 5, 3, 1, "a picture"));
        for (int i = 0; i < 15; i++)
            picture.texels[i] = (float)(i * i);
        picture.decoded = decoded;
        assert_true(rg_picture_halve(&picture));
        assert_int_equal(picture.width, 2);
        assert_int_equal(picture.height, 1);
        assert_equals(picture.texels[0], (0 + 1 + 25 + 36) / 4.0f);
        assert_equals(picture.texels[1], (4 + 9 + 49 + 64) / 4.0f);
        assert_int_equal(picture.decoded, decoded);
        rg_picture_destroy(&picture);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_codes),
        cmocka_unit_test(test_limits),
        cmocka_unit_test(test_alpha),
        cmocka_unit_test(test_half),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
