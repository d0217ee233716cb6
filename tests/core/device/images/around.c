// Images that have no edges: a scene's textures repeat, and an environment is a cube. On native
// devices the driver's own samplers read them, and on others kernels do. The models are in double
// precision.
#include <math.h>

#include "tests/core/device/images/texels.h"
#include "tests/core/device/suite.h"
#include "tests/kernels/texels/params.h"

enum { SIDE = 32, LEVELS = 6, MOST_LAYERS = 6, READS = 6000 };

// Samplers have weights of 8 bits at least.
static const double WEIGHT = 0x1p-8, ROUNDING = 0x1p-15, CODE = 1.0 / 255;

struct source {
    enum rg_format format;
    int layers;
    uint32_t texels[MOST_LAYERS][LEVELS][SIDE * SIDE];
};

static bool is_native(const struct rg_device *device)
{
    return device->info.native;
}

// Texels of all codes; of RG11B10F those from 0.5 to 1.
static void fill(struct source *s)
{
    const uint32_t below_one = 14u << 6 | 14u << 17 | 14u << 27;
    for (int layer = 0; layer < s->layers; layer++)
        for (int level = 0; level < LEVELS; level++)
            for (int i = 0; i < SIDE * SIDE; i++) {
                const uint32_t word = noise((uint32_t)((layer * LEVELS + level) * SIDE * SIDE + i));
                s->texels[layer][level][i] =
                    s->format == RG_RGBA8 ? word : below_one | (word & 0x07c1f83fu);
            }
}

static double texel(const struct source *s, int layer, int level, int x, int y, int channel)
{
    const struct colour t =
        decode_texel(s->format, &s->texels[layer][level][y * (SIDE >> level) + x]);
    return (double)(channel == 0 ? t.r : channel == 1 ? t.g : channel == 2 ? t.b : t.a);
}

// Between four texels of a level whose size is `size`; x and y are from the first texel's centre.
static double between(const struct source *s, int layer, int level, double x, double y, int channel)
{
    const int size = SIDE >> level;
    double sum = 0;
    for (int k = 0; k < 4; k++) {
        const double i = floor(x) + (k & 1), j = floor(y) + (k >> 1);
        sum += (1 - fabs(x - i)) * (1 - fabs(y - j)) *
               texel(s, layer, level, ((int)i % size + size) % size, ((int)j % size + size) % size,
                     channel);
    }
    return sum;
}

static struct colour *run_reads(struct rg_device *device, const char *kernel,
                                const struct source *s, const struct colour *reads)
{
    const struct rg_image_desc desc = {s->format, SIDE, SIDE, s->layers, LEVELS};
    struct rg_image *image = rg_image_create(device, &desc, "source");
    struct rg_pass *pass = rg_pass_create(device, kernel);
    struct rg_buf *at = make_buf(device, reads, READS * 4, "at");
    struct rg_buf *colours = filled_buf(device, 0xcacacacau, READS * 4, "colours");
    const test_texels_params p = {SIDE, SIDE, LEVELS - 1};
    assert_non_null(image);
    assert_non_null(pass);
    for (int i = 0; i < s->layers * LEVELS; i++)
        assert_true(
            rg_image_write(image, i / LEVELS, i % LEVELS, s->texels[i / LEVELS][i % LEVELS]));
    assert_true(rg_pass_run(
        pass, &(struct rg_run){.params = &p,
                               .slots = {[1].image = image, [2].buf = at, [3].buf = colours},
                               .extent = {READS, 1, 1}}));
    struct colour *got = (struct colour *)read_words(colours, READS * 4);
    rg_pass_destroy(pass);
    rg_buf_destroy(at);
    rg_buf_destroy(colours);
    rg_image_destroy(image);
    return got;
}

static float unit(uint32_t i)
{
    return (float)(noise(i) >> 8) * 0x1p-24f;
}

// --- textures that repeat ---

// From one tile to the fourth, at pixels that are up to twice as wide as the whole texture.
static struct colour *make_tiled_reads(int layers)
{
    struct colour *reads = malloc(READS * sizeof(*reads));
    for (uint32_t i = 0; i < READS; i++) {
        const float width = exp2f(unit(4 * i + 3) * (LEVELS + 1) - 1);
        reads[i] = (struct colour){unit(4 * i) * 4 - 2, unit(4 * i + 1) * 4 - 2,
                                   (float)(noise(4 * i + 2) % (uint32_t)layers), width * width};
    }
    return reads;
}

