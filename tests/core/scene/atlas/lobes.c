// The atlas' lights as directions, shares of the sphere and lobes; and pictures made smaller.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "core/scene/atlas/atlas.h"
#include "core/scene/atlas/levels.h"
#include "core/scene/atlas/lights.h"
#include "tests/tools/expect.h"

static struct rg_lobes lobes;

static int setup(void **state)
{
    (void)state;
    rg_lobes_of_atlas(&lobes);
    return 0;
}

static void assert_direction(double elevation, double azimuth, double x, double y, double z)
{
    float d[3];
    rg_lobe_direction(elevation, azimuth, d);
    assert_below(fabs((double)d[0] - x), 1e-6);
    assert_below(fabs((double)d[1] - y), 1e-6);
    assert_below(fabs((double)d[2] - z), 1e-6);
}

// The viewer is at +z; the viewer's right is +x, and up is +y.
static void test_directions(void **state)
{
    (void)state;
    assert_direction(0, 0, 0, 0, 1);
    assert_direction(0, 90, 1, 0, 0);
    assert_direction(0, 180, 0, 0, -1);
    assert_direction(90, 0, 0, 1, 0);
    assert_direction(-30, 90, sqrt(0.75), -0.5, 0);
}

// 74 lobes for 90 cells: the lights at both poles have no azimuth.
static void test_cells(void **state)
{
    (void)state;
    int cells[RG_LOBE_COUNT] = {0};
    for (int light = 0; light < RG_ATLAS_LIGHTS; light++)
        for (int phi = 0; phi < RG_ATLAS_PHIS; phi++) {
            const int lobe = rg_lobe_of_cell(light, phi);
            assert_between(lobe, 0, RG_LOBE_COUNT - 1);
            cells[lobe]++;
            float d[3];
            rg_lobe_direction(20 * light - 90, 10 + 20 * phi, d);
            for (int c = 0; c < 3; c++)
                assert_below(fabsf(d[c] - lobes.direction[lobe][c]), 1e-6f);
        }
    for (int lobe = 0; lobe < RG_LOBE_COUNT; lobe++)
        assert_int_equal(cells[lobe], lobe == 0 || lobe == RG_LOBE_COUNT - 1 ? 9 : 1);
}

static void test_shares(void **state)
{
    (void)state;
    double sum = 0;
    for (int lobe = 0; lobe < RG_LOBE_COUNT; lobe++)
        sum += rg_lobe_share_sr(lobe);
    assert_below(fabs(sum - 4 * M_PI), 1e-9);
    assert_below(fabs(rg_lobe_share_sr(0) - 2 * M_PI * (1 - cos(M_PI / 18))), 1e-9);
}

// A lamp has an irradiance of 1. It is an even disc of 7.5 degrees whose rim fades over one.
static void test_radiance(void **state)
{
    (void)state;
    enum { STEPS = 200000 };
    const double widest = 0.4;
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double angle = (i + 0.5) * widest / STEPS;
        sum += (double)rg_lobe_radiance(&lobes, (float)cos(angle)) * 2 * M_PI * sin(angle) *
               widest / STEPS;
    }
    assert_below(fabs(sum - 1), 1e-3);
    static const double expected[][2] = {{0, 1},     {3, 1},       {6.9, 1},
                                         {7.5, 0.5}, {7.75, 0.25}, {8, 0}};
    for (int i = 0; i < 6; i++) {
        const float cosine = (float)cos(expected[i][0] * M_PI / 180);
        const double radiance = (double)(rg_lobe_radiance(&lobes, cosine) / lobes.peak);
        assert_below(fabs(radiance - expected[i][1]), 1e-4);
    }
}

// A square's list holds every light that its directions can look into.
static void test_lists(void **state)
{
    (void)state;
    srand(7);
    for (int i = 0; i < 100000; i++) {
        double d[3], length = 0;
        for (int c = 0; c < 3; c++) {
            d[c] = rand() / (double)RAND_MAX * 2 - 1;
            length += d[c] * d[c];
        }
        length = sqrt(length);
        if (length < 0.1 || length > 1)
            continue;
        const int square = rg_lobes_square((float)d[0], (float)d[1], (float)d[2]);
        for (int lobe = 0; lobe < lobes.count; lobe++) {
            double cosine = 0;
            for (int c = 0; c < 3; c++)
                cosine += d[c] / length * (double)lobes.direction[lobe][c];
            bool is_listed = cosine <= (double)lobes.edge + 1e-6;
            for (int k = 0; k < lobes.listed[square]; k++)
                is_listed = is_listed || lobes.list[square][k] == lobe;
            assert_true(is_listed);
        }
    }
}

// --- smaller pictures ---

// A pixel is the mean of the pixels that it covers, whole or in part.
static void test_shrinking(void **state)
{
    (void)state;
    static const float from[] = {0, 3, 6, 9, 12, 15};
    float to[4];
    rg_shrink(from, 3, 2, to, 3, 1);
    assert_equals(to[0], 4.5f);
    assert_equals(to[1], 7.5f);
    assert_equals(to[2], 10.5f);
    rg_shrink(from, 3, 1, to, 2, 1);
    assert_below(fabsf(to[0] - 1), 1e-6f);
    assert_below(fabsf(to[1] - 5), 1e-6f);
}

// Halves round to the nearest and keep 11 bits of a number.
static void test_halves(void **state)
{
    (void)state;
    for (int i = 0; i < 4096; i++) {
        const double value = 1 + i / 4096.0;
        const double kept = (double)rg_half_value(rg_half_of((float)value));
        assert_at_most(fabs(kept - value), 1 / 2048.0);
        if (i % 4 != 2)
            assert_equals(kept, rint(value * 1024) / 1024);
    }
    assert_equals(rg_half_value(rg_half_of(1e-6f)), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_directions), cmocka_unit_test(test_cells),
        cmocka_unit_test(test_shares),     cmocka_unit_test(test_radiance),
        cmocka_unit_test(test_lists),      cmocka_unit_test(test_shrinking),
        cmocka_unit_test(test_halves),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
