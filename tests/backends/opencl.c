// For the opencl backend alone. `opencl` runs on its first device. `opencl absent CODE` expects no
// device, and a reason that names the code.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/device/device.h"
#include "kernels/probe/copy_params.h"
#include "tests/core/device/draws/quads.h"
#include "tests/kernels/image_copy_params.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

static int open_device(void **state)
{
    *state = rg_device_open("opencl");
    return *state ? 0 : -1;
}

static int close_device(void **state)
{
    return rg_device_close(*state) ? 0 : -1;
}

// A device with two buffers and a pass that copies one into the other.
struct copier {
    struct rg_device *device;
    struct rg_buf *source, *target;
    struct rg_pass *pass;
    int words;
};

static struct copier make_copier(struct rg_device *device, int words)
{
    struct copier c = {device, rg_buf_create(device, (int64_t)words * 4, "source"),
                       rg_buf_create(device, (int64_t)words * 4, "target"),
                       rg_pass_create(device, "probe_copy"), words};
    assert_true(c.source && c.target && c.pass);
    return c;
}

static void destroy_copier(const struct copier *c)
{
    rg_pass_destroy(c->pass);
    rg_buf_destroy(c->source);
    rg_buf_destroy(c->target);
}

static void copy(const struct copier *c, uint32_t salt)
{
    const struct probe_copy_params params = {c->words, 1, salt};
    assert_true(
        rg_pass_run(c->pass, &(struct rg_run){.params = &params,
                                              .slots = {[1].buf = c->source, [2].buf = c->target},
                                              .extent = {c->words, 1, 1}}));
}

static uint32_t word_of_target(const struct copier *c, int index)
{
    uint32_t word;
    assert_true(rg_buf_read(c->target, (int64_t)index * 4, &word, 4));
    return word;
}

static void data_is_the_callers_again_after_a_write(void **state)
{
    // Together the writes exceed the copies that the backend keeps, so that one of them waits.
    enum { WORDS = 1 << 20, WRITES = 20, BUSY = 8 };
    struct copier c = make_copier(*state, WORDS);
    uint32_t *data = malloc((size_t)WORDS * 4);
    for (uint32_t write = 1; write <= WRITES; write++) {
        for (int i = 0; i < WORDS; i++)
            data[i] = write + (uint32_t)i;
        for (uint32_t salt = 0; salt < BUSY; salt++)
            copy(&c, salt);
        assert_true(rg_buf_write(c.source, 0, data, (int64_t)WORDS * 4));
        memset(data, 0x99, (size_t)WORDS * 4);
        copy(&c, 0);
    }
    for (int i = 0; i < WORDS; i += WORDS / 7)
        assert_int_equal(word_of_target(&c, i), WRITES + i);
    free(data);
    destroy_copier(&c);
}

static void two_devices_live_side_by_side(void **state)
{
    struct rg_device *other_device = rg_device_open("opencl");
    assert_non_null(other_device);
    struct copier one = make_copier(*state, 1000), other = make_copier(other_device, 1000);
    uint32_t data[1000] = {0};
    assert_true(rg_buf_write(one.source, 0, data, sizeof(data)));
    memset(data, 1, sizeof(data));
    assert_true(rg_buf_write(other.source, 0, data, sizeof(data)));
    for (uint32_t salt = 0; salt < 40; salt++) {
        copy(&one, salt);
        copy(&other, salt);
    }
    assert_int_equal(word_of_target(&one, 999), 39);
    assert_int_equal(word_of_target(&other, 999), 0x01010101 ^ 39);
    destroy_copier(&other);
    assert_true(rg_device_close(other_device));
    copy(&one, 7);
    assert_int_equal(word_of_target(&one, 0), 7);
    destroy_copier(&one);
}

