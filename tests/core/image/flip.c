// FLIP against an independent transcription of the paper: double precision, 2-D convolutions, the
// colour conversions step by step.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "core/image/compare/compare.h"
#include "core/image/srgb.h"
#include "tests/core/image/rain_picture.h"
#include "tests/tools/expect.h"

enum { WIDTH = 61, HEIGHT = 43, PIXELS = WIDTH * HEIGHT, BIG = 40 };

struct vec {
    double v[3];
};

static const double to_xyz[3][3] = {
    {10135552. / 24577794, 8788810. / 24577794, 4435075. / 24577794},
    {2613072. / 12288897, 8788810. / 12288897, 887015. / 12288897},
    {1425312. / 73733382, 8788810. / 73733382, 70074185. / 73733382}};
static const double to_rgb[3][3] = {{3.241003275, -1.537398934, -0.498615861},
                                    {-0.969224334, 1.875930071, 0.041554224},
                                    {0.055639423, -0.204011202, 1.057148933}};
static const double white[3] = {0.950428545, 1.0, 1.088900371};

static struct vec multiply(const double m[3][3], struct vec c)
{
    struct vec out;
    for (int i = 0; i < 3; i++)
        out.v[i] = m[i][0] * c.v[0] + m[i][1] * c.v[1] + m[i][2] * c.v[2];
    return out;
}

static struct vec ycxcz(struct vec rgb)
{
    struct vec t = multiply(to_xyz, rgb);
    for (int i = 0; i < 3; i++)
        t.v[i] /= white[i];
    return (struct vec){{116 * t.v[1] - 16, 500 * (t.v[0] - t.v[1]), 200 * (t.v[1] - t.v[2])}};
}

static struct vec rgb_of_ycxcz(struct vec c)
{
    double y = (c.v[0] + 16) / 116;
    struct vec xyz = {{(y + c.v[1] / 500) * white[0], y, (y - c.v[2] / 200) * white[2]}};
    return multiply(to_rgb, xyz);
}

static struct vec hunt(struct vec rgb)
{
    struct vec t = multiply(to_xyz, rgb);
    for (int i = 0; i < 3; i++) {
        double x = t.v[i] / white[i], d = 6. / 29;
        t.v[i] = x > d * d * d ? cbrt(x) : x / (3 * d * d) + 4. / 29;
    }
    double l = 116 * t.v[1] - 16;
    return (struct vec){
        {l, 0.01 * l * 500 * (t.v[0] - t.v[1]), 0.01 * l * 200 * (t.v[1] - t.v[2])}};
}

static double hyab(struct vec p, struct vec q)
{
    return fabs(p.v[0] - q.v[0]) + hypot(p.v[1] - q.v[1], p.v[2] - q.v[2]);
}

static double at(const struct vec *picture, int x, int y, int c)
{
    x = x < 0 ? 0 : x >= WIDTH ? WIDTH - 1 : x;
    y = y < 0 ? 0 : y >= HEIGHT ? HEIGHT - 1 : y;
    return picture[y * WIDTH + x].v[c];
}

static double convolve(const struct vec *picture, int x, int y, int c, const double *kernel,
                       int radius, bool transposed)
{
    double sum = 0;
    for (int j = -radius; j <= radius; j++)
        for (int i = -radius; i <= radius; i++)
            sum += at(picture, x + (transposed ? j : i), y + (transposed ? i : j), c) *
                   kernel[(j + radius) * (2 * radius + 1) + i + radius];
    return sum;
}

static int spatial_kernel(double ppd, int c, double *kernel)
{
    static const double a1[] = {1, 1, 34.1}, b1[] = {0.0047, 0.0053, 0.04};
    static const double a2[] = {0, 0, 13.5}, b2[] = {1e-5, 1e-5, 0.025};
    int r = (int)ceil(3 * sqrt(0.04 / (2 * M_PI * M_PI)) * ppd), n = 2 * r + 1;
    double sum = 0;
    for (int i = 0; i < n * n; i++) {
        double x = (i % n - r) / ppd, y = (i / n - r) / ppd, z = x * x + y * y;
        kernel[i] = a1[c] * sqrt(M_PI / b1[c]) * exp(-M_PI * M_PI * z / b1[c]) +
                    a2[c] * sqrt(M_PI / b2[c]) * exp(-M_PI * M_PI * z / b2[c]);
        sum += kernel[i];
    }
    for (int i = 0; i < n * n; i++)
        kernel[i] /= sum;
    return r;
}

