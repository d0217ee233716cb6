// The tiers accept honest rain and reject mutants of it, each by the tier named here.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "core/base/log.h"
#include "core/image/compare/compare.h"
#include "core/image/srgb.h"
#include "tests/core/image/rain_picture.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

enum { WIDTH = 320, HEIGHT = 240, CHANNELS = 4 };

static struct rg_picture honest, background, mutant;

static int make_pictures(void **state)
{
    (void)state;
    rg_log_listen(log_last, NULL);
    if (!rg_picture_create(&honest, WIDTH, HEIGHT, CHANNELS, "honest") ||
        !rg_picture_create(&background, WIDTH, HEIGHT, CHANNELS, "background") ||
        !rg_picture_create(&mutant, WIDTH, HEIGHT, CHANNELS, "mutant"))
        return -1;
    rain_draw(&honest, honest_rain);
    rain_background(&background);
    return 0;
}

static int destroy_pictures(void **state)
{
    (void)state;
    rg_log_listen(NULL, NULL);
    rg_picture_destroy(&honest);
    rg_picture_destroy(&background);
    rg_picture_destroy(&mutant);
    return 0;
}

static struct rg_tiers judge(const struct rg_picture *b)
{
    struct rg_comparison comparison;
    assert_true(rg_compare(&honest, "honest", b, "b", &background, &(struct rg_compare_options){0},
                           &comparison));
    struct rg_tiers tiers = comparison.tiers;
    rg_comparison_destroy(&comparison);
    return tiers;
}

// Compares all three tiers at once, so that a message shows each with its reason.
static void assert_holds(const struct rg_tiers *t, bool t0, bool t1, bool t2)
{
    if (t->of[RG_T0].holds != t0 || t->of[RG_T1].holds != t1 || t->of[RG_T2].holds != t2)
        fail_msg("T0 %d %s; T1 %d %s; T2 %d %s", t->of[RG_T0].holds, t->of[RG_T0].why,
                 t->of[RG_T1].holds, t->of[RG_T1].why, t->of[RG_T2].holds, t->of[RG_T2].why);
}

static void the_same_rain_is_identical(void **state)
{
    (void)state;
    rain_draw(&mutant, honest_rain);
    struct rg_tiers t = judge(&mutant);
    assert_holds(&t, true, true, true);
    assert_above(t.mask_pixels, 3000);
    assert_below(t.mask_pixels, WIDTH * HEIGHT / 5);
    assert_false(t.mask_is_whole);
    assert_equals(t.energy_ratio, 1);
    assert_equals(t.relative_mean, 0);
    assert_equals(t.matched_a, 1);
}

static void one_bit_is_not_identical(void **state)
{
    (void)state;
    rain_draw(&mutant, honest_rain);
    mutant.texels[12345] = nextafterf(mutant.texels[12345], 1);
    struct rg_tiers t = judge(&mutant);
    assert_holds(&t, false, true, true);
}

static void other_rounding_is_arithmetic(void **state)
{
    (void)state;
    rain_draw(&mutant, honest_rain);
    for (int i = 0; i < WIDTH * HEIGHT * CHANNELS; i++)
        mutant.texels[i] *= 1 + 1e-5f * ((float)(rain_noise((uint32_t)i) >> 8) * 0x1p-23f - 1);
    struct rg_tiers t = judge(&mutant);
    assert_holds(&t, false, true, true);
    assert_at_most(t.max_codes, 1);
    assert_above(t.relative_mean, 1e-6);
    assert_below(t.relative_max, 2e-5);
}

static void lost_streaks_are_caught_by_t1_and_t2(void **state)
{
    (void)state;
    struct rain_look look = honest_rain;
    look.skip_every = 100; // 1 %
    rain_draw(&mutant, look);
    struct rg_tiers t = judge(&mutant);
    assert_holds(&t, false, false, false);
    assert_above(t.coverage_mismatches, 20);
}

