// Images of hundreds of megabytes: an atlas of streaks, a city's textures, a depth map.
#include "tests/core/device/images/texels.h"
#include "tests/core/device/suite.h"
#include "tests/kernels/drawing/quads_params.h"
#include "tests/kernels/texels/filter/params.h"
#include "tests/tools/expect.h"

enum { READS = 4096, APART = 96 }; // texels between starts of layers and levels in the pool

static const struct {
    struct rg_image_desc desc;
    const char *filter;
} shapes[] = {
    {{RG_R16F, 2880, 3606, 10, 12}, "test_filter_r16f"},
    {{RG_RGBA8, 624, 624, 149, 10}, "test_filter_rgba8"},
};

// The texels of a layer's level, in the pool.
static const char *source_of(const struct rg_image_desc *desc, const char *pool, int layer,
                             int level)
{
    return pool + (layer * desc->levels + level) * APART * rg_format_size(desc->format);
}

static char *make_pool(const struct rg_image_desc *desc)
{
    const int count = desc->width * desc->height + desc->layers * desc->levels * APART;
    char *pool = malloc((size_t)count * (size_t)rg_format_size(desc->format));
    random_texels(desc->format, 3, count, pool);
    return pool;
}

struct place {
    int x, y, layer, level;
};

// A random place; some are the last texel of the last layer.
static struct place place_of(const struct rg_image_desc *desc, int i)
{
    const uint32_t n = noise((uint32_t)i);
    const int layer = (int)(n % (uint32_t)desc->layers);
    const int level = (int)((n >> 16) % (uint32_t)desc->levels);
    const int width = rg_level_size(desc->width, level);
    const int height = rg_level_size(desc->height, level);
    if (i % 64 == 0)
        return (struct place){width - 1, height - 1, desc->layers - 1, level};
    return (struct place){(int)(noise(n) % (uint32_t)width), (int)(noise(~n) % (uint32_t)height),
                          layer, level};
}

// Reads at centres of texels.
static struct colour *read_places(struct rg_image *image, const char *kernel)
{
    const struct rg_image_desc *desc = &image->desc;
    float *at = malloc(READS * 4 * sizeof(*at));
    for (int i = 0; i < READS; i++) {
        const struct place p = place_of(desc, i);
        at[4 * i] = ((float)p.x + 0.5f) / (float)rg_level_size(desc->width, p.level);
        at[4 * i + 1] = ((float)p.y + 0.5f) / (float)rg_level_size(desc->height, p.level);
        at[4 * i + 2] = (float)p.layer;
        at[4 * i + 3] = (float)p.level;
    }
    struct rg_buf *places = make_buf(image->device, at, READS * 4, "places");
    struct rg_buf *colours = filled_buf(image->device, 0xcacacacau, READS * 4, "colours");
    struct rg_pass *pass = rg_pass_create(image->device, kernel);
    const test_filter_params p = {TEST_FILTER_NEAREST};
    assert_non_null(pass);
    assert_true(rg_pass_run(
        pass, &(struct rg_run){.params = &p,
                               .slots = {[1].image = image, [2].buf = places, [3].buf = colours},
                               .extent = {READS, 1, 1}}));
    struct colour *got = (struct colour *)read_words(colours, READS * 4);
    rg_pass_destroy(pass);
    rg_buf_destroy(places);
    rg_buf_destroy(colours);
    free(at);
    return got;
}

static void check_places(struct rg_image *image, const char *kernel, const char *pool)
{
    const struct rg_image_desc *desc = &image->desc;
    struct colour *got = read_places(image, kernel);
    for (int i = 0; i < READS; i++) {
        const struct place p = place_of(desc, i);
        const int texel = p.y * rg_level_size(desc->width, p.level) + p.x;
        const struct colour due =
            decode_texel(desc->format, source_of(desc, pool, p.layer, p.level) +
                                           (size_t)texel * (size_t)rg_format_size(desc->format));
        if (memcmp(&got[i], &due, sizeof(due)))
            fail_msg("%s: texel %d, %d of layer %d, level %d is %g, not %g",
                     rg_format_name(desc->format), p.x, p.y, p.layer, p.level, (double)got[i].r,
                     (double)due.r);
    }
    free(got);
}

