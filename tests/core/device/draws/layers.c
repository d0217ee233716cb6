// Light gathers in a layer of floats, from black, and then meets the picture behind it
// (core/techniques/stages/layer.h). Checked against double precision.
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

// The half nearest to a number; of two as near, the even one. Subnormal halves are not stored, so
// that 0 and the smallest normal half are neighbours.
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

// Blends this many layers over the whole layer, which share one light and alpha.
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

// The light that layers leave in a pixel, by the sum of a geometric series.
static double due_of(int drawn, int layers, double light, double alpha, double behind)
{
    const double kept = pow(1 - alpha / layers, drawn);
    const double gathered = alpha > 0 ? light / alpha * (1 - kept) : light * drawn / layers;
    return gathered + behind * kept;
}

// How many layers the kernel of quads draws at a pixel; it leaves some out.
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

// --- a loop in C against devices: formats, ways to blend, depth ---

enum { PANES = 300 };

struct pane {
    float colour[4], depth;
};

static float unit(uint32_t i)
{
    return (float)(noise(i) >> 8) / (1 << 24);
}

// From faint to opaque; every tenth pane is opaque.
static struct pane pane_of(int i)
{
    const uint32_t at = 8 * (uint32_t)i;
    const float alpha = i % 10 == 9 ? 1 : unit(at) * unit(at + 1);
    return (struct pane){{alpha * unit(at + 2), alpha * unit(at + 3), alpha * unit(at + 4), alpha},
                         unit(at + 5)};
}

// Panes over the whole target. The kernel leaves some of their pixels out
// (tests/kernels/drawing/quads.h).
static void write_panes(float *quads)
{
    static const float beside[4] = {-1, 1, 1, -1}, below[4] = {-1, -1, 1, 1};
    for (int i = 0; i < PANES; i++) {
        const struct pane pane = pane_of(i);
        float *quad = quads + i * TEST_QUAD_WORDS;
        for (int k = 0; k < 4; k++) {
            quad[4 * k] = beside[k];
            quad[4 * k + 1] = below[k];
            quad[4 * k + 2] = pane.depth;
            quad[4 * k + 3] = 1;
        }
        memcpy(quad + 16, pane.colour, sizeof(pane.colour));
    }
}

// A number as a format stores it after blending.
static float kept_in(enum rg_format format, float value)
{
    int exponent;
    if (format == RG_RGBA32F)
        return value;
    frexp((double)value, &exponent);
    const double step = ldexp(1, (exponent > -13 ? exponent : -13) - 11); // the distance of halves
    return (float)(floor((double)value / step) * step);                   // rounds down
}

static int code_of(float value)
{
    return (int)floorf(value * 255 + 0.5f);
}

static int kept_code(int target, int rest)
{
    const int t = target * rest;
    return (t + (t >> 8) + 128) >> 8;
}

// One channel: source + target (1 - alpha), or source + target. Product and sum round separately.
static float blend_one(enum rg_format format, enum rg_blend blend, const struct pane *pane, int c,
                       float target)
{
    if (format == RG_RGBA8) {
        const int rest = 255 - code_of(pane->colour[3]), was = code_of(target);
        const int sum =
            code_of(pane->colour[c]) + (blend == RG_BLEND_ADD ? was : kept_code(was, rest));
        return (float)(sum > 255 ? 255 : sum) / 255;
    }
    const volatile float rest = 1 - pane->colour[3];
    const volatile float left = blend == RG_BLEND_ADD ? target : target * rest;
    const volatile float sum = pane->colour[c] + left;
    return kept_in(format, sum);
}

static void draw_in_c(const struct rg_draw *draw, enum rg_format format, int pixel, float colour[4],
                      float *depth)
{
    const int x = pixel % SIDE, y = pixel / SIDE;
    for (int i = 0; i < PANES; i++) {
        const struct pane pane = pane_of(i);
        if (((x ^ y ^ i) & 15) == 15 ||
            (draw->depth_mode != RG_DEPTH_OFF && !(pane.depth < *depth)))
            continue;
        for (int c = 0; c < 4; c++)
            colour[c] = blend_one(format, draw->blend, &pane, c, colour[c]);
        if (draw->depth_mode == RG_DEPTH_WRITE)
            *depth = pane.depth;
    }
}

