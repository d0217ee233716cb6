// The tiers of small pictures, a few pixels of rain on grey: each figure can be counted by hand.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "core/image/compare/compare.h"
#include "core/image/srgb.h"
#include "tests/tools/expect.h"

// Tiles of 16 pixels do not fit: the last ones are 8 wide and 4 high.
enum { WIDTH = 40, HEIGHT = 20, GREY = 100 };

// Codes of two pictures, and the light that they stand for.
struct pair {
    uint8_t a[HEIGHT][WIDTH][4], b[HEIGHT][WIDTH][4];
};

static void set(uint8_t texel[4], int red, int green, int blue)
{
    texel[0] = (uint8_t)red;
    texel[1] = (uint8_t)green;
    texel[2] = (uint8_t)blue;
    texel[3] = 255;
}

static void begin(struct pair *pair)
{
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            set(pair->a[y][x], GREY, GREY, GREY);
            set(pair->b[y][x], GREY, GREY, GREY);
        }
}

// Rain of this code in both pictures, over so many pixels of a row.
static void rain(struct pair *pair, int y, int pixels, int code)
{
    for (int x = 0; x < pixels; x++) {
        set(pair->a[y][x], code, code, code);
        set(pair->b[y][x], code, code, code);
    }
}

static struct rg_picture picture_of(uint8_t (*codes)[WIDTH][4])
{
    struct rg_picture picture;
    assert_true(rg_picture_create(&picture, WIDTH, HEIGHT, 4, "a case"));
    for (int i = 0; i < WIDTH * HEIGHT * 4; i++)
        picture.texels[i] =
            i % 4 == 3 ? (&codes[0][0][0])[i] / 255.0f : rg_srgb()->linear[(&codes[0][0][0])[i]];
    return picture;
}

static struct rg_tiers judge_with(struct pair *pair, float first_of_b)
{
    struct pair plain;
    struct rg_comparison comparison;
    begin(&plain);
    struct rg_picture a = picture_of(pair->a), b = picture_of(pair->b), dry = picture_of(plain.a);
    if (!isfinite(first_of_b))
        b.texels[0] = first_of_b;
    assert_true(rg_compare(&a, "a", &b, "b", &dry, &(struct rg_compare_options){0}, &comparison));
    const struct rg_tiers tiers = comparison.tiers;
    rg_comparison_destroy(&comparison);
    rg_picture_destroy(&a);
    rg_picture_destroy(&b);
    rg_picture_destroy(&dry);
    return tiers;
}

static struct rg_tiers judge(struct pair *pair)
{
    return judge_with(pair, 0);
}

static void assert_fails(const struct rg_tiers *tiers, enum rg_tier tier, const char *why)
{
    if (tiers->of[tier].holds || !strstr(tiers->of[tier].why, why))
        fail_msg("%s: '%s' does not say '%s'", rg_tier_name(tier), tiers->of[tier].why, why);
}

// It rains where either picture differs from the background by more than a code, in any colour.
static void test_mask(void **state)
{
    (void)state;
    struct pair pair;
    begin(&pair);
    struct rg_tiers tiers = judge(&pair);
    assert_int_equal(tiers.mask_pixels, 0);
    for (int tier = 0; tier < RG_TIER_COUNT; tier++)
        assert_fails(&tiers, (enum rg_tier)tier, "empty");
    set(pair.a[3][4], GREY, GREY, GREY + 2);
    tiers = judge(&pair);
    assert_int_equal(tiers.mask_pixels, 1);
    assert_int_equal(tiers.coverage_mismatches, 1);
    set(pair.b[5][6], GREY + 2, GREY, GREY);
    tiers = judge(&pair);
    assert_int_equal(tiers.mask_pixels, 2);
    assert_int_equal(tiers.coverage_mismatches, 2);
    assert_fails(&tiers, RG_T1, "coverage differs in 2 pixels");
    set(pair.b[8][8], GREY, GREY + 1, GREY);
    assert_int_equal(judge(&pair).mask_pixels, 2);
}

// By default the screen is 3,840 pixels and 0.7 m wide, seen from 0.7 m; errors are those seen
// there.
static void test_usual_screen(void **state)
{
    (void)state;
    const double usual = 3840 / 0.7 * 0.7 * 3.14159265358979 / 180;
    const struct rg_compare_options options[] = {{0}, {.pixels_per_degree = (float)usual}};
    struct rg_comparison found[2];
    struct pair pair;
    begin(&pair);
    set(pair.a[3][4], GREY, GREY, GREY + 80);
    struct rg_picture a = picture_of(pair.a), b = picture_of(pair.b);
    for (int i = 0; i < 2; i++)
        assert_true(rg_compare(&a, "a", &b, "b", NULL, &options[i], &found[i]));
    assert_float_equal(found[0].pixels_per_degree, usual, 1e-4);
    assert_float_equal(found[0].flip.mean, found[1].flip.mean, 1e-6);
    assert_above(found[0].flip.mean, 0);
    for (int i = 0; i < 2; i++)
        rg_comparison_destroy(&found[i]);
    rg_picture_destroy(&a);
    rg_picture_destroy(&b);
}

