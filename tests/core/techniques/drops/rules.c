// By the physical rules a drop has the same size and speed on cells of any width, and its water
// spreads and thins as fast. By the paper's rules it does not (its section 5.1).
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/core/techniques/drops/rig.h"
#include "tests/tools/expect.h"

enum { FAR, WIDE, HIGH, STILL_WIDE, STILL_HIGH, MEASURES };

static const char *const names[MEASURES] = {"way of a drop in 15 steps, mm", "its wet area, mm^2",
                                            "its water, mm^3", "wet area of one at rest, mm^2",
                                            "its water, mm^3"};

static struct rg_device *device;

static drops_drop drop(double mg, double x_mm, double y_mm)
{
    return (drops_drop){
        .mass = (uint32_t)(mg * DROPS_QUANTA_MG), .x = (float)x_mm, .y = (float)y_mm};
}

// The wet area and the volume of the water left or right of the pane's middle.
static void measure_water(struct drops *d, bool is_right, double *area_mm2, double *volume_mm3)
{
    const double cell = d->settings.cell_mm;
    float *height = rig_words(d, "height");
    *area_mm2 = *volume_mm3 = 0;
    for (int row = 0; row < d->settings.rows; row++)
        for (int column = 0; column < d->settings.columns; column++) {
            const double h = (double)height[drops_cell(d->params, column, row)];
            if ((column >= d->settings.columns / 2) != is_right)
                continue;
            *area_mm2 += h > 0 ? cell * cell : 0;
            *volume_mm3 += h * cell * cell;
        }
    free(height);
}

// A pane of 96 x 72 mm with one drop that runs and one at rest.
static void run_on(const char *rules, double cell_mm, double *measures)
{
    char settings[200];
    snprintf(settings, sizeof(settings),
             "columns=%g rows=%g cell_mm=%g rules=%s drops_s=0 residual=off meander_rad=0 "
             "max_drops=10 seed=3",
             96 / cell_mm, 72 / cell_mm, cell_mm, rules);
    struct drops *d = rig_open(device, settings);
    const drops_drop both[] = {drop(21, 24.1, 10.1), drop(18, 72.1, 30.1)};
    rig_put(d, both, 2, 1);
    rig_step(d, 15);
    int count;
    drops_drop *all = rig_drops(d, &count);
    assert_int_equal(count, 2);
    measures[FAR] = (double)all[0].y - 10.1;
    measure_water(d, false, &measures[WIDE], &measures[HIGH]);
    rig_step(d, 45);
    measure_water(d, true, &measures[STILL_WIDE], &measures[STILL_HIGH]);
    free(all);
    rig_close(d);
}

// The largest share by which a measure differs from the paper's cells, over its bound.
static double worst(const char *rules, double cell_mm, const double *bounds)
{
    double due[MEASURES], found[MEASURES], most = 0;
    run_on(rules, 0.5, due);
    run_on(rules, cell_mm, found);
    for (int m = 0; m < MEASURES; m++) {
        const double off = fabs(found[m] / due[m] - 1) / bounds[m];
        print_message("%s, cells of %g mm: %s: %.4g, on 0.5 mm %.4g (%+.1f %%)\n", rules, cell_mm,
                      names[m], found[m], due[m], 100 * (found[m] / due[m] - 1));
        most = off > most ? off : most;
    }
    return most;
}

static void size_and_speed_hold_across_resolutions(void **state)
{
    (void)state;
    static const double bounds[MEASURES] = {0.01, 0.08, 0.08, 0.08, 0.08};
    static const double cells_mm[] = {0.25, 0.125, 0.1};
    for (int i = 0; i < 3; i++)
        assert_at_most(worst("physical", cells_mm[i], bounds), 1);
    assert_above(worst("paper", 0.25, bounds), 1);
}

// With the paper's cells and steps both rules agree to the bit.
static void rules_agree_on_the_papers_cells(void **state)
{
    (void)state;
    double paper[MEASURES], physical[MEASURES];
    run_on("paper", 0.5, paper);
    run_on("physical", 0.5, physical);
    assert_memory_equal(paper, physical, sizeof(paper));
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(size_and_speed_hold_across_resolutions),
        cmocka_unit_test(rules_agree_on_the_papers_cells),
    };
    device = rg_device_open(argc > 1 ? argv[1] : "cpu");
    assert_non_null(device);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return rg_device_close(device) ? failed : 1;
}