static void a_shift_by_one_is_geometry(void **state)
{
    (void)state;
    struct rain_look look = honest_rain;
    look.shift_px = 1;
    rain_draw(&mutant, look);
    struct rg_tiers t = judge(&mutant);
    assert_false(t.of[RG_T1].holds);
    assert_above(t.coverage_mismatches, 1000);
    // Every streak is found again, except at the block's edge and in tiles of few streaks.
    assert_above(t.matched_a, 0.97);
    assert_above(t.matched_b, 0.97);
}

static void a_streak_two_pixels_off_is_caught_by_t1(void **state)
{
    (void)state;
    struct rain_look look = honest_rain;
    look.shifted_streak = 17;
    look.shifted_streak_px = 2;
    rain_draw(&mutant, look);
    struct rg_tiers t = judge(&mutant);
    assert_false(t.of[RG_T1].holds);
    assert_above(t.coverage_mismatches, 10);
    assert_below(t.matched_a, 1);
    assert_below(t.matched_b, 1); // T2 sees it, too, but less than its threshold
}

static void stronger_rain_is_caught_by_t1_and_t2(void **state)
{
    (void)state;
    struct rain_look look = honest_rain;
    look.alpha_scale = 1.02f;
    rain_draw(&mutant, look);
    struct rg_tiers t = judge(&mutant);
    assert_false(t.of[RG_T1].holds);
    assert_above(t.bias_codes, 0.25);
    assert_above(t.relative_mean, 0.005);
    if (t.of[RG_T2].holds)
        fail_msg("energy %g", t.energy_ratio);
}

static void swapped_colours_are_caught(void **state)
{
    (void)state;
    rain_draw(&mutant, honest_rain);
    for (float *texel = mutant.texels; texel < mutant.texels + WIDTH * HEIGHT * CHANNELS;
         texel += CHANNELS) {
        float red = texel[0];
        texel[0] = texel[2];
        texel[2] = red;
    }
    struct rg_tiers t = judge(&mutant);
    assert_holds(&t, false, false, false);
    assert_above(fabs(t.bias_codes), 5); // in one colour; over all of them it would cancel
}

static void a_flip_is_caught(void **state)
{
    (void)state;
    for (int y = 0; y < HEIGHT; y++)
        memcpy(mutant.texels + y * WIDTH * CHANNELS,
               honest.texels + (HEIGHT - 1 - y) * WIDTH * CHANNELS, WIDTH * CHANNELS * 4);
    struct rg_tiers t = judge(&mutant);
    assert_holds(&t, false, false, false);
}

static void srgb_twice_is_caught(void **state)
{
    (void)state;
    rain_draw(&mutant, honest_rain);
    for (int i = 0; i < WIDTH * HEIGHT * CHANNELS; i++)
        if (i % CHANNELS < 3)
            mutant.texels[i] = (float)rg_srgb_encode((double)mutant.texels[i]);
    struct rg_tiers t = judge(&mutant);
    assert_holds(&t, false, false, false);
}

static void no_rain_fails_every_tier(void **state)
{
    (void)state;
    struct rg_comparison c;
    assert_true(rg_compare(&background, "a", &background, "b", &background,
                           &(struct rg_compare_options){0}, &c));
    assert_holds(&c.tiers, false, false, false);
    assert_int_equal(c.tiers.mask_pixels, 0);
    assert_non_null(strstr(c.tiers.of[RG_T0].why, "empty"));
    assert_string_equal(c.tier, "none");
    rg_comparison_destroy(&c);
}

static void without_background_the_mask_is_whole(void **state)
{
    (void)state;
    struct rg_comparison c;
    assert_true(rg_compare(&honest, "a", &honest, "b", NULL, &(struct rg_compare_options){0}, &c));
    assert_true(c.tiers.mask_is_whole);
    assert_int_equal(c.tiers.mask_pixels, WIDTH * HEIGHT);
    assert_string_equal(c.tier, "T0");
    rg_comparison_destroy(&c);
}

static void nan_in_one_picture_fails(void **state)
{
    (void)state;
    rain_draw(&mutant, honest_rain);
    mutant.texels[0] = NAN;
    struct rg_tiers t = judge(&mutant);
    assert_holds(&t, false, false, false);
}