static float texel_of(enum rg_format format, const unsigned char *texels, int i)
{
    float value;
    uint16_t half;
    if (format == RG_RGBA8)
        return (float)texels[i] / 255;
    memcpy(&half, texels + 2 * (size_t)i, sizeof(half));
    if (format == RG_RGBA16F)
        return (float)value_of(half);
    memcpy(&value, texels + 4 * (size_t)i, sizeof(value));
    return value;
}

static void expect_as_in_c(struct rg_device *device, struct rg_draw draw, enum rg_format format)
{
    static const float none[4] = {0};
    static float quads[PANES * TEST_QUAD_WORDS];
    const float far = 0.7f;
    const test_quads_params p = {0};
    unsigned char texels[16 * TEXELS];
    float depths[TEXELS];
    write_panes(quads);
    struct rg_pass *pass = rg_pass_create(device, "test_quads");
    struct rg_buf *input = make_buf(device, quads, PANES * TEST_QUAD_WORDS, "panes");
    draw.colour = rg_image_create_with(device, &(struct rg_image_desc){format, SIDE, SIDE, 1, 1},
                                       none, "panes");
    draw.depth = rg_image_create_with(device, &(struct rg_image_desc){RG_D32F, SIDE, SIDE, 1, 1},
                                      &far, "depth");
    assert_true(pass && input && draw.colour && draw.depth);
    assert_true(rg_pass_run(pass, &(struct rg_run){.params = &p,
                                                   .slots = {[1].buf = input},
                                                   .extent = {PANES, 1, 1},
                                                   .draw = &draw}));
    assert_true(rg_image_read(draw.colour, 0, 0, texels) &&
                rg_image_read(draw.depth, 0, 0, depths));
    for (int i = 0; i < TEXELS; i++) {
        float colour[4] = {0}, depth = far;
        draw_in_c(&draw, format, i, colour, &depth);
        for (int c = 0; c < 4; c++)
            if (texel_of(format, texels, 4 * i + c) != colour[c] || depths[i] != depth)
                fail_msg("%s, blend %d, depth %d: channel %d of texel %d is %.9g, not %.9g; depth "
                         "%.9g, not %.9g",
                         rg_format_name(format), draw.blend, draw.depth_mode, c, i,
                         (double)texel_of(format, texels, 4 * i + c), (double)colour[c],
                         (double)depths[i], (double)depth);
    }
    rg_image_destroy(draw.colour);
    rg_image_destroy(draw.depth);
    rg_pass_destroy(pass);
    rg_buf_destroy(input);
}

static void every_format_is_blended_as_a_loop_in_c_does(void **state)
{
    static const enum rg_format formats[] = {RG_RGBA8, RG_RGBA16F, RG_RGBA32F};
    for (int f = 0; f < COUNT_OF(formats); f++)
        for (enum rg_blend blend = RG_BLEND_OVER; blend <= RG_BLEND_ADD; blend++)
            for (enum rg_depth_mode depth = RG_DEPTH_OFF; depth <= RG_DEPTH_WRITE; depth++)
                expect_as_in_c(*state, (struct rg_draw){.blend = blend, .depth_mode = depth},
                               formats[f]);
}

// --- a layer meets the picture behind it ---

// Halves, numbers between halves, the smallest and the largest half, and numbers that no half
// holds.
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

// On a clear background a layer is rounded to the nearest half, once.
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

// Without rain a background stays as it is.
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
    cmocka_unit_test(every_format_is_blended_as_a_loop_in_c_does),
    cmocka_unit_test(faint_layers_add_up),
    cmocka_unit_test(they_are_rounded_to_the_nearest_half),
    cmocka_unit_test(a_clear_layer_changes_nothing),
};

const struct suite_tests layer_tests = {tests, COUNT_OF(tests)};
