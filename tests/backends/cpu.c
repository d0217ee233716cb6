// For cpu alone: targets of odd sizes, and any number of batches, rounds and threads leave the bits
// of cpu:reference. Also the items that cpu skips.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/device/device.h"
#include "tests/core/device/draws/quads.h"
#include "tests/kernels/idle_params.h"
#include "tests/tools/expect.h"

#define COUNT_OF(array) ((int)(sizeof(array) / sizeof((array)[0])))

static const uint32_t poison = 0x3f3f3f3fu; // a depth of 0.75, and a colour

// A scene and its target.
struct scene {
    int width, height, layers, levels, layer, level;
    int first, items; // of a buffer that holds more
    enum quad_kind kind;
    enum rg_format format; // RG_FORMAT_NONE: depth alone
    enum rg_blend blend;
    enum rg_depth_mode depth;
};

struct drawn {
    struct rg_image *image;
    uint32_t *texels;
    size_t words; // of all layers and levels
};

static struct drawn target(struct rg_device *device, const struct scene *s, enum rg_format format)
{
    const uint32_t texel[4] = {poison, poison, poison, poison};
    const struct rg_image_desc desc = {format, s->width, s->height, s->layers, s->levels};
    struct drawn drawn = {rg_image_create_with(device, &desc, texel, "target"), NULL, 0};
    assert_non_null(drawn.image);
    return drawn;
}

static void read_target(struct drawn *drawn)
{
    const struct rg_image_desc *desc = &drawn->image->desc;
    for (int level = 0; level < desc->levels; level++) {
        const size_t words = (size_t)rg_level_size(desc->width, level) *
                             (size_t)rg_level_size(desc->height, level) *
                             (size_t)rg_format_size(desc->format) / 4;
        for (int layer = 0; layer < desc->layers; layer++) {
            drawn->texels = realloc(drawn->texels, (drawn->words + words) * 4);
            assert_true(rg_image_read(drawn->image, layer, level, drawn->texels + drawn->words));
            drawn->words += words;
        }
    }
    rg_image_destroy(drawn->image);
}

static void draw(const char *name, const struct scene *s, const float *quads, struct drawn *colour,
                 struct drawn *depth)
{
    const test_quads_params p = {.gradient = 1.0f / 64, .slope_x = 0.0005f, .slope_y = -0.0004f};
    const size_t size = (size_t)(s->first + s->items) * TEST_QUAD_WORDS * sizeof(float);
    struct rg_device *device = rg_device_open(name);
    assert_non_null(device);
    struct rg_pass *pass = rg_pass_create(device, "test_quads");
    struct rg_buf *input = rg_buf_create_with(device, quads, size, "quads");
    assert_true(pass && input);
    *colour = target(device, s, s->format ? s->format : RG_RGBA8);
    *depth = target(device, s, RG_D32F);
    const struct rg_draw to = {
        .colour = s->format ? colour->image : NULL,
        .depth = depth->image,
        .layer = s->layer,
        .level = s->level,
        .blend = s->blend,
        .depth_mode = s->depth,
    };
    assert_true(rg_pass_run(pass, &(struct rg_run){.params = &p,
                                                   .slots = {[1].buf = input},
                                                   .origin = {s->first, 0, 0},
                                                   .extent = {s->items, 1, 1},
                                                   .draw = &to}));
    read_target(colour);
    read_target(depth);
    rg_pass_destroy(pass);
    rg_buf_destroy(input);
    assert_true(rg_device_close(device));
}

static bool changed(const struct drawn *drawn)
{
    for (size_t i = 0; i < drawn->words; i++)
        if (drawn->texels[i] != poison)
            return true;
    return false;
}

static void check(const struct scene *s)
{
    const int counts[] = {1, 2, 7};
    const int threads = omp_get_max_threads();
    float *quads = malloc((size_t)(s->first + s->items) * TEST_QUAD_WORDS * sizeof(float));
    quads_fill(quads, s->first + s->items, rg_level_size(s->width, s->level),
               rg_level_size(s->height, s->level), s->kind, 11);
    struct drawn due[2], drawn[2];
    draw("cpu:reference", s, quads, &due[0], &due[1]);
    assert_equals(changed(&due[0]), (s->format != RG_FORMAT_NONE));
    assert_equals(changed(&due[1]), (s->depth == RG_DEPTH_WRITE));
    for (int i = 0; i < COUNT_OF(counts); i++) {
        omp_set_num_threads(counts[i]);
        draw("cpu", s, quads, &drawn[0], &drawn[1]);
        for (int k = 0; k < 2; k++) {
            if (memcmp(due[k].texels, drawn[k].texels, due[k].words * 4) != 0)
                fail_msg("%s differs from cpu:reference's, %d threads", k ? "depth" : "colour",
                         counts[i]);
            free(drawn[k].texels);
        }
    }
    omp_set_num_threads(threads);
    free(due[0].texels);
    free(due[1].texels);
    free(quads);
}

