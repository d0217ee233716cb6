// What `diff` tells of a pair of pictures: each figure under its name, for people and for machines;
// what files hold besides; and which mutants a looser tier would accept.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/diff/accepts.h"
#include "harness/compare/diff/beside.h"
#include "harness/compare/diff/pair.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"
#include "tests/tools/process/printed.h"

// A comparison whose figures all differ.
static const struct rg_comparison all = {
    .width = 640,
    .height = 480,
    .channels = 3,
    .exposure = 2,
    .pixels_per_degree = 50.5f,
    .tier = "T2",
    .metrics = {.mean = 0.01,
                .rms = 0.02,
                .psnr_db = 30.25,
                .max = 0.5,
                .max_x = 11,
                .max_y = 12,
                .max_channel = 2,
                .values = 1000,
                .differing_values = 21,
                .differing_pixels = 7,
                .values_above = {41, 42, 43, 44},
                .pixels_above = {31, 32, 33, 34},
                .nonfinite_a = 3,
                .nonfinite_b = 4,
                .nonfinite_mismatches = 5},
    .has_codes = true,
    .code_metrics = {.mean = 0.03, .rms = 0.04, .psnr_db = 40.5, .max = 0.6},
    .flip = {.mean = 0.101,
             .max = 0.102,
             .weighted_median = 0.103,
             .weighted_quartile_1 = 0.104,
             .weighted_quartile_3 = 0.105,
             .p99 = 0.106,
             .mask_mean = 0.107,
             .mask_p99 = 0.108},
    .has_hdr_flip = true,
    .hdr_flip = {.start_exposure = -3.5,
                 .stop_exposure = 4.5,
                 .exposures = 7,
                 .flip = {.mean = 0.201,
                          .max = 0.202,
                          .weighted_median = 0.203,
                          .weighted_quartile_1 = 0.204,
                          .weighted_quartile_3 = 0.205,
                          .p99 = 0.206,
                          .mask_mean = 0.207,
                          .mask_p99 = 0.208}},
    .tiers = {.mask_pixels = 900,
              .of = {{false, "t0 why"}, {false, "t1 why"}, {true, ""}},
              .max_codes = 17,
              .above_one_fraction = 0.25,
              .bias_codes = 1.5,
              .coverage_mismatches = 6,
              .matched_a = 0.5,
              .matched_b = 0.75,
              .energy_ratio = 1.25,
              .tile_max_codes = 2.5,
              .clamped_max = 0.125,
              .clamped_bias = 0.0625,
              .clamped_ratio = 0.875,
              .relative_mean = 0.375,
              .relative_max = 0.625},
};

// --- text ---

static void expect_text(const struct rg_comparison *comparison, const char *const *parts)
{
    char due[4096] = "";
    for (; *parts; parts++)
        snprintf(due + strlen(due), sizeof(due) - strlen(due), "%s", *parts);
    printed_begin();
    rg_pair_print("a.exr", "b.exr", comparison);
    const char *text = printed_end();
    assert_string_equal(text, due);
}

static const char *const all_lines[] = {
    "A a.exr\nB b.exr\n640 x 480 pixels, 3 channels; tier T2\n\n"
    "  T0 identical                 fails: t0 why\n"
    "  T1 arithmetic                fails: t1 why\n"
    "  T2 geometry                  holds\n",
    "\nencoded: sRGB, 8 bits, exposure 2\n"
    "  rain mask                    900 pixels\n"
    "  largest difference           17/255\n"
    "  above 1/255                  25 % of the mask\n"
    "  bias                         1.5/255\n"
    "  coverage differs             6 pixels\n"
    "  found within 1 pixel         50.0000 % of A in B, 75.0000 % of B in A\n"
    "  energy ratio                 1.250000\n"
    "  largest tile difference      2.5/255\n"
    "  beyond black and white       largest 12.5 %, bias 6.25 %, ratio of light 0.875000\n"
    "  relative error (linear)      mean 0.375, largest 0.625\n",
    "\nlinear light, decoded from sRGB codes\n"
    "  differing values             21 of 1000, in 7 pixels\n"
    "  mean error, rms              0.01, 0.02\n"
    "  PSNR                         30.25 dB\n"
    "  largest error                0.5 at x 11, y 12, channel 2\n"
    "  pixels above                 1e-06: 31, 0.0001: 32, 0.001: 33, 0.01: 34\n"
    "  NaN or infinite              3 in A, 4 in B, 5 do not agree\n",
    "\ncodes, over the largest code\n"
    "  mean error, rms              0.03, 0.04\n"
    "  PSNR                         40.5 dB\n"
    "  largest error                0.6\n",
    "\nFLIP (LDR, 50.5 pixels a degree)\n"
    "  mean, weighted median        0.101000, 0.103000\n"
    "  weighted quartiles           0.104000, 0.105000\n"
    "  99th percentile, largest     0.106000, 0.102000\n"
    "  over the mask: mean, p99     0.107000, 0.108000\n",
    "\nHDR-FLIP (ACES, 7 exposures from -3.5 to 4.5 stops)\n"
    "  mean, weighted median        0.201000, 0.203000\n"
    "  weighted quartiles           0.204000, 0.205000\n"
    "  99th percentile, largest     0.206000, 0.202000\n"
    "  over the mask: mean, p99     0.207000, 0.208000\n",
    NULL};

