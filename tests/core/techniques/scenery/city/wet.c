// The kernel's mirroring of lamps by wet roads, beside an oracle's and measured roads.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "backends/cpu/kernels/notes.h"
#include "kernels/scenery/city_shade.h"
#include "tests/oracle/scenery/scene.h"
#include "tests/tools/expect.h"

static const double pi = 3.14159265358979323846;

static double gleam(int kind, const double way[3], const double to[3])
{
    return (double)scenery_gleam(kind, v3_make(0, 1, 0),
                                 v3_make((float)way[0], (float)way[1], (float)way[2]),
                                 v3_make((float)to[0], (float)to[1], (float)to[2]), (float)to[1]);
}

// A unit vector at an elevation and an azimuth, in degrees.
static void towards(double elevation, double azimuth, double d[3])
{
    const double level = cos(elevation * pi / 180);
    d[0] = level * sin(azimuth * pi / 180);
    d[1] = sin(elevation * pi / 180);
    d[2] = level * cos(azimuth * pi / 180);
}

// Lamps and suns all around a road, seen from steep to flat.
static void facets_mirror_as_the_oracle_says(void **state)
{
    (void)state;
    static const double heights[] = {1, 5, 20, 45, 80};
    const double normal[3] = {0, 1, 0};
    double most = 0;
    for (int eye = 0; eye < 5; eye++)
        for (int light = 0; light < 5; light++)
            for (int azimuth = 0; azimuth <= 180; azimuth += 30) {
                double way[3], to[3];
                towards(-heights[eye], 0, way);
                towards(heights[light], azimuth, to);
                const double lamp =
                    gleam(SCENERY_SPOT, way, to) / scene_film(normal, way, to, 0.25);
                const double sun = gleam(SCENERY_SUN, way, to) / scene_film(normal, way, to, 0.6);
                if (!(fabs(lamp - 1) < 1e-5 && fabs(sun - 1) < 1e-5)) // also where one is no number
                    fail_msg("eye %g, light %g, azimuth %d: a lamp %g, a sun %g of what is due",
                             heights[eye], heights[light], azimuth, lamp, sun);
                most = fmax(most, fmax(fabs(lamp - 1), fabs(sun - 1)));
            }
    print_message("%.2g apart at most\n", most);
}

// What a road shows of a lamp: its own share and what water mirrors. The road under the water is as
// dark as asphalt.
static double luminance(double along, double across)
{
    const double eye = pi / 180, albedo = 0.06, way[3] = {0, -sin(eye), cos(eye)},
                 length = sqrt(1 + along * along + across * across);
    const double to[3] = {across / length, 1 / length, along / length};
    return albedo / pi + gleam(SCENERY_SPOT, way, to) / pi * length;
}

// Measured wet roads (CIE 47-1979; van Bommel, Road Lighting, 2015, table 12.3): the specular
// factor S1 of classes W2 and W3, 4.5 to 9.8, and their mean luminance coefficients Q0, 0.150 and
// 0.196, seen one degree from above.
static void wet_roads_are_as_measured(void **state)
{
    (void)state;
    // r = q cos^3 of the light's angle; from straight ahead at tan 2, and from above.
    const double s1 = luminance(2, 0) / pow(5, 1.5) / luminance(0, 0);
    double sum = 0, solid = 0;
    // From 4 lamp heights behind to 12 ahead, and 3 to either side.
    for (int i = 0; i < 160; i++)
        for (int k = 0; k < 60; k++) {
            const double along = -4 + 16 * (i + 0.5) / 160, across = -3 + 6 * (k + 0.5) / 60;
            const double seen = pow(1 + along * along + across * across, -1.5);
            sum += luminance(along, across) * seen;
            solid += seen;
        }
    print_message("a wet road: S1 %.2f, Q0 %.3f\n", s1, sum / solid);
    assert_above(s1, 4.5);
    assert_below(s1, 9.8);
    assert_above(sum / solid, 0.150);
    assert_below(sum / solid, 0.196);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(facets_mirror_as_the_oracle_says),
        cmocka_unit_test(wet_roads_are_as_measured),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
