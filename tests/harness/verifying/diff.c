// rg_diff_files: exit status, table, JSON, heat maps, and one line for bad input.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <jansson.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/image/compare/heatmap.h"
#include "core/image/files/io.h"
#include "harness/compare/diff/files.h"
#include "tests/core/image/rain_picture.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/printed.h"

static char a[64], b[64], background[64], small[64], three[64], prefix[64];
static const char *text;
static char last_error[1024];
static int error_count;

static void listen(enum rg_log_level level, const char *line, void *user)
{
    (void)user;
    error_count += level == RG_LOG_ERROR;
    snprintf(last_error, sizeof(last_error), "%s", line);
}

static void write_rain(const char *path, int width, int channels, int streaks)
{
    struct rg_picture picture;
    struct rain_look look = honest_rain;
    look.streaks = streaks;
    assert_true(rg_picture_create(&picture, width, 80, channels, "rain"));
    rain_draw(&picture, look);
    const struct rg_write_options options = {.full_float = true};
    assert_true(rg_picture_write(path, &picture, &options));
    rg_picture_destroy(&picture);
}

// Runs, and keeps what is printed in `text`.
static int run(const struct rg_diff_request *request)
{
    printed_begin();
    error_count = 0;
    const int status = rg_diff_files(request);
    text = printed_end();
    return status;
}

static void the_same_files(void **state)
{
    (void)state;
    assert_int_equal(run(&(struct rg_diff_request){.a = a, .b = a, .background = background}), 0);
    assert_non_null(strstr(text, "tier T0"));
    assert_non_null(strstr(text, "PSNR                         inf dB"));
}

// A name may not control the terminal.
static void names_are_plain(void **state)
{
    (void)state;
    char path[128];
    snprintf(path, sizeof(path), "%s/a\x1b[2J.exr", folder);
    assert_int_equal(link(a, path), 0);
    assert_int_equal(run(&(struct rg_diff_request){.a = path, .b = b, .background = background}),
                     1);
    unlink(path);
    assert_non_null(strstr(text, "/a?[2J.exr\n"));
    assert_null(strchr(text, 0x1b));
}

static void differing_files(void **state)
{
    (void)state;
    assert_int_equal(run(&(struct rg_diff_request){.a = a, .b = b, .background = background}), 1);
    assert_non_null(strstr(text, "tier none"));
    assert_non_null(strstr(text, "T1 arithmetic                fails: coverage differs in"));
    assert_int_equal(error_count, 0);
}

static void json_has_the_documented_shape(void **state)
{
    (void)state;
    const struct rg_diff_request request = {.a = a, .b = b, .background = background, .json = true};
    assert_int_equal(run(&request), 1);
    json_t *root = json_loads(text, 0, NULL), *pair;
    assert_non_null(root);
    assert_int_equal(json_integer_value(json_object_get(root, "format")), 1);
    assert_int_equal(json_array_size(json_object_get(root, "pairs")), 1);
    pair = json_array_get(json_object_get(root, "pairs"), 0);
    assert_string_equal(json_string_value(json_object_get(pair, "a")), a);
    assert_string_equal(json_string_value(json_object_get(pair, "tier")), "none");
    static const char *const numbers[] = {"max", "differing", "mask", "flip_mean", "psnr"};
    for (int i = 0; i < 5; i++)
        assert_above(json_number_value(json_object_get(pair, numbers[i])), 0);
    json_decref(root);
    assert_int_equal(run(&(struct rg_diff_request){.a = a, .b = a, .json = true}), 0);
    root = json_loads(text, 0, NULL);
    pair = json_array_get(json_object_get(root, "pairs"), 0);
    assert_true(json_is_null(json_object_get(pair, "psnr"))); // infinite
    json_decref(root);
}

static void bad_input_is_one_line(void **state)
{
    (void)state;
    const struct rg_diff_request requests[] = {
        {.a = a, .b = "/none/b.png"},
        {.a = "/none/a.png", .b = "/none/b.png", .json = true},
        {.a = a, .b = small},
        {.a = a, .b = b, .background = small},
        {.a = a, .b = b, .heatmap_prefix = "/none/heat"},
        {.a = a, .b = b, .options = {.exposure = -1}},
        {.a = a, .b = b, .options = {.pixels_per_degree = 1e6f}},
    };
    for (size_t i = 0; i < sizeof(requests) / sizeof(requests[0]); i++) {
        assert_int_equal(run(&requests[i]), 2);
        assert_int_equal(error_count, 1);
        assert_string_equal(text, "");
    }
    assert_int_equal(run(&requests[2]), 2);
    assert_non_null(strstr(last_error, "120 x 80 pixels but"));
}