static int feature_kernel(double ppd, bool edge, double *kernel)
{
    double sd = 0.5 * 0.082 * ppd, positive = 0, negative = 0;
    int r = (int)ceil(3 * sd), n = 2 * r + 1;
    for (int i = 0; i < n * n; i++) {
        double x = i % n - r, y = i / n - r, g = exp(-(x * x + y * y) / (2 * sd * sd));
        kernel[i] = edge ? -x * g : (x * x / (sd * sd) - 1) * g;
        *(kernel[i] < 0 ? &negative : &positive) += fabs(kernel[i]);
    }
    for (int i = 0; i < n * n; i++)
        kernel[i] /= kernel[i] < 0 ? negative : positive;
    return r;
}

struct oracle {
    double ppd, spatial[3][BIG * BIG], edge[BIG * BIG], point[BIG * BIG];
    int spatial_radius, feature_radius;
};

static struct vec seen(const struct oracle *o, const struct vec *picture, int x, int y)
{
    struct vec c;
    for (int i = 0; i < 3; i++)
        c.v[i] = convolve(picture, x, y, i, o->spatial[i], o->spatial_radius, false);
    c = rgb_of_ycxcz(c);
    for (int i = 0; i < 3; i++)
        c.v[i] = fmin(fmax(c.v[i], 0), 1);
    return hunt(c);
}

static double feature(const struct oracle *o, const struct vec *picture, int x, int y, bool edge)
{
    const double *kernel = edge ? o->edge : o->point;
    return hypot(convolve(picture, x, y, 0, kernel, o->feature_radius, false),
                 convolve(picture, x, y, 0, kernel, o->feature_radius, true)) /
           116;
}

static double oracle_flip(const struct oracle *o, const struct vec *a, const struct vec *b, int x,
                          int y)
{
    struct vec green = {{0, 1, 0}}, blue = {{0, 0, 1}};
    double cmax = pow(hyab(hunt(green), hunt(blue)), 0.7);
    double c = pow(hyab(seen(o, a, x, y), seen(o, b, x, y)), 0.7);
    c = c < 0.4 * cmax ? 0.95 / (0.4 * cmax) * c : 0.95 + (c - 0.4 * cmax) / (0.6 * cmax) * 0.05;
    double edge = fabs(feature(o, a, x, y, true) - feature(o, b, x, y, true));
    double point = fabs(feature(o, a, x, y, false) - feature(o, b, x, y, false));
    return pow(c, 1 - sqrt(fmax(edge, point) / sqrt(2)));
}

static void to_opponent(const uint8_t *codes, struct vec *picture)
{
    for (int i = 0; i < PIXELS; i++) {
        struct vec rgb;
        for (int c = 0; c < 3; c++)
            rgb.v[c] = rg_srgb_decode(codes[i * 4 + c] / 255.0);
        picture[i] = ycxcz(rgb);
    }
}

static const struct oracle *make_oracle(float ppd)
{
    static struct oracle o;
    o.ppd = (double)ppd;
    for (int c = 0; c < 3; c++)
        o.spatial_radius = spatial_kernel(o.ppd, c, o.spatial[c]);
    o.feature_radius = feature_kernel(o.ppd, true, o.edge);
    feature_kernel(o.ppd, false, o.point);
    return &o;
}

// The largest difference between the program's map and the oracle's.
static double worst_error(const uint8_t *a, const uint8_t *b, float ppd)
{
    static struct vec va[PIXELS], vb[PIXELS];
    static float map[PIXELS];
    const struct oracle *o = make_oracle(ppd);
    to_opponent(a, va);
    to_opponent(b, vb);
    assert_true(rg_flip_map(a, b, WIDTH, HEIGHT, ppd, map));
    double worst = 0, sum = 0;
    for (int i = 0; i < PIXELS; i++) {
        double error = fabs((double)map[i] - oracle_flip(o, va, vb, i % WIDTH, i / WIDTH));
        worst = fmax(worst, error);
        sum += error;
    }
    assert_below(sum / PIXELS, 1e-6);
    return worst;
}

static void fill_noise(uint8_t *codes, uint32_t seed, int blocks)
{
    for (int i = 0; i < PIXELS * 4; i++) {
        int x = i / 4 % WIDTH / blocks, y = i / 4 / WIDTH / blocks;
        codes[i] = (uint8_t)(rain_noise(seed + (uint32_t)((y * 997 + x) * 4 + i % 4)) >> 11);
    }
}