static void each_figure_has_its_line(void **state)
{
    (void)state;
    expect_text(&all, all_lines);
}

static const char *const few_lines[] = {
    "A a.exr\nB b.exr\n640 x 480 pixels, 1 channel; tier none\n\n"
    "  T0 identical                 holds\n"
    "  T1 arithmetic                fails: t1 why\n"
    "  T2 geometry                  fails: t2 why\n"
    "\nencoded: sRGB, 8 bits, exposure 2\n"
    "  rain mask                    900 pixels (no background given: the whole picture)\n"
    "  largest difference           17/255\n"
    "  above 1/255                  25 % of the mask\n"
    "  bias                         1.5/255\n"
    "  found within 1 pixel         50.0000 % of A in B, 75.0000 % of B in A\n",
    "  energy ratio                 1.250000\n"
    "  largest tile difference      2.5/255\n"
    "  beyond black and white       largest 12.5 %, bias 6.25 %, ratio of light 0.875000\n"
    "  relative error (linear)      mean 0.375, largest 0.625\n"
    "\nlinear light\n"
    "  differing values             21 of 1000, in 7 pixels\n"
    "  mean error, rms              0.01, 0.02\n"
    "  PSNR                         none, of values that are no numbers\n"
    "  largest error                0\n"
    "  pixels above                 1e-06: 31, 0.0001: 32, 0.001: 33, 0.01: 34\n"
    "  NaN or infinite              0 in A, 4 in B, 5 do not agree\n",
    "\nFLIP (LDR, 50.5 pixels a degree)\n"
    "  mean, weighted median        0.101000, 0.103000\n"
    "  weighted quartiles           0.104000, 0.105000\n"
    "  99th percentile, largest     0.106000, 0.102000\n"
    "  over the mask: mean, p99     0.107000, 0.108000\n",
    NULL};

// Of one channel, without a background, codes, HDR-FLIP and a PSNR.
static void figures_that_are_none_have_no_line(void **state)
{
    (void)state;
    struct rg_comparison c = all;
    c.channels = 1;
    c.tier = "none";
    c.tiers.of[RG_T0] = (struct rg_verdict){true, ""};
    c.tiers.of[RG_T2] = (struct rg_verdict){false, "t2 why"};
    c.tiers.mask_is_whole = true;
    c.metrics.psnr_db = NAN;
    c.metrics.max = 0;
    c.metrics.nonfinite_a = 0;
    c.has_codes = c.has_hdr_flip = false;
    expect_text(&c, few_lines);
}

// --- JSON ---