// Pictures without rain prove nothing, and neither does a comparison of what is no rain.
static void pictures_without_rain_are_nothing(void **state)
{
    (void)state;
    const struct rg_diff_request dry = {.a = background, .b = background, .background = background};
    assert_int_equal(run(&dry), 4);
    assert_int_equal(error_count, 1);
    assert_non_null(strstr(last_error, "background.exr: has no rain before "));
    assert_int_equal(run(&(struct rg_diff_request){.a = background, .b = background}), 0);
    assert_int_equal(
        run(&(struct rg_diff_request){.a = a, .b = background, .background = background}), 1);
}

// Options reach the comparison, and files beside its prefix are spared.
static void options_are_heeded(void **state)
{
    (void)state;
    char heat[128];
    struct rg_diff_request request = {
        .a = a, .b = b, .json = true, .options = {.exposure = 2, .pixels_per_degree = 40}};
    assert_int_equal(run(&request), 1);
    json_t *root = json_loads(text, 0, NULL);
    json_t *pair = json_array_get(json_object_get(root, "pairs"), 0);
    assert_equals(json_number_value(json_object_get(pair, "exposure")), 2);
    assert_equals(json_number_value(json_object_get(pair, "pixels_per_degree")), 40);
    assert_string_equal(json_string_value(json_object_get(pair, "b")), b);
    assert_int_equal(json_array_size(json_object_get(pair, "beside")), 0);
    json_decref(root);
    for (int i = 0; i < 2; i++) {
        snprintf(heat, sizeof(heat), "%s-%s.png", prefix, i ? "difference" : "flip");
        write_rain(heat, 160, 4, 60);
        const char *const read[] = {a, b, background};
        for (int k = 0; k < 3; k++) {
            request = (struct rg_diff_request){.a = k == 0 ? heat : read[0],
                                               .b = k == 1 ? heat : read[1],
                                               .background = k == 2 ? heat : read[2],
                                               .heatmap_prefix = prefix};
            assert_int_equal(run(&request), 2);
            assert_non_null(strstr(last_error, "would be overwritten"));
        }
        unlink(heat);
    }
}

// An alpha of 1 makes no difference, and grey equals red, green and blue alike.
static void channels_that_show_the_same(void **state)
{
    (void)state;
    struct rg_picture grey, colours;
    char one[80], other[80];
    assert_int_equal(run(&(struct rg_diff_request){.a = a, .b = three}), 0);
    assert_non_null(strstr(text, "160 x 80 pixels, 4 channels; tier T0"));
    snprintf(one, sizeof(one), "%s/grey.exr", folder);
    snprintf(other, sizeof(other), "%s/colours.exr", folder);
    for (int differs = 0; differs < 2; differs++) {
        assert_true(rg_picture_create(&grey, 9, 7, 2, "grey"));
        assert_true(rg_picture_create(&colours, 9, 7, 3, "colours"));
        for (int i = 0; i < 63; i++) {
            grey.texels[2 * i] = (float)i / 64;
            grey.texels[2 * i + 1] = differs && i == 30 ? 0.5f : 1;
            for (int c = 0; c < 3; c++)
                colours.texels[3 * i + c] = (float)i / 64;
        }
        assert_true(rg_picture_write(one, &grey, &(struct rg_write_options){0}));
        assert_true(rg_picture_write(other, &colours, &(struct rg_write_options){0}));
        assert_int_equal(run(&(struct rg_diff_request){.a = one, .b = other}), differs);
        assert_int_equal(run(&(struct rg_diff_request){.a = other, .b = one}), differs);
        rg_picture_destroy(&grey);
        rg_picture_destroy(&colours);
    }
    unlink(one);
    unlink(other);
}

// EXR files are compared by light, and with HDR-FLIP; PNG files by light and by codes.
static void what_figures_are_of(void **state)
{
    (void)state;
    char png[2][80];
    for (int i = 0; i < 2; i++) {
        snprintf(png[i], sizeof(png[i]), "%s/%d.png", folder, i);
        write_rain(png[i], 160, 3, 60 - 5 * i);
    }
    assert_int_equal(run(&(struct rg_diff_request){.a = a, .b = b}), 1);
    assert_non_null(strstr(text, "\nlinear light\n"));
    assert_null(strstr(text, "\ncodes"));
    assert_non_null(strstr(text, "\nHDR-FLIP (ACES, "));
    assert_int_equal(run(&(struct rg_diff_request){.a = png[0], .b = png[1]}), 1);
    assert_non_null(strstr(text, "\nlinear light, decoded from sRGB codes\n"));
    assert_non_null(strstr(text, "\ncodes, over the largest code\n"));
    assert_null(strstr(text, "HDR-FLIP"));
    assert_int_equal(run(&(struct rg_diff_request){.a = png[0], .b = png[1], .json = true}), 1);
    json_t *root = json_loads(text, 0, NULL);
    json_t *pair = json_array_get(json_object_get(root, "pairs"), 0);
    const double light = json_number_value(json_object_get(pair, "psnr"));
    const double codes = json_number_value(json_object_get(json_object_get(pair, "codes"), "psnr"));
    assert_above(light, 0);
    assert_above(codes, 0);
    assert_differs(light, codes);
    assert_true(json_is_null(json_object_get(pair, "hdr_flip")));
    assert_above(json_number_value(json_object_get(pair, "flip_weighted_quartile_1")), 0);
    json_decref(root);
    assert_int_equal(run(&(struct rg_diff_request){.a = a, .b = b, .json = true}), 1);
    root = json_loads(text, 0, NULL);
    pair = json_array_get(json_object_get(root, "pairs"), 0);
    assert_true(json_is_null(json_object_get(pair, "codes")));
    assert_above(json_number_value(json_object_get(json_object_get(pair, "hdr_flip"), "mean")), 0);
    json_decref(root);
    unlink(png[0]);
    unlink(png[1]);
}

