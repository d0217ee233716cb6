// Light that gathers in a layer of floats from black and then meets what lies behind it
// (core/techniques/stages/layer.h), against double precision.
#include <math.h>
#include <stdio.h>

#include "kernels/scenery/layer/params.h"
#include "tests/core/device/suite.h"
#include "tests/kernels/drawing/quads_params.h"

enum { SIDE = 8, TEXELS = SIDE * SIDE };

static const struct rg_image_desc layer_desc = {RG_RGBA32F, SIDE, SIDE, 1, 1},
                                  behind_desc = {RG_RGBA16F, SIDE, SIDE, 1, 1};

// The value of a half, by its definition.
static double value_of(uint32_t half)
{
    const double fraction = half & 0x3ff;
    const int exponent = (int)(half >> 10 & 31);
    const double size =
        exponent ? ldexp(1 + fraction / 1024, exponent - 15) : ldexp(fraction / 1024, -14);
    return half & 0x8000 ? -size : size;
}

// The half nearest to a number, of two as near the even one. Subnormal ones are not stored: 0 and
// the least normal half are neighbours.
static uint32_t half_nearest(double value)
{
    uint32_t best = 0;
    for (uint32_t half = 0; half < 0x7c00; half = half ? half + 1 : 0x400) {
        const double off = fabs(value_of(half) - fabs(value)),
                     least = fabs(value_of(best) - fabs(value));
        if (off < least || (off == least && !(half & 1) && half != 0x400))
            best = half;
    }
    return value < 0 ? best | 0x8000 : best;
}

struct layer {
    struct rg_device *device;
    struct rg_image *light, *behind, *target;
};

static struct layer make_layer(struct rg_device *device, const float *texels,
                               const uint16_t *behind)
{
    static const float none[4] = {0};
    const struct layer l = {.device = device,
                            .light = rg_image_create_with(device, &layer_desc, none, "light"),
                            .behind = rg_image_create_with(device, &behind_desc, none, "behind"),
                            .target = rg_image_create_with(device, &behind_desc, none, "target")};
    assert_true(l.light && l.behind && l.target);
    assert_true(!texels || rg_image_write(l.light, 0, 0, texels));
    assert_true(rg_image_write(l.behind, 0, 0, behind));
    return l;
}

static void free_layer(const struct layer *l)
{
    rg_image_destroy(l->light);
    rg_image_destroy(l->behind);
    rg_image_destroy(l->target);
}

static void meet(const struct layer *l, uint16_t halves[4 * TEXELS])
{
    const layer_params p = {0};
    struct rg_pass *pass = rg_pass_create(l->device, "layer_meet");
    assert_true(
        pass &&
        rg_pass_run(pass, &(struct rg_run){.params = &p,
                                           .slots = {[1].image = l->light, [2].image = l->behind},
                                           .extent = {1, 1, 1},
                                           .draw = &(struct rg_draw){.colour = l->target}}));
    assert_true(rg_image_read(l->target, 0, 0, halves));
    rg_pass_destroy(pass);
}

// Blends so many layers of one light and alpha over all of the layer.
static void gather(const struct layer *l, int layers, double light, double alpha)
{
    static const float corners[16] = {-1, -1, 0, 1, 1, -1, 0, 1, 1, 1, 0, 1, -1, 1, 0, 1};
    const test_quads_params p = {0};
    float *quads = malloc((size_t)layers * TEST_QUAD_WORDS * sizeof(float));
    for (int i = 0; i < layers; i++) {
        memcpy(quads + i * TEST_QUAD_WORDS, corners, sizeof(corners));
        for (int c = 0; c < 3; c++)
            quads[i * TEST_QUAD_WORDS + 16 + c] = (float)(light / layers);
        quads[i * TEST_QUAD_WORDS + 19] = (float)(alpha / layers);
    }
    struct rg_buf *input = make_buf(l->device, quads, layers * TEST_QUAD_WORDS, "layers");
    struct rg_pass *pass = rg_pass_create(l->device, "test_quads");
    assert_true(
        pass && input &&
        rg_pass_run(pass, &(struct rg_run){.params = &p,
                                           .slots = {[1].buf = input},
                                           .extent = {layers, 1, 1},
                                           .draw = &(struct rg_draw){.colour = l->light,
                                                                     .blend = RG_BLEND_OVER}}));
    rg_pass_destroy(pass);
    rg_buf_destroy(input);
    free(quads);
}