// A value that is not finite, in either picture, is left out of the mean.
static void values_that_are_not_finite_are_left_out(void **state)
{
    (void)state;
    const float wrong[] = {NAN, INFINITY, -INFINITY};
    struct rg_comparison c;
    for (int i = 0; i < 6; i++) {
        rain_draw(&mutant, honest_rain);
        mutant.texels[0] = wrong[i / 2];
        const struct rg_picture *a = i % 2 ? &mutant : &honest, *b = i % 2 ? &honest : &mutant;
        assert_true(rg_compare(a, "a", b, "b", NULL, &(struct rg_compare_options){0}, &c));
        assert_equals(c.tiers.relative_mean, 0);
        assert_equals(c.tiers.relative_max, 0);
        assert_int_equal(c.metrics.nonfinite_mismatches, 1);
        rg_comparison_destroy(&c);
    }
}

// Rain so dim that its code is black is in no mask; a higher exposure brings it into the mask.
static void exposure_reveals_dim_rain(void **state)
{
    (void)state;
    struct rg_picture dark, dim;
    assert_true(rg_picture_create(&dark, 64, 64, 3, "dark") &&
                rg_picture_create(&dim, 64, 64, 3, "dim"));
    memset(dark.texels, 0, 64 * 64 * 3 * 4);
    memset(dim.texels, 0, 64 * 64 * 3 * 4);
    for (int y = 0; y < 64; y++)
        dim.texels[(y * 64 + 30) * 3] = 1e-4f;
    struct rg_comparison c;
    assert_true(rg_compare(&dim, "a", &dim, "b", &dark, &(struct rg_compare_options){0}, &c));
    assert_int_equal(c.tiers.mask_pixels, 0);
    rg_comparison_destroy(&c);
    const struct rg_compare_options bright = {.exposure = 1000};
    assert_true(rg_compare(&dim, "a", &dim, "b", &dark, &bright, &c));
    assert_int_equal(c.tiers.mask_pixels, 64);
    assert_true(c.tiers.of[RG_T0].holds);
    rg_comparison_destroy(&c);
    rg_picture_destroy(&dark);
    rg_picture_destroy(&dim);
}

// --- what the encoding clamps away ---

enum { BAR_PX = 32, BARS = WIDTH / BAR_PX, BELOW_BLACK = BARS - 1 };

static int bar_of(int i)
{
    return i / CHANNELS % WIDTH / BAR_PX;
}

// Bars of lamps in front of the honest rain, each brighter than the one before; the last bar is
// light below black.
static bool is_lamp(int i)
{
    return i / CHANNELS % WIDTH % BAR_PX < 8 && i % CHANNELS < 3;
}

static void draw_lamps(struct rg_picture *picture)
{
    rain_draw(picture, honest_rain);
    for (int i = 0; i < WIDTH * HEIGHT * CHANNELS; i++)
        if (is_lamp(i))
            picture->texels[i] =
                bar_of(i) == BELOW_BLACK ? -3.0f : 1.2f * powf(2.5f, (float)bar_of(i));
}

// Compares the lamps with `mutant` over the whole picture.
static struct rg_tiers judge_lamps(float exposure)
{
    struct rg_comparison c;
    struct rg_picture lamps;
    assert_true(rg_picture_create(&lamps, WIDTH, HEIGHT, CHANNELS, "lamps"));
    draw_lamps(&lamps);
    assert_true(rg_compare(&lamps, "a", &mutant, "b", NULL,
                           &(struct rg_compare_options){.exposure = exposure}, &c));
    const struct rg_tiers tiers = c.tiers;
    rg_comparison_destroy(&c);
    rg_picture_destroy(&lamps);
    return tiers;
}

// Judges the lamps with some bars multiplied by a factor.
static struct rg_tiers scale_lamps(float factor, int first, int last)
{
    draw_lamps(&mutant);
    for (int i = 0; i < WIDTH * HEIGHT * CHANNELS; i++)
        if (is_lamp(i) && bar_of(i) >= first && bar_of(i) <= last)
            mutant.texels[i] *= factor;
    return judge_lamps(1);
}

