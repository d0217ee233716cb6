// Kernels read images between their texels. Every device reads as cpu:reference does to the last
// bit, which is checked against double precision.
#include <math.h>
#include <stdio.h>

#include "tests/core/device/images/texels.h"
#include "tests/core/device/suite.h"
#include "tests/kernels/texels/filter/params.h"

enum { LAYERS = 3, LEVELS = 7, READS = 6000 };

static const enum rg_format formats[] = {RG_RGBA8, RG_RGBA16F, RG_R16F, RG_RG11B10F};
static const char *const kernels[] = {"test_filter_rgba8", "test_filter_rgba16f",
                                      "test_filter_r16f", "test_filter_rg11b10f"};
static const char *const filterings[TEST_FILTERS] = {"nearest", "linear", "trilinear"};

// A place where an image is read: u and v across it, its layer and level.
struct read {
    float u, v, layer, level;
};

// --- images ---

// Seeded texels between -1 and 1, so that one bound holds for all.
static void fill(enum rg_format format, uint32_t seed, int count, uint32_t *texels)
{
    const uint32_t below_one = 14; // exponent of 0.5 to 1
    for (int i = 0; i < count; i++) {
        const uint32_t a = noise(seed + 2 * (uint32_t)i), b = noise(seed + 2 * (uint32_t)i + 1);
        if (format == RG_RGBA8)
            texels[i] = a;
        else if (format == RG_RG11B10F)
            texels[i] = below_one << 6 | below_one << 17 | below_one << 27 | (a & 0x07c1f83fu);
        else if (format == RG_R16F)
            ((uint16_t *)texels)[i] = (uint16_t)((a & 0x83ffu) | 0x3800u);
        else {
            texels[2 * i] = (a & 0x83ff83ffu) | 0x38003800u;
            texels[2 * i + 1] = (b & 0x83ff83ffu) | 0x38003800u;
        }
    }
}

// The same texels on the host and on a device.
struct source {
    enum rg_format format;
    int width, height;
    struct colour *texels[LAYERS][LEVELS];
};

static void open_source(struct source *s, enum rg_format format, int width, int height)
{
    *s = (struct source){format, width, height, {{0}}};
    uint32_t *packed = malloc((size_t)(width * height) * 8);
    for (int layer = 0; layer < LAYERS; layer++) {
        for (int level = 0; level < LEVELS; level++) {
            const int count = rg_level_size(width, level) * rg_level_size(height, level);
            fill(format, (uint32_t)(layer * 10 + level) << 20, count, packed);
            s->texels[layer][level] = malloc((size_t)count * sizeof(struct colour));
            for (int i = 0; i < count; i++)
                s->texels[layer][level][i] =
                    decode_texel(format, (const char *)packed + i * rg_format_size(format));
        }
    }
    free(packed);
}

static void close_source(struct source *s)
{
    for (int i = 0; i < LAYERS * LEVELS; i++)
        free(s->texels[i / LEVELS][i % LEVELS]);
}

static struct rg_image *upload(struct rg_device *device, const struct source *s)
{
    const struct rg_image_desc desc = {s->format, s->width, s->height, LAYERS, LEVELS};
    struct rg_image *image = rg_image_create(device, &desc, "source");
    assert_non_null(image);
    uint32_t *packed = malloc((size_t)(s->width * s->height) * 8);
    for (int layer = 0; layer < LAYERS; layer++) {
        for (int level = 0; level < LEVELS; level++) {
            fill(s->format, (uint32_t)(layer * 10 + level) << 20,
                 rg_level_size(s->width, level) * rg_level_size(s->height, level), packed);
            assert_true(rg_image_write(image, layer, level, packed));
        }
    }
    free(packed);
    return image;
}

// --- reads ---

// Coordinates inside and far outside; on edges, on borders between texels and on centres.
static float coordinate(uint32_t n, int size)
{
    const float unit = (float)(noise(n) >> 8) * 0x1p-24f;
    const int texel = (int)(noise(~n) % (uint32_t)(size + 4)) - 2;
    switch (n % 7) {
    case 0:
        return ((float)texel + 0.5f) / (float)size;
    case 1:
        return (float)texel / (float)size;
    case 2:
        return (float)(texel & 1);
    case 3:
        return (unit - 0.5f) * 2e4f;
    case 4:
        return 3.0f * unit - 1.0f;
    default:
        return unit;
    }
}

