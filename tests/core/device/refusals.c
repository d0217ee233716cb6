// Every wrong argument is refused with one line that names the object.
#include "core/base/log.h"
#include "kernels/probe/copy_params.h"
#include "tests/core/device/suite.h"
#include "tests/kernels/image_copy_params.h"

static void buffers_refuse_bad_sizes(void **state)
{
    struct rg_device *device = *state;
    const struct rg_work before = *rg_device_work(device);
    assert_refused(rg_buf_create(device, 0, "empty"), "'empty'");
    assert_refused(rg_buf_create(device, -4, "negative"), "'negative'");
    assert_refused(rg_buf_create(device, 6, "uneven"), "'uneven'");
    const int64_t too_large = (device->info.limits.max_buffer_bytes / 4 + 1) * 4;
    assert_refused(rg_buf_create(device, too_large, "huge"), "'huge'");
    assert_refused(rg_buf_create(device, too_large, "huge"), device->info.name);
    assert_int_equal(rg_device_work(device)->live_buffers, before.live_buffers);
}

static void buffers_refuse_bad_ranges(void **state)
{
    uint32_t words[16] = {0};
    struct rg_buf *buf = make_buf(*state, words, 8, "eight");
    static const struct {
        int64_t offset, size;
    } ranges[] = {{-4, 4}, {0, 36}, {28, 8}, {32, 4},        {36, 4},       {0, 0},
                  {0, -4}, {2, 4},  {0, 6},  {INT64_MAX, 4}, {4, INT64_MAX}};
    for (int i = 0; i < COUNT_OF(ranges); i++) {
        assert_refused(rg_buf_write(buf, ranges[i].offset, words, ranges[i].size), "'eight'");
        assert_refused(rg_buf_read(buf, ranges[i].offset, words, ranges[i].size), "'eight'");
    }
    rg_buf_destroy(buf);
}

static void images_refuse_bad_shapes(void **state)
{
    struct rg_device *device = *state;
    const struct rg_limits *limits = &device->info.limits;
    const struct rg_work before = *rg_device_work(device);
    const struct rg_image_desc bad[] = {
        {RG_FORMAT_NONE, 4, 4, 1, 1},
        {RG_FORMAT_COUNT, 4, 4, 1, 1},
        {RG_RGBA8, 0, 4, 1, 1},
        {RG_RGBA8, 4, -1, 1, 1},
        {RG_RGBA8, 4, 4, 0, 1},
        {RG_RGBA8, 4, 4, 1, 0},
        {RG_RGBA8, 4, 4, 1, 4},
        {RG_RGBA8, 4, 4, 1, 17},
        {RG_RGBA8, limits->max_image_px + 1, 1, 1, 1},
        {RG_RGBA8, 1, limits->max_image_px + 1, 1, 1},
        {RG_RGBA8, 1, 1, limits->max_image_layers + 1, 1},
    };
    for (int i = 0; i < COUNT_OF(bad); i++)
        assert_refused(rg_image_create(device, &bad[i], "bad"), "'bad'");
    assert_int_equal(rg_device_work(device)->live_images, before.live_images);
}

// Larger than any memory; the line names the size.
static void images_refuse_to_be_vast(void **state)
{
    static const enum rg_format formats[] = {RG_R16F, RG_RGBA32F};
    for (int i = 0; i < COUNT_OF(formats); i++) {
        const struct rg_image_desc desc = {formats[i], 16384, 16384, 1024, 1};
        listen();
        struct rg_image *image = rg_image_create(*state, &desc, "vast");
        const char *line = heard();
        assert_null(image);
        if (!strstr(line, "'vast'") ||
            !(strstr(line, "16384x16384") || strstr(line, " bytes") || strstr(line, " GiB, ")))
            fail_msg("'%s' names no size", line);
    }
}

static void images_refuse_bad_layers_and_levels(void **state)
{
    const struct rg_image_desc desc = {RG_RGBA8, 8, 8, 2, 3};
    struct rg_image *image = rg_image_create(*state, &desc, "layered");
    assert_non_null(image);
    static const struct {
        int layer, level;
    } bad[] = {{-1, 0}, {2, 0}, {0, -1}, {0, 3}, {1, 100}};
    uint32_t texels[64] = {0};
    for (int i = 0; i < COUNT_OF(bad); i++) {
        assert_refused(rg_image_write(image, bad[i].layer, bad[i].level, texels), "'layered'");
        assert_refused(rg_image_read(image, bad[i].layer, bad[i].level, texels), "'layered'");
    }
    rg_image_destroy(image);
}

