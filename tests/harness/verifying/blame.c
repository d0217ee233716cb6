// Blame: planted differences of each kind are recognized, and the first stage, asset and place are
// named at which two devices differ.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/compare/blame/blame.h"
#include "tests/harness/verifying/rig.h"
#include "tests/tools/expect.h"
#include "tests/tools/instance.h"

enum { WORDS = 16 };

static float now[WORDS], due[WORDS], before[WORDS];
static struct rg_contents contents, expected, earlier;
static struct rg_differing differing;
static struct rg_state words; // floats, unless a test says otherwise

// Floats 1 to 16 on both sides, and 100 to 115 before the stage.
static int setup(void **state)
{
    (void)state;
    contents = (struct rg_contents){.size = sizeof(now), .bytes = now};
    expected = (struct rg_contents){.size = sizeof(due), .bytes = due};
    earlier = (struct rg_contents){.size = sizeof(before), .bytes = before};
    words = (struct rg_state){.name = "words", .words = "f"};
    for (int i = 0; i < WORDS; i++) {
        now[i] = due[i] = (float)(i + 1);
        before[i] = (float)(i + 100);
    }
    return 0;
}

static enum rg_difference found(void)
{
    return rg_difference_of(&contents, &expected, &earlier, &words, &differing);
}

// An image of side x side texels.
static void make_image(enum rg_format format, int side)
{
    contents.desc = expected.desc = earlier.desc = (struct rg_image_desc){
        .format = format, .width = side, .height = side, .layers = 1, .levels = 1};
}

static void nothing_differs(void **state)
{
    (void)state;
    assert_int_equal(found(), RG_DIFFERENCE_NONE);
    assert_int_equal(differing.count, 0);
    contents.size = 12;
    assert_int_equal(found(), RG_DIFFERENCE_SIZE);
}

static void the_first_word_and_their_number(void **state)
{
    (void)state;
    now[5] = 50;
    now[15] = 60;
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
    assert_int_equal(differing.first, 5);
    assert_int_equal(differing.count, 2);
}

// One side alone has a NaN or an infinity. Two NaNs with different bits are another kind of
// difference.
static void a_nan_is_told(void **state)
{
    (void)state;
    now[3] = NAN;
    assert_int_equal(found(), RG_DIFFERENCE_NAN);
    now[3] = due[3];
    due[7] = INFINITY;
    assert_int_equal(found(), RG_DIFFERENCE_NAN);
    now[7] = NAN;
    due[7] = -NAN;
    assert_int_not_equal(found(), RG_DIFFERENCE_NAN);
    setup(NULL);
    make_image(RG_RGBA16F, 2);
    contents.size = expected.size = 32;
    memcpy(now, &(uint32_t){0x7c003c00}, 4);
    memcpy(due, &(uint32_t){0x3c003c00}, 4);
    assert_int_equal(found(), RG_DIFFERENCE_NAN);
}

// Integers may have the bits of any float, and have no last bits.
static void integers_are_no_floats(void **state)
{
    (void)state;
    words.words = "u";
    memcpy(now, &(uint32_t){0x7fc00000}, 4);
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
    memcpy(now, &(uint32_t){0x7f800001}, 4);
    memcpy(due, &(uint32_t){0x7f800000}, 4);
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
    words.words = NULL;
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
    memcpy(now, &(uint32_t){8}, 4);
    memcpy(due, &(uint32_t){7}, 4);
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
    words.words = "u";
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
    words.words = "f";
    assert_int_equal(found(), RG_DIFFERENCE_LAST_BITS);
    words.words = "uf"; // the first word of each element is an integer
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
}

// The text about a difference of one word.
static void assert_told(uint32_t is, uint32_t should, const char *says)
{
    char text[400];
    memcpy(now + 5, &is, 4);
    memcpy(due + 5, &should, 4);
    rg_contents_describe(&contents, &expected, &words, text, sizeof(text));
    assert_string_equal(text, says);
}

