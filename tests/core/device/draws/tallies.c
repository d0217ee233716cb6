// A run's tally, against closed forms, on every device alike.
#include "core/device/work.h"

#include "tests/core/device/draws/quads.h"
#include "tests/core/device/suite.h"
#include "tests/kernels/image_copy_params.h"
#include "tests/kernels/drawing/lights_params.h"
#include "tests/tools/expect.h"

// Powers of two, so that corners on corners of pixels stay there.
enum { WIDTH = 256, HEIGHT = 128 };

// For each light, a fragment fetches a texel of the shadow map, and four of two levels of the gobo.
enum { TEXELS_A_LIGHT = 9 };

// A rectangle of whole pixels, which may reach off the target.
struct rect {
    int x0, y0, x1, y1;
    float z_left, z_right; // clipped where negative
};

static void put_corner(float *corner, int x, int y, float z)
{
    corner[0] = 2.0f * (float)x / WIDTH - 1.0f;
    corner[1] = 2.0f * (float)y / HEIGHT - 1.0f;
    corner[2] = z;
    corner[3] = 1.0f;
}

static struct rg_buf *make_quads(struct rg_device *device, const struct rect *rects, int count)
{
    float *quads = calloc((size_t)count, TEST_QUAD_WORDS * sizeof(float));
    for (int i = 0; i < count; i++) {
        float *quad = quads + i * TEST_QUAD_WORDS;
        put_corner(quad, rects[i].x0, rects[i].y0, rects[i].z_left);
        put_corner(quad + 4, rects[i].x1, rects[i].y0, rects[i].z_right);
        put_corner(quad + 8, rects[i].x1, rects[i].y1, rects[i].z_right);
        put_corner(quad + 12, rects[i].x0, rects[i].y1, rects[i].z_left);
    }
    struct rg_buf *buf = make_buf(device, quads, count * TEST_QUAD_WORDS, "quads");
    free(quads);
    return buf;
}

// A draw's objects on one device.
struct rig {
    struct rg_pass *pass;
    struct rg_buf *quads, *lights;
    struct rg_image *shadows, *gobos, *colour, *depth;
};

static struct rg_image *make_image(struct rg_device *device, struct rg_image_desc desc)
{
    const float far_away[4] = {1.0f};
    struct rg_image *image = rg_image_create(device, &desc, rg_format_name(desc.format));
    assert_true(image && rg_image_clear(image, far_away));
    return image;
}

static struct rig make_rig(struct rg_device *device, const struct rect *rects, int count)
{
    const struct rig rig = {
        .pass = rg_pass_create(device, "test_lights"),
        .quads = make_quads(device, rects, count),
        .lights = filled_buf(device, 0, 4 * (int)sizeof(struct test_light) / 4, "lights"),
        .shadows = make_image(device, (struct rg_image_desc){RG_D32F, 8, 8, 1, 1}),
        .gobos = make_image(device, (struct rg_image_desc){RG_R16F, 8, 8, 1, 4}),
        .colour = make_image(device, (struct rg_image_desc){RG_RGBA8, WIDTH, HEIGHT, 1, 1}),
        .depth = make_image(device, (struct rg_image_desc){RG_D32F, WIDTH, HEIGHT, 1, 1}),
    };
    assert_non_null(rig.pass);
    return rig;
}

static void destroy_rig(struct rig *rig)
{
    rg_pass_destroy(rig->pass);
    rg_buf_destroy(rig->quads);
    rg_buf_destroy(rig->lights);
    rg_image_destroy(rig->shadows);
    rg_image_destroy(rig->gobos);
    rg_image_destroy(rig->colour);
    rg_image_destroy(rig->depth);
}

static void draw(const struct rig *rig, int items, int lights)
{
    const test_lights_params p = {.lights = lights, .px_to_unit = 1.0f / WIDTH};
    assert_true(rg_pass_run(
        rig->pass, &(struct rg_run){.params = &p,
                                    .slots = {[1].buf = rig->quads,
                                              [2].buf = rig->lights,
                                              [3].image = rig->shadows,
                                              [4].image = rig->gobos},
                                    .extent = {items, 1, 1},
                                    .draw = &(struct rg_draw){.colour = rig->colour,
                                                              .depth = rig->depth,
                                                              .depth_mode = RG_DEPTH_WRITE}}));
}

static bool is_reference(const struct rg_device *device)
{
    return !strcmp(device->info.name, "cpu:reference");
}

// How many pixels of a rectangle the test's program keeps; it leaves out some of each 16 x 16.
static int kept_in(int x0, int y0, int x1, int y1)
{
    int kept = 0;
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++)
            kept += ((x ^ y) & 15) != 15;
    return kept;
}