static void depth_is_drawn_alone(void **state)
{
    (void)state;
    check(&(struct scene){333, 217, 1, 1, 0, 0, 0, 6000, QUAD_KINDS, RG_FORMAT_NONE, RG_BLEND_OFF,
                          RG_DEPTH_WRITE});
}

static void one_layer_of_one_level_is_drawn_to(void **state)
{
    (void)state;
    check(&(struct scene){600, 430, 3, 3, 1, 1, 0, 6000, QUAD_KINDS, RG_RGBA16F, RG_BLEND_OVER,
                          RG_DEPTH_WRITE});
}

static void few_pixels_are_drawn_to(void **state)
{
    (void)state;
    const int sizes[][2] = {{1, 1}, {3, 200}, {64, 64}, {65, 63}, {129, 8}};
    for (int i = 0; i < COUNT_OF(sizes); i++)
        check(&(struct scene){sizes[i][0], sizes[i][1], 1, 1, 0, 0, 0, 3000, QUAD_KINDS, RG_RGBA32F,
                              RG_BLEND_OVER, RG_DEPTH_TEST});
}

// So many pixels that tiles of the smallest size would exceed the largest number of tiles.
static void many_pixels_are_drawn_to(void **state)
{
    (void)state;
    check(&(struct scene){4500, 4000, 1, 1, 0, 0, 0, 3000, QUAD_KINDS, RG_RGBA8, RG_BLEND_ADD,
                          RG_DEPTH_OFF});
}

static void some_items_of_a_buffer_are_drawn(void **state)
{
    (void)state;
    const int firsts[] = {1, 255, 4097}, items[] = {1, 15, 257, 4099};
    for (int i = 0; i < COUNT_OF(firsts); i++)
        for (int k = 0; k < COUNT_OF(items); k++)
            check(&(struct scene){40, 30, 1, 1, 0, 0, firsts[i], items[k], QUAD_LARGE, RG_RGBA8,
                                  RG_BLEND_OVER, RG_DEPTH_OFF});
}

// More items than a new device has room for: the first run takes several rounds.
static void many_items_are_drawn(void **state)
{
    (void)state;
    check(&(struct scene){640, 360, 1, 1, 0, 0, 0, 150000, QUAD_STREAK, RG_RGBA16F, RG_BLEND_OVER,
                          RG_DEPTH_OFF});
}

// Room ends amid a batch of clipped items, and the whole batch is drawn again.
static void many_clipped_items_are_drawn(void **state)
{
    (void)state;
    check(&(struct scene){40, 30, 1, 1, 0, 0, 0, 150000, QUAD_BEHIND, RG_RGBA32F, RG_BLEND_ADD,
                          RG_DEPTH_OFF});
}

static void hush(enum rg_log_level level, const char *line, void *user)
{
    (void)level, (void)line, (void)user;
}

// cpu draws without packing kernels, and has no code for them.
static void kernels_that_pack_are_refused(void **state)
{
    (void)state;
    static const char *const names[] = {"cpu", "cpu:reference"};
    for (int i = 0; i < COUNT_OF(names); i++) {
        struct rg_device *device = rg_device_open(names[i]);
        assert_non_null(device);
        rg_log_listen(hush, NULL);
        assert_null(rg_pass_create(device, "test_quads_count"));
        assert_null(rg_pass_create(device, "test_quads_emit"));
        rg_log_listen(NULL, NULL);
        assert_non_null(strstr(rg_last_error(), "kernel 'test_quads_emit'"));
        assert_true(rg_device_close(device));
    }
}

// --- items with nothing to do ---

// Rows of two and a half blocks, after the columns that the run leaves out.
enum { IDLE_WIDTH = 5 * TEST_IDLE_ITEMS / 2 + 3, IDLE_ROWS = 7, IDLE_BEGIN = 3 };

