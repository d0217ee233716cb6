// The random choices of drops are distributed as in the paper: over thousands, each mean and each
// share is within four of its standard deviations.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "tests/core/techniques/drops/rig.h"
#include "tests/oracle/chance.h"
#include "tests/tools/expect.h"

#define PANE "columns=128 rows=96 cell_mm=0.5 "

enum { MANY = 3000 };

static const double WIDE_MM = 64, HIGH_MM = 48;

static struct rg_device *device;

static void expect_mean(const char *what, double sum, double due, double deviation)
{
    if (!(fabs(sum / MANY - due) <= 4 * deviation / sqrt(MANY)))
        fail_msg("%s: %.6g, not %.6g", what, sum / MANY, due);
}

// Expects a uniform distribution of width `wide`: its deviation is wide / sqrt(12).
static void expect_even(const char *what, double sum, double squares, double due, double wide)
{
    expect_mean(what, sum, due, wide / sqrt(12));
    // Squared distances from the mean have mean wide^2 / 12 and variance wide^4 / 180.
    expect_mean(what, squares, wide * wide / 12, wide * wide / sqrt(180));
}

// Drops land uniformly, at rest, and most are small (section 4.1).
static void drops_land_anywhere(void **state)
{
    (void)state;
    struct drops *d = rig_open(device, PANE "drops_s=300000 step_s=0.01 max_drops=3000 merge=off");
    rig_step(d, 1);
    int count;
    drops_drop *all = rig_drops(d, &count);
    assert_int_equal(count, MANY);
    double x = 0, y = 0, xx = 0, yy = 0, xy = 0, mg = 0, spread = 0;
    static double of[3][MANY];
    for (int i = 0; i < MANY; i++) {
        const double mass = all[i].mass / (double)DROPS_QUANTA_MG, middle = 0.25 + 99.75 / 5;
        assert_at_least(all[i].x, 0);
        assert_at_most((double)all[i].x, WIDE_MM);
        assert_at_least(all[i].y, 0);
        assert_at_most((double)all[i].y, HIGH_MM);
        assert_equals(all[i].vx, 0);
        assert_equals(all[i].vy, 0);
        x += (double)all[i].x;
        y += (double)all[i].y;
        xx += pow((double)all[i].x - WIDE_MM / 2, 2);
        yy += pow((double)all[i].y - HIGH_MM / 2, 2);
        xy += ((double)all[i].x - WIDE_MM / 2) * ((double)all[i].y - HIGH_MM / 2);
        mg += mass;
        spread += pow(mass - middle, 2);
        of[0][i] = (double)all[i].x;
        of[1][i] = (double)all[i].y;
        of[2][i] = mass;
    }
    expect_even("x", x, xx, WIDE_MM / 2, WIDE_MM);
    expect_even("y", y, yy, HIGH_MM / 2, HIGH_MM);
    expect_mean("x with y", xy, 0, WIDE_MM * HIGH_MM / 12);
    expect_mean("mass", mg, 0.25 + 99.75 / 5, 1.5);
    expect_mean("variance of mass", spread, 2.25, 2.25 * sqrt(2));
    const double *const columns[3] = {of[0], of[1], of[2]};
    assert_below(oracle_dependence(columns, 3, MANY), 5);
    free(all);
    rig_close(d);
}

// Affinity is N(0.5, 1.5), clamped to 0 to 1 (table 1).
static void affinity_is_normal(void **state)
{
    (void)state;
    struct drops *d = rig_open(device, PANE "drops_s=0");
    float *affinity = rig_words(d, "affinity");
    double none = 0, most = 0, half = 0;
    for (int i = 0; i < MANY; i++) {
        const float f = affinity[drops_cell(d->params, i % 128, i / 128)];
        none += f == 0;
        most += f == 1;
        half += f < 0.5F;
        assert_at_least(f, 0);
        assert_at_most(f, 1);
    }
    const double beyond = 0.36944; // of a normal distribution, beyond a third of its deviation
    expect_mean("no affinity", none, beyond, sqrt(beyond * (1 - beyond)));
    expect_mean("most affinity", most, beyond, sqrt(beyond * (1 - beyond)));
    expect_mean("less than half", half, 0.5, 0.5);
    free(affinity);
    rig_close(d);
}

// Many drops of one kind, which are slow; the pane is dry and draws them nowhere.
static struct drops *open_many(const char *settings, double mg, double since_s)
{
    static drops_drop all[MANY];
    for (int i = 0; i < MANY; i++)
        all[i] = (drops_drop){.mass = (uint32_t)(mg * DROPS_QUANTA_MG),
                              .x = 10.1F + (float)(i % 44),
                              .y = 5.1F + 0.5F * (float)(i / 44),

                              .vy = 20,
                              .since_s = (float)since_s};
    struct drops *d = rig_open(device, settings);
    struct rg_buf *affinity = rg_asset_find(&d->base, "affinity")->buf;
    void *even = calloc(1, affinity->size);
    assert_non_null(even);
    assert_true(rg_buf_write(affinity, 0, even, (int64_t)affinity->size));
    free(even);
    rig_put(d, all, MANY, 1);
    return d;
}

