// The whole atlas: sizes of the thesis, cells without leaks, levels that keep the light.
//
//     atlas FOLDER_OF_PUBLISHED_TABLES
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/device/device.h"
#include "core/scene/atlas/cache.h"
#include "core/scene/atlas/levels.h"
#include "core/scene/atlas/splash.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

static const char *published;
static struct rg_atlas *small;
static int calls;

static void tell(void *user, int done, int total)
{
    (void)user;
    assert_int_equal(done, ++calls);
    assert_at_most(done, total);
}

static int setup(void **state)
{
    (void)state;
    const struct rg_atlas_progress progress = {tell, NULL};
    rg_log_listen(log_last, NULL);
    small = rg_atlas_make(RG_ATLAS_SMALL, &progress);
    return !small || calls != RG_ATLAS_OSCILLATIONS * RG_ATLAS_VIEWS;
}

static int teardown(void **state)
{
    (void)state;
    rg_atlas_destroy(small);
    return 0;
}

static const uint16_t *texel(enum rg_atlas_part part, int layer, int level, int x, int y)
{
    const int width = rg_level_size(small->images[part].width, level);
    return rg_atlas_texels(small, part, layer, level) + y * width + x;
}

static FILE *open_table(const char *name)
{
    char path[1024];
    snprintf(path, sizeof(path), "%s/%s", published, name);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    char header[128];
    assert_non_null(fgets(header, sizeof(header), file));
    return file;
}

// Tables 5.1 and 5.2 and the numbers of pixels that the thesis gives.
static void test_published_sizes(void **state)
{
    (void)state;
    struct rg_atlas *full = rg_atlas_allocate(RG_ATLAS_FULL);
    assert_non_null(full);
    char name[32];
    int level, width, height, rows = 0;
    FILE *file = open_table("creus-5.1.csv");
    while (fscanf(file, " %31[a-z],%d,%d,%d", name, &level, &width, &height) == 4) {
        const int part = name[0] == 'p' ? RG_ATLAS_POINT : RG_ATLAS_ENV;
        assert_below(level, full->images[part].levels);
        assert_int_equal(rg_level_size(full->images[part].width, level), width);
        assert_int_equal(rg_level_size(full->images[part].height, level), height);
        rows++;
    }
    fclose(file);
    assert_int_equal(rows, full->images[RG_ATLAS_POINT].levels + full->images[RG_ATLAS_ENV].levels);
    file = open_table("creus-5.2.csv");
    for (rows = 0; fscanf(file, "%d,%d,%d", &level, &width, &height) == 3; rows++) {
        assert_int_equal(rg_level_size(RG_SPLASH_WIDTH_PX, level), width);
        assert_int_equal(rg_level_size(RG_SPLASH_HEIGHT_PX, level), height);
    }
    fclose(file);
    assert_int_equal(rows, full->images[RG_ATLAS_SPLASH].levels);
    assert_int_equal(rg_atlas_image_texels(&full->images[RG_ATLAS_POINT]), 10 * 13846232);
    assert_int_equal(rg_atlas_image_texels(&full->images[RG_ATLAS_ENV]), 10 * 153919);
    assert_int_equal(rg_atlas_image_texels(&full->images[RG_ATLAS_SPLASH]), 4 * 42987);
    rg_atlas_destroy(full);
}

// Rows of cells tile every level, without a gap.
static void test_rows(void **state)
{
    (void)state;
    static const int heights[4][5] = {{1050, 988, 810, 544, 214},
                                      {525, 494, 405, 272, 107},
                                      {262, 247, 203, 136, 53},
                                      {131, 123, 102, 68, 26}};
    for (int level = 0; level < RG_ATLAS_CELL_LEVELS; level++) {
        int at = 0;
        for (int view = 0; view < RG_ATLAS_VIEWS; view++) {
            assert_int_equal(rg_atlas_row_start(view, level), at);
            if (level < 4)
                assert_int_equal(rg_atlas_row_height(view, level), heights[level][view]);
            at += rg_atlas_row_height(view, level);
        }
        assert_int_equal(at, RG_ATLAS_HEIGHT_PX >> level);
    }
}

