// DRAW passes: every device draws what cpu:reference draws, to the last bit.
#include <stdio.h>

#include "tests/device/suite.h"
#include "tests/quads.h"

enum { WIDTH = 333, HEIGHT = 217, QUADS = 20000 };

// One way to draw.
struct way {
    const char *name;
    enum rg_format format;
    enum rg_blend blend;
    enum rg_depth_mode depth;
    enum rg_cull cull;
    bool scissor, counted;
};

// What a draw left.
struct drawn {
    uint32_t *colour, *depth, *samples;
    int colour_words;
};

static float *scene(enum quad_kind kind, int count)
{
    float *quads = malloc((size_t)count * TEST_QUAD_WORDS * sizeof(float));
    quads_fill(quads, count, WIDTH, HEIGHT, kind, 5);
    return quads;
}

static struct drawn draw(struct rg_device *device, const struct way *way, const float *quads,
                         int count)
{
    const test_quads_params p = {.gradient = 1.0f / 64, .slope_x = 0.0005f, .slope_y = -0.0004f};
    struct rg_pass *pass = rg_pass_create(device, "test_quads");
    struct rg_buf *input = make_buf(device, quads, count * TEST_QUAD_WORDS, "quads");
    struct rg_buf *samples = filled_buf(device, 0, count, "samples");
    struct rg_image *colour = rg_image_create(
        device, &(struct rg_image_desc){way->format, WIDTH, HEIGHT, 1, 1}, "colour");
    struct rg_image *depth =
        rg_image_create(device, &(struct rg_image_desc){RG_D32F, WIDTH, HEIGHT, 1, 1}, "depth");
    assert_true(pass && input && samples && colour && depth);
    const uint32_t black[4] = {0};
    const float far_half = 0.5f;
    assert_true(rg_image_clear(colour, black) && rg_image_clear(depth, &far_half));
    const struct rg_draw to = {
        .colour = colour,
        .depth = way->depth == RG_DEPTH_OFF ? NULL : depth,
        .blend = way->blend,
        .depth_mode = way->depth,
        .cull = way->cull,
        .x0 = way->scissor ? 17 : 0,
        .y0 = way->scissor ? 5 : 0,
        .x1 = way->scissor ? 200 : 0,
        .y1 = way->scissor ? 211 : 0,
        .samples = way->counted ? samples : NULL,
    };
    assert_true(rg_pass_run(
        pass, &(struct rg_run){
                  .params = &p, .slots = {[1].buf = input}, .extent = {count, 1, 1}, .draw = &to}));
    const int texel_words = rg_format_size(way->format) / 4;
    struct drawn drawn = {.colour_words = WIDTH * HEIGHT * texel_words};
    drawn.colour = malloc((size_t)drawn.colour_words * 4);
    drawn.depth = malloc(WIDTH * HEIGHT * 4);
    assert_true(rg_image_read(colour, 0, 0, drawn.colour) &&
                rg_image_read(depth, 0, 0, drawn.depth));
    drawn.samples = read_words(samples, count);
    rg_pass_destroy(pass);
    rg_buf_destroy(input);
    rg_buf_destroy(samples);
    rg_image_destroy(colour);
    rg_image_destroy(depth);
    return drawn;
}

static void release(struct drawn *drawn)
{
    free(drawn->colour);
    free(drawn->depth);
    free(drawn->samples);
}

static void compare(const char *way, const char *what, const uint32_t *a, const uint32_t *b,
                    int words, int row_words)
{
    int differing = 0, first = -1;
    for (int i = 0; i < words; i++) {
        if (a[i] != b[i]) {
            first = first < 0 ? i : first;
            differing++;
        }
    }
    if (differing)
        fail_msg(
            "%s: %d of %d words of %s differ from cpu:reference's, first at column %d, row %d: "
            "%08x, not %08x",
            way, differing, words, what, first % row_words, first / row_words, (unsigned)b[first],
            (unsigned)a[first]);
}

static void check_way(struct rg_device *device, const struct way *way, const float *quads,
                      int count)
{
    struct rg_device *reference = rg_device_open("cpu:reference", NULL);
    struct drawn due = draw(reference, way, quads, count);
    struct drawn drawn = draw(device, way, quads, count);
    compare(way->name, "colour", due.colour, drawn.colour, due.colour_words,
            due.colour_words / HEIGHT);
    compare(way->name, "depth", due.depth, drawn.depth, WIDTH * HEIGHT, WIDTH);
    compare(way->name, "visible samples", due.samples, drawn.samples, count, count);
    release(&due);
    release(&drawn);
    assert_true(rg_device_close(reference));
}

static const struct way ways[] = {
    {"RGBA8, over", RG_RGBA8, RG_BLEND_OVER, RG_DEPTH_OFF, RG_CULL_NONE, false, false},
    {"RGBA8, add", RG_RGBA8, RG_BLEND_ADD, RG_DEPTH_OFF, RG_CULL_NONE, false, false},
    {"RGBA8, opaque", RG_RGBA8, RG_BLEND_OFF, RG_DEPTH_WRITE, RG_CULL_NONE, false, false},
    {"RGBA16F, over", RG_RGBA16F, RG_BLEND_OVER, RG_DEPTH_OFF, RG_CULL_NONE, false, false},
    {"RGBA16F, add", RG_RGBA16F, RG_BLEND_ADD, RG_DEPTH_TEST, RG_CULL_NONE, false, false},
    {"RGBA16F, opaque", RG_RGBA16F, RG_BLEND_OFF, RG_DEPTH_WRITE, RG_CULL_BACK, false, false},
    {"RGBA32F, over", RG_RGBA32F, RG_BLEND_OVER, RG_DEPTH_OFF, RG_CULL_NONE, true, false},
    {"RGBA32F, add", RG_RGBA32F, RG_BLEND_ADD, RG_DEPTH_WRITE, RG_CULL_FRONT, false, false},
    {"counted, no depth", RG_RGBA32F, RG_BLEND_OVER, RG_DEPTH_OFF, RG_CULL_NONE, true, true},
    {"counted, tested", RG_RGBA8, RG_BLEND_OVER, RG_DEPTH_TEST, RG_CULL_NONE, false, true},
};

static void quads_of_all_kinds_are_drawn_alike(void **state)
{
    float *quads = scene(QUAD_KINDS, QUADS);
    for (int i = 0; i < COUNT_OF(ways); i++)
        check_way(*state, &ways[i], quads, QUADS);
    free(quads);
}

static void each_kind_is_drawn_alike(void **state)
{
    const struct way sum = {"", RG_RGBA32F, RG_BLEND_ADD, RG_DEPTH_OFF, RG_CULL_NONE, false, true};
    for (int kind = 0; kind < QUAD_KINDS; kind++) {
        char name[32];
        snprintf(name, sizeof(name), "quads of kind %d", kind);
        struct way way = sum;
        way.name = name;
        float *quads = scene(kind, 700);
        check_way(*state, &way, quads, 700);
        free(quads);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(each_kind_is_drawn_alike),
    cmocka_unit_test(quads_of_all_kinds_are_drawn_alike),
};

const struct suite_tests draw_tests = {tests, COUNT_OF(tests)};
