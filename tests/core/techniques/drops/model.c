// drops and the paper's own rule, one drop after the other in double precision, bring the same few
// drops down a small pane, step by step: without chance, and where the order of drops does not
// matter. A scene ends before a height comes within its rounding of a threshold.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/core/techniques/drops/rig.h"
#include "tests/oracle/drops/drops.h"
#include "tests/oracle/drops/map.h"
#include "tests/oracle/drops/particles.h"

enum { COLUMNS = 72, ROWS = 44, MOST = 8 };

#define CELL_MM 0.5

// A drop's place is in mm from the pane's upper left corner.
struct start {
    uint32_t parent;
    double mg, x, y, vx, vy;
};

// Water of a drop that is no more: so many cells of one height.
struct puddle {
    uint32_t id;
    int column, row, columns, rows;
    double height;
};

struct scene {
    const char *about, *settings;
    int steps;
    struct start drops[MOST];
    struct puddle puddles[4];
};

static const struct scene scenes[] = {
    {"a drop on a dry pane", "", 6, {{0, 60, 16.1, 2.3, 0, 0}}, {{0}}},
    {"a drop that follows another's trail",
     "",
     8,
     {{0, 30, 16.1, 3.3, 0, 0}},
     {{9, 34, 8, 4, 30, 0.4}}},
    {"a drop that follows a trail to its left",
     "",
     8,
     {{0, 30, 16.1, 3.3, 0, 0}},
     {{9, 26, 8, 4, 30, 0.4}}},
    {"water to both sides, the right one higher",
     "smooth=off erode=off",
     3,
     {{0, 30, 16.1, 3.3, 0, 0}},
     {{9, 26, 8, 4, 30, 0.2}, {10, 34, 8, 4, 30, 0.3}}},
    {"drops that run off the edges",
     "",
     5,
     {{0, 40, 2.1, 10.2, -300, 100}, {0, 40, 33.9, 10.2, 300, 100}, {0, 90, 18.1, 18.2, 0, 300}},
     {{0}}},
    {"three that merge, with momentum",
     "critical_mass_mg=100",
     4,
     {{0, 12, 14.2, 10.3, 0, 0},
      {0, 17, 16.5, 11.1, 0, 0},
      {0, 9, 18.4, 10.6, 0, 0},
      {0, 8, 30.2, 16.4, 0, 0}},
     {{0}}},
    {"two that are as low",
     "critical_mass_mg=100",
     4,
     {{0, 12, 14.2, 10.3, 0, 0}, {0, 12, 16.2, 10.3, 0, 0}},
     {{0}}},
    {"a running drop and one at rest",
     "",
     8,
     {{0, 50, 16.2, 4.3, 20, 200}, {0, 15, 17.1, 12.4, 0, 0}},
     {{0}}},
    {"kin stay apart, and a stranger joins them",
     "critical_mass_mg=100",
     2,
     {{0, 12, 10.2, 10.3, 0, 0},
      {1, 12, 12.4, 10.4, 0, 0},
      {0, 9, 24.2, 10.3, 0, 0},
      {3, 9, 26.1, 10.9, 0, 0},
      {0, 8, 22.2, 9.7, 0, 0}},
     {{0}}},
    {"a child that outlives its parent's merging",
     "critical_mass_mg=30",
     6,
     {{0, 29, 16.2, 10.3, 0, 0}, {0, 8, 14.0, 10.0, 0, 0}, {1, 12, 18.9, 12.4, 0, 0}},
     {{0}}},
    {"water of no drop",
     "smooth=off erode=off critical_mass_mg=100",
     3,
     {{0, 12, 10.2, 10.3, 0, 0}},
     {{9, 22, 15, 8, 9, 0.9},
      {10, 40, 10, 5, 6, 0.7},
      {11, 45, 10, 5, 6, 0.7},
      {12, 60, 2, 3, 3, 0.7}}},
    {"water that flattens and thins",
     "",
     12,
     {{0, 3, 31.1, 5.2, 0, 0}},
     {{0, 0, 0, 12, 9, 0.45}, {0, 60, 30, 12, 14, 0.49}, {11, 28, 5, 12, 28, 3.3}}},
    {"water that only flattens",
     "erode=off",
     4,
     {{0, 3, 31.1, 5.2, 0, 0}},
     {{0, 0, 0, 12, 9, 0.45}, {0, 60, 30, 12, 14, 0.49}, {11, 28, 5, 12, 28, 3.3}}},
    {"water that only thins",
     "smooth=off",
     3,
     {{0, 3, 31.1, 5.2, 0, 0}},
     {{0, 0, 0, 12, 9, 0.45}, {0, 60, 30, 12, 14, 0.49}, {11, 28, 5, 12, 28, 3.3}}},
    {"two that run side by side",
     "merge=off",
     4,
     {{0, 60, 14.1, 3.3, 0, 0}, {0, 40, 22.2, 3.1, 0, 0}},
     {{0}}},
    {"waters that lie over each other",
     "merge=off",
     3,
     {{0, 8, 14.1, 8.3, 0, 0}, {0, 18, 15.2, 8.1, 0, 0}},
     {{0}}},
    {"water at the pane's edge draws",
     "smooth=off erode=off",
     2,
     {{0, 30, 1.3, 4.3, 0, 0}},
     {{9, 0, 8, 2, 30, 0.3}, {10, 2, 8, 6, 30, 0.2}}},
    {"a drop that leaves in its first substep",
     "smooth=off erode=off",
     2,
     {{0, 40, 1.2, 4.2, 0, 600}},
     {{9, 0, 8, 2, 30, 0.3}}},
    {"drops that are removed",
     "remove_s=0.04",
     5,
     {{0, 18, 10.1, 8.2, 0, 0}, {0, 12, 25.2, 8.1, 0, 0}},
     {{0}}},
    {"a steep pane",
     "tilt_deg=50",
     6,
     {{0, 60, 16.1, 2.3, 0, 0}, {0, 22, 30.1, 2.3, 40, 40}},
     {{0}}},
};