// Each colour and alpha count; the largest difference is that of all rows.
static void test_differences(void **state)
{
    (void)state;
    for (int channel = 0; channel < 4; channel++) {
        struct pair pair;
        begin(&pair);
        rain(&pair, 2, 20, 150);
        rain(&pair, 9, 20, 150);
        pair.b[2][3][channel] = (uint8_t)(pair.a[2][3][channel] - 3);
        pair.b[9][3][channel] = (uint8_t)(pair.a[9][3][channel] - 1);
        struct rg_tiers tiers = judge(&pair);
        assert_int_equal(tiers.mask_pixels, 40);
        assert_int_equal(tiers.max_codes, 3);
        assert_equals(tiers.above_one_fraction, 1 / 40.0);
        assert_fails(&tiers, RG_T1, "largest difference 3/255");
        pair.b[2][3][channel]++; // two codes
        tiers = judge(&pair);
        assert_int_equal(tiers.max_codes, 2);
        assert_equals(tiers.above_one_fraction, 1 / 40.0);
        assert_fails(&tiers, RG_T1, "of the mask is above 1/255");
    }
}

// The bias counts the mask alone and keeps its sign; darker is as wrong as brighter.
static void test_bias(void **state)
{
    (void)state;
    for (int sign = -1; sign <= 1; sign += 2) {
        struct pair pair;
        begin(&pair);
        rain(&pair, 2, 20, 150);
        for (int x = 0; x < 10; x++)
            pair.b[2][x][1] = (uint8_t)(150 + sign);
        for (int x = 0; x < WIDTH; x++)
            pair.b[12][x][0] = (uint8_t)(GREY + sign); // no rain
        const struct rg_tiers tiers = judge(&pair);
        assert_int_equal(tiers.mask_pixels, 20);
        assert_equals(tiers.bias_codes, sign * 0.5);
        assert_fails(&tiers, RG_T1, "bias");
    }
}

// A colour may lie up to one pixel away, in either picture.
static void test_matches(void **state)
{
    (void)state;
    for (int way = 0; way < 9; way++) {
        struct pair pair;
        begin(&pair);
        set(pair.a[9][9], 200, 200, 200);
        set(pair.b[8 + way / 3][8 + way % 3], 200, 200, 200);
        const struct rg_tiers tiers = judge(&pair);
        assert_equals(tiers.matched_a, 1);
        assert_equals(tiers.matched_b, 1);
    }
    for (int only_b = 0; only_b < 2; only_b++) {
        struct pair pair;
        begin(&pair);
        rain(&pair, 2, 19, 150);
        set(only_b ? pair.b[9][9] : pair.a[9][9], 200, 200, 200);
        const struct rg_tiers tiers = judge(&pair);
        assert_int_equal(tiers.mask_pixels, 20);
        assert_equals(tiers.matched_a, (only_b ? 1 : 1 - 1 / 20.0));
        assert_equals(tiers.matched_b, (only_b ? 1 - 1 / 20.0 : 1));
        assert_fails(&tiers, RG_T2, "is found within 1 pixel");
    }
}

// A tile's mean is over the pixels that it has.
static void test_tiles(void **state)
{
    (void)state;
    static const int tiles[][4] = {
        {0, 0, 16, 16}, {32, 0, 40, 16}, {0, 16, 16, 20}, {32, 16, 40, 20}};
    for (int i = 0; i < 4; i++) {
        struct pair pair;
        begin(&pair);
        for (int y = tiles[i][1]; y < tiles[i][3]; y++)
            for (int x = tiles[i][0]; x < tiles[i][2]; x++)
                pair.b[y][x][2] = GREY + 6;
        const struct rg_tiers tiers = judge(&pair);
        assert_equals(tiers.tile_max_codes, 6);
    }
}

static void test_energy(void **state)
{
    (void)state;
    struct pair pair;
    begin(&pair);
    rain(&pair, 2, 20, 150);
    for (int x = 0; x < 20; x++)
        set(pair.b[2][x], 145, 145, 145);
    struct rg_tiers tiers = judge(&pair);
    assert_equals(tiers.energy_ratio, 0.9);
    assert_fails(&tiers, RG_T2, "energy ratio");
    for (int x = 0; x < 20; x++)
        set(pair.b[2][x], 155, 155, 155);
    tiers = judge(&pair);
    assert_equals(tiers.energy_ratio, 1.1);
    assert_fails(&tiers, RG_T2, "energy ratio");
}

static void test_no_number(void **state)
{
    (void)state;
    struct pair pair;
    begin(&pair);
    rain(&pair, 2, 20, 150);
    const struct rg_tiers tiers = judge_with(&pair, NAN);
    assert_fails(&tiers, RG_T1, "NaN");
    assert_fails(&tiers, RG_T2, "NaN");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mask),        cmocka_unit_test(test_usual_screen),
        cmocka_unit_test(test_differences), cmocka_unit_test(test_bias),
        cmocka_unit_test(test_matches),     cmocka_unit_test(test_tiles),
        cmocka_unit_test(test_energy),      cmocka_unit_test(test_no_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
