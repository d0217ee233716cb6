// DRAW programs with lights: every device draws as cpu:reference to the last bit, and lights add
// up.
#include <stdio.h>

#include "tests/core/device/draws/quads.h"
#include "tests/core/device/images/texels.h"
#include "tests/core/device/suite.h"
#include "tests/kernels/drawing/lights_params.h"
#include "tests/tools/expect.h"

enum { WIDTH = 333, HEIGHT = 217, PIXELS = WIDTH * HEIGHT, LIGHTS = 16, LAYERS = 3 };
enum { STREAKS = 3000, LARGE = 20, QUADS = STREAKS + LARGE };

// One way to draw, with lights first to first + lights - 1.
struct way {
    const char *name;
    enum rg_format format;
    enum rg_blend blend;
    enum rg_depth_mode depth;
    int first, lights;
    bool plain;
};

// A draw's objects on one device.
struct rig {
    struct rg_pass *pass;
    struct rg_buf *quads, *lights;
    struct rg_image *shadows, *gobos;
};

static float unit(uint32_t n)
{
    return (float)(noise(n) >> 8) * 0x1p-24f;
}

static void fill_lights(struct test_light *lights)
{
    memset(lights, 0, LIGHTS * sizeof(*lights));
    for (int i = 0; i < LIGHTS; i++) {
        const uint32_t n = 100 * (uint32_t)i;
        float *matrix = &lights[i].to_map.xx;
        lights[i].kind = i % 3 ? TEST_LIGHT_POINT : TEST_LIGHT_SUN;
        lights[i].at = (v3){4 * unit(n), 3 * unit(n + 1), unit(n + 2) - 1};
        lights[i].colour = (rgba){unit(n + 3), unit(n + 4), unit(n + 5), 1};
        lights[i].layer = i % (LAYERS + 1) - 1;
        lights[i].bias = 0.25f * unit(n + 6);
        lights[i].reach = 2 * unit(n + 7);
        for (uint32_t k = 0; k < 15; k++)
            matrix[k] = unit(n + 8 + k) - 0.25f;
        lights[i].to_map.ww = 1;
    }
}

static struct rg_image *seeded_image(struct rg_device *device, struct rg_image_desc desc)
{
    struct rg_image *image = rg_image_create(device, &desc, rg_format_name(desc.format));
    assert_non_null(image);
    uint32_t *texels = malloc((size_t)(desc.width * desc.height) * 4);
    for (int layer = 0; layer < desc.layers; layer++) {
        for (int level = 0; level < desc.levels; level++) {
            const int count = rg_level_size(desc.width, level) * rg_level_size(desc.height, level);
            random_texels(desc.format, (uint32_t)(10 * layer + level), count, texels);
            if (desc.format == RG_R16F) // 0.5 to 1
                for (int i = 0; i < count; i++)
                    ((uint16_t *)texels)[i] =
                        (uint16_t)((((uint16_t *)texels)[i] & 0x3ffu) | 0x3800u);
            assert_true(rg_image_write(image, layer, level, texels));
        }
    }
    free(texels);
    return image;
}

static struct rig make_rig(struct rg_device *device, const char *program)
{
    struct test_light lights[LIGHTS];
    float *quads = malloc(QUADS * TEST_QUAD_WORDS * sizeof(float));
    fill_lights(lights);
    quads_fill(quads, LARGE, WIDTH, HEIGHT, QUAD_LARGE, 3);
    quads_fill(quads + LARGE * TEST_QUAD_WORDS, STREAKS, WIDTH, HEIGHT, QUAD_STREAK, 4);
    const struct rig rig = {
        .pass = rg_pass_create(device, program),
        .quads = make_buf(device, quads, QUADS * TEST_QUAD_WORDS, "quads"),
        .lights = make_buf(device, lights, (int)(sizeof(lights) / 4), "lights"),
        .shadows = seeded_image(device, (struct rg_image_desc){RG_D32F, 64, 48, LAYERS, 1}),
        .gobos = seeded_image(device, (struct rg_image_desc){RG_R16F, 33, 17, LAYERS, 4}),
    };
    assert_non_null(rig.pass);
    free(quads);
    return rig;
}

static void destroy_rig(struct rig *rig)
{
    rg_pass_destroy(rig->pass);
    rg_buf_destroy(rig->quads);
    rg_buf_destroy(rig->lights);
    rg_image_destroy(rig->shadows);
    rg_image_destroy(rig->gobos);
}