// What layers leave of a pixel, by the sum of a geometric series.
static double due_of(int drawn, int layers, double light, double alpha, double behind)
{
    const double kept = pow(1 - alpha / layers, drawn);
    const double gathered = alpha > 0 ? light / alpha * (1 - kept) : light * drawn / layers;
    return gathered + behind * kept;
}

// Layers that the kernel of quads leaves out at a pixel.
static int drawn_at(int layers, int x, int y)
{
    int drawn = 0;
    for (int i = 0; i < layers; i++)
        drawn += ((x ^ y ^ i) & 15) != 15;
    return drawn;
}

static void expect_light(struct rg_device *device, int layers, double light, double alpha,
                         double behind)
{
    uint16_t halves[4 * TEXELS], back[4 * TEXELS];
    const uint32_t half = half_nearest(behind);
    for (int i = 0; i < 4 * TEXELS; i++)
        back[i] = (uint16_t)half;
    const struct layer l = make_layer(device, NULL, back);
    gather(&l, layers, light, alpha);
    meet(&l, halves);
    for (int i = 0; i < TEXELS; i++) {
        const int drawn = drawn_at(layers, i % SIDE, i / SIDE);
        const double due = due_of(drawn, layers, light, alpha, value_of(back[4 * i]));
        const double is = value_of(halves[4 * i]);
        if (!(fabs(is - due) <= 0.001 * (light + alpha * behind) + due / 2048))
            fail_msg("%d layers of %g / %d, alpha %g, onto %g: %.6g at texel %d, not %.6g", layers,
                     light, layers, alpha, behind, is, i, due);
    }
    free_layer(&l);
}

static void faint_layers_add_up(void **state)
{
    static const int counts[] = {1, 30, 1000, 10000};
    static const double behinds[] = {0, 0.02, 0.6, 1, 40, 2000};
    for (int n = 0; n < COUNT_OF(counts); n++)
        for (int b = 0; b < COUNT_OF(behinds); b++) {
            expect_light(*state, counts[n], 1, 0, behinds[b]);
            expect_light(*state, counts[n], 1, 0.5, behinds[b]);
            expect_light(*state, counts[n], 60, 1, behinds[b]);
        }
}

// Numbers between halves, halves, the least and the largest, and what no half holds.
static float number(int i)
{
    static const float odd[] = {0.0f,     -0.0f,  6.103515625e-05f, 3.0517578e-05f, 3.06e-05f,
                                6.1e-05f, 1e-7f,  65504.0f,         65519.0f,       65521.0f,
                                1e9f,     -1e-9f, 1.00048828125f,   1.00146484375f, 2049.0f,
                                2051.0f};
    const float unit = (float)(noise((uint32_t)i) >> 8) / (1 << 24);
    return i < COUNT_OF(odd) ? odd[i]
                             : ldexpf(1 + unit, (int)(noise((uint32_t)i + 77) % 30) - 14) *
                                   (i & 1 ? -1.0f : 1.0f);
}

// What meets a clear background is rounded to the nearest half, once.
static void they_are_rounded_to_the_nearest_half(void **state)
{
    static const uint16_t black[4 * TEXELS] = {0};
    float texels[4 * TEXELS];
    uint16_t halves[4 * TEXELS];
    for (int i = 0; i < 4 * TEXELS; i++)
        texels[i] = number(i);
    const struct layer l = make_layer(*state, texels, black);
    meet(&l, halves);
    for (int i = 0; i < 4 * TEXELS; i++) {
        const uint32_t due = half_nearest((double)texels[i]);
        if (halves[i] != due && ((halves[i] | due) & 0x7fff)) // a zero may have either sign
            fail_msg("%.9g becomes %04x, not %04x", (double)texels[i], halves[i], (unsigned)due);
    }
    free_layer(&l);
}

// Where no rain is, a background stays as it is.
static void a_clear_layer_changes_nothing(void **state)
{
    uint16_t back[4 * TEXELS], halves[4 * TEXELS];
    for (int i = 0; i < 4 * TEXELS; i++)
        back[i] = (uint16_t)(0x400 + noise((uint32_t)i) % 0x7800);
    const struct layer l = make_layer(*state, NULL, back);
    meet(&l, halves);
    assert_memory_equal(halves, back, sizeof(back));
    free_layer(&l);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(faint_layers_add_up),
    cmocka_unit_test(they_are_rounded_to_the_nearest_half),
    cmocka_unit_test(a_clear_layer_changes_nothing),
};

const struct suite_tests layer_tests = {tests, COUNT_OF(tests)};
