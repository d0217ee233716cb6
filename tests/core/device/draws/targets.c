// Targets of DRAW passes: any shape, layer and level, depth alone, and refusals.
#include "tests/core/device/suite.h"

#include <stdio.h>

#include "kernels/probe/copy_params.h"
#include "tests/core/device/draws/quads.h"
#include "tests/kernels/texels/params.h"
#include "tests/kernels/drawing/triangles_params.h"

// The target of a case, and how the case draws. Both images have the same shape.
struct place {
    const char *name;
    struct rg_image_desc colour; // RG_FORMAT_NONE: depth alone
    int layer, level;
    enum rg_depth_mode depth_mode;
    bool counted;
};

// Everything that a case's draws may change, and its device.
struct rig {
    struct rg_device *device;
    struct rg_pass *pass;
    struct rg_buf *quads, *samples;
    struct rg_image *colour, *depth;
    struct rg_draw to;
};

static const test_quads_params quads_params = {
    .gradient = 1.0f / 64, .slope_x = 0.00001f, .slope_y = -0.00002f};

static float *scene(const struct place *place, enum quad_kind kind, int count)
{
    float *quads = malloc((size_t)count * TEST_QUAD_WORDS * sizeof(float));
    quads_fill(quads, count, rg_level_size(place->colour.width, place->level),
               rg_level_size(place->colour.height, place->level), kind, 11);
    return quads;
}

static struct rg_image *cleared(struct rg_device *device, struct rg_image_desc desc,
                                enum rg_format format, const void *texel, const char *name)
{
    desc.format = format;
    struct rg_image *image = rg_image_create_with(device, &desc, texel, name);
    assert_non_null(image);
    return image;
}

// Depth that differs between texels, layers and levels.
static struct rg_image *uneven(struct rg_device *device, struct rg_image_desc desc)
{
    desc.format = RG_D32F;
    struct rg_image *image = rg_image_create(device, &desc, "depth");
    assert_non_null(image);
    float *texels = malloc((size_t)desc.width * (size_t)desc.height * sizeof(float));
    for (int layer = 0; layer < desc.layers; layer++) {
        for (int level = 0; level < desc.levels; level++) {
            const uint32_t seed = (uint32_t)(layer * desc.levels + level) << 20;
            const int count = rg_level_size(desc.width, level) * rg_level_size(desc.height, level);
            for (int i = 0; i < count; i++)
                texels[i] = 0.25f + 0.75f * 0x1p-24f * (float)(noise(seed + (uint32_t)i) >> 8);
            assert_true(rg_image_write(image, layer, level, texels));
        }
    }
    free(texels);
    return image;
}

static struct rig make_rig(struct rg_device *device, const struct place *place, const float *quads,
                           int count)
{
    const uint32_t dark[4] = {0};
    struct rig rig = {
        .device = device,
        .pass = rg_pass_create(device, "test_quads"),
        .quads = make_buf(device, quads, count * TEST_QUAD_WORDS, "quads"),
        .samples = filled_buf(device, 0, count, "samples"),
        .depth = uneven(device, place->colour),
    };
    assert_non_null(rig.pass);
    if (place->colour.format != RG_FORMAT_NONE)
        rig.colour = cleared(device, place->colour, place->colour.format, dark, "colour");
    rig.to = (struct rg_draw){
        .colour = rig.colour,
        .depth = rig.depth,
        .layer = place->layer,
        .level = place->level,
        .blend = RG_BLEND_OVER,
        .depth_mode = place->depth_mode,
        .samples = place->counted ? rig.samples : NULL,
    };
    return rig;
}

static void destroy_rig(struct rig *rig)
{
    rg_image_destroy(rig->colour);
    rg_image_destroy(rig->depth);
    rg_buf_destroy(rig->quads);
    rg_buf_destroy(rig->samples);
    rg_pass_destroy(rig->pass);
}

static bool draw(struct rig *rig, int first, int count)
{
    return rg_pass_run(rig->pass, &(struct rg_run){.params = &quads_params,
                                                   .slots = {[1].buf = rig->quads},
                                                   .origin = {first, 0, 0},
                                                   .extent = {count, 1, 1},
                                                   .draw = &rig->to});
}

static void compare(const char *name, const char *what, const uint32_t *due, const uint32_t *drawn,
                    int words)
{
    int differing = 0, first = -1;
    for (int i = 0; i < words; i++) {
        if (due[i] != drawn[i]) {
            first = first < 0 ? i : first;
            differing++;
        }
    }
    if (differing)
        fail_msg("%s: %d of %d words of %s differ from cpu:reference's, first the %d.: %08x, not "
                 "%08x",
                 name, differing, words, what, first, (unsigned)drawn[first], (unsigned)due[first]);
}

