// Kernels whose items store their own texels: native devices draw these, others dispatch. Both
// leave the same, but for rounding to RGBA8 and RGBA16F, which is the driver's where it draws.
#include <math.h>
#include <stdio.h>

#include "tests/core/device/images/texels.h"
#include "tests/core/device/suite.h"
#include "tests/kernels/image_copy_params.h"
#include "tests/kernels/texels/params.h"

// Items beyond the images have colours, too.
enum { WIDTH = 67, HEIGHT = 33, LAYERS = 3, WIDE = 96, HIGH = 48, DEEP = 5 };

static bool is_native(const struct rg_device *device)
{
    return device->info.native;
}

static struct colour colour_at(int layer, int x, int y)
{
    float channels[4];
    for (int c = 0; c < 4; c++) {
        const uint32_t n = noise((uint32_t)(((layer * HIGH + y) * WIDE + x) * 4 + c));
        channels[c] = ((float)(n >> 8) * 0x1p-24f * 1.5f + 0.01f) * (n & 8 ? -1.0f : 1.0f);
    }
    return (struct colour){channels[0], channels[1], channels[2], channels[3]};
}

static struct rg_buf *make_colours(struct rg_device *device)
{
    struct colour *colours = malloc(DEEP * HIGH * WIDE * sizeof(*colours));
    for (int i = 0; i < DEEP * HIGH * WIDE; i++)
        colours[i] = colour_at(i / (HIGH * WIDE), i % WIDE, i / WIDE % HIGH);
    struct rg_buf *buf = make_buf(device, colours, DEEP * HIGH * WIDE * 4, "colours");
    free(colours);
    return buf;
}

// What the image holds before the run.
static void *texels_before(const struct rg_image_desc *desc, int layer)
{
    void *texels = malloc((size_t)(desc->width * desc->height * rg_format_size(desc->format)));
    random_texels(desc->format, (uint32_t)layer * 7919u, desc->width * desc->height, texels);
    return texels;
}

static struct rg_image *make_image(struct rg_device *device, const struct rg_image_desc *desc)
{
    struct rg_image *image = rg_image_create(device, desc, "target");
    assert_non_null(image);
    for (int layer = 0; layer < desc->layers; layer++) {
        void *texels = texels_before(desc, layer);
        assert_true(rg_image_write(image, layer, 0, texels));
        free(texels);
    }
    return image;
}

// Either code beside the number.
static bool is_code(float v, unsigned char got)
{
    const double inside = v < 0 ? 0 : v > 1 ? 1 : (double)v;
    return fabs(inside * 255 - got) < 1;
}

// The half that is cut off, or the next in magnitude.
static bool is_half(uint16_t cut, uint16_t got)
{
    return got == cut || got == cut + 1;
}

static bool is_stored(const struct rg_device *device, enum rg_format format, struct colour c,
                      const unsigned char *got)
{
    const float channels[4] = {c.r, c.g, c.b, c.a};
    unsigned char due[16];
    uint16_t cut[4], halves[4];
    encode_texel(format, c, due);
    bool is_near = is_native(device) && (format == RG_RGBA8 || format == RG_RGBA16F);
    if (!is_near)
        return !memcmp(due, got, (size_t)rg_format_size(format));
    memcpy(cut, due, sizeof(cut));
    memcpy(halves, got, format == RG_RGBA8 ? 4 : 8);
    for (int i = 0; i < 4; i++)
        is_near = is_near &&
                  (format == RG_RGBA8 ? is_code(channels[i], got[i]) : is_half(cut[i], halves[i]));
    return is_near;
}

static bool lies_in(const struct rg_run *run, int x, int y, int layer)
{
    const struct rg_extent *from = &run->origin, *extent = &run->extent;
    return x >= from->width && x < from->width + extent->width && y >= from->height &&
           y < from->height + extent->height && layer >= from->depth &&
           layer < from->depth + extent->depth;
}