// How often each item ran on a device, in a run without the first columns.
static void count_runs(const char *name, const uint32_t *marks, uint32_t *runs)
{
    struct rg_device *device = rg_device_open(name);
    assert_non_null(device);
    const int64_t size = IDLE_WIDTH * IDLE_ROWS * (int64_t)sizeof(*runs);
    struct rg_buf *marked = rg_buf_create_with(device, marks, size, "marks");
    struct rg_buf *counted = rg_buf_create_with(device, runs, size, "runs");
    struct rg_pass *pass = rg_pass_create(device, "test_idle");
    assert_non_null(pass);
    assert_true(
        rg_pass_run(pass, &(struct rg_run){.params = &(test_idle_params){IDLE_WIDTH},
                                           .slots = {[1].buf = marked, [2].buf = counted},
                                           .extent = {IDLE_WIDTH - IDLE_BEGIN, IDLE_ROWS, 1},
                                           .origin = {IDLE_BEGIN, 0, 0}}));
    assert_true(rg_buf_read(counted, 0, runs, size));
    rg_pass_destroy(pass);
    rg_buf_destroy(marked);
    rg_buf_destroy(counted);
    assert_true(rg_device_close(device));
}

// Whether cpu runs an item: its block is cut short by the row's end, or holds a marked item.
static bool runs_on_cpu(const uint32_t *row, int x)
{
    const int block = IDLE_BEGIN + (x - IDLE_BEGIN) / TEST_IDLE_ITEMS * TEST_IDLE_ITEMS;
    bool marked = block + TEST_IDLE_ITEMS > IDLE_WIDTH;
    for (int i = block; i < block + TEST_IDLE_ITEMS && i < IDLE_WIDTH; i++)
        marked = marked || row[i];
    return marked;
}

// cpu skips whole blocks of items with nothing to do, and no others. The reference runs all items.
// Each runs once.
static void idle_items_are_left_out(void **state)
{
    (void)state;
    uint32_t marks[IDLE_WIDTH * IDLE_ROWS] = {0}, runs[2][IDLE_WIDTH * IDLE_ROWS] = {{0}};
    for (int row = 0; row < IDLE_ROWS; row++)
        marks[row * IDLE_WIDTH + row * (IDLE_WIDTH - 1) / (IDLE_ROWS - 1)] = 1;
    count_runs("cpu", marks, runs[0]);
    count_runs("cpu:reference", marks, runs[1]);
    int left_out = 0;
    for (int i = 0; i < IDLE_WIDTH * IDLE_ROWS; i++) {
        const int x = i % IDLE_WIDTH;
        const bool is_run = x >= IDLE_BEGIN;
        assert_int_equal(runs[1][i], is_run);
        assert_int_equal(runs[0][i], is_run && runs_on_cpu(&marks[i - x], x));
        left_out += runs[0][i] != runs[1][i];
    }
    assert_above(left_out, TEST_IDLE_ITEMS * IDLE_ROWS / 2);
}

// --- unseen items ---

// Runs that begin and end within groups, and runs of more than a batch.
enum { UNSEEN_PX = 96, UNSEEN_ITEMS = 1500, UNSEEN_GROUPS = (UNSEEN_ITEMS + 31) / 32 };

// A device's picture and counts of the items from `begin` to `end`. Without marks it runs the
// program with plain items.
static void draw_marked(const char *name, const float *quads, const uint32_t *marks, int begin,
                        int end, uint32_t *texels, struct rg_counts *counts)
{
    const uint32_t unmarked[UNSEEN_GROUPS] = {0};
    struct rg_device *device = rg_device_open(name);
    assert_non_null(device);
    const struct rg_image_desc desc = {RG_RGBA32F, UNSEEN_PX, UNSEEN_PX, 1, 1};
    const uint32_t none[4] = {0};
    struct rg_image *image = rg_image_create_with(device, &desc, none, "target");
    struct rg_buf *input = rg_buf_create_with(
        device, quads, UNSEEN_ITEMS * TEST_QUAD_WORDS * (int64_t)sizeof(*quads), "quads");
    struct rg_buf *marked =
        rg_buf_create_with(device, marks ? marks : unmarked, UNSEEN_GROUPS * 4, "marks");
    struct rg_pass *pass = rg_pass_create(device, marks ? "test_unseen" : "test_plain");
    assert_true(image && input && marked && pass);
    const struct rg_draw to = {.colour = image, .blend = marks ? RG_BLEND_ADD : RG_BLEND_OFF};
    assert_true(rg_pass_run(
        pass, &(struct rg_run){.params = &(test_quads_params){0},
                               .slots = {[1].buf = input, [2].buf = marks ? marked : NULL},
                               .origin = {begin, 0, 0},
                               .extent = {end - begin, 1, 1},
                               .draw = &to,
                               .counts = counts}));
    assert_true(rg_image_read(image, 0, 0, texels));
    rg_pass_destroy(pass);
    rg_buf_destroy(input);
    rg_buf_destroy(marked);
    rg_image_destroy(image);
    assert_true(rg_device_close(device));
}