// --- setting up ---

// Uneven, and the same for both; without ties.
static double affinity_at(int column, int row)
{
    return fmod(0.35 + 0.6180339887 * column + 0.7548776662 * row + 0.013 * column * row, 1);
}

static bool is_off(const struct scene *s, const char *name)
{
    const char *at = strstr(s->settings, name);
    return at && !strncmp(at + strlen(name), "=off", 4);
}

static double setting(const struct scene *s, const char *name, double otherwise)
{
    const char *at = strstr(s->settings, name);
    return at ? atof(at + strlen(name) + 1) : otherwise;
}

static struct drops *open_ours(struct rg_device *device, const struct scene *s, const char *more)
{
    char text[256];
    snprintf(text, sizeof(text), "columns=%d rows=%d drops_s=0 meander_rad=0 residual=off %s %s",
             COLUMNS, ROWS, s->settings, more);
    struct drops *d = rig_open(device, text);
    float *affinity = rig_words(d, "affinity"), *height = rig_words(d, "height");
    uint32_t *ids = rig_words(d, "ids");
    for (int row = 0; row < ROWS; row++)
        for (int column = 0; column < COLUMNS; column++)
            affinity[drops_cell(d->params, column, row)] = (float)affinity_at(column, row);
    for (const struct puddle *p = s->puddles; p < s->puddles + 4; p++)
        for (int i = 0; i < p->columns * p->rows; i++) {
            const int at =
                drops_cell(d->params, p->column + i % p->columns, p->row + i / p->columns);
            height[at] = (float)p->height;
            ids[at] = p->id;
        }
    const char *const names[] = {"affinity", "height", "ids"};
    void *const words[] = {affinity, height, ids};
    for (int i = 0; i < 3; i++) {
        struct rg_buf *buf = rg_asset_find(&d->base, names[i])->buf;
        assert_true(rg_buf_write(buf, 0, words[i], (int64_t)buf->size));
        free(words[i]);
    }
    drops_drop all[MOST];
    int count = 0;
    for (const struct start *a = s->drops; a < s->drops + MOST && a->mg > 0; a++)
        all[count++] = (drops_drop){.parent = a->parent,
                                    .mass = (uint32_t)(a->mg * DROPS_QUANTA_MG),
                                    .x = (float)a->x,
                                    .y = (float)a->y,
                                    .vx = (float)a->vx,
                                    .vy = (float)a->vy};
    rig_put(d, all, count);
    const uint32_t next = 20;
    assert_true(rg_buf_write(d->tally->buf, DROPS_NEXT_ID * 4, &next, sizeof(next)));
    return d;
}