static const struct {
    const char *object, *key; // "": of the pair itself
    double value;
} figures[] = {
    {"", "max", 17},
    {"", "differing", 21},
    {"", "mask", 900},
    {"", "flip_mean", 0.101},
    {"", "flip_weighted_median", 0.103},
    {"", "flip_weighted_quartile_1", 0.104},
    {"", "flip_weighted_quartile_3", 0.105},
    {"", "flip_p99", 0.106},
    {"", "flip_max", 0.102},
    {"", "flip_mask_mean", 0.107},
    {"", "flip_mask_p99", 0.108},
    {"", "exposure", 2},
    {"", "pixels_per_degree", 50.5},
    {"", "relative_mean", 0.375},
    {"", "psnr", 30.25},
    {"tiers", "above_one_fraction", 0.25},
    {"tiers", "bias_codes", 1.5},
    {"tiers", "coverage_mismatches", 6},
    {"tiers", "matched_a", 0.5},
    {"tiers", "matched_b", 0.75},
    {"tiers", "energy_ratio", 1.25},
    {"tiers", "tile_max_codes", 2.5},
    {"tiers", "relative_mean", 0.375},
    {"tiers", "relative_max", 0.625},
    {"tiers", "clamped_max", 0.125},
    {"tiers", "clamped_bias", 0.0625},
    {"tiers", "clamped_ratio", 0.875},
    {"linear", "mean", 0.01},
    {"linear", "rms", 0.02},
    {"linear", "max", 0.5},
    {"linear", "values", 1000},
    {"linear", "differing_pixels", 7},
    {"linear", "nonfinite_a", 3},
    {"linear", "nonfinite_b", 4},
    {"linear", "nonfinite_mismatches", 5},
    {"codes", "mean", 0.03},
    {"codes", "rms", 0.04},
    {"codes", "max", 0.6},
    {"codes", "psnr", 40.5},
    {"hdr_flip", "start_exposure", -3.5},
    {"hdr_flip", "stop_exposure", 4.5},
    {"hdr_flip", "exposures", 7},
    {"hdr_flip", "mean", 0.201},
    {"hdr_flip", "weighted_median", 0.203},
    {"hdr_flip", "weighted_quartile_1", 0.204},
    {"hdr_flip", "weighted_quartile_3", 0.205},
    {"hdr_flip", "p99", 0.206},
    {"hdr_flip", "max", 0.202},
    {"hdr_flip", "mask_mean", 0.207},
    {"hdr_flip", "mask_p99", 0.208},
};

static void each_figure_has_its_key(void **state)
{
    (void)state;
    json_t *pair = rg_pair_json("a.exr", "b.exr", &all);
    assert_non_null(pair);
    for (size_t i = 0; i < sizeof(figures) / sizeof(figures[0]); i++) {
        const json_t *of = *figures[i].object ? json_object_get(pair, figures[i].object) : pair;
        const json_t *value = json_object_get(of, figures[i].key);
        if (!json_is_number(value) || json_number_value(value) != figures[i].value)
            fail_msg("%s %s is %g, not %g", figures[i].object, figures[i].key,
                     json_number_value(value), figures[i].value);
    }
    static const double thresholds[] = {1e-6, 1e-4, 1e-3, 1e-2};
    const json_t *linear = json_object_get(pair, "linear");
    for (int t = 0; t < 4; t++) {
        const json_t *above = json_array_get(json_object_get(linear, "above"), (size_t)t);
        assert_near(json_number_value(json_object_get(above, "threshold")), thresholds[t], 1e-9);
        assert_int_equal(json_integer_value(json_object_get(above, "values")), 41 + t);
        assert_int_equal(json_integer_value(json_object_get(above, "pixels")), 31 + t);
    }
    json_t *rest =
        json_pack("[sss[iii]b{sbss}{sbss}{sbss}]", "a.exr", "b.exr", "T2", 11, 12, 2, 0, "holds", 0,
                  "why", "t0 why", "holds", 0, "why", "t1 why", "holds", 1, "why", "");
    const json_t *tiers = json_object_get(pair, "tiers");
    json_t *found = json_pack("[OOOOOOOO]", json_object_get(pair, "a"), json_object_get(pair, "b"),
                              json_object_get(pair, "tier"), json_object_get(linear, "max_at"),
                              json_object_get(tiers, "mask_is_whole"), json_object_get(tiers, "t0"),
                              json_object_get(tiers, "t1"), json_object_get(tiers, "t2"));
    assert_non_null(found);
    assert_true(json_equal(found, rest));
    json_decref(found);
    json_decref(rest);
    json_decref(pair);
}

// JSON has neither infinities nor NaN.
static void figures_that_are_no_numbers_are_null(void **state)
{
    (void)state;
    struct rg_comparison c = all;
    c.metrics.max = INFINITY;
    c.metrics.psnr_db = NAN;
    c.code_metrics.psnr_db = INFINITY;
    json_t *pair = rg_pair_json("a.exr", "b.exr", &c);
    assert_true(json_is_null(json_object_get(json_object_get(pair, "linear"), "max")));
    assert_null(json_object_get(pair, "psnr"));
    assert_true(json_is_null(json_object_get(json_object_get(pair, "codes"), "psnr")));
    json_decref(pair);
    c.has_codes = c.has_hdr_flip = false;
    pair = rg_pair_json("a.exr", "b.exr", &c);
    assert_true(json_is_null(json_object_get(pair, "codes")));
    assert_true(json_is_null(json_object_get(pair, "hdr_flip")));
    json_decref(pair);
    rg_log_hold(true);
    assert_null(rg_pair_json("a\xff.exr", "b.exr", &c));
    assert_non_null(strstr(rg_last_error(), "'a\xff.exr' is not UTF-8"));
    assert_null(rg_pair_json("a.exr", "b\xff.exr", &c));
    rg_log_hold(false);
}