// Every cell's largest value is 1 and has a factor. Cells of oscillation 0 have a dark margin.
static void test_cells(void **state)
{
    (void)state;
    for (int k = 0; k < RG_ATLAS_OSCILLATIONS; k++)
        for (int view = 0; view < RG_ATLAS_VIEWS; view++)
            for (int cell = 0; cell < RG_ATLAS_CELLS; cell++) {
                uint16_t largest = 0, edge = 0;
                const int first = rg_atlas_row_start(view, 2), rows = rg_atlas_row_height(view, 2);
                for (int r = first; r < first + rows; r++)
                    for (int c = 0; c < 8; c++) {
                        const uint16_t value = *texel(RG_ATLAS_POINT, k, 0, cell * 8 + c, r);
                        largest = value > largest ? value : largest;
                        edge = (c == 0 || c == 7 || r == first || r == first + rows - 1) &&
                                       value > edge
                                   ? value
                                   : edge;
                    }
                assert_int_equal(largest, 0x3c00); // 1
                assert_true(edge == 0 || k > 0);   // other oscillations swing into the margin
                assert_above((&small->point_factor[k][view][0][0])[cell], 1e-5f);
                assert_below((&small->point_factor[k][view][0][0])[cell], 10);
            }
}

// Light from straight above or below has no azimuth, so that its nine cells hold one picture.
static void test_poles(void **state)
{
    (void)state;
    for (int light = 0; light < 10; light += 9)
        for (int phi = 1; phi < 9; phi++)
            for (int r = 0; r < 901; r++) {
                const int x = light * 72;
                assert_memory_equal(texel(RG_ATLAS_POINT, 3, 0, x, r),
                                    texel(RG_ATLAS_POINT, 3, 0, x + 8 * phi, r), 16);
                assert_equals(small->point_factor[3][r % 5][light][0],
                              small->point_factor[3][r % 5][light][phi]);
            }
}

// The mean of a cell at a level, over its height in level 0.
static double mean_of(enum rg_atlas_part part, int layer, int view, int cell, int level)
{
    const int first = rg_atlas_row_start(view, level + 2), width = 8 >> level;
    const int rows = rg_atlas_row_height(view, level + 2);
    double sum = 0;
    for (int r = first; r < first + rows; r++)
        for (int c = 0; c < width; c++)
            sum += (double)rg_half_value(*texel(part, layer, level, cell * width + c, r));
    return sum / (rows * width);
}

// Each level of a cell holds the light of the first: other cells do not leak in.
static void test_levels_keep_light(void **state)
{
    (void)state;
    for (int view = 0; view < RG_ATLAS_VIEWS; view++)
        for (int cell = 0; cell < RG_ATLAS_CELLS; cell++)
            for (int level = 1; level < 4; level++) {
                const double first = mean_of(RG_ATLAS_POINT, 6, view, cell, 0);
                const double here = mean_of(RG_ATLAS_POINT, 6, view, cell, level);
                if (fabs(here / first - 1) > 2e-3)
                    fail_msg("view %d, cell %d, level %d: %g of %g", view, cell, level, here,
                             first);
            }
    // the smallest levels keep the light of all cells together
    double means[2] = {0, 0};
    for (int i = 0; i < 90 * 112; i++)
        means[0] += (double)rg_half_value(rg_atlas_texels(small, RG_ATLAS_POINT, 6, 3)[i]);
    means[1] = (double)rg_half_value(*rg_atlas_texels(small, RG_ATLAS_POINT, 6, 9));
    assert_below(fabs(means[0] / (90 * 112) / means[1] - 1), 5e-3);
}

// The mean light of a cell of oscillation 0, seen from the front.
static double scaled_mean(int light, int phi)
{
    return mean_of(RG_ATLAS_POINT, 0, 0, light * RG_ATLAS_PHIS + phi, 0) *
           (double)small->point_factor[0][0][light][phi];
}