// Compares every layer and level, so that changes outside the target are seen as well.
static void compare_images(const char *name, struct rg_image *due, struct rg_image *drawn)
{
    const struct rg_image_desc *desc = &due->desc;
    const size_t most = (size_t)desc->width * (size_t)desc->height * 16;
    uint32_t *a = malloc(most), *b = malloc(most);
    for (int layer = 0; layer < desc->layers; layer++) {
        for (int level = 0; level < desc->levels; level++) {
            char what[64];
            snprintf(what, sizeof(what), "%s, layer %d, level %d,", due->name, layer, level);
            assert_true(rg_image_read(due, layer, level, a) &&
                        rg_image_read(drawn, layer, level, b));
            compare(name, what, a, b,
                    rg_level_size(desc->width, level) * rg_level_size(desc->height, level) *
                        rg_format_size(desc->format) / 4);
        }
    }
    free(a);
    free(b);
}

static void compare_rigs(const char *name, const struct rig *due, const struct rig *drawn)
{
    if (due->colour)
        compare_images(name, due->colour, drawn->colour);
    compare_images(name, due->depth, drawn->depth);
    const int count = (int)(due->samples->size / 4);
    uint32_t *a = read_words(due->samples, count), *b = read_words(drawn->samples, count);
    compare(name, "visible samples", a, b, count);
    free(a);
    free(b);
}

// Draws items first to first + count of `total`, on the device and on cpu:reference.
static void check_place(struct rg_device *device, const struct place *place, const float *quads,
                        int total, int first, int count)
{
    struct rg_device *reference = rg_device_open("cpu:reference");
    struct rig due = make_rig(reference, place, quads, total);
    struct rig drawn = make_rig(device, place, quads, total);
    assert_true(draw(&due, first, count) && draw(&drawn, first, count));
    compare_rigs(place->name, &due, &drawn);
    destroy_rig(&due);
    destroy_rig(&drawn);
    assert_true(rg_device_close(reference));
}

static void check_scene(struct rg_device *device, const struct place *place, int count)
{
    float *quads = scene(place, QUAD_KINDS, count);
    check_place(device, place, quads, count, 0, count);
    free(quads);
}

// --- shapes ---

static void targets_of_any_shape_are_drawn_alike(void **state)
{
    static const struct place places[] = {
        {"1x1", {RG_RGBA8, 1, 1, 1, 1}, 0, 0, RG_DEPTH_WRITE, false},
        {"as wide as can be", {RG_RGBA8, 16384, 3, 1, 1}, 0, 0, RG_DEPTH_WRITE, false},
        {"as high as can be", {RG_RGBA16F, 3, 16384, 1, 1}, 0, 0, RG_DEPTH_TEST, true},
        {"a layer", {RG_RGBA8, 101, 67, 3, 1}, 2, 0, RG_DEPTH_WRITE, false},
        {"a level", {RG_RGBA32F, 101, 67, 1, 4}, 0, 2, RG_DEPTH_WRITE, false},
        {"a layer's level", {RG_RGBA16F, 101, 67, 4, 3}, 1, 1, RG_DEPTH_TEST, true},
        {"the last level", {RG_RGBA8, 33, 65, 2, 7}, 1, 6, RG_DEPTH_WRITE, false},
    };
    for (int i = 0; i < COUNT_OF(places); i++)
        check_scene(*state, &places[i], 1500);
}

static void depth_alone_is_drawn_alike(void **state)
{
    static const struct place places[] = {
        {"depth alone", {RG_FORMAT_NONE, 119, 85, 1, 1}, 0, 0, RG_DEPTH_WRITE, false},
        {"depth alone, of a layer", {RG_FORMAT_NONE, 119, 85, 3, 2}, 1, 1, RG_DEPTH_WRITE, false},
        {"a count alone", {RG_FORMAT_NONE, 119, 85, 1, 1}, 0, 0, RG_DEPTH_TEST, true},
        {"a count alone, not tested", {RG_FORMAT_NONE, 119, 85, 2, 1}, 1, 0, RG_DEPTH_OFF, true},
        {"nothing at all", {RG_FORMAT_NONE, 119, 85, 1, 1}, 0, 0, RG_DEPTH_TEST, false},
    };
    for (int i = 0; i < COUNT_OF(places); i++)
        check_scene(*state, &places[i], 2000);
}

