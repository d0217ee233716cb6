// Water that gathers: each step against independent integers, an account exact to the unit, and
// painted puddles.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/core/techniques/cartoon/rain/rig.h"
#include "tests/tools/expect.h"

enum { SIDE = 128, CELLS = SIDE * SIDE, SIZE_PX = 128 };

static struct rg_device *device;

// The grid's place and its rates, from the settings alone.
struct due {
    double low[2], wide_m[2], area_m2, spread, dried, units;
};

static struct due due_of(const struct cartoon *c)
{
    const struct rg_mesh *m = c->diorama->mesh;
    const double dt = 1.0 / c->settings.rain.steps_s;
    struct due d;
    for (int k = 0; k < 2; k++) {
        d.low[k] = (double)m->low[2 * k];
        d.wide_m[k] = (double)m->high[2 * k] - d.low[k];
    }
    d.area_m2 = d.wide_m[0] * d.wide_m[1] / CELLS;
    d.spread = fmin(c->settings.water.spread_m2_s * dt / d.area_m2, 0.2);
    d.dried = 1 - exp(-dt / c->settings.water.dry_s);
    d.units = c->settings.water.drop_m3 / 1e-10;
    return d;
}

static int cell_of(const struct due *d, const cartoon_raindrop *drop, double *to_edge)
{
    const double x = ((double)drop->x - d->low[0]) / d->wide_m[0] * SIDE,
                 y = ((double)drop->z - d->low[1]) / d->wide_m[1] * SIDE;
    *to_edge = fmin(fabs(x - round(x)), fabs(y - round(y)));
    return x < 0 || y < 0 || x >= SIDE || y >= SIDE ? -1 : (int)floor(y) * SIDE + (int)floor(x);
}

// Adds the drops that hit in this step. Returns their whole volume, and counts drops near a
// column's edge as doubtful.
static double add_hits(struct cartoon *c, const struct due *d, double *cells, int *doubtful)
{
    struct rig_rain rain = rig_look(c);
    uint32_t *hits = rig_words(c, "hits");
    cartoon_surface *surfaces = rig_words(c, "surfaces");
    double all = 0;
    for (int i = 0; i < c->rain.drops; i++) {
        if (!hits[i])
            continue;
        double to_edge;
        const cartoon_raindrop *drop = &rain.drops[rain.living[i]];
        const double units = round(d->units * pow(0.4 + 0.6 * (double)drop->size, 3));
        const int cell = cell_of(d, drop, &to_edge);
        const double up = (double)surfaces[i].ny;
        all += units;
        *doubtful += to_edge < 1e-3 || fabs(up - 0.94) < 1e-6;
        if (cell >= 0 && up >= 0.94)
            cells[cell] += units;
    }
    free(hits);
    free(surfaces);
    rig_free(&rain);
    return all;
}

static double given(const struct due *d, const double *cells, int x, int y)
{
    return x < 0 || y < 0 || x >= SIDE || y >= SIDE ? 0 : floor(cells[y * SIDE + x] * d->spread);
}

// The water due in a column after a step.
static double due_in(const struct due *d, const double *cells, int x, int y)
{
    const double left = cells[y * SIDE + x] - 4 * given(d, cells, x, y) +
                        given(d, cells, x - 1, y) + given(d, cells, x + 1, y) +
                        given(d, cells, x, y - 1) + given(d, cells, x, y + 1);
    return left > 0 ? left - floor((left - 1) * d->dried) - 1 : 0;
}

static void expect_account(struct cartoon *c, const uint32_t *cells, double hit)
{
    uint32_t *account = rig_words(c, "account"), held = 0;
    for (int i = 0; i < CELLS; i++)
        held += cells[i];
    assert_int_equal(account[0], held + account[1] + account[2]);
    rig_expect("units that have hit", account[0], hit, 1e-4 * hit + 1);
    free(account);
}

static void expect_water(const char *settings, int from, int to)
{
    struct cartoon *c = rig_open(device, settings, SIZE_PX, SIZE_PX);
    const struct due d = due_of(c);
    double *cells = calloc(CELLS, sizeof(*cells)), hit = 0;
    assert_non_null(cells);
    int wet = 0, doubtful = 0, unlike = 0;
    for (int step = 0; step < to; step++) {
        uint32_t *was = rig_words(c, "water");
        for (int i = 0; i < CELLS; i++)
            cells[i] = was[i];
        rig_step(c, 1);
        hit += add_hits(c, &d, cells, &doubtful);
        uint32_t *is = rig_words(c, "water");
        expect_account(c, is, hit);
        for (int i = 0; step >= from && i < CELLS; i++) {
            // Rates are rounded to 2^-32, and volumes to a unit.
            const double due = due_in(&d, cells, i % SIDE, i / SIDE);
            unlike += fabs(is[i] - due) > 4 + 1e-6 * due;
            wet += is[i] > 0;
        }
        free(was);
        free(is);
    }
    free(cells);
    rig_close(c);
    // A drop at an edge may count for either column, which makes six columns unlike.
    if (wet < 1000 || unlike > 6 * doubtful)
        fail_msg("%s: %d columns are wet, %d unlike, %d doubtful", settings, wet, unlike, doubtful);
}