// A map is the picture's height and is wider by a scale. It is dark if nothing differs.
static void heat_maps_are_written(void **state)
{
    (void)state;
    const struct rg_diff_request request = {.a = a, .b = b, .heatmap_prefix = prefix};
    assert_int_equal(run(&request), 1);
    static const char *const names[] = {"flip", "difference"};
    for (int i = 0; i < 2; i++) {
        char path[128];
        snprintf(path, sizeof(path), "%s-%s.png", prefix, names[i]);
        struct rg_picture heat;
        assert_true(rg_picture_read(path, &heat));
        assert_above(heat.width, 160 + 50);
        assert_equals(heat.height, 80);
        float brightest = 0;
        for (int y = 0; y < 80; y++)
            for (int x = 0; x < 160; x++)
                brightest = fmaxf(brightest, heat.texels[(y * heat.width + x) * 3]);
        assert_above(brightest, 0.2f);
        // The scale runs from light yellow at the top to black.
        const float *top = heat.texels + (160 + 10) * 3;
        const float *bottom = heat.texels + (79 * heat.width + 160 + 10) * 3;
        assert_above(top[0], 0.9f);
        assert_below(bottom[0], 0.01f);
        rg_picture_destroy(&heat);
        unlink(path);
    }
}

static void heat_colours_are_magma(void **state)
{
    (void)state;
    static const float values[3] = {0.0f, 0.5f, NAN};
    struct rg_picture heat;
    assert_true(rg_heatmap_draw(values, 3, 1, 1.0f, &heat));
    // sRGB (183, 55, 121) in the middle; NaN has the top colour, (252, 253, 191).
    const float *middle = heat.texels + 3 * 85, *last = heat.texels + 3 * 255; // of 3 x 85 pixels
    assert_true(fabsf(middle[0] - 0.4735f) < 1e-3f && fabsf(middle[1] - 0.0382f) < 1e-3f);
    assert_memory_equal(middle + 3 * 84, middle, 3 * sizeof(float));
    assert_memory_equal(middle + 3 * heat.width * 84, middle, 3 * sizeof(float));
    assert_below(fabsf(heat.texels[3 * 254] - 0.9734f), 1e-3f);
    assert_below(fabsf(last[0]), 1e-3f);
    rg_picture_destroy(&heat);
}

static int make_files(void **state)
{
    rg_log_listen(listen, NULL);
    if (make_folder(state))
        return -1;
    snprintf(a, sizeof(a), "%s/a.exr", folder);
    snprintf(b, sizeof(b), "%s/b.exr", folder);
    snprintf(background, sizeof(background), "%s/background.exr", folder);
    snprintf(small, sizeof(small), "%s/small.exr", folder);
    snprintf(three, sizeof(three), "%s/three.exr", folder);
    snprintf(prefix, sizeof(prefix), "%s/heat", folder);
    write_rain(a, 160, 4, 60);
    write_rain(b, 160, 4, 55);
    write_rain(background, 160, 4, 0);
    write_rain(small, 120, 4, 60);
    write_rain(three, 160, 3, 60);
    return 0;
}

static int remove_files(void **state)
{
    rg_log_listen(NULL, NULL);
    const char *const files[] = {a, b, background, small, three};
    for (int i = 0; i < 5; i++)
        unlink(files[i]);
    return remove_folder(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_files),
        cmocka_unit_test(differing_files),
        cmocka_unit_test(names_are_plain),
        cmocka_unit_test(json_has_the_documented_shape),
        cmocka_unit_test(what_figures_are_of),
        cmocka_unit_test(bad_input_is_one_line),
        cmocka_unit_test(pictures_without_rain_are_nothing),
        cmocka_unit_test(options_are_heeded),
        cmocka_unit_test(channels_that_show_the_same),
        cmocka_unit_test(heat_maps_are_written),
        cmocka_unit_test(heat_colours_are_magma),
    };
    return cmocka_run_group_tests_name("diff of files", tests, make_files, remove_files);
}