static void lamps_that_clip_alike_are_told_apart(void **state)
{
    (void)state;
    const struct rg_tiers same = scale_lamps(1, 0, 9);
    assert_holds(&same, true, true, true);
    assert_equals(same.clamped_max, 0);
    assert_equals(same.clamped_bias, 0);
    assert_equals(same.clamped_ratio, 1);
    struct rg_tiers t = scale_lamps(4000, 0, 0); // 1.2 and 4800: no code differs
    assert_int_equal(t.max_codes, 0);
    assert_holds(&t, false, false, false);
    assert_non_null(strstr(t.of[RG_T1].why, "beyond black and white"));
    t = scale_lamps(1000, BELOW_BLACK, BELOW_BLACK);
    assert_int_equal(t.max_codes, 0);
    assert_holds(&t, false, false, false);
}

static void what_halves_round_is_arithmetic(void **state)
{
    (void)state;
    const struct rg_tiers t = scale_lamps(1 + 0x1p-11f, 0, BELOW_BLACK);
    assert_holds(&t, false, true, true);
    assert_above(t.clamped_max, 4e-4);
    assert_below(t.clamped_max, 6e-4);
}

// Each case exceeds at most one bound of its tier.
static void each_bound_beyond_white_decides(void **state)
{
    (void)state;
    struct rg_tiers t =
        scale_lamps(1.003f, 0, BELOW_BLACK); // a quarter of the picture, by less than a code
    assert_holds(&t, false, true, true);
    assert_above(t.clamped_bias, 5e-4);
    assert_below(t.clamped_bias, 1e-3);
    t = scale_lamps(1.011f, 3, 3); // more than a code in 2.5 % of the picture
    assert_false(t.of[RG_T1].holds);
    assert_true(t.of[RG_T2].holds);
    t = scale_lamps(1.012f, 0, BELOW_BLACK);
    assert_false(t.of[RG_T2].holds);
    assert_non_null(strstr(t.of[RG_T2].why, "ratio"));
    draw_lamps(&mutant);
    mutant.texels[0] *= 1.02f; // one value
    t = judge_lamps(1);
    assert_false(t.of[RG_T1].holds);
    assert_above(t.clamped_max, 0.0195);
    assert_below(t.clamped_max, 0.0197);
}

static void a_value_that_clips_on_one_side_is_told_apart(void **state)
{
    (void)state;
    draw_lamps(&mutant);
    for (int i = 0; i < WIDTH * HEIGHT * CHANNELS; i++)
        if (is_lamp(i) && bar_of(i) == 5)
            mutant.texels[i] = 0.999f;
    const struct rg_tiers t = judge_lamps(1);
    assert_int_equal(t.max_codes, 0);
    assert_holds(&t, false, false, false);
}

// At a tenth of the exposure a lamp of 1.2 no longer clips, and one of 117 still does.
static void the_exposure_decides_what_clips(void **state)
{
    (void)state;
    draw_lamps(&mutant);
    for (int i = 0; i < WIDTH * HEIGHT * CHANNELS; i++)
        if (is_lamp(i) && bar_of(i) == 0)
            mutant.texels[i] *= 1.004f;
    assert_above(judge_lamps(1).clamped_max, 0.003);
    assert_equals(judge_lamps(0.1f).clamped_max, 0);
    draw_lamps(&mutant);
    for (int i = 0; i < WIDTH * HEIGHT * CHANNELS; i++)
        if (is_lamp(i) && bar_of(i) == 5)
            mutant.texels[i] *= 20;
    assert_false(judge_lamps(0.1f).of[RG_T1].holds);
}

// Four times the exposure makes two lights below white clip: they must still be told apart.
static void light_that_the_exposure_clips_is_compared(void **state)
{
    (void)state;
    struct rg_comparison c;
    struct rg_picture a, b;
    assert_true(rg_picture_create(&a, WIDTH, HEIGHT, CHANNELS, "a"));
    assert_true(rg_picture_create(&b, WIDTH, HEIGHT, CHANNELS, "b"));
    for (int i = 0; i < WIDTH * HEIGHT * CHANNELS; i++) {
        a.texels[i] = i % CHANNELS < 3 ? 0.5f : 1;
        b.texels[i] = i % CHANNELS < 3 ? 0.9f : 1;
    }
    assert_true(
        rg_compare(&a, "a", &b, "b", NULL, &(struct rg_compare_options){.exposure = 4}, &c));
    assert_equals(c.tiers.max_codes, 0);
    assert_above(c.tiers.clamped_max, 0.4);
    assert_holds(&c.tiers, false, false, false);
    rg_comparison_destroy(&c);
    rg_picture_destroy(&a);
    rg_picture_destroy(&b);
}

