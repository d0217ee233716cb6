// The same few drops run down a small pane, step by step alike: as drops on a device, and by the
// paper's own rule, one drop after the other in double precision.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/core/techniques/drops/scenes.h"

// IDs that arise in a scene differ between the two, but correspond one to one.
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
        if (a->id <= (i ? all[i - 1].id : 0) || a->id >= rig_tally(d, DROPS_NEXT_ID))
            fail_msg("%s, step %d: drop %u is out of order", s->about, step, a->id);
        // Compared by place, since IDs of drops that merge in one step rise in another order.
        // Momentum is in whole steps of 1/4 mg mm/s.
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

// Heights are rounded in each step; taking a mean of them does not enlarge the error.
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
    for (int i = 0; scenes[i].about; i++) {
        struct drops *d = scene_open(device, &scenes[i], "");
        struct oracle_drops o;
        for (uint32_t id = 0; id < 256; id++)
            of_model[id] = of_ours[id] = id < SCENE_NEXT_ID ? id : 0;
        scene_open_model(&o, &scenes[i]);
        for (int step = 0; step < scenes[i].steps; step++) {
            rig_step(d, 1);
            if (step == (int)floor(scene_setting(&scenes[i], "remove_s", -1) * 60))
                oracle_drops_delete(&o);
            oracle_drops_step(&o);
            compare_drops(&scenes[i], step, d, &o);
            compare_maps(&scenes[i], step, d, &o);
        }
        oracle_drops_close(&o);
        rig_close(d);
    }
}

// A child merges with a stranger. The new drop is no kin of the child's parent, and merges with it
// in a later step.
static void what_merges_is_nobodys_child(void **state)
{
    (void)state;
    const struct scene kin = {
        "a child and a stranger",
        "critical_mass_mg=100",
        0,
        {{0, 12, 10.2, 10.3, 0, 0}, {1, 12, 13.4, 10.9, 0, 0}, {0, 12, 16, 10.3, 0, 0}},
        {{0}}};
    struct drops *d = scene_open(device, &kin, "");
    rig_step(d, 4);
    int count;
    drops_drop *all = rig_drops(d, &count);
    assert_int_equal(count, 1);
    assert_int_equal(all[0].mass, 36 * (int)DROPS_QUANTA_MG);
    assert_int_equal(rig_tally(d, DROPS_MERGINGS), 2);
    free(all);
    rig_close(d);
}

// Tiles skipped because nothing changes in them keep the right contents.
static void sleep_changes_no_bit(void **state)
{
    (void)state;
    static const char *const names[] = {"height", "ids"};
    for (int i = 0; scenes[i].about; i++) {
        struct drops *a = scene_open(device, &scenes[i], "");
        struct drops *b = scene_open(device, &scenes[i], "sleep=off");
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
                                       cmocka_unit_test(what_merges_is_nobodys_child),
                                       cmocka_unit_test(sleep_changes_no_bit)};
    device = rg_device_open(argc > 1 ? argv[1] : "cpu");
    assert_non_null(device);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return rg_device_close(device) ? failed : 1;
}
