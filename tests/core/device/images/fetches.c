// Kernels fetch and store texels of every format as the host computes them.
#include <math.h>
#include <stdio.h>

#include "tests/core/device/images/texels.h"
#include "tests/core/device/suite.h"
#include "tests/kernels/image_copy_params.h"
#include "tests/kernels/texels/params.h"

static const char *const format_names[RG_FORMAT_COUNT] = {NULL,   "rgba8", "rgba16f",  "rgba32f",
                                                          "r32f", "r16f",  "rg11b10f", "d32f"};

static struct rg_pass *format_pass(struct rg_device *device, const char *verb, int format)
{
    char name[64];
    snprintf(name, sizeof(name), "test_%s_%s", verb, format_names[format]);
    struct rg_pass *pass = rg_pass_create(device, name);
    assert_non_null(pass);
    return pass;
}

static void check_fetch(struct rg_pass *pass, struct rg_image *image, int level)
{
    const struct rg_image_desc *desc = &image->desc;
    const struct test_texels_params params = {rg_level_size(desc->width, level),
                                              rg_level_size(desc->height, level), level};
    const int texels = params.width * params.height, size = rg_format_size(desc->format);
    struct rg_buf *colours =
        filled_buf(pass->device, 0xcacacacau, texels * desc->layers * 4, "colours");
    assert_true(
        rg_pass_run(pass, &(struct rg_run){.params = &params,
                                           .slots = {[1].image = image, [2].buf = colours},
                                           .extent = {params.width, params.height, desc->layers}}));
    struct colour *got = (struct colour *)read_words(colours, texels * desc->layers * 4);
    char *packed = malloc((size_t)(texels * size));
    for (int layer = 0; layer < desc->layers; layer++) {
        random_texels(desc->format, (uint32_t)(level * 10 + layer), texels, packed);
        for (int i = 0; i < texels; i++) {
            const struct colour expected = decode_texel(desc->format, packed + i * size);
            if (memcmp(&got[layer * texels + i], &expected, sizeof(expected)))
                fail_msg("%s, layer %d, level %d, texel %d", rg_format_name(desc->format), layer,
                         level, i);
        }
    }
    free(packed);
    free(got);
    rg_buf_destroy(colours);
}

static void kernels_fetch_every_format(void **state)
{
    for (int format = RG_RGBA8; format < RG_FORMAT_COUNT; format++) {
        const struct rg_image_desc desc = {(enum rg_format)format, 67, 33, 3, 7};
        struct rg_image *image = rg_image_create(*state, &desc, "source");
        struct rg_pass *pass = format_pass(*state, "fetch", format);
        assert_non_null(image);
        uint32_t *texels = malloc(67 * 33 * 16);
        for (int level = 0; level < desc.levels; level++) {
            for (int layer = 0; layer < desc.layers; layer++) {
                random_texels(desc.format, (uint32_t)(level * 10 + layer),
                              rg_level_size(67, level) * rg_level_size(33, level), texels);
                assert_true(rg_image_write(image, layer, level, texels));
            }
        }
        for (int level = 0; level < desc.levels; level++)
            check_fetch(pass, image, level);
        free(texels);
        rg_pass_destroy(pass);
        rg_image_destroy(image);
    }
}

// All finite halves, among neighbours of every kind: with odd rows, the pairs that share a word
// change from row to row.
static void kernels_fetch_every_half(void **state)
{
    enum { WIDTH = 255, HEIGHT = 257, HALVES = WIDTH * HEIGHT }; // 65,536 but for the last, a NaN
    uint16_t *halves = malloc(HALVES * sizeof(*halves));
    for (uint32_t i = 0; i < HALVES; i++)
        halves[i] = (uint16_t)((i & 0x7c00) == 0x7c00 ? i & ~0x4000u : i);
    struct rg_image *image =
        rg_image_create(*state, &(struct rg_image_desc){RG_R16F, WIDTH, HEIGHT, 1, 1}, "halves");
    struct rg_buf *colours = filled_buf(*state, 0xcacacacau, HALVES * 4, "colours");
    struct rg_pass *pass = format_pass(*state, "fetch", RG_R16F);
    assert_true(image && rg_image_write(image, 0, 0, halves));
    const struct test_texels_params params = {WIDTH, HEIGHT, 0};
    assert_true(rg_pass_run(pass, &(struct rg_run){.params = &params,
                                                   .slots = {[1].image = image, [2].buf = colours},
                                                   .extent = {WIDTH, HEIGHT, 1}}));
    struct colour *got = (struct colour *)read_words(colours, HALVES * 4);
    for (int i = 0; i < HALVES; i++) {
        const struct colour due = decode_texel(RG_R16F, &halves[i]);
        if (memcmp(&got[i], &due, sizeof(due)))
            fail_msg("half %04x is %a, not %a", halves[i], (double)got[i].r, (double)due.r);
    }
    free(got);
    free(halves);
    rg_pass_destroy(pass);
    rg_buf_destroy(colours);
    rg_image_destroy(image);
}