static void water_spreads_and_dries_to_the_unit(void **state)
{
    (void)state;
    expect_water("scene=house2 water=on water_m3=2e-6 drops_s=3000", 60, 110);
    expect_water(
        "scene=ground water=on water_m3=5e-6 drops_s=3000 collide=faithful water_dry_s=0.5 "
        "water_spread_m2_s=0.002",
        60, 100);
}

// Whether `wet` is between `dry` and a colour, at least a quarter of the way, and not beside that
// way.
static bool is_towards(const double wet[3], const double dry[3], const double colour[3])
{
    double along = 0, whole = 0, off = 0;
    for (int k = 0; k < 3; k++) {
        along += (wet[k] - dry[k]) * (colour[k] - dry[k]);
        whole += (colour[k] - dry[k]) * (colour[k] - dry[k]);
    }
    for (int k = 0; k < 3; k++)
        off = fmax(off, fabs(wet[k] - dry[k] - along / whole * (colour[k] - dry[k])));
    return along > 0.25 * whole && off < 0.004;
}

// Dry pixels, and those not on level ground, are drawn as without water. Deep water is a film with
// ink at its edge and a highlight within.
static void puddles_lie_on_level_ground(void **state)
{
    (void)state;
    const char *const settings = "scene=ground style=cartoon water_m3=2e-6 drops_s=12000 "
                                 "drop_m=0.001 splash_m=0.001 water=";
    char text[160];
    uint16_t *pictures[2];
    struct cartoon *c = NULL;
    for (int on = 0; on < 2; on++) {
        snprintf(text, sizeof(text), "%s%s", settings, on ? "on" : "off");
        c = rig_open(device, text, SIZE_PX, SIZE_PX);
        rig_step(c, 120);
        assert_true(c->base.technique->draw(&c->base));
        pictures[on] = rig_texels(c, "target", 0, 0);
        if (!on)
            rig_close(c);
    }
    uint16_t *normals = rig_texels(c, "normal_map", 0, 0);
    int level = 0, filmed = 0, other = 0, inked = 0, lit = 0;
    for (int i = 0; i < SIZE_PX * SIZE_PX; i++) {
        const bool is_level =
            rig_half(normals[4 * i + 3]) > 0 && rig_half(normals[4 * i + 1]) >= 0.94;
        static const double film[3] = {0.52, 0.72, 0.92};
        static const double ink[3] = {0.17 * 0.17, 0.15 * 0.15, 0.22 * 0.22};
        double dry[3], wet[3], off = 0, changed = 0;
        for (int k = 0; k < 3; k++) {
            dry[k] = rig_half(pictures[0][4 * i + k]);
            wet[k] = rig_half(pictures[1][4 * i + k]);
            off = fmax(off, fabs(wet[k] - (film[k] * film[k] * 0.6 + dry[k] * 0.4)));
            changed = fmax(changed, fabs(wet[k] - dry[k]));
        }
        if (!is_level)
            assert_at_most(changed, 0);
        level += is_level;
        filmed += is_level && off < 0.004;
        other += is_level && off >= 0.004 && changed > 0;
        inked += is_level && changed > 0 && is_towards(wet, dry, ink);
        lit += is_level && changed > 0 && fmin(wet[0], fmin(wet[1], wet[2])) > 0.99;
    }
    free(pictures[0]);
    free(pictures[1]);
    free(normals);
    rig_close(c);
    if (level < 2000 || filmed < level / 4 || other > level / 3 || inked < 100 || lit < 30)
        fail_msg("of %d level pixels %d have a film, %d something else, %d ink, %d a highlight",
                 level, filmed, other, inked, lit);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(water_spreads_and_dries_to_the_unit),
        cmocka_unit_test(puddles_lie_on_level_ground),
    };
    device = rg_device_open(argc > 1 ? argv[1] : "cpu");
    assert_non_null(device);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return rg_device_close(device) ? failed : 1;
}