// Colour, then depth; the caller frees them.
static uint32_t *draw(const struct rig *rig, const struct way *way, size_t *words)
{
    struct rg_device *device = rig->pass->device;
    const test_lights_params p = {way->lights, way->first, way->plain, 4.0f / WIDTH};
    const uint32_t black[4] = {0};
    const float far_away = 1.0f;
    const struct rg_image_desc coloured = {way->format, WIDTH, HEIGHT, 1, 1};
    const struct rg_image_desc deep = {RG_D32F, WIDTH, HEIGHT, 1, 1};
    struct rg_image *colour = rg_image_create_with(device, &coloured, black, "colour");
    struct rg_image *depth = rg_image_create_with(device, &deep, &far_away, "depth");
    assert_true(colour && depth);
    assert_true(rg_pass_run(rig->pass, &(struct rg_run){.params = &p,
                                                        .slots = {[1].buf = rig->quads,
                                                                  [2].buf = rig->lights,
                                                                  [3].image = rig->shadows,
                                                                  [4].image = rig->gobos},
                                                        .extent = {QUADS, 1, 1},
                                                        .draw = &(struct rg_draw){
                                                            .colour = colour,
                                                            .depth = depth,
                                                            .blend = way->blend,
                                                            .depth_mode = way->depth,
                                                        }}));
    const size_t colour_words = (size_t)PIXELS * (size_t)rg_format_size(way->format) / 4;
    uint32_t *drawn = malloc((colour_words + PIXELS) * 4);
    assert_true(rg_image_read(colour, 0, 0, drawn) &&
                rg_image_read(depth, 0, 0, drawn + colour_words));
    rg_image_destroy(colour);
    rg_image_destroy(depth);
    *words = colour_words + PIXELS;
    return drawn;
}

static const struct way ways[] = {
    {"no light", RG_RGBA16F, RG_BLEND_OFF, RG_DEPTH_WRITE, 0, 0, false},
    {"one light", RG_RGBA16F, RG_BLEND_OFF, RG_DEPTH_WRITE, 3, 1, false},
    {"six lights", RG_RGBA8, RG_BLEND_OVER, RG_DEPTH_OFF, 2, 6, false},
    {"sixteen lights", RG_RGBA16F, RG_BLEND_OVER, RG_DEPTH_TEST, 0, 16, false},
    {"sixteen lights, as they are", RG_RGBA32F, RG_BLEND_ADD, RG_DEPTH_WRITE, 0, 16, true},
};

static void expect_alike(const struct rig *due_rig, const struct rig *rig, const char *as)
{
    for (int w = 0; w < COUNT_OF(ways); w++) {
        size_t words;
        uint32_t *due = draw(due_rig, &ways[w], &words);
        uint32_t *drawn = draw(rig, &ways[w], &words);
        for (size_t i = 0; i < words; i++)
            if (due[i] != drawn[i])
                fail_msg("%s: word %zu is %08x, not %08x as %s", ways[w].name, i,
                         (unsigned)drawn[i], (unsigned)due[i], as);
        free(due);
        free(drawn);
    }
}

static void programs_with_lights_draw_alike(void **state)
{
    struct rg_device *reference = rg_device_open("cpu:reference");
    struct rig due = make_rig(reference, "test_lights"), rig = make_rig(*state, "test_lights");
    expect_alike(&due, &rig, "on cpu:reference");
    destroy_rig(&due);
    destroy_rig(&rig);
    assert_true(rg_device_close(reference));
}

// A device may store records for an item and a light, which pixels would compute anyway. Thus
// programs with and without records draw the same picture.
static void records_of_lights_change_nothing(void **state)
{
    struct rig due = make_rig(*state, "test_lights");
    struct rig rig = make_rig(*state, "test_lights_recorded");
    expect_alike(&due, &rig, "without records");
    destroy_rig(&due);
    destroy_rig(&rig);
}

static void check_sum(const struct rig *rig, int lights, const float *sums)
{
    const struct way all = {"", RG_RGBA32F, RG_BLEND_OFF, RG_DEPTH_WRITE, 0, lights, true};
    size_t words;
    uint32_t *together = draw(rig, &all, &words);
    for (int i = 0; i < PIXELS * 4; i++)
        if (memcmp(&together[i], &sums[i], 4))
            fail_msg("%d lights: channel %d of pixel %d is %a, not %a", lights, i % 4, i / 4,
                     (double)((const float *)together)[i], (double)sums[i]);
    free(together);
}

// All lights together give the float sum of each light alone, in their order.
static void lights_add_up_in_order(void **state)
{
    struct rig rig = make_rig(*state, "test_lights");
    size_t words;
    float *sums = calloc(PIXELS * 4, sizeof(*sums));
    for (int light = 0; light < LIGHTS; light++) {
        const struct way one = {"", RG_RGBA32F, RG_BLEND_OFF, RG_DEPTH_WRITE, light, 1, true};
        uint32_t *alone = draw(&rig, &one, &words);
        for (int i = 0; i < PIXELS * 4; i++)
            sums[i] += ((const float *)alone)[i];
        free(alone);
        if (light == 5 || light == LIGHTS - 1)
            check_sum(&rig, light + 1, sums);
    }
    int lit = 0;
    for (int i = 0; i < PIXELS; i++)
        lit += sums[4 * i + 3] > 0.0f;
    assert_between(lit, PIXELS / 4, PIXELS);
    free(sums);
    destroy_rig(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(programs_with_lights_draw_alike),
    cmocka_unit_test(records_of_lights_change_nothing),
    cmocka_unit_test(lights_add_up_in_order),
};
const struct suite_tests light_tests = {tests, COUNT_OF(tests)};