static const struct place plain = {"plain", {RG_RGBA8, 119, 85, 1, 1}, 0, 0, RG_DEPTH_TEST, true};

static void items_off_the_target_draw_nothing(void **state)
{
    float *quads = scene(&plain, QUAD_OFF, 300);
    check_place(*state, &plain, quads, 300, 0, 300);
    free(quads);
}

// One pair of images is drawn to again and again, in ways that need other pipelines.
static void draws_follow_one_another(void **state)
{
    float *quads = scene(&plain, QUAD_KINDS, 900);
    struct rg_device *reference = rg_device_open("cpu:reference");
    struct rig rigs[] = {make_rig(reference, &plain, quads, 900),
                         make_rig(*state, &plain, quads, 900)};
    for (int r = 0; r < 2; r++) {
        struct rg_draw *to = &rigs[r].to;
        for (int i = 0; i < 45; i++) {
            to->blend = (enum rg_blend)(i % 3);
            to->depth_mode = (enum rg_depth_mode)(i / 3 % 3);
            to->samples = i % 2 && to->depth_mode != RG_DEPTH_WRITE ? rigs[r].samples : NULL;
            to->colour = i % 5 ? rigs[r].colour : NULL;
            assert_true(draw(&rigs[r], 20 * i, 20));
        }
    }
    compare_rigs("45 draws", &rigs[0], &rigs[1]);
    destroy_rig(&rigs[0]);
    destroy_rig(&rigs[1]);
    free(quads);
    assert_true(rg_device_close(reference));
}

// --- long ranges ---

static void runs_begin_at_their_origin(void **state)
{
    float *quads = scene(&plain, QUAD_KINDS, 900);
    check_place(*state, &plain, quads, 900, 301, 517);
    free(quads);
}

// More items than have room in one buffer of primitives: devices that pack draw several batches.
static void long_ranges_are_drawn_in_order(void **state)
{
    enum { ITEMS = 600000, SEEN = 1500 };
    float *quads = calloc((size_t)ITEMS * TEST_QUAD_WORDS, sizeof(float)); // all w 0: not seen
    float *seen = scene(&plain, QUAD_KINDS, SEEN);
    for (int i = 0; i < SEEN; i++)
        memcpy(quads + (int64_t)(ITEMS / SEEN) * i * TEST_QUAD_WORDS, seen + i * TEST_QUAD_WORDS,
               TEST_QUAD_WORDS * sizeof(float));
    check_place(*state, &plain, quads, ITEMS, 0, ITEMS);
    free(seen);
    free(quads);
}

// --- depth that later passes read ---

static uint32_t *fetched_depth(struct rig *rig)
{
    const int width = rig->depth->desc.width, height = rig->depth->desc.height;
    const struct test_texels_params params = {width, height, 0};
    struct rg_buf *colours =
        filled_buf(rig->device, 0, width * height * rig->depth->desc.layers * 4, "colours");
    struct rg_pass *fetch = rg_pass_create(rig->device, "test_fetch_d32f");
    assert_non_null(fetch);
    assert_true(
        rg_pass_run(fetch, &(struct rg_run){.params = &params,
                                            .slots = {[1].image = rig->depth, [2].buf = colours},
                                            .extent = {width, height, rig->depth->desc.layers}}));
    uint32_t *words = read_words(colours, (int)(colours->size / 4));
    rg_pass_destroy(fetch);
    rg_buf_destroy(colours);
    return words;
}

static void kernels_fetch_what_depth_was_drawn(void **state)
{
    const struct place place = {
        "fetched depth", {RG_FORMAT_NONE, 119, 85, 2, 1}, 1, 0, RG_DEPTH_WRITE, false};
    float *quads = scene(&place, QUAD_KINDS, 900);
    struct rg_device *reference = rg_device_open("cpu:reference");
    struct rig due = make_rig(reference, &place, quads, 900);
    struct rig drawn = make_rig(*state, &place, quads, 900);
    assert_true(draw(&due, 0, 900) && draw(&drawn, 0, 900));
    uint32_t *a = fetched_depth(&due), *b = fetched_depth(&drawn);
    compare(place.name, "colours", a, b, 119 * 85 * 2 * 4);
    free(a);
    free(b);
    destroy_rig(&due);
    destroy_rig(&drawn);
    free(quads);
    assert_true(rg_device_close(reference));
}