static void open_model(struct oracle_drops *o, const struct scene *s)
{
    struct oracle_drops_settings settings = oracle_drops_defaults();
    settings.columns = COLUMNS;
    settings.rows = ROWS;
    settings.drops_a_step = settings.meander_rad = 0;
    settings.residual = false;
    settings.merge = !is_off(s, "merge");
    settings.smooth = !is_off(s, "smooth");
    settings.erode = !is_off(s, "erode");
    settings.critical_mass_mg = setting(s, "critical_mass_mg", 20);
    settings.tilt_deg = setting(s, "tilt_deg", 90);
    oracle_drops_open(o, &settings);
    for (int row = 0; row < ROWS; row++)
        for (int column = 0; column < COLUMNS; column++)
            o->affinity[row * COLUMNS + column] = affinity_at(column, row);
    for (const struct puddle *p = s->puddles; p < s->puddles + 4; p++)
        for (int i = 0; i < p->columns * p->rows; i++) {
            const int at = (p->row + i / p->columns) * COLUMNS + p->column + i % p->columns;
            o->height_mm[at] = p->height;
            o->id[at] = p->id;
        }
    oracle_drops_find_wet(o);
    for (const struct start *a = s->drops; a < s->drops + MOST && a->mg > 0; a++) {
        oracle_drops_add(o, a->x, ROWS * CELL_MM - a->y, a->mg);
        struct oracle_drop *drop = &o->drops[o->count - 1];
        drop->parent_id = a->parent;
        drop->vx_mm_s = a->vx;
        drop->vy_mm_s = -a->vy;
    }
    while (o->next_id < 20) // the puddles' owners, which are no more
        oracle_drops_end(o, &o->drops[oracle_drops_add(o, 1, 1, 1) - 1]);
    oracle_drops_clear_away(o);
}

// --- comparing ---

// IDs are other numbers in both, one for one; of those since a scene began.
static uint32_t of_model[256], of_ours[256];

static bool is_same_id(uint32_t ours, uint32_t model)
{
    const uint32_t a = ours & 255, b = model & 255;
    if ((a == 0) != (b == 0) || (of_model[a] && of_model[a] != b) ||
        (of_ours[b] && of_ours[b] != a))
        return false;
    of_model[a] = b;
    of_ours[b] = a;
    return true;
}

static bool is_near(double found, double due, double off)
{
    return fabs(found - due) <= off;
}

static void compare_drops(const struct scene *s, int step, struct drops *d,
                          const struct oracle_drops *o)
{
    int count;
    drops_drop *all = rig_drops(d, &count);
    if (count != o->count)
        fail_msg("%s, step %d: %d drops, not %d", s->about, step, count, o->count);
    if (!is_near(rig_tally(d, DROPS_DRAINED) / (double)DROPS_QUANTA_MG, o->ledger.drained_mg,
                 4e-3) ||
        !is_near(rig_tally(d, DROPS_REMOVED) / (double)DROPS_QUANTA_MG, o->ledger.deleted_mg, 4e-3))
        fail_msg("%s, step %d: what left or was removed is not as heavy", s->about, step);
    for (int i = 0; i < count; i++) {
        const drops_drop *a = &all[i];
        // By place: the IDs of those that merge in one step rise in another order. Momentum
        // is whole steps of 1/4 mg mm/s.
        const struct oracle_drop *b = NULL;
        for (int k = 0; k < count; k++)
            if (is_near((double)a->x, o->drops[k].x_mm, 2e-3) &&
                is_near((double)a->y, ROWS * CELL_MM - o->drops[k].y_mm, 2e-3))
                b = &o->drops[k];
        if (!b || !is_near(a->mass / (double)DROPS_QUANTA_MG, b->mass_mg, 4e-3) ||
            !is_near((double)a->vx, b->vx_mm_s, 0.05) ||
            !is_near((double)a->vy, -b->vy_mm_s, 0.05) || !is_same_id(a->id, b->id))
            fail_msg("%s, step %d: drop %u of %u quanta is at %g, %g with %g, %g", s->about, step,
                     a->id, a->mass, (double)a->x, (double)a->y, (double)a->vx, (double)a->vy);
    }
    free(all);
}

