// Pictures of the database compared with an atlas. The test writes the pictures from an atlas of
// noise: unchanged, mirrored, lit from the other side, and with noise of a known strength.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/base/log.h"
#include "core/scene/atlas/levels.h"
#include "harness/commands/drawing/atlas/compare.h"
#include "kernels/dialect/rng.h"
#include "tests/core/scene/atlas/codes.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"

// Widths 8 and 4 are levels 2 and 3, the first two of the small atlas.
enum { LEVEL = 2, WIDTH = 8, MOST = WIDTH * 400 };

static struct rg_atlas *atlas;

static double uniform(uint32_t a, uint32_t b)
{
    return (double)rg_uniform(rg_random(11, a, b, 1).x);
}

// A texel of the atlas, 0 to 1: each cell has its own noise.
static double texel_of(int k, int view, int cell, int i)
{
    return uniform((uint32_t)(k + 10 * (view + 5 * cell)), (uint32_t)i);
}

static double own_factor(int k, int view, int cell)
{
    return 0.001 + uniform((uint32_t)(k + 10 * (view + 5 * cell)), 1u << 20);
}

static int height_of(int view)
{
    return rg_atlas_row_height(view, LEVEL);
}

static void in_root(char path[300], const char *name, int number)
{
    snprintf(path, 300, "%s/%s%d", folder, name, number);
}

static int make_atlas(void **state)
{
    (void)state;
    static float texels[MOST];
    atlas = rg_atlas_allocate(RG_ATLAS_SMALL);
    for (int k = 0; k < RG_ATLAS_OSCILLATIONS; k++)
        for (int view = 0; view < RG_ATLAS_VIEWS; view++)
            for (int cell = 0; cell <= RG_ATLAS_CELLS; cell++) { // the last cell is env
                const bool env = cell == RG_ATLAS_CELLS;
                for (int i = 0; i < WIDTH * height_of(view); i++)
                    texels[i] = (float)texel_of(k, view, cell, i);
                if (!rg_atlas_put_cell_levels(atlas, env ? RG_ATLAS_ENV : RG_ATLAS_POINT, k, view,
                                              env ? 0 : cell, LEVEL, texels))
                    return -1;
                if (env)
                    atlas->env_factor[k][view] = 1;
                else
                    (&atlas->point_factor[k][view][0][0])[cell] = (float)own_factor(k, view, cell);
            }
    return rg_atlas_finish(atlas) ? make_folder(state) : -1;
}

static int free_atlas(void **state)
{
    rg_atlas_destroy(atlas);
    return remove_whole_folder(state);
}

// --- a database ---

enum { LIGHT = 5, PHI = 4, CELL = LIGHT * RG_ATLAS_PHIS + PHI };

// Oscillations that are each other's mirror image, by docs/atlas.md: drops turned by 90 and 270
// degrees.
static int partner(int k)
{
    return k == 2 ? 4 : k == 4 ? 2 : k == 6 ? 8 : k == 8 ? 6 : k;
}

// Changes to the atlas' picture before it is written.
struct change {
    bool mirrored, other_drop;
    double noise; // share of the picture that is replaced by other noise
};

static double changed(const struct change *c, int k, int view, int cell, int i)
{
    const int x = i % WIDTH, row = i - x;
    const double own = texel_of(c->other_drop ? partner(k) : k, view, cell,
                                row + (c->mirrored ? WIDTH - 1 - x : x));
    return own * (1 - c->noise) + c->noise * uniform((uint32_t)(7000 + k), (uint32_t)i);
}

static void write_one(const char *database, const struct change *c, int k, int view, bool env)
{
    static uint16_t codes[MOST];
    char path[600];
    const int cell = env ? RG_ATLAS_CELLS : CELL;
    for (int i = 0; i < WIDTH * height_of(view); i++)
        codes[i] = (uint16_t)lrint(65535 * changed(c, k, view, cell, i));
    if (env)
        snprintf(path, sizeof(path), "%s/cv%d_osc%d.png", database, 20 * view, k);
    else
        snprintf(path, sizeof(path), "%s/cv%d_v%d_h%d_osc%d.png", database, 20 * view,
                 20 * LIGHT - 90, 20 * PHI + 10, k);
    write_codes(path, WIDTH, height_of(view), codes);
}

// All oscillations from two views, in a folder within the folder.
static void write_all(const char *database, const struct change *c)
{
    char within[512];
    assert_int_equal(mkdir(database, 0700), 0);
    snprintf(within, sizeof(within), "%s/within", database);
    assert_int_equal(mkdir(within, 0700), 0);
    for (int k = 0; k < RG_ATLAS_OSCILLATIONS; k++) {
        write_one(within, c, k, 0, false);
        write_one(within, c, k, 3, false);
        write_one(database, c, k, 3, true);
    }
}