// cpu with marks draws the same as the reference with marked quads of no area. The reference
// ignores marks and draws all quads.
static void unseen_items_are_left_out(void **state)
{
    (void)state;
    const int runs[][2] = {{0, UNSEEN_ITEMS}, {31, 33}, {5, 6}, {64, 96}, {45, 1003}, {700, 1499}};
    static float quads[UNSEEN_ITEMS * TEST_QUAD_WORDS], left[UNSEEN_ITEMS * TEST_QUAD_WORDS];
    static uint32_t texels[2][UNSEEN_PX * UNSEEN_PX * 4];
    uint32_t marks[UNSEEN_GROUPS], none[UNSEEN_GROUPS] = {0};
    quads_fill(quads, UNSEEN_ITEMS, UNSEEN_PX, UNSEEN_PX, QUAD_STREAK, 5);
    memcpy(left, quads, sizeof(left));
    for (uint32_t i = 0; i < UNSEEN_GROUPS; i++)
        marks[i] = i % 4 ? (i * 0x9e3779b9u) ^ (i * 0x85ebca6bu) >> 7 : i % 8 ? ~0u : 0;
    for (int i = 0; i < UNSEEN_ITEMS; i++)
        if (marks[i / 32] >> i % 32 & 1)
            memset(left + (ptrdiff_t)i * TEST_QUAD_WORDS, 0, 16 * sizeof(float));
    for (int i = 0; i < COUNT_OF(runs); i++) {
        struct rg_counts counts[2];
        draw_marked("cpu:reference", left, none, runs[i][0], runs[i][1], texels[0], &counts[0]);
        draw_marked("cpu", quads, marks, runs[i][0], runs[i][1], texels[1], &counts[1]);
        assert_memory_equal(texels[0], texels[1], sizeof(texels[0]));
        assert_int_equal(counts[0].fragments, counts[1].fragments);
        draw_marked("cpu:reference", quads, none, runs[i][0], runs[i][1], texels[0], NULL);
        draw_marked("cpu:reference", quads, marks, runs[i][0], runs[i][1], texels[1], NULL);
        assert_memory_equal(texels[0], texels[1], sizeof(texels[0]));
    }
}

// cpu treats pixels of plain items as plain, and no others. It does not list long rows and draws
// them as usual. The reference treats none as plain.
static void plain_items_are_listed_apart(void **state)
{
    (void)state;
    static float quads[UNSEEN_ITEMS * TEST_QUAD_WORDS];
    static uint32_t texels[2][UNSEEN_PX * UNSEEN_PX * 4];
    quads_fill(quads, UNSEEN_ITEMS, UNSEEN_PX, UNSEEN_PX, QUAD_STREAK, 7);
    draw_marked("cpu:reference", quads, NULL, 0, UNSEEN_ITEMS, texels[0], NULL);
    draw_marked("cpu", quads, NULL, 0, UNSEEN_ITEMS, texels[1], NULL);
    int plain = 0, others = 0, taken = 0;
    for (int i = 0; i < UNSEEN_PX * UNSEEN_PX; i++) {
        float due[4], drawn[4];
        memcpy(due, texels[0] + (ptrdiff_t)4 * i, sizeof(due));
        memcpy(drawn, texels[1] + (ptrdiff_t)4 * i, sizeof(drawn));
        const bool is_plain = due[3] > 0 && (int)due[0] % 3 == 0;
        assert_true(due[0] == drawn[0] && due[3] == drawn[3] && due[1] == 0);
        assert_true(drawn[1] == 0 || (is_plain && drawn[1] == 1));
        taken += drawn[1] == 1;
        plain += is_plain;
        others += due[3] > 0 && !is_plain;
    }
    assert_above(plain, 1000);
    assert_above(taken, plain * 3 / 4);
    assert_above(others, 2000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kernels_that_pack_are_refused),
        cmocka_unit_test(depth_is_drawn_alone),
        cmocka_unit_test(one_layer_of_one_level_is_drawn_to),
        cmocka_unit_test(few_pixels_are_drawn_to),
        cmocka_unit_test(many_pixels_are_drawn_to),
        cmocka_unit_test(some_items_of_a_buffer_are_drawn),
        cmocka_unit_test(many_items_are_drawn),
        cmocka_unit_test(many_clipped_items_are_drawn),
        cmocka_unit_test(idle_items_are_left_out),
        cmocka_unit_test(unseen_items_are_left_out),
        cmocka_unit_test(plain_items_are_listed_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