static void a_document_has_what_there_is(void **state)
{
    (void)state;
    for (int has = 0; has < 2; has++) {
        json_t *devices = has ? json_pack("[s]", "d") : NULL;
        json_t *pictures = has ? json_pack("[s]", "p") : NULL;
        json_t *pairs = json_pack("[s]", "q"), *failures = json_pack("[s]", "f");
        printed_begin();
        assert_true(rg_pairs_print_json(devices, pictures, pairs, failures));
        const char *text = printed_end();
        json_t *found = json_loads(text, 0, NULL);
        json_t *due = has ? json_pack("{si s[s] s[s] s[s] s[s]}", "format", 1, "devices", "d",
                                      "pictures", "p", "pairs", "q", "failures", "f")
                          : json_pack("{si s[s] s[s]}", "format", 1, "pairs", "q", "failures", "f");
        assert_true(json_equal(found, due));
        json_decref(due);
        json_decref(found);
        json_decref(pictures);
        json_decref(pairs);
        json_decref(failures);
    }
}

// --- what files hold besides ---

static struct rg_picture picture_with(const char *extras, float alpha, bool is_associated)
{
    struct rg_picture picture;
    assert_true(rg_picture_create(&picture, 1, 1, 4, "one"));
    for (int i = 0; i < 4; i++)
        picture.texels[i] = i == 3 ? alpha : 0;
    picture.extras = extras ? strdup(extras) : NULL;
    picture.is_associated = is_associated;
    return picture;
}

// Compares what two pictures hold besides; the caller frees the items.
static struct rg_beside find(struct rg_picture a, struct rg_picture b)
{
    struct rg_beside beside = {0};
    logged_lines = 0;
    rg_log_listen(log_last, NULL);
    assert_true(rg_beside_find(&a, "a.png", &b, "b.png", &beside));
    rg_log_listen(NULL, NULL);
    rg_picture_destroy(&a);
    rg_picture_destroy(&b);
    return beside;
}

static void differences_are_told_with_both_values(void **state)
{
    (void)state;
    struct rg_beside beside = find(picture_with("channel Z\t1\nname\tx\nview\tv\n", 1, false),
                                   picture_with("channel Z\t2\nname\tx\n!profile\tp\n", 1, true));
    printed_begin();
    rg_beside_print(&beside);
    const char *text = printed_end();
    assert_string_equal(text, "\nthe files differ in\n"
                              "  channel Z                    A: 1; B: 2\n"
                              "  view                         A: v; B: none\n"
                              "  profile                      A: none; B: p\n");
    json_t *json = rg_beside_json(&beside),
           *due = json_pack("[{ssssss}{ssssss}{ssssss}]", "what", "channel Z", "a", "1", "b", "2",
                            "what", "view", "a", "v", "b", "none", "what", "profile", "a", "none",
                            "b", "p");
    assert_true(json_equal(json, due));
    assert_int_equal(logged_lines, 0);
    json_decref(json);
    json_decref(due);
    free(beside.items);
}

static void what_files_share_is_no_difference(void **state)
{
    (void)state;
    static const char extras[] = "!profile\tp\nname\tx\n!colours\tc\n";
    struct rg_beside beside = find(picture_with(extras, 1, false), picture_with(extras, 1, false));
    assert_int_equal(beside.count, 0);
    assert_int_equal(logged_lines, 1);
    assert_string_equal(logged, "a.png and b.png: have the same profile, colours, which is not "
                                "applied: figures of light are those of sRGB's colours");
    printed_begin();
    rg_beside_print(&beside);
    const char *text = printed_end();
    assert_string_equal(text, "");
    beside = find(picture_with("name\tx\n", 1, false), picture_with("name\tx\n", 1, false));
    assert_int_equal(beside.count + logged_lines, 0);
}

// Colours that were multiplied by alpha look another way, unless the alpha is 1.
static void alpha_of_two_kinds_differs(void **state)
{
    (void)state;
    for (int is = 0; is < 2; is++) {
        struct rg_beside beside = find(picture_with(NULL, 0.5f, is), picture_with(NULL, 0.5f, !is));
        assert_int_equal(beside.count, 1);
        assert_string_equal(beside.items[0].what, "alpha");
        assert_string_equal(beside.items[0].a, is ? "associated" : "straight");
        assert_string_equal(beside.items[0].b, is ? "straight" : "associated");
        free(beside.items);
        assert_int_equal(find(picture_with(NULL, 0.5f, is), picture_with(NULL, 0.5f, is)).count, 0);
        assert_int_equal(find(picture_with(NULL, 1, is), picture_with(NULL, 0.5f, !is)).count, 0);
        assert_int_equal(find(picture_with(NULL, 0.5f, is), picture_with(NULL, 1, !is)).count, 0);
    }
}