static void unknown_kernels_are_refused(void **state)
{
    assert_refused(rg_pass_create(*state, "no_such_kernel"), "'no_such_kernel'");
    assert_refused(rg_pass_create(*state, ""), "''");
}

// A correct run; each refusal below spoils one part of it.
struct rig {
    struct rg_buf *source, *target;
    struct rg_pass *copy;
    struct probe_copy_params params;
    struct rg_run run;
};

static struct rig make_rig(struct rg_device *device)
{
    struct rig rig = {.params = {4, 1, 0}};
    rig.source = filled_buf(device, 1, 4, "source");
    rig.target = filled_buf(device, 2, 4, "target");
    rig.copy = rg_pass_create(device, "probe_copy");
    assert_non_null(rig.copy);
    rig.run =
        (struct rg_run){.slots = {[1].buf = rig.source, [2].buf = rig.target}, .extent = {4, 1, 1}};
    return rig;
}

static void destroy_rig(struct rig *rig)
{
    rig->run.params = &rig->params;
    assert_true(rg_pass_run(rig->copy, &rig->run));
    rg_pass_destroy(rig->copy);
    rg_buf_destroy(rig->source);
    rg_buf_destroy(rig->target);
}

static void runs_refuse_bad_grids(void **state)
{
    struct rig rig = make_rig(*state);
    static const struct {
        struct rg_extent origin, extent;
    } bad[] = {
        {{0, 0, 0}, {0, 1, 1}},         {{0, 0, 0}, {1, 0, 1}},         {{0, 0, 0}, {1, 1, 0}},
        {{0, 0, 0}, {-1, 1, 1}},        {{0, 0, 0}, {1, -5, 1}},        {{0, 0, 0}, {1, 1, -7}},
        {{-1, 0, 0}, {1, 1, 1}},        {{0, -1, 0}, {1, 1, 1}},        {{0, 0, -1}, {1, 1, 1}},
        {{2, 0, 0}, {INT32_MAX, 1, 1}}, {{0, INT32_MAX, 0}, {1, 1, 1}},
    };
    for (int i = 0; i < COUNT_OF(bad); i++) {
        struct rg_run run = rig.run;
        run.params = &rig.params;
        run.origin = bad[i].origin;
        run.extent = bad[i].extent;
        assert_refused(rg_pass_run(rig.copy, &run), "'probe_copy'");
    }
    destroy_rig(&rig);
}

static void runs_refuse_bad_slots(void **state)
{
    struct rig rig = make_rig(*state);
    const struct rg_image_desc desc = {RG_RGBA8, 4, 4, 1, 1};
    struct rg_image *image = rg_image_create(*state, &desc, "picture");
    assert_non_null(image);
    struct rg_run run = rig.run;
    assert_refused(rg_pass_run(rig.copy, &run), "'probe_copy': no parameters");
    run.params = &rig.params;
    run.slots[1].buf = NULL;
    assert_refused(rg_pass_run(rig.copy, &run), "'source'");
    run.slots[1].image = image;
    assert_refused(rg_pass_run(rig.copy, &run), "slot 1");
    run.slots[1].buf = rig.source;
    assert_refused(rg_pass_run(rig.copy, &run), "wants a buffer");
    run.slots[1].image = NULL;
    run.slots[2].buf = rig.source;
    assert_refused(rg_pass_run(rig.copy, &run), "are one object");
    run.slots[2].buf = NULL;
    assert_refused(rg_pass_run(rig.copy, &run), "'target'");
    rg_image_destroy(image);
    destroy_rig(&rig);
}

static void runs_refuse_objects_of_other_devices(void **state)
{
    struct rig rig = make_rig(*state);
    struct rg_device *other = rg_device_open(suite_device);
    assert_non_null(other);
    struct rg_buf *foreign = filled_buf(other, 0, 4, "foreign");
    struct rg_run run = rig.run;
    run.params = &rig.params;
    run.slots[2].buf = foreign;
    assert_refused(rg_pass_run(rig.copy, &run), "'foreign'");
    rg_buf_destroy(foreign);
    assert_true(rg_device_close(other));
    destroy_rig(&rig);
}

