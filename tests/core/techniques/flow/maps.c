// Flow's remainder, noise and bead maps, generated and the user's own, are as docs/flow.md
// describes.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/image/files/io.h"
#include "core/image/files/options.h"
#include "core/image/srgb.h"
#include "core/techniques/flow/inputs/flow.h"
#include "tests/tools/expect.h"

static char folder[] = "/tmp/raingauge-maps-XXXXXX";
static char path[64];

static struct flow_settings defaults(void)
{
    struct flow_settings s;
    rg_params_reset(&flow_param_table, &s);
    return s;
}

// --- remainder ---

// All water stays up to L. Then the remainder falls to remainder_low at remainder_low_height, on
// the cubic whose slope is 0 at both ends, and stays there. The last entry is for
// remainder_max_height.
static void test_the_remainder_falls_from_1_to_its_low(void **state)
{
    (void)state;
    static const double cases[][4] = {
        {0.15, 0.3, 1, 2}, {0.5, 0, 0.75, 1}, {0, 0.8, 3, 4}, {0.2, 1, 1, 2}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct flow_settings s = defaults();
        const double l = s.move_threshold = cases[i][0], low = s.remainder_low = cases[i][1];
        const double end = s.remainder_low_height = cases[i][2];
        s.remainder_max_height = cases[i][3];
        float *map = flow_remainder_map(&s);
        assert_non_null(map);
        for (int k = 0; k < FLOW_REMAINDER_ENTRIES; k++) {
            const double water = s.remainder_max_height * k / (FLOW_REMAINDER_ENTRIES - 1);
            const double t = (water - l) / (end - l);
            const double due = water <= l     ? 1
                               : water >= end ? low
                                              : 1 - (1 - low) * (3 * t * t - 2 * t * t * t);
            if (fabs((double)map[k] - due) > 1e-6)
                fail_msg("case %zu: %g at %g units, not %g", i, (double)map[k], water, due);
        }
        free(map);
    }
}

// A map is data: a texel's code is the same number whatever curve displays use. The picture holds
// codes, column after column; the row below means nothing.
static void write_codes(int width, int height, int (*code)(int x, int y, int channel))
{
    struct rg_picture p;
    assert_true(rg_picture_create(&p, width, height, 3, "map"));
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            for (int c = 0; c < 3; c++)
                p.texels[(y * width + x) * 3 + c] = (float)rg_srgb_decode(code(x, y, c) / 255.0);
    assert_true(rg_picture_write(path, &p, &(struct rg_write_options){0}));
    rg_picture_destroy(&p);
}

static int remainder_code(int x, int y, int channel)
{
    const int codes[4] = {255, 128, 40, 0};
    return y ? 77 : channel == 2 && x == 2 ? 100 : codes[x];
}

static void test_a_remainder_image_is_its_first_row(void **state)
{
    (void)state;
    struct flow_settings s = defaults();
    write_codes(4, 3, remainder_code);
    snprintf(s.remainder_map, sizeof(s.remainder_map), "%s", path);
    float *map = flow_remainder_map(&s);
    assert_non_null(map);
    const double due[4] = {1, 128 / 255.0, (40 + 40 + 100) / 3.0 / 255, 0};
    for (int k = 0; k < FLOW_REMAINDER_ENTRIES; k++)
        if (fabs((double)map[k] - due[k / 256]) > 1e-6)
            fail_msg("entry %d is %g, not %g", k, (double)map[k], due[k / 256]);
    free(map);
}

// --- noise ---

static double correlation(const float *map, int n, int apart)
{
    double sum = 0, square = 0, both = 0;
    for (int i = 0; i < n * n; i++) {
        const double a = (double)map[i], b = (double)map[i / n * n + (i % n + apart) % n];
        sum += a;
        square += a * a;
        both += a * b;
    }
    const double mean = sum / n / n;
    return (both / n / n - mean * mean) / (square / n / n - mean * mean);
}

// The largest step between neighbours, across the seam or elsewhere.
static double largest_step(const float *map, int n, bool over_seam)
{
    double most = 0;
    for (int i = 0; i < n; i++)
        for (int k = over_seam ? n - 1 : 0; k < (over_seam ? n : n - 1); k++) {
            const int next = (k + 1) % n;
            most = fmax(most, fabs((double)map[i * n + k] - (double)map[i * n + next]));
            most = fmax(most, fabs((double)map[k * n + i] - (double)map[next * n + i]));
        }
    return most;
}

// Noise runs from noise_low to 1, has its mean in the middle, and has no seam. Neighbours are
// alike. Places farther apart than 32 texels, a cell of the coarsest octave, are not.
static void test_the_noise_is_noise(void **state)
{
    (void)state;
    for (int seed = 1; seed <= 3; seed++) {
        struct flow_settings s = defaults();
        s.seed = seed;
        s.noise_low = 0.25 * seed;
        int n;
        float *map = flow_noise_map(&s, &n);
        assert_non_null(map);
        assert_int_equal(n, 512);
        double low = 2, high = -1, sum = 0;
        for (int i = 0; i < n * n; i++) {
            low = fmin(low, (double)map[i]);
            high = fmax(high, (double)map[i]);
            sum += (double)map[i];
        }
        const double range = 1 - s.noise_low;
        assert_below(fabs(low - s.noise_low), 1e-6);
        assert_below(fabs(high - 1), 1e-6);
        assert_below(fabs(sum / n / n - (s.noise_low + range / 2)), 0.06 * range);
        assert_at_most(largest_step(map, n, true), 1.2 * largest_step(map, n, false));
        assert_below(largest_step(map, n, false), 0.5 * range);
        assert_above(correlation(map, n, 1), 0.9);
        assert_below(fabs(correlation(map, n, 96)), 0.15);
        free(map);
    }
}