static void a_draw_comes_to_what_its_items_cover(void **state)
{
    static const struct rect rects[] = {
        {10, 10, 50, 30, 0.5f, 0.5f},     // 40 x 20
        {15, 12, 25, 22, 0.75f, 0.75f},   // 10 x 10, behind the first
        {300, 10, 340, 30, 0.5f, 0.5f},   // off the target
        {60, 40, 60, 80, 0.5f, 0.5f},     // without area
        {248, 100, 264, 110, 0.5f, 0.5f}, // half of 16 x 10 off the target
        {64, 64, 96, 80, -0.5f, 0.5f},    // clipped to 16 x 16
    };
    enum { ITEMS = 6, RECORDS = 4, FRAGMENTS = 40 * 20 + 10 * 10 + 8 * 10 + 16 * 16 };
    struct rg_device *device = *state;
    struct rig rig = make_rig(device, rects, ITEMS);
    struct rg_tally tally;
    const int kept =
        kept_in(10, 10, 50, 30) + kept_in(248, 100, 256, 110) + kept_in(80, 64, 96, 80);
    uint32_t words[4] = {0};
    for (int lights = 0; lights <= 3; lights += 3) {
        const float far_away = 1.0f;
        assert_true(rg_image_clear(rig.depth, &far_away));
        rg_tally_begin(device, &tally);
        draw(&rig, ITEMS, lights);
        assert_true(rg_buf_write(rig.lights, 0, words, 12) &&
                    rg_buf_read(rig.lights, 0, words, 16));
        rg_tally_end(device);
        assert_int_equal(tally.runs, 1);
        assert_int_equal(tally.items, ITEMS);
        assert_int_equal(tally.records, RECORDS);
        assert_int_equal(tally.fragments, FRAGMENTS);
        assert_int_equal(tally.light_evaluations, lights * FRAGMENTS);
        assert_int_equal(tally.bytes_written, 12);
        assert_int_equal(tally.bytes_read, 16);
        assert_at_least(tally.dispatches, 1);
        assert_int_equal(tally.fragments_kept, is_reference(device) ? kept : -1);
        assert_int_equal(tally.texels_fetched,
                         is_reference(device) ? lights * FRAGMENTS * TEXELS_A_LIGHT : -1);
    }
    destroy_rig(&rig);
}

// More items than a batch on any device, and more primitives than are read at once.
static void long_draws_are_counted_whole(void **state)
{
    enum { ITEMS = 10000 };
    struct rg_device *device = *state;
    struct rect *rects = calloc(ITEMS, sizeof(*rects));
    int fragments = 0;
    for (int i = 0; i < ITEMS; i++) {
        const int x = i % WIDTH, y = i / WIDTH, side = i % 3; // a third of them are empty
        rects[i] = (struct rect){x, y, x + side, y + side, 0.5f, 0.5f};
        fragments += side * (x + side > WIDTH ? WIDTH - x : side);
    }
    struct rig rig = make_rig(device, rects, ITEMS);
    struct rg_tally tally;
    rg_tally_begin(device, &tally);
    draw(&rig, ITEMS, 0);
    draw(&rig, ITEMS, 0);
    rg_tally_end(device);
    assert_int_equal(tally.runs, 2);
    assert_int_equal(tally.items, 2 * ITEMS);
    assert_int_equal(tally.records, 2 * (ITEMS - (ITEMS + 2) / 3));
    assert_int_equal(tally.fragments, 2 * fragments);
    destroy_rig(&rig);
    free(rects);
}

// Runs before or after a tally do not count, and GRID kernels have no records.
static void grids_are_counted_by_their_items(void **state)
{
    struct rg_device *device = *state;
    const struct rg_image_desc desc = {RG_RGBA32F, 40, 30, 1, 1};
    const test_image_copy_params p = {0, 0};
    struct rg_pass *copy = rg_pass_create(device, "test_image_copy");
    struct rg_image *from = make_image(device, desc), *to = make_image(device, desc);
    const struct rg_run run = {
        .params = &p, .slots = {[1].image = from, [2].image = to}, .extent = {40, 30, 1}};
    struct rg_tally tally;
    assert_true(copy && rg_pass_run(copy, &run));
    rg_tally_begin(device, &tally);
    assert_true(rg_pass_run(copy, &run) && rg_pass_run(copy, &run));
    rg_tally_end(device);
    assert_true(rg_pass_run(copy, &run));
    assert_int_equal(tally.runs, 2);
    assert_int_equal(tally.items, 2 * 40 * 30);
    assert_int_equal(tally.records + tally.fragments + tally.light_evaluations, 0);
    assert_int_equal(tally.texels_fetched, is_reference(device) ? 2 * 40 * 30 : -1);
    assert_int_equal(tally.bytes_written + tally.bytes_read, 0);
    rg_pass_destroy(copy);
    rg_image_destroy(from);
    rg_image_destroy(to);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_draw_comes_to_what_its_items_cover),
    cmocka_unit_test(long_draws_are_counted_whole),
    cmocka_unit_test(grids_are_counted_by_their_items),
};
const struct suite_tests tally_tests = {tests, COUNT_OF(tests)};