// A streak is brightest against the light, and far darker with the light at the viewer.
static void test_factors(void **state)
{
    (void)state;
    const float(*front)[RG_ATLAS_PHIS] = small->point_factor[0][0];
    assert_above(front[5][8], 30 * front[5][0]);
    assert_above(front[5][1], 2 * front[5][3]); // the primary rainbow's glow
    for (int light = 0; light < 10; light++)    // a sphere mirrors light from above and below
        for (int phi = 0; phi < 9; phi++)
            assert_below(fabs(scaled_mean(light, phi) / scaled_mean(9 - light, phi) - 1), 0.02);
    for (int view = 0; view < RG_ATLAS_VIEWS; view++)
        assert_below(fabs((double)small->env_factor[0][view] * 42.5 * cos(view * 0.349065850) - 1),
                     0.1);
}

// --- splashes ---

static double splash_mean(int material, int frame)
{
    const uint16_t *texels =
        rg_atlas_texels(small, RG_ATLAS_SPLASH, material * RG_ATLAS_FRAMES + frame, 0);
    double sum = 0;
    for (int i = 0; i < 48 * 32; i++) {
        const double value = (double)rg_half_value(texels[i]);
        assert_at_least(value, 0);
        assert_at_most(value, 1);
        sum += value;
    }
    return sum / (48 * 32);
}

// A furnace: lights from all directions make a streak as bright as an even sky of radiance 1 does.
// Each light is as strong as its part of the sky, which the test computes itself, ring by ring.
static void test_furnace(void **state)
{
    (void)state;
    const double pi = 3.14159265358979323846, degree = pi / 180;
    for (int k = 0; k < RG_ATLAS_OSCILLATIONS; k++)
        for (int view = 0; view < RG_ATLAS_VIEWS; view++) {
            double lights = 0;
            for (int cell = 0; cell < RG_ATLAS_CELLS; cell++) {
                const int light = cell / RG_ATLAS_PHIS, phi = cell % RG_ATLAS_PHIS;
                const double low = fmax(20 * light - 100, -90), high = fmin(20 * light - 80, 90);
                const double ring_sr = 2 * pi * (sin(high * degree) - sin(low * degree));
                lights += ring_sr / RG_ATLAS_PHIS * mean_of(RG_ATLAS_POINT, k, view, cell, 0) *
                          (double)small->point_factor[k][view][light][phi];
            }
            const double sky =
                mean_of(RG_ATLAS_ENV, k, view, 0, 0) * (double)small->env_factor[k][view];
            if (fabs(lights / sky - 1) > 2e-3)
                fail_msg("oscillation %d, view %d: lights all around make %g of the sky's light", k,
                         view, lights / sky);
        }
}

// Of the puddle that is as measured, which the small atlas of tables lacks.
static double puddle_mean(int material, int frame)
{
    float texels[RG_SPLASH_WIDTH_PX * RG_SPLASH_HEIGHT_PX];
    double sum = 0;
    assert_true(rg_splash_draw(RG_SWINGS_MEASURED, material, frame, texels, NULL));
    for (int i = 0; i < RG_SPLASH_WIDTH_PX * RG_SPLASH_HEIGHT_PX; i++)
        sum += (double)texels[i];
    return sum / (RG_SPLASH_WIDTH_PX * RG_SPLASH_HEIGHT_PX);
}

// The brightest frame is as bright as due, and so is the first one.
static void expect_splash(double (*mean_in)(int material, int frame), int material,
                          double due_highest, double due_first)
{
    double highest = 0;
    for (int frame = 0; frame < RG_ATLAS_FRAMES; frame++)
        highest = fmax(highest, mean_in(material, frame));
    const double first = mean_in(material, 0);
    if (!(fabs(highest / due_highest - 1) < 0.2 && fabs(first / due_first - 1) < 0.2))
        fail_msg("material %d: %g of the picture, and %g at first", material, highest, first);
    assert_below(mean_in(material, RG_ATLAS_FRAMES - 1), 0.02 * highest);
}

