// The crown of a puddle beside published splashes. Worthington photographed drops of almost the
// energy of ours (A Study of Splashes, 1908), and Lehmann et al. counted droplets (Ejection of
// marine microplastics by raindrops, 2021). Neither has splashes on a film, dry ground or glass.
#include <math.h>
#include <stdlib.h>

#include "core/scene/atlas/splash.h"
#include "tests/tools/expect.h"

enum { FILM, PUDDLE, ROUGH, SMOOTH };
static const double pi = 3.14159265358979323846;

// Of our drop, of 3.2 mm at 8.16 m/s.
static double energy_j(void)
{
    return pi / 6 * pow(0.0032, 3) * 1000 * 8.16 * 8.16 / 2;
}

// Series I: a drop of 0.2 g fell by 40 cm into milk and water. Its crown was about highest after 7
// ms, and a mere ring of lobes after 56 ms.
static void test_times_of_the_crown(void **state)
{
    (void)state;
    double highest_m = 0, at_s = 0;
    for (int k = 1; k < 1000; k++) {
        const double time_s = k * 1e-4,
                     height_m = rg_splash_crown(RG_SWINGS_MEASURED, PUDDLE, time_s).height_m;
        at_s = height_m > highest_m ? time_s : at_s;
        highest_m = fmax(height_m, highest_m);
        assert_true(time_s > 0.056 ? height_m == 0 : time_s > 0.0559 || height_m > 0);
    }
    assert_below(fabs(at_s - 0.007), 2e-4);
    assert_below(fabs(0.2e-3 * 9.81 * 0.4 / energy_j() - 1.37), 0.01); // their energy over ours
}

// Series IV: the crater of a drop of 0.176 g, which fell by 40 cm, would contain about fifty drops.
// The widest crater of this volume is half a sphere. The water that it lifts has an energy as the
// fourth power of its radius.
static void test_width_of_the_crown(void **state)
{
    (void)state;
    const double crater_m3 = 50 * 0.176e-6, theirs_j = 0.176e-3 * 9.81 * 0.4;
    const double due_m = cbrt(1.5 * crater_m3 / pi) * pow(energy_j() / theirs_j, 0.25);
    const double is_m = rg_splash_crown(RG_SWINGS_MEASURED, PUDDLE, 1).radius_m;
    if (fabs(is_m / due_m - 1) > 0.01)
        fail_msg("a crown of %.2f mm, not %.2f", 1000 * is_m, 1000 * due_m);
    // More than any water may have if it gets the drop's energy whole: pi / 4 rho g r^4.
    assert_below(is_m, pow(4 * energy_j() / (pi * 1000 * 9.81), 0.25));
    // Splashes are largest on a film a third as deep as the drop is wide (Mutchler and Hansen,
    // 1970).
    for (int material = PUDDLE; material <= SMOOTH; material++)
        assert_below(rg_splash_crown(RG_SWINGS_MEASURED, material, 1).radius_m,
                     rg_splash_crown(RG_SWINGS_MEASURED, FILM, 1).radius_m);
}

// A drop of 4 mm at its 8.83 m/s throws up 167 droplets, ours as many of them as it has of that
// energy. All are in the air after 9 ms, beside the balls of the rim and of the fingers.
static void test_number_of_droplets(void **state)
{
    (void)state;
    const double due = 167 * energy_j() / (pi / 6 * pow(0.004, 3) * 1000 * 8.83 * 8.83 / 2);
    struct rg_water water;
    rg_splash_water(RG_SWINGS_MEASURED, PUDDLE, 0.009, &water);
    const int is = water.count - 11 * water.spikes;
    if (abs(is - (int)lround(due)) > 0)
        fail_msg("%d droplets, not %.1f", is, due);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_times_of_the_crown),
        cmocka_unit_test(test_width_of_the_crown),
        cmocka_unit_test(test_number_of_droplets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
