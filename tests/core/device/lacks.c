// core/device refuses what a device lacks, as unsupported, from the limits and before it asks the
// backend. Here limits say less than the device can do.
#include "core/device/limits.h"
#include "tests/core/device/suite.h"
#include "tests/kernels/drawing/quads_params.h"

// The device's true limits; given_back restores them.
static struct rg_limits kept;

static struct rg_limits *taken(void **state)
{
    struct rg_device *device = *state;
    kept = device->info.limits;
    return &device->info.limits;
}

static void given_back(void **state)
{
    ((struct rg_device *)*state)->info.limits = kept;
}

static void objects_beyond_the_limits_are_unsupported(void **state)
{
    struct rg_device *device = *state;
    const struct rg_image_desc desc = {RG_R32F, 8, 4, 3, 2};
    struct rg_limits *limits = taken(state);
    limits->max_buffer_bytes = 64;
    assert_lacks(rg_buf_create(device, 68, "long"), "'long': 68 bytes exceed the 64");
    const struct rg_format_limits most = limits->formats[RG_R32F];
    struct rg_format_limits *less = &limits->formats[RG_R32F];
    less->max_px = 7;
    assert_lacks(rg_image_create(device, &desc, "wide"), "'wide': 8x4 with 3 layers exceeds the 7");
    *less = most;
    less->max_layers = 2;
    assert_lacks(rg_image_create(device, &desc, "deep"), "and 2 layers that");
    *less = most;
    less->max_levels = 1;
    assert_lacks(rg_image_create(device, &desc, "levels"), "2 levels exceed the 1");
    *less = most;
    less->max_bytes = 64 + 3 * (8 * 4 + 4 * 2) * 4 - 1;
    assert_lacks(rg_image_create(device, &desc, "large"), "'large': 544 bytes exceed the 543");
    less->uses = 0;
    assert_lacks(rg_image_create(device, &desc, "format"), "has no images of R32F");
    given_back(state);
}

static void more_objects_than_the_limit_are_unsupported(void **state)
{
    struct rg_device *device = *state;
    const struct rg_work *work = rg_device_work(device);
    const struct rg_image_desc desc = {RG_R32F, 8, 4, 3, 2};
    struct rg_limits *limits = taken(state);
    limits->max_objects = (int)(work->live_buffers + work->live_images) + 1;
    struct rg_buf *last = rg_buf_create(device, 64, "last");
    assert_non_null(last);
    assert_lacks(rg_buf_create(device, 64, "one more"), "buffer 'one more'");
    assert_lacks(rg_image_create(device, &desc, "one more"), "image 'one more'");
    rg_buf_destroy(last);
    given_back(state);
}

static void kernels_with_too_many_slots_are_unsupported(void **state)
{
    struct rg_device *device = *state;
    struct rg_limits *limits = taken(state);
    limits->slot_end.buffers = 2;
    assert_lacks(rg_pass_create(device, "probe_copy"), "'probe_copy': slot 2, 'target', is beyond");
    *limits = kept;
    limits->slot_count.buffers = 1;
    assert_lacks(rg_pass_create(device, "probe_copy"), "slot 2, 'target', is one more than the 1");
    *limits = kept;
    limits->slot_count.images = 0;
    assert_lacks(rg_pass_create(device, "test_image_copy"), "the 0 images that");
    *limits = kept;
    limits->slot_end.out_images = 2;
    assert_lacks(rg_pass_create(device, "test_image_copy"), "is beyond the 2 slots of images to");
    *limits = kept;
    limits->formats[RG_RGBA8].uses &= ~(unsigned)RG_USE_STORE;
    assert_lacks(rg_pass_create(device, "test_store_rgba8"), "does not store to images of RGBA8");
    given_back(state);
}

static void programs_that_cannot_be_drawn_are_unsupported(void **state)
{
    struct rg_device *device = *state;
    struct rg_limits *limits = taken(state);
    strcpy(limits->no_draws, "has no pencil");
    assert_lacks(rg_pass_create(device, "test_quads"), "has no pencil");
    *limits = kept;
    limits->slot_end.buffers = RG_SLOT_SAMPLES;
    assert_lacks(rg_pass_create(device, "test_quads"), "slot 14, 'visible samples', is beyond");
    given_back(state);
}

static bool draw(struct rg_pass *pass, struct rg_buf *quads, const struct rg_draw *to)
{
    const test_quads_params params = {0};
    return rg_pass_run(
        pass, &(struct rg_run){
                  .params = &params, .slots = {[1].buf = quads}, .extent = {1, 1, 1}, .draw = to});
}

static void targets_that_cannot_be_drawn_to_are_unsupported(void **state)
{
    struct rg_device *device = *state;
    struct rg_image *colour =
        rg_image_create(device, &(struct rg_image_desc){RG_RGBA32F, 4, 4, 1, 1}, "colour");
    struct rg_image *depth =
        rg_image_create(device, &(struct rg_image_desc){RG_D32F, 4, 4, 1, 1}, "depth");
    struct rg_buf *quads = filled_buf(device, 0, TEST_QUAD_WORDS, "quads");
    struct rg_pass *pass = rg_pass_create(device, "test_quads");
    assert_true(colour && depth && pass);
    const struct rg_draw blended = {.colour = colour, .blend = RG_BLEND_ADD};
    const struct rg_draw plain = {.colour = colour};
    const struct rg_draw tested = {.colour = colour, .depth = depth, .depth_mode = RG_DEPTH_TEST};
    struct rg_limits *limits = taken(state);
    limits->formats[RG_RGBA32F].uses &= ~(unsigned)RG_USE_BLEND;
    assert_lacks(draw(pass, quads, &blended), "does not blend to RGBA32F");
    assert_true(draw(pass, quads, &plain));
    limits->formats[RG_RGBA32F].uses &= ~(unsigned)RG_USE_DRAW;
    assert_lacks(draw(pass, quads, &plain), "does not draw to RGBA32F");
    *limits = kept;
    limits->formats[RG_D32F].uses &= ~(unsigned)RG_USE_DRAW;
    assert_lacks(draw(pass, quads, &tested), "does not draw to D32F");
    given_back(state);
    assert_true(draw(pass, quads, &tested));
    rg_pass_destroy(pass);
    rg_buf_destroy(quads);
    rg_image_destroy(colour);
    rg_image_destroy(depth);
}

static void a_missing_clock_is_unsupported(void **state)
{
    int64_t time_ns;
    taken(state)->has_clock = false;
    assert_lacks(rg_device_time(*state, &time_ns), "has no clock");
    given_back(state);
}

// Neither fixed functions nor the driver's own way of drawing are asked for where they are not.
static void a_missing_pipeline_is_unsupported(void **state)
{
    struct rg_device *device = *state;
    strcpy(taken(state)->no_native, "has no camera");
    assert_lacks(rg_device_fixed_draw(device, "linear", NULL, NULL), "for it has no camera");
    assert_lacks(rg_limits_allow_native("box:native", &device->info),
                 "'box:native': has no native way, for");
    given_back(state);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(objects_beyond_the_limits_are_unsupported),
    cmocka_unit_test(more_objects_than_the_limit_are_unsupported),
    cmocka_unit_test(kernels_with_too_many_slots_are_unsupported),
    cmocka_unit_test(programs_that_cannot_be_drawn_are_unsupported),
    cmocka_unit_test(targets_that_cannot_be_drawn_to_are_unsupported),
    cmocka_unit_test(a_missing_clock_is_unsupported),
    cmocka_unit_test(a_missing_pipeline_is_unsupported),
};
const struct suite_tests lack_tests = {tests, COUNT_OF(tests)};
