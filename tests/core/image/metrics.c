// Linear figures against closed forms, and against OpenImageIO's own comparison.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <omp.h>

#include "core/base/log.h"
#include "core/image/compare/compare.h"
#include "core/image/files/oiio.h"
#include "core/image/srgb.h"
#include "tests/core/image/rain_picture.h"
#include "tests/tools/expect.h"

static struct rg_picture noise_picture(int width, int height, int channels, uint32_t seed)
{
    struct rg_picture picture;
    assert_true(rg_picture_create(&picture, width, height, channels, "noise"));
    for (int64_t i = 0; i < rg_picture_values(&picture); i++)
        picture.texels[i] = 2 * (float)(rain_noise((uint32_t)i + seed) >> 8) * 0x1p-24f - 0.5f;
    return picture;
}

static bool near(double a, double b, double relative)
{
    return fabs(a - b) <= relative * fabs(b);
}

static void equal_pictures_have_no_error(void **state)
{
    (void)state;
    struct rg_picture a = noise_picture(19, 7, 3, 1);
    struct rg_metrics m;
    assert_true(rg_metrics_compute(&a, &a, &m));
    assert_equals(m.mean, 0);
    assert_equals(m.rms, 0);
    assert_equals(m.max, 0);
    assert_true(isinf(m.psnr_db));
    assert_int_equal(m.differing_values, 0);
    assert_int_equal(m.values, 19 * 7 * 3);
    rg_picture_destroy(&a);
}

// One value of 4 x 5 x 3 differs by 0.5, one by the sign of zero.
static void closed_form(void **state)
{
    (void)state;
    struct rg_picture a, b;
    assert_true(rg_picture_create(&a, 4, 5, 3, "a") && rg_picture_create(&b, 4, 5, 3, "b"));
    for (int i = 0; i < 60; i++)
        a.texels[i] = b.texels[i] = i ? 0.25f : 0.0f;
    b.texels[0] = -0.0f;
    b.texels[(3 * 4 + 2) * 3 + 1] = 0.75f;
    struct rg_metrics m;
    assert_true(rg_metrics_compute(&a, &b, &m));
    assert_true(near(m.mean, 0.5 / 60, 1e-14));
    assert_true(near(m.rms, sqrt(0.25 / 60), 1e-14));
    assert_true(near(m.psnr_db, 20 * log10(1 / sqrt(0.25 / 60)), 1e-14));
    assert_equals(m.max, 0.5);
    assert_equals(m.max_x, 2);
    assert_equals(m.max_y, 3);
    assert_equals(m.max_channel, 1);
    assert_int_equal(m.differing_values, 2);
    assert_int_equal(m.differing_pixels, 2);
    for (int t = 0; t < RG_ABOVE_COUNT; t++) {
        assert_int_equal(m.values_above[t], 1);
        assert_int_equal(m.pixels_above[t], 1);
    }
    b.texels[(4 * 4 + 1) * 3] = 0.75f; // as large, in the row below: the first counts
    b.texels[(3 * 4 + 3) * 3] = 0.75f; // and in the same pixel
    assert_true(rg_metrics_compute(&a, &b, &m));
    assert_equals(m.max, 0.5);
    assert_equals(m.max_x, 2);
    assert_equals(m.max_y, 3);
    assert_equals(m.max_channel, 1);
    b.texels[(3 * 4 + 3) * 3 + 2] += 1e-5f; // less, after the pixel's largest difference
    assert_true(rg_metrics_compute(&a, &b, &m));
    assert_int_equal(m.values_above[RG_ABOVE_COUNT - 1], 3);
    assert_int_equal(m.pixels_above[RG_ABOVE_COUNT - 1], 3);
    rg_picture_destroy(&a);
    rg_picture_destroy(&b);
}

static void nonfinite_values_are_counted(void **state)
{
    (void)state;
    struct rg_picture a = noise_picture(40, 3, 4, 1), b = noise_picture(40, 3, 4, 1);
    a.texels[5] = b.texels[5] = NAN;
    a.texels[6] = b.texels[6] = INFINITY;
    struct rg_metrics m;
    assert_true(rg_metrics_compute(&a, &b, &m));
    assert_equals(m.max, 0);
    assert_equals(m.mean, 0);
    assert_true(isinf(m.psnr_db)); // the pictures agree
    assert_int_equal(m.nonfinite_a, 2);
    assert_int_equal(m.nonfinite_mismatches, 0);
    a.texels[40 * 4 + 9] = -INFINITY;
    a.texels[1] += 0.5f;
    assert_true(rg_metrics_compute(&a, &b, &m));
    assert_true(isinf(m.max));
    assert_equals(m.max_y, 1);
    assert_equals(m.max_x, 2);
    assert_equals(m.max_channel, 1);
    assert_true(near(m.mean, 0.5 / 480, 1e-6) && isnan(m.psnr_db));
    assert_int_equal(m.nonfinite_mismatches, 1);
    assert_int_equal(m.values_above[RG_ABOVE_COUNT - 1], 2);
    rg_picture_destroy(&a);
    rg_picture_destroy(&b);
}

