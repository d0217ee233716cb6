// The absolute brightness of streaks, all pixels together, for lamps around the viewer: what a drop
// scatters into each angle, in tents of 20 degrees. A sphere's against Snell's and Fresnel's laws
// in closed form; swinging drops' against an ensemble of the same shapes, by an oracle.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "core/scene/atlas/streak.h"
#include "tests/oracle/optics/drop.h"
#include "tests/oracle/optics/fresnel.h"
#include "tests/tools/expect.h"

#define PI       3.14159265358979323846
#define LAMP_DEG 7.5

enum { ANGLES = 8, AREA = ANGLES, FIGURES, LAMPS = 19, OSCILLATIONS = 10 };

static const double angles[ANGLES] = {22, 40, 60, 80, 100, 120, 140, 162};

// --- lamps ---

// Lamp i of a tent stands 2 (i - 9) degrees further; together they weigh 1.
static double weight_of(int i)
{
    return (1 - fabs(i - 9.0) / 10) / 10;
}

// The azimuth of a lamp of the tent at a scattering angle: at 180 light comes from the viewer.
static double azimuth_of(int angle, int i)
{
    return 180 - angles[angle] + 2 * (i - 9);
}

// The mean radiance of a tent's lamps in a direction, for an irradiance of 1 from each. The lamps
// stand at the viewer's right; a direction on the left counts as its mirror image.
static double tent_radiance(int angle, const double d[3])
{
    const double edge = cos(LAMP_DEG * PI / 180);
    double sum = 0;
    for (int i = 0; i < LAMPS; i++) {
        const double azimuth = azimuth_of(angle, i) * PI / 180;
        for (int side = -1; side < 2; side += 2)
            if (side * d[0] * sin(azimuth) + d[2] * cos(azimuth) > edge)
                sum += 0.5 * weight_of(i) / (2 * PI * (1 - edge));
    }
    return sum;
}

// --- ours ---

static struct rg_streak_detail coarse(enum rg_swings swings)
{
    return (struct rg_streak_detail){swings, .moments = RG_DATABASE_POSES, .column = 20,
                                     .along = 48};
}

// Adds what the drops of an oscillation scatter into each angle over the exposure, and the area
// that they cover, in radii^2. Traces a level of the atlas in some detail.
static void add_ours(struct rg_streak_detail detail, int level, int oscillation,
                     double sums[FIGURES])
{
    static struct rg_lobes lobes;
    const double radius_px = 23.744 / 2 / (1 << level), drop_px = radius_px * radius_px;
    for (int first = 0; first < ANGLES; first += 2) {
        float directions[2 * LAMPS][3];
        for (int i = 0; i < 2 * LAMPS; i++)
            rg_lobe_direction(0, azimuth_of(first + i / LAMPS, i % LAMPS), directions[i]);
        rg_lobes_fill(&lobes, 2 * LAMPS, directions, RG_LAMP_DEG);
        struct rg_streaks s;
        assert_true(rg_streaks_trace(oscillation, 0, level, &detail, &lobes, &s));
        const int pixels = s.width * s.height;
        for (int k = 0; k < 2 * LAMPS * pixels; k++)
            sums[first + k / (LAMPS * pixels)] +=
                (double)s.point[k] * weight_of(k / pixels % LAMPS) / drop_px;
        for (int k = 0; first == 0 && k < pixels; k++)
            sums[AREA] += (double)s.env[k] / drop_px;
        rg_streaks_free(&s);
    }
}

// --- theirs ---

// A place in the square of numbers that fill it evenly.
static double even(int i, double step)
{
    return i * step - floor(i * step);
}

// A sphere's, in closed form: rays of all distances from the middle, in all directions about it.
static void find_sphere(double sums[ANGLES])
{
    enum { RAYS = 300000 };
    for (int r = 0; r < RAYS; r++) {
        const double b = sqrt((r + 0.5) / RAYS), turn = 2 * PI * even(r, 0.6180339887498949);
        const double in = asin(b), out = asin(b / 1.333);
        const double reflected = fresnel(in, 1 / 1.333);
        for (int way = 0; way < ORACLE_WAYS; way++) {
            const double bend = way ? 2 * (in - out) + (way - 1) * (PI - 2 * out) : PI - 2 * in;
            const double share = way ? pow(1 - reflected, 2) * pow(reflected, way - 1) : reflected;
            const double aside = way ? -sin(bend) : sin(bend);
            const double d[3] = {aside * cos(turn), aside * sin(turn), -cos(bend)};
            for (int a = 0; a < ANGLES; a++)
                sums[a] += share * tent_radiance(a, d) * PI / RAYS;
        }
    }
}