// How bright clear water is: tests/core/scene/atlas/water.c holds its light to an oracle's.
static void test_splashes(void **state)
{
    (void)state;
    expect_splash(splash_mean, 0, 0.0132, 0.0078);
    expect_splash(splash_mean, 1, 0.0114, 0.0062);
    expect_splash(splash_mean, 2, 0.0045, 0.0033);
    expect_splash(splash_mean, 3, 0.0063, 0.0047);
    expect_splash(puddle_mean, 1, 0.0128, 0.0093);
    assert_above(splash_mean(1, 5), 3 * splash_mean(2, 5)); // a puddle's crown against asphalt's
}

// At first R = D (2 / (3 h))^(1/4) sqrt(v t / D), here for a drop of 3.2 mm at 8.16 m/s. The sheet
// rises, then falls.
static void test_crown(void **state)
{
    (void)state;
    const double time = 2e-4,
                 wanted = 3.2e-3 * pow(2 / (3 * 0.3), 0.25) * sqrt(8.16 * time / 3.2e-3);
    assert_below(fabs(rg_splash_crown(RG_SWINGS_MEASURED, 0, time).radius_m / wanted - 1), 0.03);
    double last = 0;
    for (int i = 1; i < 60; i++) {
        const double radius = rg_splash_crown(RG_SWINGS_MEASURED, 0, i * 1e-3).radius_m;
        assert_above(radius, last);
        last = radius;
    }
    assert_above(rg_splash_crown(RG_SWINGS_DATABASE, 1, 0.03).height_m,
                 3 * rg_splash_crown(RG_SWINGS_DATABASE, 1, 0.001).height_m);
    assert_below(rg_splash_crown(RG_SWINGS_DATABASE, 1, 0.07).height_m,
                 rg_splash_crown(RG_SWINGS_DATABASE, 1, 0.04).height_m);
    assert_at_most(rg_splash_crown(RG_SWINGS_DATABASE, 1, 0.1).height_m, 0);
}

// --- from the cache ---

// A damaged file is computed again, with one line, and one thread computes the same as many. Later
// loads are silent.
static void test_damaged_cache(void **state)
{
    (void)state;
    char folder[] = "/tmp/raingauge-atlas-XXXXXX", path[RG_ATLAS_PATH_SIZE], why[256];
    assert_non_null(mkdtemp(folder));
    setenv("XDG_CACHE_HOME", folder, 1);
    assert_true(rg_atlas_cache_path(RG_ATLAS_SMALL, path, why));
    assert_true(rg_atlas_cache_write(small, why));
    assert_int_equal(truncate(path, 4000000), 0);
    for (int turn = 0; turn < 2; turn++) {
        logged_lines = 0;
        omp_set_num_threads(1);
        struct rg_atlas *atlas = rg_atlas_load(RG_ATLAS_SMALL, NULL);
        omp_set_num_threads(omp_get_num_procs());
        assert_non_null(atlas);
        assert_int_equal(logged_lines, 1 - turn);
        assert_int_equal(atlas->hash, small->hash);
        rg_atlas_destroy(atlas);
    }
    unlink(path);
    snprintf(path, sizeof(path), "%s/raingauge", folder);
    assert_int_equal(rmdir(path), 0);
    assert_int_equal(rmdir(folder), 0);
}

int main(int argc, char **argv)
{
    published = argc > 1 ? argv[1] : ".";
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_published_sizes),
        cmocka_unit_test(test_rows),
        cmocka_unit_test(test_cells),
        cmocka_unit_test(test_poles),
        cmocka_unit_test(test_levels_keep_light),
        cmocka_unit_test(test_factors),
        cmocka_unit_test(test_furnace),
        cmocka_unit_test(test_splashes),
        cmocka_unit_test(test_crown),
        cmocka_unit_test(test_damaged_cache),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