static void words_are_told_as_what_they_are(void **state)
{
    (void)state;
    assert_told(
        0x3f000000, 0x3e800000,
        "[5] is 0.5 (0x3f000000), not 0.25 (0x3e800000), off by 0.25; 1 of 16 words differ");
    words.words = "u";
    assert_told(0xff6a0001, 7,
                "[5] is 4285136897 (0xff6a0001), not 7 (0x00000007), off by 4285136890; 1 of 16 "
                "words differ");
    words.words = "fiu";
    assert_told(0xffffffff, 1,
                "[1], word 2 of its 3, is 4294967295 (0xffffffff), not 1 (0x00000001), off by "
                "4294967294; 1 of 16 words differ");
    words.words = "fi";
    assert_told(0xffffffff, 1,
                "[2], word 1 of its 2, is -1 (0xffffffff), not 1 (0x00000001), off by 2; 1 of 16 "
                "words differ");
}

static void texels_are_told_as_what_they_hold(void **state)
{
    (void)state;
    words.words = NULL;
    make_image(RG_RGBA8, 4);
    assert_told(0xff0a00fe, 0xff0c00ff,
                " (1, 1) of layer 0, level 0, byte 0 of the texel is (254, 0, 10, 255) "
                "(0xff0a00fe), not (255, 0, 12, 255) (0xff0c00ff), off by 2; 1 of 16 words differ");
    make_image(RG_RG11B10F, 4); // 1, 0.5 and 2
    assert_told(0x801c03c0, 0x781c03c0,
                " (1, 1) of layer 0, level 0, byte 0 of the texel is (1, 0.5, 2) (0x801c03c0), "
                "not (1, 0.5, 1) (0x781c03c0), off by 1; 1 of 16 words differ");
    make_image(RG_R32F, 4);
    assert_told(0x3f800000, 0,
                " (1, 1) of layer 0, level 0, byte 0 of the texel is 1 (0x3f800000), not 0 "
                "(0x00000000), off by 1; 1 of 16 words differ");
    contents.size = expected.size = sizeof(now);
    make_image(RG_RGBA16F, 2);
    contents.size = expected.size = 32;
    assert_told(0x3c00c000, 0x38004000,
                " (0, 1) of layer 0, level 0, byte 4 of the texel is (-2, 1) (0x3c00c000), not "
                "(2, 0.5) (0x38004000), off by 4; 1 of 8 words differ");
}

// A small float is NaN if its exponent is all ones; a step of its last bit is a difference in last
// bits.
static void small_floats_are_told(void **state)
{
    (void)state;
    make_image(RG_RG11B10F, 4);
    memcpy(now, &(uint32_t){0x7c1}, 4);
    memcpy(due, &(uint32_t){0x3c0}, 4);
    assert_int_equal(found(), RG_DIFFERENCE_NAN);
    memcpy(now, &(uint32_t){0x3c1 | 0x3c1u << 11}, 4);
    memcpy(due, &(uint32_t){0x3c0 | 0x3c0u << 11}, 4);
    assert_int_equal(found(), RG_DIFFERENCE_LAST_BITS);
    memcpy(now, &(uint32_t){0x3d0}, 4);
    memcpy(due, &(uint32_t){0x3c0}, 4);
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
}

// All differing words must be missing, or all surplus; if only some are, the kind is neither.
static void what_the_stage_left_out_is_told(void **state)
{
    (void)state;
    now[4] = before[4];
    now[9] = before[9];
    assert_int_equal(found(), RG_DIFFERENCE_MISSING);
    now[2] = 55;
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
    setup(NULL);
    due[4] = before[4];
    assert_int_equal(found(), RG_DIFFERENCE_SURPLUS);
    earlier.bytes = NULL;
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
}

// Elements of two words: swapped words within elements are not another order.
static void another_order_is_told(void **state)
{
    (void)state;
    memcpy(now + 4, due + 10, 8);
    memcpy(now + 10, due + 4, 8);
    words.words = "ff";
    assert_int_equal(found(), RG_DIFFERENCE_ORDER);
    words.words = "ffff";
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
    words.words = "ff";
    now[4]++;
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
    setup(NULL);
    now[0] = due[4]; // three elements in turn
    now[4] = due[10];
    now[10] = due[0];
    assert_int_equal(found(), RG_DIFFERENCE_ORDER);
}

