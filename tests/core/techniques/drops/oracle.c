// drops on a device and the paper's own rule (one drop after the other, in double precision) agree
// in the mean over many seeds. Single drops differ, since their random numbers do.
//
// Equivalence (two one-sided tests at 5 %): the 90 % interval of the difference of two means lies
// within a bound, a share of the model's mean.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/core/techniques/drops/rig.h"
#include "tests/oracle/drops/drops.h"

enum { SEEDS = 30, STEPS = 2000, COLUMNS = 160, ROWS = 120 };
enum { DROPS, MASS, DRAINED, TRAIL, WET, MERGES, RESIDUALS, MEASURES };

static const char *const names[MEASURES] = {"drops",         "mass on the pane", "mass drained",
                                            "trail length",  "wet area",         "merges",
                                            "residual drops"};

static struct rg_device *device;

// The distance that all drops ran in a step, from the paths that they remember.
static double way_of_step(struct drops *d)
{
    const int points = d->settings.substeps + 1;
    float *ways = rig_words(d, "ways");
    double sum = 0;
    for (int i = 0; i < d->params.count; i++)
        for (int k = 0; k + 1 < points; k++) {
            const float *at = ways + 2 * ((int64_t)i * points + k);
            sum += hypot((double)at[2] - (double)at[0], (double)at[3] - (double)at[1]);
        }
    free(ways);
    return sum;
}

static void run_ours(int seed, double drops_a_step, int most, double *measures)
{
    char text[160];
    snprintf(text, sizeof(text), "columns=%d rows=%d seed=%d drops_s=%.17g max_drops=%d", COLUMNS,
             ROWS, seed, drops_a_step * 60, most);
    struct drops *d = rig_open(device, text);
    measures[TRAIL] = 0;
    for (int i = 0; i < STEPS; i++) {
        rig_step(d, 1);
        measures[TRAIL] += way_of_step(d);
    }
    int count;
    drops_drop *all = rig_drops(d, &count);
    float *height = rig_words(d, "height");
    measures[DROPS] = count;
    measures[MASS] = measures[WET] = 0;
    for (int i = 0; i < count; i++)
        measures[MASS] += all[i].mass / (double)DROPS_QUANTA_MG;
    for (int64_t i = 0; i < (int64_t)rg_asset_find(&d->base, "height")->buf->size / 4; i++)
        measures[WET] += height[i] > 0;
    measures[DRAINED] = rig_tally(d, DROPS_DRAINED) / (double)DROPS_QUANTA_MG;
    measures[MERGES] = rig_tally(d, DROPS_MERGED) - (double)rig_tally(d, DROPS_MERGINGS);
    measures[RESIDUALS] = rig_tally(d, DROPS_BORN);
    free(all);
    free(height);
    rig_close(d);
}

static void run_model(int seed, double drops_a_step, int most, double *measures)
{
    struct oracle_drops_settings settings = oracle_drops_defaults();
    settings.columns = COLUMNS;
    settings.rows = ROWS;
    settings.drops_a_step = drops_a_step;
    settings.max_drops = most;
    settings.seed = (uint64_t)seed;
    struct oracle_drops model;
    oracle_drops_open(&model, &settings);
    for (int i = 0; i < STEPS; i++)
        oracle_drops_step(&model);
    const struct oracle_drops_measures m = oracle_drops_measure(&model);
    measures[DROPS] = m.drops;
    measures[MASS] = m.mass_mg;
    measures[DRAINED] = m.drained_mg;
    measures[TRAIL] = m.trail_mm;
    measures[WET] = m.wet_cells;
    measures[MERGES] = (double)model.ledger.merges;
    measures[RESIDUALS] = (double)model.ledger.residuals;
    oracle_drops_close(&model);
}

struct moments {
    double mean, variance;
};

static struct moments moments_of(double runs[SEEDS][MEASURES], int measure)
{
    struct moments m = {0};
    for (int i = 0; i < SEEDS; i++)
        m.mean += runs[i][measure] / SEEDS;
    for (int i = 0; i < SEEDS; i++)
        m.variance += (runs[i][measure] - m.mean) * (runs[i][measure] - m.mean) / (SEEDS - 1);
    return m;
}

// Prints each measure; returns how many are not shown to be equivalent within their bounds.
static int compare(double drops_a_step, int most, const double *bounds)
{
    static double ours[SEEDS][MEASURES], model[SEEDS][MEASURES];
    const double t = 1.6716; // Student's, 95 %, 58 degrees of freedom
    int failed = 0;
    for (int i = 0; i < SEEDS; i++) {
        run_ours(i + 1, drops_a_step, most, ours[i]);
        run_model(i + 1, drops_a_step, most, model[i]);
    }
    for (int m = 0; m < MEASURES; m++) {
        const struct moments a = moments_of(ours, m), b = moments_of(model, m);
        const double half = t * sqrt((a.variance + b.variance) / SEEDS);
        const double worst = (fabs(a.mean - b.mean) + half) / b.mean;
        print_message("%g a step, %d: %s: %.4g, model %.4g (%+.1f %%), within %.1f %%\n",
                      drops_a_step, most, names[m], a.mean, b.mean, 100 * (a.mean / b.mean - 1),
                      100 * worst);
        failed += !(worst <= bounds[m]);
    }
    return failed;
}

static void rain_is_as_the_paper_has_it(void **state)
{
    (void)state;
    // As tight as the scatter of 30 runs allows. The number of drops and their mass vary most.
    static const double bounds[MEASURES] = {
        [DROPS] = 0.2, [MASS] = 0.2,    [DRAINED] = 0.1,    [TRAIL] = 0.1,
        [WET] = 0.15,  [MERGES] = 0.12, [RESIDUALS] = 0.12,
    };
    int failed = compare(0.1, 150, bounds);
    failed += compare(0.03, 150, bounds);
    assert_int_equal(failed, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(rain_is_as_the_paper_has_it)};
    device = rg_device_open("cpu");
    assert_non_null(device);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return rg_device_close(device) ? failed : 1;
}