static void runs_above_two_billion_items_are_split(void **state)
{
    struct rg_image_desc desc = {RG_RGBA32F, 1, 1, 1, 1};
    struct rg_image *source = rg_image_create(*state, &desc, "source");
    desc.layers = 3;
    struct rg_image *target = rg_image_create(*state, &desc, "target");
    struct rg_pass *pass = rg_pass_create(*state, "test_image_copy");
    const float texel[4] = {1, 2, 3, 4}, nothing[4] = {0};
    assert_true(source && target && pass && rg_image_write(source, 0, 0, texel) &&
                rg_image_clear(target, nothing));
    // All items except one a layer are outside the image and end at once.
    const struct test_image_copy_params params = {0, 0};
    assert_true(
        rg_pass_run(pass, &(struct rg_run){.params = &params,
                                           .slots = {[1].image = source, [2].image = target},
                                           .extent = {65536, 16384, 3}}));
    for (int layer = 0; layer < 3; layer++) {
        float got[4];
        assert_true(rg_image_read(target, layer, 0, got));
        assert_memory_equal(got, texel, sizeof(got));
    }
    rg_pass_destroy(pass);
    rg_image_destroy(source);
    rg_image_destroy(target);
}

static void the_clock_runs_on(void **state)
{
    struct copier c = make_copier(*state, 1 << 20);
    int64_t before_ns = 0, between_ns = 0, after_ns = 0;
    assert_true(rg_device_time(*state, &before_ns));
    copy(&c, 1);
    assert_true(rg_device_time(*state, &between_ns));
    assert_true(rg_device_time(*state, &after_ns));
    assert_above(before_ns, 0);
    assert_below(before_ns, between_ns);
    assert_at_most(between_ns, after_ns);
    destroy_copier(&c);
}

// --- drawing ---

enum { TARGET_PX = 1000, LAYERS = 3, LEVEL = 1, LEVEL_PX = TARGET_PX / 2, QUADS = 3000 };
enum { ENOUGH_BYTES = 64 << 20 };

// The results of a draw of quads: colour and depth of one layer of one level, and visible samples.
struct drawn {
    uint32_t *colour, *depth, *samples;
};

static uint32_t *read_texels(struct rg_image *image)
{
    uint32_t *texels = malloc(LEVEL_PX * LEVEL_PX * 4);
    assert_true(rg_image_read(image, LAYERS - 1, LEVEL, texels));
    return texels;
}

// Quads of all kinds, and a few in a row that fill the target.
static float *make_quads(void)
{
    static const float corners[8] = {-1, -1, 1, -1, 1, 1, -1, 1};
    float *quads = malloc(QUADS * TEST_QUAD_WORDS * sizeof(float));
    quads_fill(quads, QUADS, LEVEL_PX, LEVEL_PX, QUAD_KINDS, 11);
    for (int i = 1000; i < 1004; i++) {
        float *quad = quads + (ptrdiff_t)i * TEST_QUAD_WORDS;
        for (int k = 0; k < 4; k++)
            memcpy(quad + 4 * k, (float[]){corners[2 * k], corners[2 * k + 1], 0.1f, 1},
                   4 * sizeof(float));
    }
    return quads;
}