static void last_bits_are_told(void **state)
{
    (void)state;
    now[6] = nextafterf(due[6], 0);
    assert_int_equal(found(), RG_DIFFERENCE_LAST_BITS);
    due[8] = 1e-44f; // on either side of zero
    now[8] = -1e-44f;
    assert_int_equal(found(), RG_DIFFERENCE_LAST_BITS);
    now[7] = due[7] * 1.001f;
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
    setup(NULL);
    make_image(RG_RGBA8, 4);
    memcpy(now, &(uint32_t){0x10203040}, 4);
    memcpy(due, &(uint32_t){0x0f213040}, 4);
    assert_int_equal(found(), RG_DIFFERENCE_LAST_BITS);
    memcpy(due, &(uint32_t){0x0e213040}, 4);
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
}

static const struct {
    enum rg_format format;
    uint32_t now, due;
    enum rg_difference kind;
} steps[] = {
    {RG_R32F, 0x3f800010, 0x3f800000, RG_DIFFERENCE_LAST_BITS},
    {RG_R32F, 0x3f800011, 0x3f800000, RG_DIFFERENCE_VALUES},
    {RG_R32F, 0x80000008, 0x00000008, RG_DIFFERENCE_LAST_BITS},
    {RG_R32F, 0x80000009, 0x00000008, RG_DIFFERENCE_VALUES},
    {RG_RGBA16F, 0x3c003c02, 0x3c003c00, RG_DIFFERENCE_LAST_BITS},
    {RG_RGBA16F, 0x3c003c03, 0x3c003c00, RG_DIFFERENCE_VALUES},
    {RG_RGBA16F, 0x3c023c00, 0x3c003c00, RG_DIFFERENCE_LAST_BITS},
    {RG_RGBA16F, 0x3c033c00, 0x3c003c00, RG_DIFFERENCE_VALUES},
    {RG_RGBA16F, 0x80010000, 0x00010000, RG_DIFFERENCE_LAST_BITS},
    {RG_RGBA16F, 0x80020000, 0x00010000, RG_DIFFERENCE_VALUES},
    {RG_RGBA16F, 0xfc000000, 0x00000000, RG_DIFFERENCE_NAN},
    {RG_RGBA16F, 0xfbff0000, 0x00000000, RG_DIFFERENCE_VALUES},
    {RG_RG11B10F, 0x40000002, 0x40000000, RG_DIFFERENCE_LAST_BITS},
    {RG_RG11B10F, 0x40000003, 0x40000000, RG_DIFFERENCE_VALUES},
    {RG_RG11B10F, 0x40800000, 0x40000000, RG_DIFFERENCE_LAST_BITS}, // 2 of the third part
    {RG_RG11B10F, 0x40c00000, 0x40000000, RG_DIFFERENCE_VALUES},
    {RG_RG11B10F, 0x003e0000, 0x00000000, RG_DIFFERENCE_NAN},    // the second part: 11 bits
    {RG_RG11B10F, 0xf8000000, 0x00000000, RG_DIFFERENCE_NAN},    // the third: 10
    {RG_RG11B10F, 0xf0000000, 0x00000000, RG_DIFFERENCE_VALUES}, // the largest exponent below
    {RG_RGBA8, 0xff000000, 0xfe000000, RG_DIFFERENCE_LAST_BITS},
    {RG_RGBA8, 0xff000000, 0xfd000000, RG_DIFFERENCE_VALUES},
};

// docs/ci.md: floats by up to 16 units in the last place, halves by 2, codes by 1; small floats are
// like halves. Each part of a word counts by itself, also on both sides of zero.
static void last_bits_have_their_number(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof(steps) / sizeof(steps[0]); i++) {
        setup(NULL);
        make_image(steps[i].format, steps[i].format == RG_RGBA16F ? 2 : 4);
        contents.size = expected.size = steps[i].format == RG_RGBA16F ? 32 : 64;
        memset(now, 0, sizeof(now));
        memset(due, 0, sizeof(due));
        memcpy(&now[5], &steps[i].now, 4);
        memcpy(&due[5], &steps[i].due, 4);
        if (found() != steps[i].kind)
            fail_msg("%08x, not %08x: %s", steps[i].now, steps[i].due, rg_difference_name(found()));
    }
}