// The correlation of two maps of n texels.
static double likeness(const float *a, const float *b, int n)
{
    double sum_a = 0, sum_b = 0, both = 0, square_a = 0, square_b = 0;
    for (int i = 0; i < n; i++) {
        sum_a += (double)a[i];
        sum_b += (double)b[i];
    }
    for (int i = 0; i < n; i++) {
        const double off_a = (double)a[i] - sum_a / n, off_b = (double)b[i] - sum_b / n;
        both += off_a * off_b;
        square_a += off_a * off_a;
        square_b += off_b * off_b;
    }
    return both / sqrt(square_a * square_b);
}

// One seed makes one map, and other seeds make others. The coarsest octave has 256 places: two maps
// correlate by 1/16 by chance, and never by 1/4.
static void test_noise_follows_the_seed(void **state)
{
    (void)state;
    struct flow_settings s = defaults();
    int n;
    float *one = flow_noise_map(&s, &n), *again = flow_noise_map(&s, &n);
    assert_memory_equal(one, again, (size_t)(n * n) * sizeof(*one));
    for (s.seed = 2; s.seed <= 4; s.seed++) {
        float *other = flow_noise_map(&s, &n);
        const double alike = likeness(one, other, n * n);
        if (fabs(alike) > 0.25)
            fail_msg("seeds 1 and %d are alike by %g", s.seed, alike);
        free(other);
    }
    free(one);
    free(again);
}

static int noise_code(int x, int y, int channel)
{
    (void)channel;
    return 20 + 30 * x + 100 * y;
}

static int noise_of_one_code(int x, int y, int channel)
{
    (void)x, (void)y, (void)channel;
    return 128;
}

// The longer side is kept, and texels along the other one are repeated.
static void test_a_noise_image_becomes_square(void **state)
{
    (void)state;
    struct flow_settings s = defaults();
    int n;
    write_codes(4, 2, noise_code);
    snprintf(s.noise_map, sizeof(s.noise_map), "%s", path);
    float *map = flow_noise_map(&s, &n);
    assert_non_null(map);
    assert_int_equal(n, 4);
    for (int i = 0; i < n * n; i++)
        assert_below(fabs((double)map[i] - noise_code(i % 4, i / 4 / 2, 0) / 255.0), 1e-6);
    free(map);
    write_codes(4097, 1, noise_of_one_code);
    assert_null(flow_noise_map(&s, &n));
    assert_non_null(strstr(rg_last_error(), "at most 4096 pixels"));
}

// No two panes share a window: each begins 0.382 of the map after the one before.
static void test_windows_of_panes_lie_apart(void **state)
{
    (void)state;
    const struct flow_settings s = defaults();
    flow_pane panes[FLOW_MAX_PANES];
    flow_panes_at(&s, 512, 7, panes);
    for (int i = 0; i < FLOW_MAX_PANES; i++) {
        const double due = i * 0.382 - floor(i * 0.382);
        assert_below(fabs((double)panes[i].noise_shift / 512 - due), 1e-3);
    }
}

// --- beads ---

// Beads are smooth, seamless and at most bead_mm high. Half of the places are dry, and resolutions
// agree.
static void test_beads(void **state)
{
    (void)state;
    struct flow_settings s = defaults();
    s.resolution_px = 240;
    float *map = flow_bead_map(&s);
    s.resolution_px = 720;
    float *fine = flow_bead_map(&s);
    assert_true(map && fine);
    const int n = 240;
    double high = 0, dry = 0;
    for (int i = 0; i < n * n; i++) {
        high = fmax(high, (double)map[i] * s.relief);
        dry += map[i] == 0;
        // The middle one of nine fine texels has the coarse texel's place.
        assert_below(fabsf(map[i] - fine[(i / n * 3 + 1) * 720 + i % n * 3 + 1]), 1e-6f);
    }
    assert_below(fabs(high - s.bead_mm), 1e-6);
    assert_above(dry / n / n, 0.45);
    assert_below(dry / n / n, 0.55);
    assert_at_most(largest_step(map, n, true), 1.2 * largest_step(map, n, false));
    // Beads have the right distance: places a spacing apart do not correlate.
    assert_above(correlation(map, n, 1), 0.8);
    assert_below(fabs(correlation(map, n, 8)), 0.15);
    free(map);
    free(fine);
}

static int make_folder(void **state)
{
    (void)state;
    if (!mkdtemp(folder))
        return -1;
    snprintf(path, sizeof(path), "%s/map.png", folder);
    return 0;
}

static int remove_folder(void **state)
{
    (void)state;
    unlink(path);
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_remainder_falls_from_1_to_its_low),
        cmocka_unit_test(test_a_remainder_image_is_its_first_row),
        cmocka_unit_test(test_the_noise_is_noise),
        cmocka_unit_test(test_noise_follows_the_seed),
        cmocka_unit_test(test_a_noise_image_becomes_square),
        cmocka_unit_test(test_windows_of_panes_lie_apart),
        cmocka_unit_test(test_beads),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