// No tier holds then; what failed before fails for its own reason.
static void a_difference_besides_fails_every_tier(void **state)
{
    (void)state;
    struct rg_difference item = {.what = "channel Z"};
    const struct rg_beside beside = {.items = &item, .count = 1}, none = {0};
    struct rg_comparison c = all;
    rg_beside_judge(&none, &c);
    assert_string_equal(c.tier, "T2");
    assert_true(c.tiers.of[RG_T2].holds);
    rg_beside_judge(&beside, &c);
    assert_string_equal(c.tier, "none");
    for (int tier = 0; tier < RG_TIER_COUNT; tier++)
        assert_false(c.tiers.of[tier].holds);
    assert_string_equal(c.tiers.of[RG_T0].why, "t0 why");
    assert_string_equal(c.tiers.of[RG_T1].why, "t1 why");
    assert_string_equal(c.tiers.of[RG_T2].why, "the files differ in channel Z");
}

// --- what a looser tier would accept ---

static void expect_accepts(const struct rg_tiers *tiers, bool wanted, const char *text,
                           const char *json)
{
    // Drawn before, so that nothing is drawn here.
    static struct rg_accepts accepts = {
        .is_known = {false, true, true},
        .of = {[RG_T1] = {RG_T1, 9, 0, {NULL}}, [RG_T2] = {RG_T2, 8, 2, {"fewer", "bent less"}}}};
    printed_begin();
    assert_null(rg_accepts_tell(&accepts, NULL, tiers, wanted, false));
    const char *told = printed_end();
    assert_string_equal(told, text);
    json_t *found = rg_accepts_tell(&accepts, NULL, tiers, wanted, true);
    json_t *due = json_loads(json, 0, NULL);
    assert_non_null(due);
    assert_true(json_equal(found, due));
    json_decref(found);
    json_decref(due);
}

static void the_strictest_tier_that_holds_is_told(void **state)
{
    (void)state;
    struct rg_tiers tiers = all.tiers;
    expect_accepts(&tiers, true, "  T2 would hold; of 8 mutants it accepts fewer, bent less\n",
                   "{\"tier\": \"T2\", \"mutants\": 8, \"accepted\": [\"fewer\", \"bent less\"]}");
    expect_accepts(&tiers, false, "  T2 would hold\n", "{\"tier\": \"T2\"}");
    tiers.of[RG_T1].holds = true;
    expect_accepts(&tiers, true, "  T1 would hold; of 9 mutants it accepts none\n",
                   "{\"tier\": \"T1\", \"mutants\": 9, \"accepted\": []}");
    tiers.of[RG_T1].holds = false;
    tiers.of[RG_T2] = (struct rg_verdict){false, "t2 why"};
    expect_accepts(&tiers, true, "  no tier would hold: t2 why\n", "{\"tier\": \"none\"}");
}

static void mutants_are_listed(void **state)
{
    (void)state;
    struct rg_mutants_told told = {.alive = {"one", "two", "three"}};
    static const char *const due[] = {"", "one", "one, two", "one, two, three"};
    char text[64];
    for (told.alive_count = 0; told.alive_count <= 3; told.alive_count++) {
        rg_mutants_text(&told, text, sizeof(text));
        assert_string_equal(text, due[told.alive_count]);
    }
    told.alive_count = 3;
    rg_mutants_text(&told, text, 7); // what has no room is cut off
    assert_string_equal(text, "one, t");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_figure_has_its_line),
        cmocka_unit_test(figures_that_are_none_have_no_line),
        cmocka_unit_test(each_figure_has_its_key),
        cmocka_unit_test(figures_that_are_no_numbers_are_null),
        cmocka_unit_test(a_document_has_what_there_is),
        cmocka_unit_test(differences_are_told_with_both_values),
        cmocka_unit_test(what_files_share_is_no_difference),
        cmocka_unit_test(alpha_of_two_kinds_differs),
        cmocka_unit_test(a_difference_besides_fails_every_tier),
        cmocka_unit_test(the_strictest_tier_that_holds_is_told),
        cmocka_unit_test(mutants_are_listed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