// Colours inside and outside a format's range, with ties of halves and of bytes among them.
static float random_channel(uint32_t n)
{
    const float unit = (float)(noise(n) >> 8) * 0x1p-24f;
    switch (n % 5) {
    case 0:
        return (float)(noise(n) % 511) / 510.0f;
    case 1:
        return unit * 3.0f - 1.0f;
    case 2:
        return ldexpf(unit + 0.5f, (int)(noise(~n) % 60) - 30);
    case 3:
        return -ldexpf(unit + 0.5f, (int)(noise(~n) % 60) - 30);
    default:
        return (float)(2048 + n % 2048) * 0x1p-11f;
    }
}

static void check_stores(const struct rg_image_desc *desc, struct rg_image *image,
                         const struct colour *colours)
{
    const int size = rg_format_size(desc->format), texels = desc->width * desc->height;
    unsigned char *back = malloc((size_t)(texels * size));
    for (int layer = 0; layer < desc->layers; layer++) {
        assert_true(rg_image_read(image, layer, 0, back));
        for (int i = 0; i < texels; i++) {
            unsigned char expected[16];
            encode_texel(desc->format, colours[layer * texels + i], expected);
            if (memcmp(back + i * size, expected, (size_t)size))
                fail_msg("%s, layer %d, texel %d: colour %a %a %a %a", rg_format_name(desc->format),
                         layer, i, (double)colours[layer * texels + i].r,
                         (double)colours[layer * texels + i].g,
                         (double)colours[layer * texels + i].b,
                         (double)colours[layer * texels + i].a);
        }
    }
    free(back);
}

static void kernels_store_every_storable_format(void **state)
{
    enum { WIDTH = 129, HEIGHT = 65, LAYERS = 2, COLOURS = WIDTH * HEIGHT * LAYERS };
    float *channels = malloc(COLOURS * sizeof(struct colour));
    for (uint32_t i = 0; i < COLOURS * 4; i++)
        channels[i] = random_channel(i + i / 7);
    struct rg_buf *source = make_buf(*state, channels, COLOURS * 4, "colours");
    for (int format = RG_RGBA8; format <= RG_R32F; format++) {
        const struct rg_image_desc desc = {(enum rg_format)format, WIDTH, HEIGHT, LAYERS, 1};
        struct rg_image *image = rg_image_create(*state, &desc, "target");
        struct rg_pass *pass = format_pass(*state, "store", format);
        assert_non_null(image);
        const struct test_texels_params params = {WIDTH, HEIGHT, 0};
        assert_true(
            rg_pass_run(pass, &(struct rg_run){.params = &params,
                                               .slots = {[1].buf = source, [2].image = image},
                                               .extent = {WIDTH, HEIGHT, LAYERS}}));
        check_stores(&desc, image, (const struct colour *)channels);
        rg_pass_destroy(pass);
        rg_image_destroy(image);
    }
    rg_buf_destroy(source);
    free(channels);
}

// Store, fetch, store: each pass sees the previous pass's writes.
static void passes_read_what_passes_wrote(void **state)
{
    enum { WIDTH = 65, HEIGHT = 31, TEXELS = WIDTH * HEIGHT };
    const struct rg_image_desc desc = {RG_RGBA32F, WIDTH, HEIGHT, 1, 1};
    struct rg_image *first = rg_image_create(*state, &desc, "first");
    struct rg_image *second = rg_image_create(*state, &desc, "second");
    struct rg_pass *copy = rg_pass_create(*state, "test_image_copy");
    assert_true(first && second && copy);
    uint32_t *texels = malloc(TEXELS * 16), *back = malloc(TEXELS * 16);
    const struct test_image_copy_params params = {0, 0};
    for (uint32_t round = 0; round < 4; round++) {
        random_texels(desc.format, round, TEXELS, texels);
        assert_true(rg_image_write(first, 0, 0, texels));
        struct rg_run run = {.params = &params,
                             .slots = {[1].image = first, [2].image = second},
                             .extent = {WIDTH, HEIGHT, 1}};
        assert_true(rg_pass_run(copy, &run));
        assert_true(rg_image_clear(first, "0123456789abcdef"));
        run.slots[1].image = second;
        run.slots[2].image = first;
        assert_true(rg_pass_run(copy, &run));
        assert_true(rg_image_read(first, 0, 0, back));
        assert_memory_equal(back, texels, TEXELS * 16);
    }
    free(texels);
    free(back);
    rg_pass_destroy(copy);
    rg_image_destroy(first);
    rg_image_destroy(second);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(kernels_fetch_every_format),
    cmocka_unit_test(kernels_fetch_every_half),
    cmocka_unit_test(kernels_store_every_storable_format),
    cmocka_unit_test(passes_read_what_passes_wrote),
};
const struct suite_tests texel_tests = {tests, COUNT_OF(tests)};