static struct read *make_reads(const struct source *s, int filtering)
{
    struct read *reads = malloc(READS * sizeof(*reads));
    for (uint32_t i = 0; i < READS; i++) {
        const uint32_t r = noise(i);
        const int level = (int)(r >> 8) % LEVELS;
        reads[i] = (struct read){
            .u = coordinate(noise(r), rg_level_size(s->width, level)),
            .v = coordinate(noise(r + 1), rg_level_size(s->height, level)),
            .layer = (float)(r % LAYERS),
            .level = (float)level,
        };
        if (filtering == TEST_FILTER_TRILINEAR && i % 4)
            reads[i].level = 10.0f * (float)(noise(r + 2) >> 8) * 0x1p-24f - 1.5f;
    }
    return reads;
}

static struct colour *run_reads(struct rg_device *device, const char *kernel,
                                const struct source *s, int filtering, const struct read *reads)
{
    struct rg_image *image = upload(device, s);
    struct rg_pass *pass = rg_pass_create(device, kernel);
    struct rg_buf *at = make_buf(device, reads, READS * 4, "at");
    struct rg_buf *colours = filled_buf(device, 0xcacacacau, READS * 4, "colours");
    const test_filter_params p = {filtering};
    assert_non_null(pass);
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

// --- in double precision ---

static double channel_at(const struct source *s, const struct read *r, int level, int x, int y,
                         int channel)
{
    const int width = rg_level_size(s->width, level), height = rg_level_size(s->height, level);
    x = x < 0 ? 0 : x < width ? x : width - 1;
    y = y < 0 ? 0 : y < height ? y : height - 1;
    const struct colour *c = &s->texels[(int)r->layer][level][y * width + x];
    return (double)(channel == 0 ? c->r : channel == 1 ? c->g : channel == 2 ? c->b : c->a);
}

static double linear_at(const struct source *s, const struct read *r, int level, int channel)
{
    const double x = (double)r->u * rg_level_size(s->width, level) - 0.5;
    const double y = (double)r->v * rg_level_size(s->height, level) - 0.5;
    const double left = floor(x), top = floor(y);
    double sum = 0;
    for (int k = 0; k < 4; k++) {
        const double i = left + (k & 1), j = top + (k >> 1);
        sum += (1 - fabs(x - i)) * (1 - fabs(y - j)) *
               channel_at(s, r, level, (int)i, (int)j, channel);
    }
    return sum;
}

static double trilinear_at(const struct source *s, const struct read *r, int channel)
{
    const double level = fmin(fmax((double)r->level, 0), LEVELS - 1);
    const int fine = (int)level, coarse = fine + 1 < LEVELS ? fine + 1 : fine;
    return linear_at(s, r, fine, channel) * (1 - (level - fine)) +
           linear_at(s, r, coarse, channel) * (level - fine);
}

// Whether `got` is the texel at a coordinate; near a border rounding allows both neighbours.
static bool is_nearest(const struct source *s, const struct read *r, int channel, double got)
{
    const int level = (int)r->level;
    const double x = (double)r->u * rg_level_size(s->width, level);
    const double y = (double)r->v * rg_level_size(s->height, level);
    for (int k = 0; k < 4; k++) {
        const double hair_x = (k & 1 ? 1 : -1) * fabs(x) * 0x1p-23;
        const double hair_y = (k & 2 ? 1 : -1) * fabs(y) * 0x1p-23;
        if (channel_at(s, r, level, (int)floor(x + hair_x), (int)floor(y + hair_y), channel) == got)
            return true;
    }
    return false;
}

// The image has 67 texels. A coordinate in texels is rounded twice, each time by 2^-24 of 67 at
// most. The value moves by as much, times twice the largest texel, 1. Each of seven blends rounds
// three times.
static const double BOUND = 2 * 2 * 2 * 67 * 0x1p-24 + 21 * 0x1p-24;
// A driver's sampler has three weights of 8 bits at least, each of which is off by half of its last
// place, or cut, and moves the value by as much of the largest difference, 2. It may filter codes
// of 8 bits, which round three times by a code.
static const double NATIVE_BOUND = BOUND + 3 * 2 * 0x1p-8 + 3.0 / 255;

static void check_reads(const struct source *s, int filtering, const struct read *reads,
                        const struct colour *got, double bound)
{
    for (int i = 0; i < READS; i++) {
        const struct read *r = &reads[i];
        const float channels[4] = {got[i].r, got[i].g, got[i].b, got[i].a};
        for (int c = 0; c < 4; c++) {
            const double value = (double)channels[c];
            const double due = filtering == TEST_FILTER_LINEAR ? linear_at(s, r, (int)r->level, c)
                                                               : trilinear_at(s, r, c);
            const bool right = filtering == TEST_FILTER_NEAREST ? is_nearest(s, r, c, value)
                                                                : fabs(value - due) <= bound;
            if (!right)
                fail_msg("%s, %s: at (%a, %a), layer %g, level %g: channel %d is %.9g, not %.9g",
                         rg_format_name(s->format), filterings[filtering], (double)r->u,
                         (double)r->v, (double)r->layer, (double)r->level, c, value, due);
        }
    }
}

static void check_format(struct rg_device *device, struct rg_device *reference, int format,
                         int width, int height)
{
    struct source s;
    open_source(&s, formats[format], width, height);
    for (int filtering = 0; filtering < TEST_FILTERS; filtering++) {
        struct read *reads = make_reads(&s, filtering);
        struct colour *due = run_reads(reference, kernels[format], &s, filtering, reads);
        struct colour *got = run_reads(device, kernels[format], &s, filtering, reads);
        check_reads(&s, filtering, reads, due, BOUND);
        for (int i = 0; i < READS; i++)
            if (memcmp(&got[i], &due[i], sizeof(got[i])))
                fail_msg("%s, %s: at (%a, %a), layer %g, level %g: not as on cpu:reference",
                         rg_format_name(s.format), filterings[filtering], (double)reads[i].u,
                         (double)reads[i].v, (double)reads[i].layer, (double)reads[i].level);
        free(reads);
        free(due);
        free(got);
    }
    close_source(&s);
}

static void images_are_read_between_texels(void **state)
{
    struct rg_device *reference = rg_device_open("cpu:reference");
    for (int format = 0; format < COUNT_OF(formats); format++) {
        check_format(*state, reference, format, 67, 33);
        check_format(*state, reference, format, 64, 32);
    }
    assert_true(rg_device_close(reference));
}

// At a texel's centre every filter gives the texel itself, to the bit, if sizes are powers of 2,
// for which coordinates are exact.
static void a_texels_centre_shows_the_texel(void **state)
{
    struct source s;
    struct read *reads = calloc(READS, sizeof(*reads));
    open_source(&s, RG_RGBA16F, 64, 32);
    for (int i = 0; i < READS; i++) {
        const int level = i % LEVELS, layer = i / LEVELS % LAYERS;
        const int width = rg_level_size(64, level), height = rg_level_size(32, level);
        const uint32_t r = noise((uint32_t)i);
        reads[i] = (struct read){((float)(r % (uint32_t)width) + 0.5f) / (float)width,
                                 ((float)(r / 64 % (uint32_t)height) + 0.5f) / (float)height,
                                 (float)layer, (float)level};
    }
    for (int filtering = 0; filtering < TEST_FILTERS; filtering++) {
        struct colour *got = run_reads(*state, "test_filter_rgba16f", &s, filtering, reads);
        for (int i = 0; i < READS; i++) {
            const int level = (int)reads[i].level, width = rg_level_size(64, level);
            const int x = (int)(reads[i].u * (float)width);
            const int y = (int)(reads[i].v * (float)rg_level_size(32, level));
            assert_memory_equal(&got[i], &s.texels[(int)reads[i].layer][level][y * width + x],
                                sizeof(got[i]));
        }
        free(got);
    }
    free(reads);
    close_source(&s);
}

static void native_reads_are_near(void **state)
{
    for (int format = 0; format < COUNT_OF(formats); format++) {
        struct source s;
        open_source(&s, formats[format], 67, 33);
        for (int filtering = 0; filtering < TEST_FILTERS; filtering++) {
            struct read *reads = make_reads(&s, filtering);
            struct colour *got = run_reads(*state, kernels[format], &s, filtering, reads);
            check_reads(&s, filtering, reads, got, NATIVE_BOUND);
            free(reads);
            free(got);
        }
        close_source(&s);
    }
}

static const struct CMUnitTest native_tests[] = {cmocka_unit_test(native_reads_are_near)};
const struct suite_tests native_filter_tests = {native_tests, COUNT_OF(native_tests)};

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(images_are_read_between_texels),
    cmocka_unit_test(a_texels_centre_shows_the_texel),
};
const struct suite_tests filter_tests = {tests, COUNT_OF(tests)};