static void check_last_layer(struct rg_image *image, const char *pool)
{
    const struct rg_image_desc *desc = &image->desc;
    const size_t size = (size_t)(desc->width * desc->height) * (size_t)rg_format_size(desc->format);
    char *back = malloc(size);
    assert_true(rg_image_read(image, desc->layers - 1, 0, back));
    assert_memory_equal(back, source_of(desc, pool, desc->layers - 1, 0), size);
    free(back);
}

static void large_images_keep_and_show_what_was_written(void **state)
{
    for (int s = 0; s < COUNT_OF(shapes); s++) {
        const struct rg_image_desc *desc = &shapes[s].desc;
        char *pool = make_pool(desc);
        struct rg_image *image = rg_image_create(*state, desc, "large");
        assert_non_null(image);
        for (int layer = 0; layer < desc->layers; layer++)
            for (int level = 0; level < desc->levels; level++)
                assert_true(
                    rg_image_write(image, layer, level, source_of(desc, pool, layer, level)));
        check_last_layer(image, pool);
        check_places(image, shapes[s].filter, pool);
        rg_image_destroy(image);
        free(pool);
    }
}

// --- depth ---

enum { DEPTH_PX = 8192, QUADS = 4 };

// A quad of 200 x 200 pixels in each corner of the target, with the depth of its pixels.
static void fill_quads(float *quads)
{
    memset(quads, 0, QUADS * TEST_QUAD_WORDS * sizeof(*quads));
    for (int q = 0; q < QUADS; q++) {
        const float side = 400.0f / DEPTH_PX;
        const float left = q & 1 ? 1 - side : -1, top = q & 2 ? 1 - side : -1;
        const float depth = 0.125f * (float)(q + 1);
        const float corners[16] = {left,  top,        depth,       1,          left + side, top,
                                   depth, 1,          left + side, top + side, depth,       1,
                                   left,  top + side, depth,       1};
        memcpy(quads + q * TEST_QUAD_WORDS, corners, sizeof(corners));
    }
}

static void large_maps_of_depth_are_drawn(void **state)
{
    const struct rg_image_desc desc = {RG_D32F, DEPTH_PX, DEPTH_PX, 1, 1};
    const test_quads_params p = {0};
    const float far_away = 1.0f;
    float quads[QUADS * TEST_QUAD_WORDS];
    fill_quads(quads);
    struct rg_image *depth = rg_image_create_with(*state, &desc, &far_away, "map");
    struct rg_buf *input = make_buf(*state, quads, QUADS * TEST_QUAD_WORDS, "quads");
    struct rg_pass *pass = rg_pass_create(*state, "test_quads");
    assert_true(pass && depth);
    assert_true(rg_pass_run(
        pass,
        &(struct rg_run){.params = &p,
                         .slots = {[1].buf = input},
                         .extent = {QUADS, 1, 1},
                         .draw = &(struct rg_draw){.depth = depth, .depth_mode = RG_DEPTH_WRITE}}));
    float *back = malloc((size_t)DEPTH_PX * DEPTH_PX * sizeof(*back));
    assert_true(rg_image_read(depth, 0, 0, back));
    int64_t counts[QUADS + 1] = {0};
    for (int y = 0; y < DEPTH_PX; y++) {
        for (int x = 0; x < DEPTH_PX; x++) {
            const float got = back[(size_t)y * DEPTH_PX + (size_t)x];
            const bool right = x >= DEPTH_PX - 200, low = y >= DEPTH_PX - 200;
            const int q = (right ? 1 : 0) | (low ? 2 : 0);
            const bool inside = (right || x < 200) && (low || y < 200);
            if (got != far_away && (!inside || got != 0.125f * (float)(q + 1)))
                fail_msg("depth at %d, %d is %g", x, y, (double)got);
            counts[got == far_away ? QUADS : q]++;
        }
    }
    // test_quads leaves out a sixteenth of its pixels.
    for (int q = 0; q < QUADS; q++)
        assert_between(counts[q], 200 * 200 * 14 / 16, 200 * 200);
    free(back);
    rg_pass_destroy(pass);
    rg_buf_destroy(input);
    rg_image_destroy(depth);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(large_images_keep_and_show_what_was_written),
    cmocka_unit_test(large_maps_of_depth_are_drawn),
};
const struct suite_tests large_tests = {tests, COUNT_OF(tests)};
