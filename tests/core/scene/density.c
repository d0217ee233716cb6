// Density maps: codes taken literally, sums against brute force, and refusal of files that are no
// maps.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/image/files/io.h"
#include "core/scene/density.h"
#include "tests/core/techniques/rigs/packets.h"
#include "tests/oracle/streaks/packets.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"

// A PNG of these bytes, with 8 or 16 bits a channel (the more significant byte first).
static const char *write_png(int width, int height, int bits, int colour, const uint8_t *bytes)
{
    const char *path = in_folder("map.png");
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    if (setjmp(png_jmpbuf(png)))
        fail_msg("libpng failed");
    png_init_io(png, file);
    png_set_IHDR(png, info, (png_uint_32)width, (png_uint_32)height, bits, colour,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (int y = 0; y < height; y++)
        png_write_row(png, bytes + (size_t)y * png_get_rowbytes(png, info));
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    assert_int_equal(fclose(file), 0);
    return path;
}

static struct rg_density *read_and_remove(const char *path)
{
    struct rg_density *density = rg_density_read(path);
    assert_int_equal(unlink(path), 0);
    assert_non_null(density);
    return density;
}

static void expect_near(double actual, double expected, double within)
{
    if (!(fabs(actual - expected) <= within))
        fail_msg("%.17g, expected %.17g", actual, expected);
}

// --- values ---

// All codes of 8 bits, then of 16: a density is the code, not the light that it encodes.
static void test_codes_stand_as_they_are(void **state)
{
    (void)state;
    uint8_t bytes[256];
    for (int i = 0; i < 256; i++)
        bytes[i] = (uint8_t)i;
    struct rg_density *density = read_and_remove(write_png(16, 16, 8, PNG_COLOR_TYPE_GRAY, bytes));
    for (int i = 0; i < 256; i++)
        expect_near(rg_density_at(density, i % 16, i / 16), i / 255.0, 1e-15);
    rg_density_destroy(density);

    uint8_t *wide = malloc(2 * 65536);
    assert_non_null(wide);
    for (int i = 0; i < 65536; i++) {
        wide[2 * i] = (uint8_t)(i >> 8);
        wide[2 * i + 1] = (uint8_t)i;
    }
    density = read_and_remove(write_png(256, 256, 16, PNG_COLOR_TYPE_GRAY, wide));
    for (int i = 0; i < 65536; i++)
        expect_near(rg_density_at(density, i % 256, i / 256), i / 65535.0, 1e-12);
    rg_density_destroy(density);
    free(wide);
}

static void test_colours_and_alpha(void **state)
{
    (void)state;
    static const uint8_t colours[] = {200, 200, 200, 255, 0, 0, 0, 255, 0, 0, 0, 255, 10, 20, 30};
    static const double greys[] = {200 / 255.0, 0.2126, 0.7152, 0.0722,
                                   (2.126 + 14.304 + 2.166) / 255};
    struct rg_density *density = read_and_remove(write_png(5, 1, 8, PNG_COLOR_TYPE_RGB, colours));
    for (int i = 0; i < 5; i++)
        expect_near(rg_density_at(density, i, 0), greys[i], 1.0 / 65535);
    rg_density_destroy(density);

    static const uint8_t alpha[] = {100, 255, 100, 0, 100, 51};
    density = read_and_remove(write_png(3, 1, 8, PNG_COLOR_TYPE_GRAY_ALPHA, alpha));
    expect_near(rg_density_at(density, 0, 0), 100 / 255.0, 1e-12);
    assert_equals(rg_density_at(density, 1, 0), 0);
    expect_near(rg_density_at(density, 2, 0), 20 / 255.0, 1.0 / 65535);
    rg_density_destroy(density);
}

// Floats are divided by the file's largest value.
static void test_floats(void **state)
{
    (void)state;
    float texels[6] = {0, 3, 12, 0.75f, 24, 6};
    const struct rg_picture picture = {.width = 3, .height = 2, .channels = 1, .texels = texels};
    const char *path = in_folder("map.exr");
    assert_true(rg_picture_write(path, &picture, &(struct rg_write_options){.full_float = true}));
    struct rg_density *density = read_and_remove(path);
    for (int i = 0; i < 6; i++)
        expect_near(rg_density_at(density, i % 3, i / 3), (double)texels[i] / 24, 1e-7);
    rg_density_destroy(density);
}

static void test_gradient(void **state)
{
    (void)state;
    struct rg_density *density = rg_density_gradient();
    assert_non_null(density);
    // A cone of height 1 over a circle of radius 1 in a square of side 2.
    expect_near(rg_density_mean(density), acos(-1) / 12, 1e-6);
    const int side = density->width;
    assert_int_equal(side, density->height);
    expect_near(rg_density_at(density, side / 2, side / 2), 1, 2.0 / side);
    assert_equals(rg_density_at(density, 0, 0), 0);
    assert_equals(rg_density_at(density, side - 1, 0), 0);
    expect_near(rg_density_at(density, side / 4, side / 2), 0.5, 2.0 / side);
    uint64_t random = 5;
    for (int i = 0; i < 10; i++) {
        double r[4];
        for (int k = 0; k < 4; k++)
            r[k] = oracle_uniform(&random, -1, 1);
        const double left = fmin(r[0], r[1]), right = fmax(r[0], r[1]);
        const double top = fmin(r[2], r[3]), bottom = fmax(r[2], r[3]), scale = side / 2.0;
        expect_near(rg_density_mass(density, (left + 1) * scale, (top + 1) * scale,
                                    (right + 1) * scale, (bottom + 1) * scale) /
                        scale / scale,
                    oracle_gradient_mass(left, top, right, bottom), 2e-5);
    }
    rg_density_destroy(density);
}

// --- sums ---

static double overlap(double begin, double end, int texel)
{
    return fmax(0, fmin(end, texel + 1) - fmax(begin, texel));
}

static void test_mass_against_brute_force(void **state)
{
    (void)state;
    enum { WIDE = 9, HIGH = 13 };
    uint64_t random = 6;
    float texels[WIDE * HIGH];
    for (int i = 0; i < WIDE * HIGH; i++)
        texels[i] = i % 3 ? (float)(oracle_random(&random) % 1025) / 1024 : 0;
    texels[1] = 1;
    struct rg_density *density = rig_map(WIDE, HIGH, texels);
    for (int i = 0; i < 3000; i++) {
        double x[2], y[2];
        for (int k = 0; k < 2; k++) { // whole numbers among them
            x[k] = oracle_uniform(&random, 0, WIDE);
            y[k] = oracle_uniform(&random, 0, HIGH);
            if (i % 3 == 0)
                x[k] = rint(x[k]);
            if (i % 5 == 0)
                y[k] = rint(y[k]);
        }
        const double left = fmin(x[0], x[1]), right = fmax(x[0], x[1]);
        const double top = fmin(y[0], y[1]), bottom = fmax(y[0], y[1]);
        double expected = 0;
        for (int t = 0; t < WIDE * HIGH; t++)
            expected +=
                (double)texels[t] * overlap(left, right, t % WIDE) * overlap(top, bottom, t / WIDE);
        const double mass = rg_density_mass(density, left, top, right, bottom);
        expect_near(mass, expected, 1e-12);
        assert_true(expected > 0 || mass == 0); // the sum over black is exactly 0
    }
    rg_density_destroy(density);
}

// --- what is no map ---

static void expect_refused(int width, int height, int channels, const float *texels)
{
    struct rg_picture picture = {.width = width,
                                 .height = height,
                                 .channels = channels,
                                 .texels = (float *)(uintptr_t)texels};
    rig_listen();
    assert_null(rg_density_from_picture(&picture, "map"));
    assert_int_equal(rig_errors(), 1);
}

static void test_wrong_maps(void **state)
{
    (void)state;
    expect_refused(2, 2, 1, (const float[]){0, 0, 0, 0});
    expect_refused(2, 2, 1, (const float[]){1, -0.5f, 0, 0});
    expect_refused(2, 2, 1, (const float[]){1, NAN, 0, 0});
    expect_refused(2, 2, 1, (const float[]){1, 0, INFINITY, 0});
    expect_refused(2, 1, 2, (const float[]){1, 0, 1, 0}); // all of it transparent
    expect_refused(0, 0, 1, NULL);
    expect_refused(65536, 1025, 1, NULL); // too large: refused before a texel is read
    rig_listen();
    assert_null(rg_density_read(in_folder("absent.png")));
    assert_int_equal(rig_errors(), 1);
    FILE *file = fopen(in_folder("empty.png"), "wb");
    assert_non_null(file);
    fclose(file);
    rig_listen();
    assert_null(rg_density_read(in_folder("empty.png")));
    assert_int_equal(rig_errors(), 1);
    assert_int_equal(unlink(in_folder("empty.png")), 0);
    rg_density_destroy(NULL);
}

// A map of one grey means the same rain everywhere.
static void test_constant_map(void **state)
{
    (void)state;
    const float grey[1] = {0.125f};
    struct rg_density *density = rig_map(1, 1, grey);
    expect_near(rg_density_mean(density), 1, 1e-12);
    rg_density_destroy(density);
    const uint8_t code[4] = {51, 51, 51, 51};
    density = read_and_remove(write_png(2, 2, 8, PNG_COLOR_TYPE_GRAY, code));
    expect_near(rg_density_mean(density), 0.2, 1e-12);
    rg_density_destroy(density);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_codes_stand_as_they_are),
        cmocka_unit_test(test_colours_and_alpha),
        cmocka_unit_test(test_floats),
        cmocka_unit_test(test_gradient),
        cmocka_unit_test(test_mass_against_brute_force),
        cmocka_unit_test(test_wrong_maps),
        cmocka_unit_test(test_constant_map),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