// Triangles read the depth that the quads left: a shadow map.
static struct rg_image *draw_shadowed(struct rig *rig, int count)
{
    const test_triangles_params params = {1, 0};
    const uint32_t dark[4] = {0};
    const struct rg_image_desc desc = {RG_RGBA32F, 150, 100, 1, 1};
    struct rg_image *picture = cleared(rig->device, desc, RG_RGBA32F, dark, "shadowed");
    struct rg_pass *pass = rg_pass_create(rig->device, "test_triangles");
    assert_non_null(pass);
    const struct rg_draw to = {.colour = picture, .blend = RG_BLEND_ADD};
    assert_true(draw(rig, 0, count));
    assert_true(
        rg_pass_run(pass, &(struct rg_run){.params = &params,
                                           .slots = {[1].buf = rig->quads, [2].image = rig->depth},
                                           .extent = {count, 1, 1},
                                           .draw = &to}));
    assert_true(draw(rig, 0, count)); // overwrites what the triangles have read
    rg_pass_destroy(pass);
    return picture;
}

static void programs_fetch_what_depth_was_drawn(void **state)
{
    const struct place place = {"shadow map", {RG_FORMAT_NONE, 119, 85, 2, 1}, 1, 0, RG_DEPTH_WRITE,
                                false};
    float *quads = scene(&place, QUAD_KINDS, 900);
    struct rg_device *reference = rg_device_open("cpu:reference");
    struct rig due = make_rig(reference, &place, quads, 900);
    struct rig drawn = make_rig(*state, &place, quads, 900);
    struct rg_image *a = draw_shadowed(&due, 900), *b = draw_shadowed(&drawn, 900);
    compare_images(place.name, a, b);
    rg_image_destroy(a);
    rg_image_destroy(b);
    destroy_rig(&due);
    destroy_rig(&drawn);
    free(quads);
    assert_true(rg_device_close(reference));
}

// --- lifetimes ---

// Images take each other's places in memory. A device must drop what it keeps of a target along
// with the target.
static void targets_come_and_go(void **state)
{
    float *quads = scene(&plain, QUAD_LARGE, 20);
    const uint32_t dark[4] = {0};
    struct rig rig = make_rig(*state, &plain, quads, 20);
    rig.to.depth_mode = RG_DEPTH_OFF;
    rig.to.samples = NULL;
    uint32_t *due = malloc(119 * 85 * 16), *drawn = malloc(119 * 85 * 16);
    assert_true(draw(&rig, 0, 20));
    assert_true(rg_image_read(rig.colour, 0, 0, due));
    for (int i = 0; i < 60; i++) {
        struct rg_image_desc desc = plain.colour;
        desc.levels = 1 + i % 3;
        struct rg_image *image = cleared(*state, desc, RG_RGBA8, dark, "short-lived");
        struct rg_image *depth = cleared(*state, desc, RG_D32F, dark, "short-lived depth");
        rig.to.colour = image;
        rig.to.depth = i % 2 ? depth : NULL;
        assert_true(draw(&rig, 0, 20));
        assert_true(rg_image_read(image, 0, 0, drawn));
        compare("a new target", "colour", due, drawn, 119 * 85);
        rg_image_destroy(i % 4 < 2 ? image : depth);
        rg_image_destroy(i % 4 < 2 ? depth : image);
    }
    free(due);
    free(drawn);
    destroy_rig(&rig);
    free(quads);
}

// --- refusals ---