static double tiled_at(const struct source *s, const struct colour *r, int level, int channel)
{
    const int size = SIDE >> level;
    return between(s, (int)r->b, level, (double)r->r * size - 0.5, (double)r->g * size - 0.5,
                   channel);
}

// The nearest level alone is read.
static double tiled_due(const struct source *s, const struct colour *r, int channel)
{
    const double level = fmin(fmax(0.5 * log2((double)r->a), 0), LEVELS - 1);
    return tiled_at(s, r, (int)lround(level), channel);
}

// Colours are squares of what is mixed; alpha is not. Each of a sampler's two mixes is off by its
// weight and rounds by a code, for 8 bits are enough for it. Kernels cut two weights and round
// three times.
static void textures_repeat(void **state)
{
    static struct source s = {RG_RGBA8, 3, {{{0}}}};
    struct colour *reads = make_tiled_reads(3);
    fill(&s);
    struct colour *got = run_reads(*state, "test_tiled", &s, reads);
    const double bound = ROUNDING + 2 * WEIGHT + (is_native(*state) ? 2 : 1.5) * CODE;
    for (int i = 0; i < READS; i++) {
        const float channels[4] = {got[i].r, got[i].g, got[i].b, got[i].a};
        const double level = 0.5 * log2((double)reads[i].a);
        for (int c = 0; c < 4; c++) {
            const double due = tiled_due(&s, &reads[i], c);
            const double value = c < 3 ? sqrt((double)channels[c]) : (double)channels[c];
            const bool is_between_levels = fabs(level - floor(level) - 0.5) < 1e-5;
            if (!(fabs(value - due) <= bound) && !is_between_levels)
                fail_msg("(%a, %a), layer %g, level %g: channel %d is %.9g, not %.9g",
                         (double)reads[i].r, (double)reads[i].g, (double)reads[i].b, level, c,
                         value, due);
        }
    }
    free(reads);
    free(got);
}

// --- cubes ---

static struct colour *make_directions(void)
{
    struct colour *reads = malloc(READS * sizeof(*reads));
    for (uint32_t i = 0; i < READS; i++) {
        const float length = exp2f(unit(5 * i + 4) * 8 - 4);
        reads[i] =
            (struct colour){(unit(5 * i) * 2 - 1) * length, (unit(5 * i + 1) * 2 - 1) * length,
                            (unit(5 * i + 2) * 2 - 1) * length, (float)(noise(5 * i + 3) % LEVELS)};
    }
    return reads;
}

// The table of faces of OpenGL's section Cube Map Texture Selection; the outermost texels' centres
// lie on the edges.
static double cube_due(const struct source *s, const struct colour *r, int channel)
{
    const double d[3] = {(double)r->r, (double)r->g, (double)r->b};
    int axis = 0;
    for (int i = 1; i < 3; i++)
        axis = fabs(d[i]) > fabs(d[axis]) ? i : axis;
    const double sign = d[axis] < 0 ? -1 : 1;
    const double across = axis == 0 ? -sign * d[2] : axis == 1 ? d[0] : sign * d[0];
    const double down = axis == 1 ? sign * d[2] : -d[1];
    const int level = (int)r->a, last = (SIDE >> level) - 1;
    return between(s, 2 * axis + (sign < 0), level, (across / fabs(d[axis]) + 1) / 2 * last,
                   (down / fabs(d[axis]) + 1) / 2 * last, channel);
}

// Texels differ by at most one half, and each of two mixes is off by its weight.
static void cubes_are_read_up_to_their_edges(void **state)
{
    static struct source s = {RG_RG11B10F, 6, {{{0}}}};
    struct colour *reads = make_directions();
    fill(&s);
    struct colour *got = run_reads(*state, "test_cube", &s, reads);
    const double bound = ROUNDING + (is_native(*state) ? WEIGHT : 0);
    for (int i = 0; i < READS; i++) {
        const float channels[3] = {got[i].r, got[i].g, got[i].b};
        for (int c = 0; c < 3; c++) {
            const double due = cube_due(&s, &reads[i], c);
            if (!(fabs((double)channels[c] - due) <= bound))
                fail_msg("(%a, %a, %a), level %g: channel %d is %.9g, not %.9g", (double)reads[i].r,
                         (double)reads[i].g, (double)reads[i].b, (double)reads[i].a, c,
                         (double)channels[c], due);
        }
    }
    free(reads);
    free(got);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(textures_repeat),
    cmocka_unit_test(cubes_are_read_up_to_their_edges),
};
const struct suite_tests around_tests = {tests, COUNT_OF(tests)};