static struct rg_cave_comparison compared(const char *database)
{
    struct rg_cave_comparison comparison;
    assert_true(rg_cave_compare(database, atlas, NULL, &comparison));
    return comparison;
}

// --- ways ---

static void the_way_is_told(void **state)
{
    (void)state;
    static const struct change changes[RG_CAVE_WAYS] = {
        [RG_CAVE_AS_IT_IS] = {false, false, 0},
        [RG_CAVE_MIRRORED] = {true, false, 0},
        [RG_CAVE_OTHER_SIDE] = {true, true, 0},
        [RG_CAVE_OTHER_DROP] = {false, true, 0},
    };
    for (int way = 0; way < RG_CAVE_WAYS; way++) {
        char database[300];
        in_root(database, "way", way);
        write_all(database, &changes[way]);
        struct rg_cave_comparison comparison = compared(database);
        assert_int_equal(comparison.count, 30);
        assert_int_equal(rg_cave_best(&comparison), way);
        for (int other = 0; other < RG_CAVE_WAYS; other++) {
            const struct rg_cave_figures f =
                rg_cave_figures(&comparison, RG_CAVE_LIGHTS, (enum rg_cave_way)other);
            assert_int_equal(f.pictures, 20);
            assert_true(other == way ? f.worst > 0.9999 && f.above == 1 : f.worst < 0.3);
        }
        assert_int_equal(rg_cave_figures(&comparison, 3, way).pictures, 10);
        assert_int_equal(rg_cave_figures(&comparison, 1, way).pictures, 0);
        assert_above(rg_cave_figures(&comparison, RG_CAVE_ENV, way).worst, 0.9999);
        free(comparison.rows);
    }
}

// --- figures ---

static double correlation_due(const struct change *c, int k, int view)
{
    const int n = WIDTH * height_of(view);
    double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
    for (int i = 0; i < n; i++) {
        const double x = texel_of(k, view, CELL, i), y = changed(c, k, view, CELL, i);
        a += x, b += y, aa += x * x, bb += y * y, ab += x * y;
    }
    return (ab - a * b / n) / sqrt((aa - a * a / n) * (bb - b * b / n));
}

static void noise_lowers_the_correlation(void **state)
{
    (void)state;
    const struct change noisy = {.noise = 0.325};
    char database[300];
    in_root(database, "noisy", 0);
    write_all(database, &noisy);
    struct rg_cave_comparison comparison = compared(database);
    double values[10];
    int above = 0;
    for (int i = 0; i < comparison.count; i++) {
        const struct rg_cave_row *row = &comparison.rows[i];
        if (row->found.env)
            continue;
        const double due = correlation_due(&noisy, row->found.oscillation, row->found.view);
        assert_near(row->correlation[RG_CAVE_AS_IT_IS], due, 1e-3);
        assert_above(due, 0.8);
        assert_below(due, 0.97);
        if (!row->found.view) {
            values[row->found.oscillation] = row->correlation[RG_CAVE_AS_IT_IS];
            above += due > 0.9;
        }
    }
    for (int i = 0; i < 10; i++)
        for (int k = i + 1; k < 10; k++)
            if (values[k] < values[i]) {
                const double kept = values[i];
                values[i] = values[k];
                values[k] = kept;
            }
    const struct rg_cave_figures f = rg_cave_figures(&comparison, 0, RG_CAVE_AS_IT_IS);
    assert_below(fabs(f.median - (values[4] + values[5]) / 2), 1e-12);
    assert_equals(f.worst, values[0]);
    assert_below(fabs(f.above - above / 10.0), 1e-12);
    assert_above(above, 0);
    assert_below(above, 10);
    free(comparison.rows);
}