static void draws_refuse_bad_targets(void **state)
{
    float *quads = scene(&plain, QUAD_STREAK, 50);
    const uint32_t dark[4] = {0};
    struct rig rig = make_rig(*state, &plain, quads, 50);
    const struct rg_draw right = rig.to;
    struct rg_image *narrow =
        cleared(*state, (struct rg_image_desc){0, 118, 85, 1, 1}, RG_D32F, dark, "narrow");
    struct rg_image *numbers =
        cleared(*state, (struct rg_image_desc){0, 119, 85, 1, 1}, RG_R32F, dark, "numbers");
    struct rg_device *other = rg_device_open("cpu:reference");
    struct rg_image *foreign = cleared(other, plain.colour, RG_RGBA8, dark, "foreign");
#define REFUSED(part, ...)                                                                         \
    do {                                                                                           \
        rig.to = right;                                                                            \
        __VA_ARGS__;                                                                               \
        assert_refused(draw(&rig, 0, 50), part);                                                   \
    } while (0)
    REFUSED("no target given", rig.to.colour = rig.to.depth = NULL);
    REFUSED("'depth' is D32F; colours go to", rig.to.colour = rig.depth);
    REFUSED("'numbers' is R32F; colours go to", rig.to.colour = numbers);
    REFUSED("'numbers' is R32F; depth goes to D32F", rig.to.depth = numbers);
    REFUSED("'colour' and 'narrow' differ in size", rig.to.depth = narrow);
    REFUSED("'foreign' belongs to another device", rig.to.colour = foreign);
    REFUSED("'colour' has no layer 1, level 0", rig.to.layer = 1);
    REFUSED("'colour' has no layer 0, level 1", rig.to.level = 1);
    REFUSED("no depth target given", rig.to.depth = NULL);
    REFUSED("against depth that is not written", rig.to.depth_mode = RG_DEPTH_WRITE);
    REFUSED("scissor 0,0 to 120,85", rig.to.x1 = 120, rig.to.y1 = 85);
    REFUSED("scissor 0,0 to 5,", rig.to.x1 = 5, rig.to.y1 = right.colour->desc.height + 1);
    REFUSED("to ", rig.to.x1 = right.colour->desc.width + 1, rig.to.y1 = 5);
    REFUSED("scissor -1,0 to 5,5", rig.to.x0 = -1, rig.to.x1 = 5, rig.to.y1 = 5);
    REFUSED("scissor 7,2 to 7,5 is empty", rig.to.x0 = rig.to.x1 = 7, rig.to.y0 = 2, rig.to.y1 = 5);
    REFUSED("slot 'quads' and a target are one object", rig.to.samples = rig.quads);
#undef REFUSED
    rig.to = right;
    assert_true(draw(&rig, 0, 50));
    rg_image_destroy(foreign);
    assert_true(rg_device_close(other));
    rg_image_destroy(narrow);
    rg_image_destroy(numbers);
    destroy_rig(&rig);
    free(quads);
}

static void draws_refuse_bad_runs(void **state)
{
    float *quads = scene(&plain, QUAD_STREAK, 50);
    struct rig rig = make_rig(*state, &plain, quads, 50);
    struct rg_run run = {
        .params = &quads_params, .slots = {[1].buf = rig.quads}, .extent = {50, 1, 1}};
    assert_refused(rg_pass_run(rig.pass, &run), "'test_quads': a DRAW program");
    run.draw = &rig.to;
    run.extent.height = 2;
    assert_refused(rg_pass_run(rig.pass, &run), "lie along x");
    run.extent = (struct rg_extent){51, 1, 1};
    assert_refused(rg_pass_run(rig.pass, &run), "'samples' has 50 counters for 51 items");

    struct rg_pass *triangles = rg_pass_create(*state, "test_triangles");
    const test_triangles_params params = {0, 0};
    assert_non_null(triangles);
    run = (struct rg_run){.params = &params,
                          .slots = {[1].buf = rig.quads, [2].image = rig.depth},
                          .extent = {50, 1, 1},
                          .draw = &rig.to};
    assert_refused(rg_pass_run(triangles, &run), "slot 'before' and a target are one object");
    rg_pass_destroy(triangles);

    struct rg_pass *copy = rg_pass_create(*state, "probe_copy");
    const probe_copy_params copied = {4, 1, 0};
    assert_non_null(copy);
    run = (struct rg_run){.params = &copied,
                          .slots = {[1].buf = rig.quads, [2].buf = rig.samples},
                          .extent = {4, 1, 1},
                          .draw = &rig.to};
    assert_refused(rg_pass_run(copy, &run), "'probe_copy': a GRID kernel");
    rg_pass_destroy(copy);
    destroy_rig(&rig);
    free(quads);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(targets_of_any_shape_are_drawn_alike),
    cmocka_unit_test(depth_alone_is_drawn_alike),
    cmocka_unit_test(items_off_the_target_draw_nothing),
    cmocka_unit_test(draws_follow_one_another),
    cmocka_unit_test(runs_begin_at_their_origin),
    cmocka_unit_test(long_ranges_are_drawn_in_order),
    cmocka_unit_test(kernels_fetch_what_depth_was_drawn),
    cmocka_unit_test(programs_fetch_what_depth_was_drawn),
    cmocka_unit_test(targets_come_and_go),
    cmocka_unit_test(draws_refuse_bad_targets),
    cmocka_unit_test(draws_refuse_bad_runs),
};

const struct suite_tests target_tests = {tests, COUNT_OF(tests)};
