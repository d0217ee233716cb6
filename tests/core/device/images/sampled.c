// What the driver's own samplers do on native devices: they compare depths, and levels are made.
// The bounds are of models in double precision; other devices compute the same by kernels.
#include <math.h>

#include "tests/core/device/images/texels.h"
#include "tests/core/device/suite.h"
#include "tests/kernels/texels/params.h"

// Samplers have weights of 8 bits at least.
static const double WEIGHT = 0x1p-8;

static bool is_native(const struct rg_device *device)
{
    return device->info.native;
}

// --- shadows ---

enum { LAYERS = 2, READS = 4000, DEPTHS = 8 };

static float depth_at(int size, int layer, int x, int y)
{
    x = x < 0 ? 0 : x < size ? x : size - 1;
    y = y < 0 ? 0 : y < size ? y : size - 1;
    return (float)(noise((uint32_t)((layer * size + y) * size + x)) % DEPTHS) / DEPTHS;
}

static struct rg_image *make_map(struct rg_device *device, int size)
{
    struct rg_image *map =
        rg_image_create(device, &(struct rg_image_desc){RG_D32F, size, size, LAYERS, 1}, "map");
    float *depths = malloc((size_t)(size * size) * sizeof(*depths));
    assert_non_null(map);
    for (int layer = 0; layer < LAYERS; layer++) {
        for (int i = 0; i < size * size; i++)
            depths[i] = depth_at(size, layer, i % size, i / size);
        assert_true(rg_image_write(map, layer, 0, depths));
    }
    free(depths);
    return map;
}

// Places in a map and a little beyond, at depths between those of texels.
static struct colour *make_places(int size)
{
    struct colour *places = malloc(READS * sizeof(*places));
    for (uint32_t i = 0; i < READS; i++) {
        const float x = (float)(noise(4 * i) >> 8) * 0x1p-24f,
                    y = (float)(noise(4 * i + 1) >> 8) * 0x1p-24f;
        places[i] = (struct colour){x * (float)(size + 4) - 2, y * (float)(size + 4) - 2,
                                    (float)(noise(4 * i + 2) % LAYERS),
                                    ((float)(noise(4 * i + 3) % DEPTHS) + 0.5f) / DEPTHS};
    }
    return places;
}

static double lit_at(int size, const struct colour *place, double x, double y)
{
    return place->a <= depth_at(size, (int)place->b, (int)floor(x), (int)floor(y)) ? 1 : 0;
}

static double lit_softly(int size, const struct colour *place)
{
    const double x = (double)place->r - 0.5, y = (double)place->g - 0.5;
    const double fx = x - floor(x), fy = y - floor(y);
    return (1 - fy) * ((1 - fx) * lit_at(size, place, x, y) + fx * lit_at(size, place, x + 1, y)) +
           fy * ((1 - fx) * lit_at(size, place, x, y + 1) + fx * lit_at(size, place, x + 1, y + 1));
}

static struct colour *compare(struct rg_device *device, struct rg_image *map,
                              const struct colour *places)
{
    struct rg_pass *pass = rg_pass_create(device, "test_compare");
    struct rg_buf *at = make_buf(device, places, READS * 4, "at");
    struct rg_buf *lit = filled_buf(device, 0xcacacacau, READS * 4, "lit");
    const test_texels_params p = {map->desc.width, map->desc.height, 0};
    assert_non_null(pass);
    assert_true(
        rg_pass_run(pass, &(struct rg_run){.params = &p,
                                           .slots = {[1].image = map, [2].buf = at, [3].buf = lit},
                                           .extent = {READS, 1, 1}}));
    struct colour *got = (struct colour *)read_words(lit, READS * 4);
    rg_pass_destroy(pass);
    rg_buf_destroy(at);
    rg_buf_destroy(lit);
    return got;
}

// A coordinate is rounded twice, by 2^-24 of its size, and on a native device each axis has a
// weight of its own.
static void check_map(struct rg_device *device, int size)
{
    const double rounding = 8 * (size + 4) * 0x1p-24;
    const double bound = rounding + (is_native(device) ? 2 * WEIGHT : 0);
    struct rg_image *map = make_map(device, size);
    struct colour *places = make_places(size), *got = compare(device, map, places);
    int between = 0;
    for (int i = 0; i < READS; i++) {
        const struct colour *p = &places[i];
        const double one = lit_at(size, p, (double)p->r, (double)p->g), soft = lit_softly(size, p);
        between += soft > 0.1 && soft < 0.9;
        if (fabs((double)got[i].r - one) > (is_native(device) ? rounding : 0))
            fail_msg("%d px, (%a, %a): %a, not %g", size, (double)p->r, (double)p->g,
                     (double)got[i].r, one);
        if (!(fabs((double)got[i].g - soft) <= bound))
            fail_msg("%d px, (%a, %a): softly %.9g, not %.9g", size, (double)p->r, (double)p->g,
                     (double)got[i].g, soft);
    }
    assert_true(between > READS / 4);
    free(places);
    free(got);
    rg_image_destroy(map);
}

static void depths_are_compared_between_texels(void **state)
{
    check_map(*state, 64);
    check_map(*state, 100);
}

// --- levels ---

enum { LEVELS = 6, MOST_PX = 67 * 33 };

// Texels of 0.5 to 1, or of all codes.
static void fill(enum rg_format format, uint32_t seed, int count, uint32_t *texels)
{
    const int words = (count * rg_format_size(format) + 3) / 4;
    for (int i = 0; i < words; i++)
        texels[i] = format == RG_RGBA8 ? noise(seed + (uint32_t)i)
                                       : (noise(seed + (uint32_t)i) & 0x03ff03ffu) | 0x38003800u;
}