// Single pixels whose filtered colours nearly agree may be off by more than the mean. The power of
// 0.7 is steep there and enlarges the rounding of L*, which is around 1e-5.
static void map_equals_the_paper(void **state)
{
    (void)state;
    static uint8_t a[PIXELS * 4], b[PIXELS * 4];
    for (int blocks = 1; blocks <= 9; blocks += 4) {
        fill_noise(a, 1, blocks);
        fill_noise(b, 77, blocks);
        assert_below(worst_error(a, b, 67.0206433f), 1e-5);
        assert_below(worst_error(a, b, 31.5f), 1e-4);
    }
    memcpy(b, a, sizeof(b));
    b[(20 * WIDTH + 30) * 4] ^= 0x80; // one pixel, far from the edges
    b[3 * 4 + 1] ^= 0x40;             // and one at the top edge
    assert_below(worst_error(a, b, 67.0206433f), 1e-4);
}

static void rain_equals_the_paper(void **state)
{
    (void)state;
    static uint8_t a[PIXELS * 4], b[PIXELS * 4];
    struct rg_picture picture;
    assert_true(rg_picture_create(&picture, WIDTH, HEIGHT, 3, "rain"));
    struct rain_look look = honest_rain;
    look.streaks = 20;
    rain_draw(&picture, look);
    rg_encode(&picture, 1.0f, a);
    look.shift_px = 1;
    rain_draw(&picture, look);
    rg_encode(&picture, 1.0f, b);
    rg_picture_destroy(&picture);
    assert_below(worst_error(a, b, 67.0206433f), 1e-5);
}

// --- high dynamic range ---

// ACES as published, applied to a colour at an exposure of 0.6.
static double aces(double x)
{
    x *= 0.6;
    return fmin(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 1);
}

// The light that ACES maps to 0.85, found by halving.
static double bright(void)
{
    double low = 0, high = 100;
    for (int i = 0; i < 200; i++)
        *(aces((low + high) / 2) < 0.85 ? &low : &high) = (low + high) / 2;
    return low;
}

static int ascending_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// The median and the largest luminance.
static void luminances(const struct rg_picture *picture, double *median, double *largest)
{
    static double y[PIXELS];
    for (int i = 0; i < PIXELS; i++) {
        const float *t = picture->texels + i * 3;
        y[i] = 0.2126 * (double)t[0] + 0.7152 * (double)t[1] + 0.0722 * (double)t[2];
    }
    qsort(y, PIXELS, sizeof(double), ascending_doubles);
    *median = y[PIXELS / 2]; // the count is odd
    *largest = y[PIXELS - 1];
}

static void see(const struct rg_picture *picture, double exposure, struct vec *seen_picture)
{
    for (int i = 0; i < PIXELS; i++) {
        struct vec rgb;
        for (int c = 0; c < 3; c++)
            rgb.v[c] = aces((double)picture->texels[i * 3 + c] * exp2(exposure));
        seen_picture[i] = ycxcz(rgb);
    }
}

// Light over a dozen stops, in blocks, times `more`.
static struct rg_picture wide_picture(uint32_t seed, float more)
{
    struct rg_picture picture;
    assert_true(rg_picture_create(&picture, WIDTH, HEIGHT, 3, "wide"));
    for (int i = 0; i < PIXELS * 3; i++) {
        const uint32_t block = (uint32_t)(i / 3 / WIDTH / 4 * 97 + i / 3 % WIDTH / 4);
        const float stops = (float)(rain_noise(seed + block * 3 + (uint32_t)i % 3) >> 8) * 0x1p-24f;
        const float grain = (float)(rain_noise(seed + (uint32_t)i + 9999) >> 8) * 0x1p-24f;
        picture.texels[i] = more * exp2f(12 * stops - 6) * (0.5f + grain);
    }
    return picture;
}