// Figures of a pair whose values reach up to `most`, at each threshold.
static void agree_up_to(const struct rg_oiio_functions *oiio, float most, int channels)
{
    struct rg_picture a = noise_picture(83, 61, channels, 1);
    struct rg_picture b = noise_picture(83, 61, channels, 1);
    for (int64_t i = 0; i < rg_picture_values(&b); i++) {
        a.texels[i] = b.texels[i] *= most;
        if (i % 7 == 0)
            b.texels[i] *= 1 - 0.03f * (float)(rain_noise((uint32_t)i) >> 8) * 0x1p-24f;
    }
    a.texels[0] = b.texels[0] = most;
    struct rg_metrics m;
    assert_true(rg_metrics_compute(&a, &b, &m));
    for (int t = 0; t < RG_ABOVE_COUNT; t++) {
        struct rg_oiio_comparison theirs;
        assert_true(oiio->compare(a.texels, b.texels, 83, 61, channels, rg_above_thresholds[t],
                                  1.0f, &theirs));
        assert_int_equal(m.pixels_above[t], theirs.pixels_failing);
        assert_true(near(m.mean, theirs.mean, 1e-12));
        assert_true(near(m.rms, theirs.rms, 1e-12));
        assert_true(near(m.psnr_db, theirs.psnr_db, 1e-12));
        assert_equals(m.max, theirs.max);
        assert_equals(m.max_x, theirs.max_x);
        assert_equals(m.max_y, theirs.max_y);
        assert_equals(m.max_channel, theirs.max_channel);
    }
    rg_picture_destroy(&a);
    rg_picture_destroy(&b);
}

static void openimageio_agrees(void **state)
{
    (void)state;
    static const float most[] = {0.1f, 0.7f, 1, 8, 100};
    char why[300];
    const struct rg_oiio_functions *oiio = rg_oiio(why, sizeof(why));
    if (!oiio)
        fail_msg("%s", why);
    for (int channels = 1; channels <= 4; channels++)
        for (int i = 0; i < 5; i++)
            agree_up_to(oiio, most[i], channels);
}

// Colours count as codes, alpha as it is: 20 against 10 of 255, and alpha 0.5 against 0.25.
static void codes_in_closed_form(void **state)
{
    (void)state;
    struct rg_picture a = noise_picture(5, 3, 4, 1), b = noise_picture(5, 3, 4, 1);
    for (int i = 0; i < 5 * 3 * 4; i++) {
        const bool alpha = i % 4 == 3;
        a.texels[i] = alpha ? 0.5f : (float)rg_srgb_decode(20 / 255.0);
        b.texels[i] = alpha ? 0.25f : (float)rg_srgb_decode(10 / 255.0);
    }
    a.decoded = b.decoded = true;
    struct rg_metrics m;
    const double d = 10 / 255.0, rms = sqrt((3 * d * d + 0.25 * 0.25) / 4);
    assert_true(rg_code_metrics(&a, &b, &m));
    assert_true(near(m.mean, (3 * d + 0.25) / 4, 1e-6) && near(m.rms, rms, 1e-6));
    assert_true(near(m.max, 0.25, 1e-6) && near(m.psnr_db, 20 * log10(1 / rms), 1e-6));
    const struct rg_compare_options options = {.hdr_flip = true};
    struct rg_comparison c;
    assert_true(rg_compare(&a, "a", &b, "b", NULL, &options, &c));
    assert_true(c.has_codes);
    assert_true(!c.has_hdr_flip);
    assert_equals(c.code_metrics.rms, m.rms);
    assert_differs(c.metrics.rms, m.rms); // this one is of light
    rg_comparison_destroy(&c);
    b.decoded = false; // without codes in one picture there are no code metrics
    assert_true(rg_compare(&a, "a", &b, "b", NULL, &options, &c));
    assert_true(!c.has_codes && !c.has_hdr_flip);
    rg_comparison_destroy(&c);
    a.decoded = false;
    assert_true(rg_compare(&a, "a", &b, "b", NULL, &options, &c));
    assert_true(!c.has_codes);
    assert_true(c.has_hdr_flip);
    assert_above(c.hdr_flip.flip.mean, 0);
    rg_comparison_destroy(&c);
    rg_picture_destroy(&a);
    rg_picture_destroy(&b);
}

static void threads_change_nothing(void **state)
{
    (void)state;
    struct rg_picture a = noise_picture(300, 211, 4, 1), b = noise_picture(300, 211, 4, 9);
    struct rg_comparison one, many;
    int threads = omp_get_max_threads();
    const struct rg_compare_options options = {0};
    omp_set_num_threads(1);
    assert_true(rg_compare(&a, "a", &b, "b", NULL, &options, &one));
    omp_set_num_threads(5);
    assert_true(rg_compare(&a, "a", &b, "b", NULL, &options, &many));
    omp_set_num_threads(threads);
    assert_memory_equal(&one.metrics, &many.metrics, sizeof(one.metrics));
    assert_memory_equal(&one.flip, &many.flip, sizeof(one.flip));
    assert_equals(one.tiers.relative_mean, many.tiers.relative_mean);
    assert_equals(one.tiers.tile_max_codes, many.tiers.tile_max_codes);
    assert_equals(one.tiers.matched_a, many.tiers.matched_a);
    assert_memory_equal(one.flip_map, many.flip_map, 300 * 211 * 4);
    rg_comparison_destroy(&one);
    rg_comparison_destroy(&many);
    rg_picture_destroy(&a);
    rg_picture_destroy(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_pictures_have_no_error), cmocka_unit_test(closed_form),
        cmocka_unit_test(nonfinite_values_are_counted), cmocka_unit_test(openimageio_agrees),
        cmocka_unit_test(codes_in_closed_form),         cmocka_unit_test(threads_change_nothing),
    };
    return cmocka_run_group_tests_name("image metrics", tests, NULL, NULL);
}