static void check_layer(const struct rg_run *run, struct rg_image *image, int layer)
{
    const enum rg_format format = image->desc.format;
    const int size = rg_format_size(format);
    unsigned char *before = texels_before(&image->desc, layer), *got = malloc(HEIGHT * WIDTH * 16);
    assert_true(rg_image_read(image, layer, 0, got));
    for (int i = 0; i < HEIGHT * WIDTH; i++) {
        const int x = i % WIDTH, y = i / WIDTH;
        const bool ok =
            lies_in(run, x, y, layer)
                ? is_stored(image->device, format, colour_at(layer, x, y), got + i * size)
                : !memcmp(got + i * size, before + i * size, (size_t)size);
        if (!ok)
            fail_msg("%s, from %d, %d, %d on: texel %d, %d of layer %d", rg_format_name(format),
                     run->origin.width, run->origin.height, run->origin.depth, x, y, layer);
    }
    free(before);
    free(got);
}

static void check_store(struct rg_pass *pass, enum rg_format format, struct rg_buf *colours,
                        struct rg_extent origin, struct rg_extent extent)
{
    struct rg_image *image =
        make_image(pass->device, &(struct rg_image_desc){format, WIDTH, HEIGHT, LAYERS, 1});
    const test_texels_params p = {WIDE, HIGH, 0};
    const struct rg_run run = {.params = &p,
                               .slots = {[1].buf = colours, [2].image = image},
                               .origin = origin,
                               .extent = extent};
    assert_true(rg_pass_run(pass, &run));
    for (int layer = 0; layer < LAYERS; layer++)
        check_layer(&run, image, layer);
    rg_image_destroy(image);
}

static void items_store_their_own_texels(void **state)
{
    static const char *const names[] = {[RG_RGBA8] = "test_store_rgba8",
                                        [RG_RGBA16F] = "test_store_rgba16f",
                                        [RG_RGBA32F] = "test_store_rgba32f",
                                        [RG_R32F] = "test_store_r32f"};
    struct rg_buf *colours = make_colours(*state);
    for (int f = RG_RGBA8; f <= RG_R32F; f++) {
        const enum rg_format format = (enum rg_format)f;
        struct rg_pass *pass = rg_pass_create(*state, names[f]);
        assert_non_null(pass);
        assert_int_equal(rg_is_drawn(*state, pass->kernel), is_native(*state));
        check_store(pass, format, colours, (struct rg_extent){0, 0, 0},
                    (struct rg_extent){WIDTH, HEIGHT, LAYERS});
        check_store(pass, format, colours, (struct rg_extent){5, 3, 1},
                    (struct rg_extent){41, 19, 2});
        if (is_native(*state)) { // elsewhere no item may store beyond its image
            check_store(pass, format, colours, (struct rg_extent){60, 30, 2},
                        (struct rg_extent){20, 10, 3});
            check_store(pass, format, colours, (struct rg_extent){WIDTH, 0, 0},
                        (struct rg_extent){9, 9, 1});
        }
        rg_pass_destroy(pass);
    }
    rg_buf_destroy(colours);
}

// The source is smaller than the target.
static void items_may_store_nothing(void **state)
{
    const struct rg_image_desc desc = {RG_RGBA32F, WIDTH, HEIGHT, 1, 1},
                               less = {RG_RGBA32F, 20, 9, 1, 1};
    struct rg_image *source = make_image(*state, &less), *target = make_image(*state, &desc);
    struct rg_pass *copy = rg_pass_create(*state, "test_image_copy");
    const test_image_copy_params p = {0, 0};
    assert_non_null(copy);
    assert_true(
        rg_pass_run(copy, &(struct rg_run){.params = &p,
                                           .slots = {[1].image = source, [2].image = target},
                                           .extent = {WIDTH, HEIGHT, 1}}));
    struct colour *from = texels_before(&less, 0), *before = texels_before(&desc, 0);
    struct colour *got = malloc(WIDTH * HEIGHT * sizeof(*got));
    assert_true(rg_image_read(target, 0, 0, got));
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int x = i % WIDTH, y = i / WIDTH;
        const struct colour *due =
            x < less.width && y < less.height ? &from[y * less.width + x] : &before[i];
        if (memcmp(&got[i], due, sizeof(*due)) != 0)
            fail_msg("texel %d, %d", x, y);
    }
    free(from);
    free(before);
    free(got);
    rg_pass_destroy(copy);
    rg_image_destroy(source);
    rg_image_destroy(target);
}