// Drops of all oscillations at all times of the exposure, by the oracle. Where `sees` is set, light
// meets the surface again however near it is, as in a real drop.
static void find_ensemble(bool database, bool sees, double sums[FIGURES])
{
    enum { RAYS = 100000 };
    const double reach = 1.31, ray[3] = {0, 0, -1};
    for (int r = 0; r < RAYS; r++) {
        const double part = even(r, 0.8191725133961645);
        struct oracle_drop drop = oracle_drop_at(database, r % OSCILLATIONS, part);
        drop.blind = sees ? 0 : drop.blind;
        const double start[3] = {reach * (2 * even(r, 0.6710436067037893) - 1),
                                 reach * (2 * even(r, 0.5497004779019703) - 1), 2};
        double direction[ORACLE_WAYS][3], share[ORACLE_WAYS];
        if (!oracle_drop_light(&drop, start, ray, direction, share))
            continue;
        const double area = 4 * reach * reach / RAYS;
        sums[AREA] += area;
        for (int way = 0; way < ORACLE_WAYS; way++)
            for (int a = 0; a < ANGLES && share[way] > 0; a++)
                sums[a] += share[way] * tent_radiance(a, direction[way]) * area;
    }
}

// --- tests ---

static double sphere[ANGLES];

static int setup(void **state)
{
    (void)state;
    find_sphere(sphere);
    return 0;
}

// Prints a row of docs/atlas.md: the ratios of one to the other.
static void print_ratios(const char *what, const double of[ANGLES], const double to[ANGLES])
{
    print_message("%-40s", what);
    for (int a = 0; a < ANGLES; a++)
        print_message(" %5.2f", of[a] / to[a]);
    print_message("\n");
}

static void expect_near(const double ours[ANGLES], const double theirs[ANGLES], double room)
{
    for (int a = 0; a < ANGLES; a++)
        if (!(fabs(ours[a] / theirs[a] - 1) < room))
            fail_msg("%g degrees: %g, expected %g", angles[a], ours[a], theirs[a]);
}

static void test_sphere(void **state)
{
    (void)state;
    double ours[FIGURES] = {0};
    add_ours(coarse(RG_SWINGS_DATABASE), 2, 0, ours);
    print_ratios("a sphere, over the closed form", ours, sphere);
    expect_near(ours, sphere, 0.05); // 4.6 %: rays near the rim turn by 80 degrees
}

static void expect_ensemble(bool database, double room)
{
    double ours[FIGURES] = {0}, theirs[FIGURES] = {0};
    for (int k = 0; k < OSCILLATIONS; k++) {
        add_ours(coarse(database ? RG_SWINGS_DATABASE : RG_SWINGS_MEASURED), 2, k, ours);
        if (k == 0)
            print_ratios(database ? "database, at rest" : "measured, at rest", ours, sphere);
    }
    for (int i = 0; i < FIGURES; i++)
        ours[i] /= OSCILLATIONS;
    find_ensemble(database, false, theirs);
    print_ratios(database ? "database, over the oracle" : "measured, over the oracle", ours,
                 theirs);
    print_ratios(database ? "database, over a sphere" : "measured, over a sphere", ours, sphere);
    print_ratios("the oracle, over a sphere", theirs, sphere);
    print_message("an area of %.4f for %.4f\n", ours[AREA] / PI, theirs[AREA] / PI);
    assert_below(fabs(ours[AREA] / theirs[AREA] - 1), 0.004); // 0.3 %
    expect_near(ours, theirs, room);
}

static void test_measured(void **state)
{
    (void)state;
    expect_ensemble(false, 0.035); // 2.8 %
}

// Swings alone make the database's drops, which are spheres at rest, bright: without the blind zone
// of its renderer they are as bright at 120 degrees, and brighter still at 162.
static void test_database(void **state)
{
    (void)state;
    double sees[FIGURES] = {0};
    expect_ensemble(true, 0.03); // 2.2 %
    find_ensemble(true, true, sees);
    print_ratios("no blind zone, over a sphere", sees, sphere);
    assert_below(fabs(sees[5] / sphere[5] - 1.73), 0.02);
    assert_below(fabs(sees[7] / sphere[7] - 4.86), 0.02);
}

// The default atlas in its whole detail scatters as much as in the coarse one of the tests above.
static void test_shipped(void **state)
{
    (void)state;
    double whole[FIGURES] = {0}, ours[FIGURES] = {0};
    add_ours(rg_atlas_kinds[RG_ATLAS_MEASURED].detail, 0, 8, whole);
    add_ours(coarse(RG_SWINGS_MEASURED), 2, 8, ours);
    print_ratios("in its whole detail, over a coarse one", whole, ours);
    expect_near(whole, ours, 0.005); // 0.4 %
    assert_below(fabs(whole[AREA] / ours[AREA] - 1), 0.004);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sphere),
        cmocka_unit_test(test_measured),
        cmocka_unit_test(test_database),
        cmocka_unit_test(test_shipped),
    };
    return cmocka_run_group_tests(tests, setup, NULL);
}
