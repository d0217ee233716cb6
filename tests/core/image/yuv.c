// Frames of a clip: the codes that BT.709 gives colours, in closed cases and against its formula in
// double precision.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "core/image/clip/yuv.h"
#include "core/image/srgb.h"
#include "tests/tools/expect.h"

enum { MOST_BYTES = 64 };

// A picture of so many pixels with these sRGB codes, three a pixel.
static struct rg_picture picture_of(int width, int height, const uint8_t *codes)
{
    struct rg_picture picture;
    assert_true(rg_picture_create(&picture, width, height, 3, "test"));
    for (int64_t i = 0; i < rg_picture_values(&picture); i++)
        picture.texels[i] = rg_srgb()->linear[codes[i]];
    return picture;
}

// The frame of such a picture; nothing may be written past its end.
static void encode(int width, int height, const uint8_t *codes, uint8_t yuv[MOST_BYTES])
{
    struct rg_picture picture = picture_of(width, height, codes);
    const size_t bytes = rg_yuv_bytes(width, height);
    assert_below(bytes, MOST_BYTES);
    memset(yuv, 0x99, MOST_BYTES);
    rg_yuv_encode(&picture, 1, yuv);
    for (size_t i = bytes; i < MOST_BYTES; i++)
        assert_int_equal(yuv[i], 0x99);
    rg_picture_destroy(&picture);
}

static void expect_colour(uint8_t red, uint8_t green, uint8_t blue, int y, int cb, int cr)
{
    const uint8_t codes[] = {red, green, blue};
    uint8_t yuv[MOST_BYTES];
    encode(1, 1, codes, yuv);
    assert_int_equal(yuv[0], y);
    assert_int_equal(yuv[1], cb);
    assert_int_equal(yuv[2], cr);
}

// The codes of colour bars of 100 %, as in test signals.
static void colour_bars_have_their_codes(void **state)
{
    (void)state;
    expect_colour(0, 0, 0, 16, 128, 128);
    expect_colour(255, 255, 255, 235, 128, 128);
    expect_colour(255, 0, 0, 63, 102, 240);
    expect_colour(0, 255, 0, 173, 42, 26);
    expect_colour(0, 0, 255, 32, 240, 118);
    expect_colour(255, 255, 0, 219, 16, 138);
    expect_colour(0, 255, 255, 188, 154, 16);
    expect_colour(255, 0, 255, 78, 214, 230);
}

// The nearest code to a value; either neighbour if it lies halfway.
static void expect_nearest(int code, double value)
{
    assert_at_most(fabs(code - value), 0.5 + 1e-9);
}

static void every_code_is_the_nearest_to_the_formula(void **state)
{
    (void)state;
    const double kr = 0.2126, kb = 0.0722, kg = 1 - kr - kb;
    for (int i = 0; i < 18 * 18 * 18; i++) {
        const uint8_t codes[] = {(uint8_t)(i % 18 * 15), (uint8_t)(i / 18 % 18 * 15),
                                 (uint8_t)(i / 18 / 18 * 15)};
        const double r = codes[0] / 255.0, g = codes[1] / 255.0, b = codes[2] / 255.0;
        const double y = kr * r + kg * g + kb * b;
        uint8_t yuv[MOST_BYTES];
        encode(1, 1, codes, yuv);
        expect_nearest(yuv[0], 16 + 219 * y);
        expect_nearest(yuv[1], 128 + 224 * (b - y) / (2 * (1 - kb)));
        expect_nearest(yuv[2], 128 + 224 * (r - y) / (2 * (1 - kr)));
    }
}

// 3 x 3 pixels make one whole square, one of a column, one of a row, and one of a single pixel. A
// square's red is its share of the pixels that it has.
static void squares_have_the_mean_of_their_pixels(void **state)
{
    (void)state;
    static const uint8_t codes[] = {
        255, 0, 0, 0, 0, 0, 0,   0, 0, // red    black  black
        0,   0, 0, 0, 0, 0, 255, 0, 0, // black  black  red
        255, 0, 0, 0, 0, 0, 255, 0, 0, // red    black  red
    };
    static const int red_pixels[] = {1, 2, 2, 4}; // in quarters of each square
    uint8_t yuv[MOST_BYTES];
    encode(3, 3, codes, yuv);
    assert_int_equal(rg_yuv_bytes(3, 3), 9 + 4 + 4);
    for (int i = 0; i < 9; i++)
        assert_int_equal(yuv[i], codes[3 * i] ? 63 : 16);
    for (int i = 0; i < 4; i++) {
        const double y = 0.2126 * red_pixels[i] / 4;
        expect_nearest(yuv[9 + i], 128 - 224 * y / (2 * (1 - 0.0722)));
        expect_nearest(yuv[13 + i], 128 + 224 * (red_pixels[i] / 4.0 - y) / (2 * (1 - 0.2126)));
    }
}

static void exposure_alpha_and_grey_are_those_of_a_png(void **state)
{
    (void)state;
    float bright[] = {0.25f, 2.0f, -1.0f, 0.5f}, dim[] = {0.5f};
    uint8_t yuv[3], same[MOST_BYTES];
    const uint8_t grey = rg_srgb_code(rg_srgb(), 0.5f);
    const uint8_t codes[] = {grey, 255, 0}, greys[] = {grey, grey, grey};
    rg_yuv_encode(&(struct rg_picture){.width = 1, .height = 1, .channels = 4, .texels = bright}, 2,
                  yuv);
    encode(1, 1, codes, same);
    assert_memory_equal(yuv, same, 3);
    rg_yuv_encode(&(struct rg_picture){.width = 1, .height = 1, .channels = 1, .texels = dim}, 1,
                  yuv);
    encode(1, 1, greys, same);
    assert_memory_equal(yuv, same, 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colour_bars_have_their_codes),
        cmocka_unit_test(every_code_is_the_nearest_to_the_formula),
        cmocka_unit_test(squares_have_the_mean_of_their_pixels),
        cmocka_unit_test(exposure_alpha_and_grey_are_those_of_a_png),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