// Counts samples against depth; without colour it writes depth instead. Scratch memory grows in
// buffers of at most `max_buffer_bytes`.
static struct drawn draw(struct rg_device *device, bool with_colour, int64_t max_buffer_bytes)
{
    const test_quads_params p = {.gradient = 1.0f / 64, .slope_x = 0.0005f, .slope_y = -0.0004f};
    const uint32_t black = 0;
    const float far_half = 0.5f;
    float *quads = make_quads();
    uint32_t *zeros = calloc(QUADS, 4);
    struct rg_image_desc desc = {RG_RGBA8, TARGET_PX, TARGET_PX, LAYERS, LEVEL + 1};
    struct rg_image *colour = rg_image_create_with(device, &desc, &black, "colour");
    desc.format = RG_D32F;
    struct rg_image *depth = rg_image_create_with(device, &desc, &far_half, "depth");
    struct rg_buf *input = rg_buf_create_with(device, quads, QUADS * TEST_QUAD_WORDS * 4, "quads");
    struct rg_buf *samples = rg_buf_create_with(device, zeros, QUADS * 4, "samples");
    struct rg_pass *pass = rg_pass_create(device, "test_quads");
    assert_true(colour && depth && input && samples && pass);
    const struct rg_draw to = {
        .colour = with_colour ? colour : NULL,
        .depth = depth,
        .layer = LAYERS - 1,
        .level = LEVEL,
        .blend = RG_BLEND_OVER,
        .depth_mode = with_colour ? RG_DEPTH_TEST : RG_DEPTH_WRITE,
        .samples = with_colour ? samples : NULL,
    };
    const int64_t allowed = device->info.limits.max_buffer_bytes;
    device->info.limits.max_buffer_bytes = max_buffer_bytes;
    assert_true(rg_pass_run(
        pass, &(struct rg_run){
                  .params = &p, .slots = {[1].buf = input}, .extent = {QUADS, 1, 1}, .draw = &to}));
    device->info.limits.max_buffer_bytes = allowed;
    struct drawn drawn = {read_texels(colour), read_texels(depth), zeros};
    assert_true(rg_buf_read(samples, 0, drawn.samples, QUADS * 4));
    rg_pass_destroy(pass);
    rg_buf_destroy(input);
    rg_buf_destroy(samples);
    rg_image_destroy(colour);
    rg_image_destroy(depth);
    free(quads);
    return drawn;
}

static void release(struct drawn *drawn)
{
    free(drawn->colour);
    free(drawn->depth);
    free(drawn->samples);
}

static void draws_as_the_reference(struct rg_device *device)
{
    struct rg_device *reference = rg_device_open("cpu:reference");
    for (int with_colour = 0; with_colour <= 1; with_colour++) {
        struct drawn due = draw(reference, with_colour, ENOUGH_BYTES),
                     got = draw(device, with_colour, ENOUGH_BYTES);
        assert_memory_equal(got.colour, due.colour, LEVEL_PX * LEVEL_PX * 4);
        assert_memory_equal(got.depth, due.depth, LEVEL_PX * LEVEL_PX * 4);
        assert_memory_equal(got.samples, due.samples, QUADS * 4);
        release(&due);
        release(&got);
    }
    assert_true(rg_device_close(reference));
}

static void a_layer_of_a_level_is_drawn_to(void **state)
{
    draws_as_the_reference(*state);
}

// A work group shades a tile on a GPU, and a work item on a processor. A processor that takes
// itself for a GPU draws the same.
static void tiles_are_shared_as_on_a_gpu(void **state)
{
    (void)state;
    struct rg_device *device = rg_device_open("opencl");
    assert_non_null(device);
    device->info.software = !device->info.software;
    draws_as_the_reference(device);
    assert_true(rg_device_close(device));
}

// A GPU's list has room for no more than 1,024 pairs of a primitive and a tile, so that each tile
// looks for its primitives itself.
static void tiles_without_a_list_find_their_primitives(void **state)
{
    struct drawn whole = draw(*state, true, ENOUGH_BYTES);
    struct rg_device *device = rg_device_open("opencl");
    assert_non_null(device);
    device->info.software = !device->info.software;
    struct drawn listed = draw(device, true, ENOUGH_BYTES), alone = draw(device, true, 4096);
    assert_memory_equal(listed.samples, whole.samples, QUADS * 4);
    assert_memory_equal(alone.colour, whole.colour, LEVEL_PX * LEVEL_PX * 4);
    assert_memory_equal(alone.samples, whole.samples, QUADS * 4);
    release(&whole);
    release(&listed);
    release(&alone);
    assert_true(rg_device_close(device));
}

// A list of 1,024 elements has room for the tiles of one quad that fills the target, not of two.
static void little_memory_takes_rounds(void **state)
{
    struct drawn whole = draw(*state, true, ENOUGH_BYTES), parts = draw(*state, true, 4096);
    assert_memory_equal(parts.colour, whole.colour, LEVEL_PX * LEVEL_PX * 4);
    assert_memory_equal(parts.samples, whole.samples, QUADS * 4);
    release(&whole);
    release(&parts);
}