static void expect_hdr(const struct rg_picture *a, const struct rg_picture *b)
{
    static struct vec va[PIXELS], vb[PIXELS];
    static float map[PIXELS];
    static double due[PIXELS];
    struct rg_hdr_flip hdr;
    double median, largest, sum = 0;
    const struct oracle *o = make_oracle(31.5f);
    luminances(a, &median, &largest);
    const double start = log2(bright() / largest), stop = log2(bright() / median);
    const int count = (int)fmax(2, ceil(stop - start));
    assert_true(rg_hdr_flip_map(a, b, 31.5f, map, &hdr));
    assert_below(fabs(hdr.start_exposure - start), 1e-5);
    assert_below(fabs(hdr.stop_exposure - stop), 1e-5);
    assert_int_equal(hdr.exposures, count);
    for (int e = 0; e < count; e++) {
        see(a, start + e * (stop - start) / (count - 1), va);
        see(b, start + e * (stop - start) / (count - 1), vb);
        for (int i = 0; i < PIXELS; i++)
            due[i] = fmax(e ? due[i] : 0, oracle_flip(o, va, vb, i % WIDTH, i / WIDTH));
    }
    for (int i = 0; i < PIXELS; i++) {
        assert_below(fabs((double)map[i] - due[i]), 1e-4);
        sum += fabs((double)map[i] - due[i]);
    }
    assert_below(sum / PIXELS, 2e-6);
}

static void hdr_equals_the_paper(void **state)
{
    (void)state;
    struct rg_picture a = wide_picture(1, 1), b = wide_picture(77, 1),
                      dark = wide_picture(1, 0.01f);
    expect_hdr(&a, &b);
    expect_hdr(&a, &dark); // exposures are the reference's
    expect_hdr(&dark, &a);
    rg_picture_destroy(&a);
    rg_picture_destroy(&b);
    rg_picture_destroy(&dark);
}

static void hdr_in_closed_form(void **state)
{
    (void)state;
    static float map[PIXELS];
    struct rg_hdr_flip hdr;
    struct rg_picture light = wide_picture(1, 1), black = wide_picture(1, 0);
    assert_true(rg_hdr_flip_map(&light, &light, 67, map, &hdr));
    for (int i = 0; i < PIXELS; i++)
        assert_equals(map[i], 0.0f);
    // Even light against black has one exposure, which maps the light to 0.85; it differs in L*
    // alone.
    for (int i = 0; i < PIXELS * 3; i++)
        light.texels[i] = 512;
    struct vec green = {{0, 1, 0}}, blue = {{0, 0, 1}};
    const double cmax = pow(hyab(hunt(green), hunt(blue)), 0.7);
    const double due = 0.95 + (pow(116 * cbrt(0.85) - 16, 0.7) - 0.4 * cmax) / (0.6 * cmax) * 0.05;
    assert_true(rg_hdr_flip_map(&light, &black, 67, map, &hdr));
    assert_int_equal(hdr.exposures, 2);
    assert_below(fabs(hdr.start_exposure - log2(bright() / 512)), 1e-5);
    assert_equals(hdr.start_exposure, hdr.stop_exposure);
    for (int i = 0; i < PIXELS; i++)
        assert_below(fabs((double)map[i] - due), 1e-5);
    // A black reference and values that are not finite give a number, too.
    light.texels[0] = INFINITY;
    light.texels[1] = NAN;
    light.texels[2] = -5;
    assert_true(rg_hdr_flip_map(&black, &light, 67, map, &hdr));
    for (int i = 0; i < PIXELS; i++)
        assert_true(map[i] > 0 && map[i] <= 1);
    // Negative light and NaN are seen as black.
    for (int i = 0; i < PIXELS * 3; i++)
        light.texels[i] = i % 2 ? -0.5f : NAN;
    assert_true(rg_hdr_flip_map(&black, &light, 67, map, &hdr));
    for (int i = 0; i < PIXELS; i++)
        assert_equals(map[i], 0.0f);
    rg_picture_destroy(&light);
    rg_picture_destroy(&black);
}