// Of contents of two sizes, words within the shorter are compared.
static void the_shorter_is_compared(void **state)
{
    (void)state;
    now[2] = now[7] = now[9] = 50;
    for (int is_due = 0; is_due < 2; is_due++) {
        contents.size = is_due ? 64 : 32;
        expected.size = is_due ? 32 : 64;
        assert_int_equal(found(), RG_DIFFERENCE_SIZE);
        assert_int_equal(differing.first, 2);
        assert_int_equal(differing.count, 2);
    }
}

// A step one texel to the right is an edge; a step two texels away is not.
static void an_edge_is_told(void **state)
{
    (void)state;
    make_image(RG_R32F, 4);
    for (int i = 0; i < WORDS; i++) {
        due[i] = i % 4 < 2 ? 1.0f : 9.0f;
        now[i] = i % 4 < 3 ? 1.0f : 9.0f;
    }
    assert_int_equal(found(), RG_DIFFERENCE_EDGE);
    for (int i = 0; i < WORDS; i++)
        due[i] = i % 4 < 1 ? 1.0f : 9.0f;
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
    for (int i = 0; i < WORDS; i++)
        due[i] = now[i] = i < 12 ? 1.0f : 9.0f;
    now[0] = 9.0f; // a value that is three rows away
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
    now[0] = 5.0f; // a value that is nowhere
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
}

// A texel has eight neighbours, of either picture; an image of several layers or levels has no
// edges that are looked for.
static void edges_lie_on_every_side(void **state)
{
    (void)state;
    for (int y = 0; y < 4; y++)
        for (int x = 0; x < 4; x++) { // where the bright texel is, instead of at (1, 1)
            const int away = abs(x - 1) > abs(y - 1) ? abs(x - 1) : abs(y - 1);
            setup(NULL);
            make_image(RG_R32F, 4);
            for (int i = 0; i < WORDS; i++)
                now[i] = due[i] = 1;
            due[4 * 1 + 1] = now[4 * y + x] = 9;
            assert_int_equal(found(), away == 0   ? RG_DIFFERENCE_NONE
                                      : away == 1 ? RG_DIFFERENCE_EDGE
                                                  : RG_DIFFERENCE_VALUES);
            contents.desc.layers = contents.desc.levels = away == 1 ? 2 : 1;
            if (away)
                assert_int_equal(found(), RG_DIFFERENCE_VALUES);
        }
    make_image(RG_R32F, 4);
    for (int i = 0; i < WORDS; i++)
        now[i] = due[i] = 1;
    due[5] = 5; // a value that the device has nowhere
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
    due[5] = 1;
    now[0] = due[3] = now[3] = 9; // a value that the truth has in that row, but three columns away
    assert_int_equal(found(), RG_DIFFERENCE_VALUES);
}

// docs/ci.md lists the names.
static void kinds_have_names_and_words(void **state)
{
    (void)state;
    static const char *const told[][2] = {
        {"none", "no difference"},
        {"size", "of size"},
        {"nan", "a NaN or an infinity in one of the two alone"},
        {"missing", "missing: what was there before the stage still is"},
        {"surplus", "surplus: the stage was not to write there"},
        {"order", "the same elements in another order"},
        {"last-bits", "in the last bits"},
        {"edge", "at edges, by a texel"},
        {"values", "other values"}};
    for (int i = 0; i < RG_DIFFERENCE_COUNT; i++) {
        assert_string_equal(rg_difference_name((enum rg_difference)i), told[i][0]);
        assert_string_equal(rg_difference_words((enum rg_difference)i), told[i][1]);
    }
    words.words = "fuf";
    assert_int_equal(rg_difference_element(&words), 12);
    words.words = NULL;
    assert_int_equal(rg_difference_element(&words), 4);
}

static void names_are_read_back(void **state)
{
    (void)state;
    for (int i = 0; i < RG_DIFFERENCE_COUNT; i++)
        assert_int_equal(rg_difference_find(rg_difference_name((enum rg_difference)i)), i);
    assert_int_equal(rg_difference_find("?"), RG_DIFFERENCE_NONE);
}

// --- devices that differ ---

// From the second step on, a word of the state differs on `cpu`.
static bool step_off_on_cpu(struct rg_instance *instance)
{
    struct rg_buf *buf = instance->state[0].asset->buf;
    uint32_t word;
    if (!rg_technique_find("flow")->step(instance))
        return false;
    if (strcmp(instance->device->info.name, "cpu") != 0 || instance->frame < 2)
        return true;
    return rg_buf_read(buf, 40, &word, 4) && (word ^= 1, rg_buf_write(buf, 40, &word, 4));
}