// Heights are rounded in each step, which a mean of them does not enlarge.
static void compare_maps(const struct scene *s, int step, struct drops *d,
                         const struct oracle_drops *o)
{
    float *height = rig_words(d, "height");
    uint32_t *ids = rig_words(d, "ids");
    const double off = (step + 1) * 0.5 / (double)DROPS_HEIGHTS_A_MM + 1e-4;
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        const int cell = drops_cell(d->params, i % COLUMNS, i / COLUMNS);
        if (fabs((double)height[cell] - o->height_mm[i]) > off ||
            (height[cell] > 0) != (o->height_mm[i] > 0))
            fail_msg("%s, step %d: cell %d, %d is %g mm high, not %g", s->about, step, i % COLUMNS,
                     i / COLUMNS, (double)height[cell], o->height_mm[i]);
        if (!is_same_id(ids[cell], o->id[i]))
            fail_msg("%s, step %d: cell %d, %d is of %u, not %u (%.9g mm, %.9g mm)", s->about, step,
                     i % COLUMNS, i / COLUMNS, ids[cell], o->id[i], (double)height[cell],
                     o->height_mm[i]);
    }
    free(height);
    free(ids);
}

static struct rg_device *device;

static void a_few_drops_are_as_the_model_has_them(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof(scenes) / sizeof(scenes[0]); i++) {
        struct drops *d = open_ours(device, &scenes[i], "");
        struct oracle_drops o;
        memset(of_model, 0, sizeof(of_model));
        memset(of_ours, 0, sizeof(of_ours));
        open_model(&o, &scenes[i]);
        for (int step = 0; step < scenes[i].steps; step++) {
            rig_step(d, 1);
            if (step == (int)floor(setting(&scenes[i], "remove_s", -1) * 60))
                oracle_drops_delete(&o);
            oracle_drops_step(&o);
            compare_drops(&scenes[i], step, d, &o);
            compare_maps(&scenes[i], step, d, &o);
        }
        oracle_drops_close(&o);
        rig_close(d);
    }
}

// Tiles that are left out, since nothing changes in them, are as they would be.
static void sleep_changes_no_bit(void **state)
{
    (void)state;
    static const char *const names[] = {"height", "ids"};
    for (size_t i = 0; i < sizeof(scenes) / sizeof(scenes[0]); i++) {
        struct drops *a = open_ours(device, &scenes[i], "");
        struct drops *b = open_ours(device, &scenes[i], "sleep=off");
        for (int step = 0; step < 40; step += 4) {
            rig_step(a, 4);
            rig_step(b, 4);
            for (int k = 0; k < 2; k++) {
                void *words = rig_words(a, names[k]), *due = rig_words(b, names[k]);
                if (memcmp(words, due, rg_asset_find(&a->base, names[k])->buf->size))
                    fail_msg("%s, step %d: %s differ", scenes[i].about, step + 3, names[k]);
                free(words);
                free(due);
            }
        }
        rig_close(a);
        rig_close(b);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_few_drops_are_as_the_model_has_them),
                                       cmocka_unit_test(sleep_changes_no_bit)};
    device = rg_device_open(argc > 1 ? argv[1] : "cpu");
    assert_non_null(device);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return rg_device_close(device) ? failed : 1;
}
