// DRAW passes: every device draws what cpu:reference draws, to the last bit.
#include <math.h>
#include <stdio.h>

#include "tests/core/device/draws/quads.h"
#include "tests/core/device/suite.h"

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

// The results of a draw.
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
    const uint32_t black[4] = {0};
    const float far_half = 0.5f;
    const struct rg_image_desc coloured = {way->format, WIDTH, HEIGHT, 1, 1};
    const struct rg_image_desc deep = {RG_D32F, WIDTH, HEIGHT, 1, 1};
    struct rg_image *colour = rg_image_create_with(device, &coloured, black, "colour");
    struct rg_image *depth = rg_image_create_with(device, &deep, &far_half, "depth");
    assert_true(pass && input && samples && colour && depth);
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
    struct rg_device *reference = rg_device_open("cpu:reference");
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

// --- blending ---

enum { ROW_PX = 256, ROWS = 8192 };

static uint32_t word_at(int at, enum rg_format format)
{
    if (format == RG_RGBA8)
        return (uint32_t)(at % ROW_PX) * 0x01010101u;               // each byte along a row
    const uint32_t low = (uint32_t)at * 2 & 0xffff, high = low + 1; // each half in turn
    const uint32_t finite =
        ~((low & 0x7c00) == 0x7c00 ? 0x4000u : 0) & ~((high & 0x7c00) == 0x7c00 ? 0x40000000u : 0);
    return (low | high << 16) & finite;
}

// A row of the target in one colour, from 1e-9 to 1e6, or in eighths of a byte's steps.
static void fill_row(float *quad, int row, enum rg_format format)
{
    const float top = 2.0f * (float)row / ROWS - 1, bottom = 2.0f * (float)(row + 1) / ROWS - 1;
    const float corners[16] = {-1, top, 0, 1, 1, top, 0, 1, 1, bottom, 0, 1, -1, bottom, 0, 1};
    memcpy(quad, corners, sizeof(corners));
    for (int c = 0; c < 4; c++) {
        const uint32_t random = noise((uint32_t)(4 * row + c));
        const float unit = (float)(random >> 8) / (1 << 24);
        const float scale = c < 3 ? powf(10, (float)(random & 15) - 9) : 1;
        quad[16 + c] = format == RG_RGBA8 ? floorf(unit * 2041) / 2040 : unit * scale;
    }
}

static uint32_t *blend_rows(struct rg_device *device, enum rg_format format, enum rg_blend blend,
                            const float *quads, const uint32_t *target)
{
    const test_quads_params p = {0};
    struct rg_pass *pass = rg_pass_create(device, "test_quads");
    struct rg_buf *input = make_buf(device, quads, ROWS * TEST_QUAD_WORDS, "rows");
    struct rg_image *colour =
        rg_image_create(device, &(struct rg_image_desc){format, ROW_PX, ROWS, 1, 1}, "every value");
    assert_true(pass && input && colour && rg_image_write(colour, 0, 0, target));
    assert_true(rg_pass_run(
        pass, &(struct rg_run){.params = &p,
                               .slots = {[1].buf = input},
                               .extent = {ROWS, 1, 1},
                               .draw = &(struct rg_draw){.colour = colour, .blend = blend}}));
    uint32_t *blended = malloc((size_t)ROW_PX * ROWS * (size_t)rg_format_size(format));
    assert_true(rg_image_read(colour, 0, 0, blended));
    rg_pass_destroy(pass);
    rg_buf_destroy(input);
    rg_image_destroy(colour);
    return blended;
}

static void check_rows(struct rg_device *device, enum rg_format format, enum rg_blend blend)
{
    const int words = ROW_PX * ROWS * rg_format_size(format) / 4;
    float *quads = malloc(ROWS * TEST_QUAD_WORDS * sizeof(float));
    uint32_t *target = malloc((size_t)words * 4);
    for (int row = 0; row < ROWS; row++)
        fill_row(quads + row * TEST_QUAD_WORDS, row, format);
    for (int i = 0; i < words; i++)
        target[i] = word_at(i, format);
    struct rg_device *reference = rg_device_open("cpu:reference");
    uint32_t *due = blend_rows(reference, format, blend, quads, target);
    uint32_t *blended = blend_rows(device, format, blend, quads, target);
    compare(rg_format_name(format), "every value", due, blended, words, words / ROWS);
    assert_true(rg_device_close(reference));
    free(quads);
    free(target);
    free(due);
    free(blended);
}

static void every_value_of_a_target_blends_alike(void **state)
{
    for (enum rg_blend blend = RG_BLEND_OVER; blend <= RG_BLEND_ADD; blend++) {
        check_rows(*state, RG_RGBA8, blend);
        check_rows(*state, RG_RGBA16F, blend);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(each_kind_is_drawn_alike),
    cmocka_unit_test(quads_of_all_kinds_are_drawn_alike),
    cmocka_unit_test(every_value_of_a_target_blends_alike),
};

const struct suite_tests draw_tests = {tests, COUNT_OF(tests)};