static void find(int frames, struct rg_blame *blame)
{
    struct rg_device *truth = rg_device_open("cpu:reference"), *device = rg_device_open("cpu");
    void *settings = settings_of("flow", RIG_CHEAP, "drops=40");
    const struct rg_digest_run run = {{&rig_flow, settings, 16, 16}, frames};
    assert_true(rg_blame_find(&run, device, truth, blame));
    free(settings);
    assert_true(rg_device_close(device));
    assert_true(rg_device_close(truth));
}

static void where_devices_part_is_found(void **state)
{
    struct rg_blame blame;
    rig_setup(state);
    find(5, &blame);
    assert_false(blame.found);
    rig_flow.step = step_off_on_cpu;
    find(1, &blame);
    assert_false(blame.found);
    find(5, &blame);
    assert_true(blame.found);
    assert_false(blame.is_alone);
    assert_int_equal(blame.first.frame, 2);
    assert_differs(blame.first.hash, blame.expected);
    assert_false(blame.is_image);
    assert_int_equal(blame.differing, 1);
    assert_non_null(strstr(blame.text, "frame 2, stage flow_"));
    assert_non_null(strstr(blame.text, blame.first.asset));
    json_t *json = rg_blame_json(&blame);
    assert_non_null(json);
    assert_int_equal(json_integer_value(json_object_get(json, "item")), blame.item);
    assert_string_equal(json_string_value(json_object_get(json, "class")),
                        rg_difference_name(blame.difference));
    json_decref(json);
}

// After the drawing of frame 2 the host changes a texel of the target on `cpu`, or on both devices,
// to different values.
static bool changes_both;

static bool draw_off(struct rg_instance *instance)
{
    uint16_t *texels = malloc(16 * 16 * 8);
    bool ok = texels && rg_technique_find("flow")->draw(instance);
    const bool on_cpu = !strcmp(instance->device->info.name, "cpu");
    if (ok && instance->frame == 2 && (on_cpu || changes_both)) {
        ok = rg_image_read(instance->target, 0, 0, texels);
        texels[4 * (16 * 9 + 5)] ^= on_cpu ? 0x4000 : 0x2000;
        ok = ok && rg_image_write(instance->target, 0, 0, texels);
    }
    free(texels);
    return ok;
}

static void a_texel_is_named(void **state)
{
    struct rg_blame blame;
    rig_setup(state);
    rig_flow.draw = draw_off;
    changes_both = false;
    find(5, &blame);
    assert_true(blame.found);
    assert_true(blame.is_alone);
    assert_non_null(strstr(blame.text, "target is written by one of the two alone"));
    changes_both = true;
    find(5, &blame);
    assert_false(blame.is_alone);
    assert_true(blame.is_image);
    assert_int_equal(blame.x, 5);
    assert_int_equal(blame.y, 9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(nothing_differs, setup),
        cmocka_unit_test_setup(the_first_word_and_their_number, setup),
        cmocka_unit_test_setup(a_nan_is_told, setup),
        cmocka_unit_test_setup(integers_are_no_floats, setup),
        cmocka_unit_test_setup(words_are_told_as_what_they_are, setup),
        cmocka_unit_test_setup(texels_are_told_as_what_they_hold, setup),
        cmocka_unit_test_setup(small_floats_are_told, setup),
        cmocka_unit_test_setup(what_the_stage_left_out_is_told, setup),
        cmocka_unit_test_setup(another_order_is_told, setup),
        cmocka_unit_test_setup(last_bits_are_told, setup),
        cmocka_unit_test_setup(an_edge_is_told, setup),
        cmocka_unit_test_setup(last_bits_have_their_number, setup),
        cmocka_unit_test_setup(the_shorter_is_compared, setup),
        cmocka_unit_test_setup(edges_lie_on_every_side, setup),
        cmocka_unit_test_setup(kinds_have_names_and_words, setup),
        cmocka_unit_test(names_are_read_back),
        cmocka_unit_test(where_devices_part_is_found),
        cmocka_unit_test(a_texel_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