// listen_to_stderr collects stderr; stop_listening restores it and returns the bytes.
static int own_stderr;
static FILE *heard;

static void listen_to_stderr(void)
{
    fflush(stderr);
    heard = tmpfile();
    assert_non_null(heard);
    own_stderr = dup(STDERR_FILENO);
    dup2(fileno(heard), STDERR_FILENO);
}

static long stop_listening(void)
{
    fflush(stderr);
    dup2(own_stderr, STDERR_FILENO);
    close(own_stderr);
    fseek(heard, 0, SEEK_END);
    long bytes = ftell(heard);
    fclose(heard);
    return bytes;
}

static void a_broken_kernel_is_one_line(void **state)
{
    (void)state;
    struct rg_device *device = rg_device_open("opencl"); // a device that has built nothing yet
    assert_non_null(device);
    char folder[] = "/tmp/raingauge-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof(path), "%s/probe_copy.cl", folder);
    FILE *file = fopen(path, "w");
    fputs("__kernel void rg_grid(void)\n{\n    this_is_missing = 1;\n}\n", file);
    fclose(file);
    setenv("RG_KERNEL_DIR", folder, 1);
    logged_lines = 0;
    rg_log_listen(log_last, NULL);
    listen_to_stderr();
    struct rg_pass *pass = rg_pass_create(device, "probe_copy");
    assert_int_equal(stop_listening(), 0);
    rg_log_listen(NULL, NULL);
    unsetenv("RG_KERNEL_DIR");
    unlink(path);
    rmdir(folder);
    assert_null(pass);
    assert_int_equal(logged_lines, 1);
    assert_non_null(strstr(rg_last_error(), "kernel 'probe_copy'"));
    assert_non_null(strstr(rg_last_error(), "CL_BUILD_PROGRAM_FAILURE"));
    assert_non_null(strstr(rg_last_error(), "this_is_missing"));
    assert_int_equal(rg_failure_take().fault, RG_FAULT_DRIVER);
    assert_true(rg_device_close(device));
}

static const char *expected_code;

static void absence_is_explained(void **state)
{
    (void)state;
    static struct rg_device_list list;
    listen_to_stderr();
    rg_device_list_all(&list);
    assert_int_equal(stop_listening(), 0);
    for (int i = 0; i < list.count; i++)
        assert_string_not_equal(list.infos[i].name, "opencl");
    const char *why = NULL;
    for (int i = 0; i < list.missing_count; i++)
        if (!strncmp(list.missing[i].why, "opencl:", 7))
            why = list.missing[i].why;
    assert_non_null(why);
    assert_non_null(strstr(why, expected_code));
    logged_lines = 0;
    rg_log_listen(log_last, NULL);
    listen_to_stderr();
    assert_null(rg_device_open("opencl"));
    assert_int_equal(stop_listening(), 0);
    rg_log_listen(NULL, NULL);
    assert_int_equal(logged_lines, 1);
    assert_int_equal(rg_failure_take().fault, RG_FAULT_NONE);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest absent[] = {cmocka_unit_test(absence_is_explained)};
    const struct CMUnitTest present[] = {
        cmocka_unit_test(data_is_the_callers_again_after_a_write),
        cmocka_unit_test(two_devices_live_side_by_side),
        cmocka_unit_test(runs_above_two_billion_items_are_split),
        cmocka_unit_test(the_clock_runs_on),
        cmocka_unit_test(a_layer_of_a_level_is_drawn_to),
        cmocka_unit_test(tiles_are_shared_as_on_a_gpu),
        cmocka_unit_test(tiles_without_a_list_find_their_primitives),
        cmocka_unit_test(little_memory_takes_rounds),
        cmocka_unit_test(a_broken_kernel_is_one_line),
    };
    expected_code = argc > 2 ? argv[2] : "";
    return argc > 2 ? cmocka_run_group_tests_name("opencl, absent", absent, NULL, NULL)
                    : cmocka_run_group_tests_name("opencl", present, open_device, close_device);
}