static double channel(enum rg_format format, const void *texels, int i, int c)
{
    const struct colour t = decode_texel(format, (const char *)texels + i * rg_format_size(format));
    return (double)(c == 0 ? t.r : c == 1 ? t.g : c == 2 ? t.b : t.a);
}

struct level {
    int width, height;
    uint32_t texels[MOST_PX * 2];
};

static struct level read_level(struct rg_image *image, int layer, int level)
{
    struct level l = {
        rg_level_size(image->desc.width, level), rg_level_size(image->desc.height, level), {0}};
    assert_true(rg_image_read(image, layer, level, l.texels));
    return l;
}

// A texel is the mean of four where its sides are halves; else it lies between the texels above it,
// for the APIs leave the filter open. Weights of one half are exact, and a mix across and one down
// round by half of the format's step each, or cut halves by all of it.
static void check_texel(enum rg_format format, const struct level *above, const struct level *l,
                        int x, int y, int c)
{
    const double step = (format == RG_RGBA8 ? 1.0 / 255 : 0x1p-10) + 1e-6;
    const bool halves = above->width == 2 * l->width && above->height == 2 * l->height;
    const double got = channel(format, l->texels, y * l->width + x, c);
    double least = INFINITY, most = -INFINITY, sum = 0;
    for (int v = y * above->height / l->height; v * l->height < (y + 1) * above->height; v++) {
        for (int u = x * above->width / l->width; u * l->width < (x + 1) * above->width; u++) {
            const double t = channel(format, above->texels, v * above->width + u, c);
            least = fmin(least, t);
            most = fmax(most, t);
            sum += t;
        }
    }
    const double low = halves ? sum / 4 : least, high = halves ? sum / 4 : most;
    if (!(got >= low - step && got <= high + step))
        fail_msg("%s, %dx%d: texel %d, %d: channel %d is %.9g, not %.9g to %.9g",
                 rg_format_name(format), l->width, l->height, x, y, c, got, low, high);
}

static void check_layer(struct rg_image *image, int layer, int first)
{
    struct level above = read_level(image, layer, first - 1);
    for (int level = first; level < image->desc.levels; level++) {
        const struct level l = read_level(image, layer, level);
        for (int i = 0; i < l.width * l.height; i++)
            for (int c = 0; c < 4; c++)
                check_texel(image->desc.format, &above, &l, i % l.width, i / l.width, c);
        above = l;
    }
}

static void make_levels(struct rg_device *device, enum rg_format format, int width, int height,
                        int first)
{
    const struct rg_image_desc desc = {format, width, height, LAYERS, LEVELS};
    struct rg_image *image = rg_image_create(device, &desc, "halved");
    static uint32_t texels[MOST_PX * 2];
    assert_non_null(image);
    for (int i = 0; i < LAYERS * first; i++) {
        fill(format, (uint32_t)i << 16, MOST_PX, texels);
        assert_true(rg_image_write(image, i / first, i % first, texels));
    }
    assert_true(rg_image_make_levels(image, first));
    for (int i = 0; i < LAYERS * first; i++) {
        const struct level l = read_level(image, i / first, i % first);
        fill(format, (uint32_t)i << 16, MOST_PX, texels);
        assert_memory_equal(l.texels, texels,
                            (size_t)(l.width * l.height * rg_format_size(format)));
    }
    for (int layer = 0; layer < LAYERS; layer++)
        check_layer(image, layer, first);
    rg_image_destroy(image);
}

// A closed case: all levels of a constant image are constant, to the bit.
static void make_constant(struct rg_device *device, enum rg_format format)
{
    const struct rg_image_desc desc = {format, 67, 33, LAYERS, LEVELS};
    static uint32_t texels[MOST_PX * 2];
    const uint32_t word = format == RG_RGBA8 ? 0x80ff0123u : 0x38cd38cdu;
    struct rg_image *image = rg_image_create(device, &desc, "constant");
    assert_non_null(image);
    for (int i = 0; i < MOST_PX * 2; i++)
        texels[i] = word;
    for (int layer = 0; layer < LAYERS; layer++)
        assert_true(rg_image_write(image, layer, 0, texels));
    assert_true(rg_image_make_levels(image, 1));
    for (int i = 0; i < LAYERS * LEVELS; i++) {
        const struct level l = read_level(image, i / LEVELS, i % LEVELS);
        assert_memory_equal(l.texels, texels,
                            (size_t)(l.width * l.height * rg_format_size(format)));
    }
    rg_image_destroy(image);
}

static void refuse_levels(struct rg_device *device)
{
    const struct rg_image_desc desc = {RG_R16F, 8, 8, 1, 2};
    struct rg_image *image = rg_image_create(device, &desc, "halved");
    assert_non_null(image);
    assert_false(rg_image_makes_levels(image));
    assert_refused(rg_image_make_levels(image, 1), "image 'halved': device '");
    rg_image_destroy(image);
}

static void drivers_make_levels(void **state)
{
    static const enum rg_format formats[] = {RG_R16F, RG_RGBA16F, RG_RGBA8};
    if (!is_native(*state)) {
        refuse_levels(*state);
        return;
    }
    for (int f = 0; f < COUNT_OF(formats); f++) {
        make_levels(*state, formats[f], 64, 32, 1);
        make_levels(*state, formats[f], 64, 32, 3);
        make_levels(*state, formats[f], 67, 33, 1);
        make_levels(*state, formats[f], 67, 33, LEVELS);
        make_constant(*state, formats[f]);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(depths_are_compared_between_texels),
    cmocka_unit_test(drivers_make_levels),
};
const struct suite_tests sampled_tests = {tests, COUNT_OF(tests)};