static void known_values(void **state)
{
    (void)state;
    static uint8_t black[PIXELS * 4], white_codes[PIXELS * 4], noise[PIXELS * 4];
    static float map[PIXELS];
    memset(white_codes, 255, sizeof(white_codes));
    fill_noise(noise, 5, 1);
    assert_true(rg_flip_map(noise, noise, WIDTH, HEIGHT, 67, map));
    for (int i = 0; i < PIXELS; i++)
        assert_equals(map[i], 0.0f);
    // Black to white differs by 100 in L* alone; the closed form is 0.9674.
    struct vec green = {{0, 1, 0}}, blue = {{0, 0, 1}};
    double cmax = pow(hyab(hunt(green), hunt(blue)), 0.7);
    double expected = 0.95 + (pow(100, 0.7) - 0.4 * cmax) / (0.6 * cmax) * 0.05;
    assert_above(expected, 0.967);
    assert_below(expected, 0.968);
    assert_true(rg_flip_map(black, white_codes, WIDTH, HEIGHT, 67, map));
    for (int i = 0; i < PIXELS; i++)
        assert_below(fabs((double)map[i] - expected), 1e-5);
    // Green to blue is the largest possible difference.
    for (int i = 0; i < PIXELS; i++) {
        memcpy(black + i * 4, (uint8_t[]){0, 255, 0, 255}, 4);
        memcpy(white_codes + i * 4, (uint8_t[]){0, 0, 255, 255}, 4);
    }
    assert_true(rg_flip_map(black, white_codes, WIDTH, HEIGHT, 67, map));
    assert_below(fabs((double)map[PIXELS / 2] - 1), 1e-5);
    assert_false(rg_flip_map(black, white_codes, WIDTH, HEIGHT, 0.5f, map));
}

static void approximations_are_as_near_as_stated(void **state)
{
    (void)state;
    double cbrt_error = 0, pow_error = 0;
    for (uint32_t i = 0; i < 200000; i++) {
        float x = 1e-4f + (float)(rain_noise(i) >> 8) * 0x1p-24f;
        cbrt_error = fmax(cbrt_error, fabs((double)rg_flip_cbrt(x) / cbrt((double)x) - 1));
        float y = (float)(rain_noise(i + 7777777) >> 8) * 0x1p-24f, h = x * 200;
        pow_error =
            fmax(pow_error, fabs((double)rg_flip_pow(h, y) / pow((double)h, (double)y) - 1));
    }
    assert_below(cbrt_error, 4e-7);
    assert_below(pow_error, 4e-6);
}

static int ascending(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static void pooling_equals_sorting(void **state)
{
    (void)state;
    enum { COUNT = 12345 };
    static float map[COUNT], sorted[COUNT], in_mask[COUNT];
    static uint8_t mask[COUNT];
    double sum = 0, running = 0, mask_sum = 0;
    int masked = 0;
    for (uint32_t i = 0; i < COUNT; i++) {
        float u = (float)(rain_noise(i) >> 8) * 0x1p-24f;
        map[i] = i % 3 ? u * u * u : 0.0f;
        mask[i] = i % 7 == 0;
        in_mask[masked] = map[i];
        masked += mask[i];
        mask_sum += mask[i] ? (double)map[i] : 0;
    }
    map[100] = 1.0f;
    memcpy(sorted, map, sizeof(map));
    qsort(sorted, COUNT, sizeof(float), ascending);
    qsort(in_mask, (size_t)masked, sizeof(float), ascending);
    for (int i = 0; i < COUNT; i++)
        sum += (double)sorted[i];
    int quarter[3] = {0}; // ranks at which one, two and three quarters of the sum are passed
    for (int i = 0; i < COUNT; i++) {
        for (int q = 0; q < 3; q++)
            quarter[q] += running + (double)sorted[i] <= sum * (q + 1) / 4;
        running += (double)sorted[i];
    }
    struct rg_flip flip;
    assert_true(rg_flip_pool(map, mask, COUNT, &flip));
    assert_below(fabs(flip.mean - sum / COUNT), 1e-9);
    assert_equals(flip.max, 1.0);
    assert_below(fabs(flip.p99 - (double)sorted[(COUNT * 99 + 99) / 100 - 1]), 1e-8);
    assert_below(fabs(flip.weighted_quartile_1 - (double)sorted[quarter[0]]), 1e-8);
    assert_below(fabs(flip.weighted_median - (double)sorted[quarter[1]]), 1e-8);
    assert_below(fabs(flip.weighted_quartile_3 - (double)sorted[quarter[2]]), 1e-8);
    assert_below(fabs(flip.mask_mean - mask_sum / masked), 1e-9);
    assert_below(fabs(flip.mask_p99 - (double)in_mask[(masked * 99 + 99) / 100 - 1]), 1e-8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(map_equals_the_paper),
        cmocka_unit_test(rain_equals_the_paper),
        cmocka_unit_test(known_values),
        cmocka_unit_test(hdr_equals_the_paper),
        cmocka_unit_test(hdr_in_closed_form),
        cmocka_unit_test(approximations_are_as_near_as_stated),
        cmocka_unit_test(pooling_equals_sorting),
    };
    return cmocka_run_group_tests_name("FLIP", tests, NULL, NULL);
}
