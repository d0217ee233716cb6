// The texels that differ most are found, worst first, with all values around them.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/report/pictures/linear.h"
#include "tests/tools/expect.h"

enum { WIDTH = 100, HEIGHT = 40, CHANNELS = 3 };

static struct rg_picture make(void)
{
    struct rg_picture picture;
    assert_true(rg_picture_create(&picture, WIDTH, HEIGHT, CHANNELS, "picture"));
    for (int i = 0; i < WIDTH * HEIGHT * CHANNELS; i++)
        picture.texels[i] = 0.1f * (float)(i % 7);
    return picture;
}

static float *texel(struct rg_picture *picture, int x, int y, int channel)
{
    return &picture->texels[(y * WIDTH + x) * CHANNELS + channel];
}

static int at(const json_t *json, int worst, const char *field)
{
    const json_t *place = json_array_get(json_object_get(json, "worst"), (size_t)worst);
    return (int)json_integer_value(json_object_get(place, field));
}

// A value in the text of a picture's values around one of the worst.
static void assert_value(const json_t *json, int picture, int worst, int number, const char *wanted)
{
    const json_t *one = json_array_get(json_object_get(json, "pictures"), (size_t)picture);
    const json_t *texts = json_object_get(one, "values");
    const char *text = json_string_value(json_array_get(texts, (size_t)worst));
    for (; number; number--)
        text = strchr(text, ' ') + 1;
    assert_int_equal(strcspn(text, " "), strlen(wanted));
    assert_memory_equal(text, wanted, strlen(wanted));
}

static void test_worst(void **state)
{
    (void)state;
    struct rg_linear linear = {.names = {"a", "b"}, .pictures = {make(), make()}, .count = 2};
    assert_null(rg_linear_json(&linear)); // nothing differs
    *texel(&linear.pictures[1], 50, 20, 1) += 0.5f;
    *texel(&linear.pictures[1], 51, 20, 1) += 0.4f; // beside a worse one
    *texel(&linear.pictures[1], 99, 39, 2) -= 0.25f;
    *texel(&linear.pictures[1], 2, 1, 0) = NAN;
    *texel(&linear.pictures[1], 5, 39, 0) += 0.125f;
    json_t *json = rg_linear_json(&linear);
    assert_int_equal(json_array_size(json_object_get(json, "worst")), RG_LINEAR_WORST);
    assert_int_equal(json_integer_value(json_object_get(json, "differing")), 5);
    const int wanted[RG_LINEAR_WORST][4] = {{2, 1, 0, 0}, {50, 20, 34, 4}, {99, 39, 67, 7}};
    for (int i = 0; i < RG_LINEAR_WORST; i++) {
        assert_int_equal(at(json, i, "x"), wanted[i][0]);
        assert_int_equal(at(json, i, "y"), wanted[i][1]);
        assert_int_equal(at(json, i, "left"), wanted[i][2]);
        assert_int_equal(at(json, i, "top"), wanted[i][3]);
        assert_int_equal(at(json, i, "width"), RG_LINEAR_SIDE);
    }
    assert_value(json, 1, 0, (1 * RG_LINEAR_SIDE + 2) * CHANNELS, "nan");
    assert_value(json, 1, 0, 0, "=");
    assert_value(json, 0, 0, 1, "0.100000001");
    assert_value(json, 1, 1, (16 * RG_LINEAR_SIDE + 16) * CHANNELS, "=");
    json_decref(json);
    rg_linear_free(&linear);
}

// Of several pictures any two may differ; pictures of other sizes have no texels in common.
static void test_several(void **state)
{
    (void)state;
    struct rg_linear linear = {
        .names = {"a", "b", "c"}, .pictures = {make(), make(), make()}, .count = 3};
    *texel(&linear.pictures[2], 9, 9, 0) = INFINITY;
    json_t *json = rg_linear_json(&linear);
    assert_int_equal(at(json, 0, "x"), 9);
    assert_value(json, 1, 0, (9 * RG_LINEAR_SIDE + 9) * CHANNELS, "=");
    assert_value(json, 2, 0, (9 * RG_LINEAR_SIDE + 9) * CHANNELS, "inf");
    json_decref(json);
    linear.pictures[2].height--;
    assert_null(rg_linear_json(&linear));
    rg_linear_free(&linear);
}

// A picture that is smaller than the surroundings is shown whole, and each text ends with its last
// value.
static void test_small(void **state)
{
    (void)state;
    struct rg_linear linear = {.names = {"left", "right"}, .count = 2};
    const char *texts[2];
    for (int i = 0; i < 2; i++) {
        assert_true(rg_picture_create(&linear.pictures[i], 3, 2, 1, "picture"));
        for (int k = 0; k < 6; k++)
            linear.pictures[i].texels[k] = (float)k;
    }
    linear.pictures[1].texels[4] = 4.5f;
    linear.pictures[1].texels[5] = -5;
    json_t *json = rg_linear_json(&linear);
    assert_int_equal(json_array_size(json_object_get(json, "worst")), 1);
    static const char *const fields[] = {"x", "y", "left", "top", "width", "height"};
    static const int due[] = {2, 1, 0, 0, 3, 2};
    for (int i = 0; i < 6; i++)
        assert_int_equal(at(json, 0, fields[i]), due[i]);
    const json_t *pictures = json_object_get(json, "pictures");
    for (int i = 0; i < 2; i++) {
        const json_t *picture = json_array_get(pictures, (size_t)i);
        assert_string_equal(json_string_value(json_object_get(picture, "name")), linear.names[i]);
        texts[i] = json_string_value(json_array_get(json_object_get(picture, "values"), 0));
    }
    assert_string_equal(texts[0], "0 1 2 3 4 5");
    assert_string_equal(texts[1], "= = = = 4.5 -5");
    assert_int_equal(json_integer_value(json_object_get(json, "channels")), 1);
    assert_int_equal(json_integer_value(json_object_get(json, "differing")), 2);
    json_decref(json);
    rg_linear_free(&linear);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_worst),
        cmocka_unit_test(test_several),
        cmocka_unit_test(test_small),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