static void runs_refuse_bad_images(void **state)
{
    const struct rg_image_desc floats = {RG_RGBA32F, 4, 4, 1, 1}, bytes = {RG_RGBA8, 4, 4, 1, 1};
    struct rg_image *first = rg_image_create(*state, &floats, "first");
    struct rg_image *second = rg_image_create(*state, &floats, "second");
    struct rg_image *narrow = rg_image_create(*state, &bytes, "narrow");
    struct rg_buf *buf = filled_buf(*state, 0, 4, "words");
    struct rg_pass *copy = rg_pass_create(*state, "test_image_copy");
    assert_true(first && second && narrow && copy);
    const struct test_image_copy_params params = {0, 0};
    struct rg_run run = {
        .params = &params, .slots = {[1].image = first, [2].image = narrow}, .extent = {4, 4, 1}};
    assert_refused(rg_pass_run(copy, &run), "'narrow' is RGBA8");
    run.slots[2].image = NULL;
    assert_refused(rg_pass_run(copy, &run), "'target'");
    run.slots[2].buf = buf;
    assert_refused(rg_pass_run(copy, &run), "wants an image");
    run.slots[2] = (struct rg_binding){.image = first};
    assert_refused(rg_pass_run(copy, &run), "are one object");
    run.slots[2].image = second;
    assert_true(rg_image_clear(first, "0123456789abcdef"));
    assert_true(rg_pass_run(copy, &run));
    rg_pass_destroy(copy);
    rg_buf_destroy(buf);
    rg_image_destroy(first);
    rg_image_destroy(second);
    rg_image_destroy(narrow);
}

static void elements_must_be_whole(void **state)
{
    struct rg_buf *colours = filled_buf(*state, 0, 6, "colours");
    const struct rg_image_desc desc = {RG_R32F, 1, 1, 1, 1};
    struct rg_image *image = rg_image_create(*state, &desc, "target");
    struct rg_pass *store = rg_pass_create(*state, "test_store_r32f");
    assert_true(image && store);
    const int params[3] = {1, 1, 0};
    const struct rg_run run = {
        .params = params, .slots = {[1].buf = colours, [2].image = image}, .extent = {1, 1, 1}};
    assert_refused(rg_pass_run(store, &run), "'colours'");
    rg_pass_destroy(store);
    rg_image_destroy(image);
    rg_buf_destroy(colours);
}

// A name that does not fit is not cut to one that is there.
static void long_names_of_devices_are_refused(void **state)
{
    (void)state;
    char name[2 * RG_DEVICE_NAME_SIZE];
    memset(name, '0', sizeof(name));
    memcpy(name, "cpu:", 4);
    name[RG_DEVICE_NAME_SIZE] = 0;
    assert_refused(rg_device_open(name), "has at most 511 characters");
    strcpy(name + RG_DEVICE_NAME_SIZE, ":native");
    assert_refused(rg_device_open(name), "has at most 511 characters");
}

static void unknown_devices_are_refused(void **state)
{
    (void)state;
    assert_refused(rg_device_open("abacus"), "'abacus'");
    assert_int_equal(rg_failure_take().fault, RG_FAULT_INPUT);
    char name[64] = "";
    strncat(name, suite_device, strcspn(suite_device, ":"));
    strcat(name, ":no such thing");
    assert_refused(rg_device_open(name), name);
    assert_int_equal(rg_failure_take().fault, RG_FAULT_INPUT);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(buffers_refuse_bad_sizes),
    cmocka_unit_test(buffers_refuse_bad_ranges),
    cmocka_unit_test(images_refuse_bad_shapes),
    cmocka_unit_test(images_refuse_to_be_vast),
    cmocka_unit_test(images_refuse_bad_layers_and_levels),
    cmocka_unit_test(unknown_kernels_are_refused),
    cmocka_unit_test(runs_refuse_bad_grids),
    cmocka_unit_test(runs_refuse_bad_slots),
    cmocka_unit_test(runs_refuse_objects_of_other_devices),
    cmocka_unit_test(runs_refuse_bad_images),
    cmocka_unit_test(elements_must_be_whole),
    cmocka_unit_test(long_names_of_devices_are_refused),
    cmocka_unit_test(unknown_devices_are_refused),
};
const struct suite_tests refusal_tests = {tests, COUNT_OF(tests)};