#define RUNS PANE "drops_s=0 merge=off substeps=1 max_drops=6000 trail=lines "

// A drop that runs straight turns by a uniform angle of at most theta, and keeps its speed.
static void drops_meander(void **state)
{
    (void)state;
    struct drops *d = open_many(RUNS "meander_rad=0.4 residual=off", 30, 0);
    rig_step(d, 1);
    int count;
    drops_drop *all = rig_drops(d, &count);
    assert_int_equal(count, MANY);
    double sum = 0, squares = 0;
    for (int i = 0; i < MANY; i++) {
        const double angle = atan2((double)all[i].vx, (double)all[i].vy);
        const double speed = hypot((double)all[i].vx, (double)all[i].vy);
        assert_at_most(fabs(angle), 0.4001);
        assert_below(fabs(speed / (20 + 9800.0 / 3 / 60) - 1), 1e-4);
        sum += angle;
        squares += angle * angle;
    }
    expect_even("angle", sum, squares, 0, 0.8);
    free(all);
    rig_close(d);
}

// Eq. 6: a drop that has run for a part of tau_max without shedding sheds with this chance. The
// child has a uniform share of the parent's mass, starts where the parent was, and names it as its
// parent.
static void drops_shed(void **state)
{
    (void)state;
    static const struct {
        double since_s, chance, mg;
    } cases[] = {{0.05, 0.25, 50}, {0.1, 0.5, 50}, {7, 0.5, 150}};
    for (int c = 0; c < 3; c++) {
        struct drops *d = open_many(RUNS "meander_rad=0 step_s=0.005 residual_beta=10 "
                                         "residual_low=0.2 residual_high=0.3",
                                    cases[c].mg, cases[c].since_s);
        rig_step(d, 1);
        int count;
        drops_drop *all = rig_drops(d, &count);
        const int children = count - MANY;
        expect_mean("children", children, cases[c].chance,
                    sqrt(cases[c].chance * (1 - cases[c].chance)));
        assert_int_equal(rig_tally(d, DROPS_BORN), children);
        double shares = 0, squares = 0;
        for (int i = MANY; i < count; i++) {
            const drops_drop *child = &all[i], *parent = &all[child->parent - 1];
            const double share = child->mass / (cases[c].mg * (double)DROPS_QUANTA_MG);
            assert_int_equal(parent->id, child->parent);
            assert_int_equal(parent->mass + child->mass, (uint32_t)(cases[c].mg * DROPS_QUANTA_MG));
            assert_equals(parent->since_s, 0);
            assert_equals(child->since_s, 0);
            assert_equals(child->vy, 0);
            assert_equals(child->x, parent->x);
            assert_below(child->y, parent->y);
            assert_at_most(share, 0.3);
            assert_at_most(child->mass, d->params.critical);
            shares += share;
            squares += pow(share - 0.25, 2);
        }
        if (cases[c].mg < 100) // lighter than the critical mass
            expect_even("share", shares * MANY / children, squares * MANY / children, 0.25, 0.1);
        int kept = 0;
        for (int i = 0; i < MANY; i++)
            kept += fabs((double)all[i].since_s - cases[c].since_s - 0.005) < 1e-6;
        assert_int_equal(kept, MANY - children);
        free(all);
        rig_close(d);
    }
}

// The first drops shed, one child each, until there is no more room.
static void drops_shed_while_there_is_room(void **state)
{
    (void)state;
    enum { ROOM = 500 };
    struct drops *d = open_many(PANE "drops_s=0 merge=off substeps=1 max_drops=3500 meander_rad=0 "
                                     "residual_max_s=0.001 residual_beta=10",
                                50, 7);
    rig_step(d, 1);
    int count;
    drops_drop *all = rig_drops(d, &count);
    assert_int_equal(count, MANY + ROOM);
    for (int i = 0; i < MANY; i++)
        assert_equals(all[i].since_s, 0); // whether it has a child or not
    for (int i = 0; i < ROOM; i++)
        assert_int_equal(all[MANY + i].parent, i + 1);
    free(all);
    rig_close(d);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drops_land_anywhere),
        cmocka_unit_test(affinity_is_normal),
        cmocka_unit_test(drops_meander),
        cmocka_unit_test(drops_shed),
        cmocka_unit_test(drops_shed_while_there_is_room),
    };
    device = rg_device_open(argc > 1 ? argv[1] : "cpu");
    assert_non_null(device);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return rg_device_close(device) ? failed : 1;
}