static void infinite_lamps_agree_with_themselves_alone(void **state)
{
    (void)state;
    struct rg_comparison c;
    struct rg_picture other;
    assert_true(rg_picture_create(&other, WIDTH, HEIGHT, CHANNELS, "other"));
    draw_lamps(&mutant);
    draw_lamps(&other);
    mutant.texels[0] = INFINITY;
    struct rg_tiers t = judge_lamps(1);
    assert_holds(&t, false, false, false);
    other.texels[0] = INFINITY;
    other.texels[1] = nextafterf(other.texels[1], 0);
    assert_true(rg_compare(&mutant, "a", &other, "b", NULL, &(struct rg_compare_options){0}, &c));
    assert_holds(&c.tiers, false, true, true);
    assert_above(c.tiers.clamped_max, 0);
    assert_below(c.tiers.clamped_max, 1e-6);
    rg_comparison_destroy(&c);
    rg_picture_destroy(&other);
}

// A pixel of a lamp is off by a factor from 1.02 to 1000, either way, and still clips.
static void seeded_mutants_of_lamps_are_rejected(void **state)
{
    (void)state;
    uint32_t noise = 1;
    for (int run = 0; run < 40; run++) {
        int i;
        do
            i = (int)((noise = rain_noise(noise + 1)) % (WIDTH * HEIGHT * CHANNELS));
        while (!is_lamp(i));
        draw_lamps(&mutant);
        const float factor = 1.02f + (float)(noise >> 16) / 65536.0f * (run % 2 ? 1000.0f : 0.1f);
        mutant.texels[i] *= run % 4 < 2 || fabsf(mutant.texels[i]) < 1.5f ? factor : 1 / factor;
        const struct rg_tiers t = judge_lamps(1);
        if (t.of[RG_T1].holds)
            fail_msg("run %d: value %d times %g holds T1", run, i, (double)factor);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_rain_is_identical),
        cmocka_unit_test(one_bit_is_not_identical),
        cmocka_unit_test(other_rounding_is_arithmetic),
        cmocka_unit_test(lost_streaks_are_caught_by_t1_and_t2),
        cmocka_unit_test(a_shift_by_one_is_geometry),
        cmocka_unit_test(a_streak_two_pixels_off_is_caught_by_t1),
        cmocka_unit_test(stronger_rain_is_caught_by_t1_and_t2),
        cmocka_unit_test(swapped_colours_are_caught),
        cmocka_unit_test(a_flip_is_caught),
        cmocka_unit_test(srgb_twice_is_caught),
        cmocka_unit_test(no_rain_fails_every_tier),
        cmocka_unit_test(without_background_the_mask_is_whole),
        cmocka_unit_test(nan_in_one_picture_fails),
        cmocka_unit_test(values_that_are_not_finite_are_left_out),
        cmocka_unit_test(exposure_reveals_dim_rain),
        cmocka_unit_test(lamps_that_clip_alike_are_told_apart),
        cmocka_unit_test(what_halves_round_is_arithmetic),
        cmocka_unit_test(each_bound_beyond_white_decides),
        cmocka_unit_test(a_value_that_clips_on_one_side_is_told_apart),
        cmocka_unit_test(the_exposure_decides_what_clips),
        cmocka_unit_test(light_that_the_exposure_clips_is_compared),
        cmocka_unit_test(infinite_lamps_agree_with_themselves_alone),
        cmocka_unit_test(seeded_mutants_of_lamps_are_rejected),
    };
    return cmocka_run_group_tests_name("agreement tiers", tests, make_pictures, destroy_pictures);
}