// Brightness correlates in logarithms: factors that are five times ours are as good as equal, and
// random factors are not.
static void brightness_is_compared(void **state)
{
    (void)state;
    char database[300], path[400];
    for (int noisy = 0; noisy < 2; noisy++) {
        in_root(database, "bright", noisy);
        write_all(database, &(struct change){.noise = 0});
        snprintf(path, sizeof(path), "%s/dcam00_point_max.txt", database);
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        fprintf(file, "cv0\nv%d\nh%d", 20 * LIGHT - 90, 20 * PHI + 10);
        double sum[5] = {0};
        for (int k = 0; k < 10; k++) {
            const double own = own_factor(k, 0, CELL);
            const double factor = own * (noisy ? exp(3 * uniform(99, (uint32_t)k)) : 5);
            double mean = 0;
            for (int i = 0; i < WIDTH * height_of(0); i++)
                mean += texel_of(k, 0, CELL, i) / (WIDTH * height_of(0));
            const double x = log(own * mean), y = log(factor * mean);
            const double parts[5] = {x, y, x * x, y * y, x * y};
            for (int c = 0; c < 5; c++)
                sum[c] += parts[c];
            fprintf(file, " %.9f", factor);
        }
        fprintf(file, "\n");
        assert_int_equal(fclose(file), 0);
        const double due = (sum[4] - sum[0] * sum[1] / 10) /
                           sqrt((sum[2] - sum[0] * sum[0] / 10) * (sum[3] - sum[1] * sum[1] / 10));
        struct rg_cave_comparison comparison = compared(database);
        int pictures;
        const double is = rg_cave_brightness(&comparison, &pictures);
        assert_int_equal(pictures, 10); // the other view has no factors
        assert_true(fabs(is - due) < 1e-3 && (noisy ? due < 0.97 : due > 0.9999));
        free(comparison.rows);
    }
}

// --- files ---

static void the_widest_of_a_picture_is_taken(void **state)
{
    (void)state;
    static uint16_t codes[4 * 400];
    char database[300], path[400];
    in_root(database, "widths", 0);
    write_all(database, &(struct change){.noise = 0});
    snprintf(path, sizeof(path), "%s/cv0_v%d_h%d_osc1.png", database, 20 * LIGHT - 90,
             20 * PHI + 10);
    write_codes(path, 4, rg_atlas_row_height(0, LEVEL + 1), codes); // it would be flat
    struct rg_cave_comparison comparison = compared(database);
    assert_int_equal(comparison.count, 30);
    for (int i = 0; i < 30; i++)
        assert_true(comparison.rows[i].found.width == WIDTH && !comparison.rows[i].flat);
    free(comparison.rows);
}

static void an_even_picture_has_no_correlation(void **state)
{
    (void)state;
    static uint16_t codes[MOST];
    char database[300], path[400];
    in_root(database, "even", 0);
    assert_int_equal(mkdir(database, 0700), 0);
    snprintf(path, sizeof(path), "%s/cv0_v10_h90_osc0.png", database);
    write_codes(path, WIDTH, height_of(0), codes);
    struct rg_cave_comparison comparison = compared(database);
    assert_equals(comparison.count, 1);
    assert_true(comparison.rows[0].flat);
    assert_int_equal(rg_cave_figures(&comparison, RG_CAVE_LIGHTS, RG_CAVE_AS_IT_IS).pictures, 0);
    free(comparison.rows);
}

static void expect_refused(const char *database, const char *words)
{
    struct rg_cave_comparison comparison;
    logged[0] = 0;
    assert_false(rg_cave_compare(database, atlas, NULL, &comparison));
    if (!strstr(logged, words))
        fail_msg("'%s' lacks '%s'", logged, words);
}

static void what_is_no_picture_is_refused(void **state)
{
    (void)state;
    static uint16_t codes[MOST];
    char database[300], path[400];
    expect_refused("/nonexistent/folder", "No such file");
    in_root(database, "none", 0);
    assert_int_equal(mkdir(database, 0700), 0);
    static const char *const others[] = {"cv0_v10_h90_osc1.png.old", "cv5_osc1.png",
                                         "cv0_v10_h90_osc10.png", "cv0_v0_h90_osc1.png",
                                         "acv0_osc1.png"};
    for (int i = 0; i < 5; i++) {
        snprintf(path, sizeof(path), "%s/%s", database, others[i]);
        write_codes(path, WIDTH, height_of(0), codes);
    }
    expect_refused(database, "no picture of the database");
    snprintf(path, sizeof(path), "%s/cv0_osc3.png", database);
    write_codes(path, WIDTH, height_of(0) / 2, codes);
    expect_refused(database, "cv0_osc3.png: 8 x ");
    FILE *file = fopen(path, "w");
    assert_true(file);
    assert_at_least(fputs("no picture", file), 0);
    assert_true(!fclose(file));
    expect_refused(database, "cv0_osc3.png");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_way_is_told),
        cmocka_unit_test(noise_lowers_the_correlation),
        cmocka_unit_test(brightness_is_compared),
        cmocka_unit_test(the_widest_of_a_picture_is_taken),
        cmocka_unit_test(an_even_picture_has_no_correlation),
        cmocka_unit_test(what_is_no_picture_is_refused),
    };
    rg_log_listen(log_last, NULL);
    return cmocka_run_group_tests(tests, make_atlas, free_atlas);
}