// Draws and dispatches read what the other has written, in more runs than a batch has.
static void draws_and_dispatches_follow_each_other(void **state)
{
    enum { RUNS = 40, SIDE = 24, TEXELS = SIDE * SIDE, WORDS = RUNS * TEXELS * 4 };
    const struct rg_image_desc desc = {RG_RGBA32F, SIDE, SIDE, RUNS, 1};
    struct rg_pass *store = rg_pass_create(*state, "test_store_rgba32f");
    struct rg_pass *fetch = rg_pass_create(*state, "test_fetch_rgba32f");
    struct rg_image *first = make_image(*state, &desc), *second = make_image(*state, &desc);
    uint32_t *words = malloc(WORDS * sizeof(*words)), *got = malloc(TEXELS * 16);
    random_texels(RG_RGBA32F, 1, RUNS * TEXELS, words);
    struct rg_buf *from = make_buf(*state, words, WORDS, "from");
    struct rg_buf *between = filled_buf(*state, 0x40404040u, WORDS, "between");
    const test_texels_params p = {SIDE, SIDE, 0};
    assert_true(store && fetch);
    for (int z = 0; z < RUNS; z++) {
        struct rg_run run = {.params = &p,
                             .slots = {[1].buf = from, [2].image = first},
                             .origin = {0, 0, z},
                             .extent = {SIDE, SIDE, 1}};
        assert_true(rg_pass_run(store, &run));
        run.slots[1] = (struct rg_binding){.image = first};
        run.slots[2] = (struct rg_binding){.buf = between};
        assert_true(rg_pass_run(fetch, &run));
        run.slots[1] = (struct rg_binding){.buf = between};
        run.slots[2] = (struct rg_binding){.image = second};
        assert_true(rg_pass_run(store, &run));
    }
    for (int z = 0; z < RUNS; z++) {
        assert_true(rg_image_read(second, z, 0, got));
        assert_memory_equal(got, words + z * TEXELS * 4, TEXELS * 16);
    }
    free(words);
    free(got);
    rg_pass_destroy(store);
    rg_pass_destroy(fetch);
    rg_image_destroy(first);
    rg_image_destroy(second);
    rg_buf_destroy(from);
    rg_buf_destroy(between);
}

// A format that cannot be drawn to is stored to, by dispatches; an image that is too large to be
// drawn to is refused.
static void what_cannot_be_drawn_is_told(void **state)
{
    struct rg_device *device = *state;
    const struct rg_image_desc desc = {RG_RGBA8, 4, 4, 1, 1};
    const test_texels_params p = {4, 4, 0};
    if (!is_native(device))
        return;
    struct rg_buf *colours = make_colours(device);
    struct rg_image *image = make_image(device, &desc);
    struct rg_pass *drawn = rg_pass_create(device, "test_store_rgba8");
    const struct rg_run run = {
        .params = &p, .slots = {[1].buf = colours, [2].image = image}, .extent = {4, 4, 1}};
    assert_non_null(drawn);
    image->desc.width = 20000;
    assert_refused(rg_pass_run(drawn, &run), "'target' is 20000x4; at most 16384 px a side");
    image->desc.width = 4;
    rg_pass_destroy(drawn);
    const unsigned uses = device->info.limits.formats[RG_RGBA8].uses;
    device->info.limits.formats[RG_RGBA8].uses &= ~(unsigned)RG_USE_DRAW;
    struct rg_pass *pass = rg_pass_create(device, "test_store_rgba8");
    assert_non_null(pass);
    assert_false(rg_is_drawn(device, pass->kernel));
    assert_true(rg_pass_run(pass, &run));
    unsigned char got[4 * 4 * 4], due[4];
    assert_true(rg_image_read(image, 0, 0, got));
    struct colour *all = (struct colour *)read_words(colours, 4 * 4 * 4);
    for (int i = 0; i < 4 * 4; i++) {
        encode_texel(RG_RGBA8, all[i], due);
        assert_memory_equal(got + 4 * i, due, 4);
    }
    free(all);
    rg_pass_destroy(pass);
    device->info.limits.formats[RG_RGBA8].uses = uses;
    rg_image_destroy(image);
    rg_buf_destroy(colours);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(items_store_their_own_texels),
    cmocka_unit_test(items_may_store_nothing),
    cmocka_unit_test(draws_and_dispatches_follow_each_other),
    cmocka_unit_test(what_cannot_be_drawn_is_told),
};
const struct suite_tests pass_tests = {tests, COUNT_OF(tests)};
