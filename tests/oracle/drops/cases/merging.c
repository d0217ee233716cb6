// Which drops of the model merge, the drops that result, and the owners of their water.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "tests/oracle/drops/cases/rig.h"
#include "tests/oracle/drops/drops.h"
#include "tests/oracle/drops/map.h"
#include "tests/oracle/drops/merge.h"
#include "tests/tools/expect.h"

// Two drops whose water touches become one, with their mass, their momentum and the lower one's
// place. A twin that does not merge shows the drops before.
static void test_merge(void **state)
{
    (void)state;
    struct oracle_drops_settings s = still(61, 200);
    s.meander_rad = 0.3;
    struct oracle_drops o, twin;
    oracle_drops_open(&twin, &s);
    s.merge = true;
    oracle_drops_open(&o, &s);
    for (int i = 0; i < 2; i++) {
        struct oracle_drops *each = i ? &twin : &o;
        even_affinity(each);
        oracle_drops_add(each, 15.25, 80, 50);
        oracle_drops_add(each, 17.25, 77, 30);
        each->drops[0].vy_mm_s = -100;
        oracle_drops_step(each);
    }
    assert_int_equal(o.count, 1);
    assert_int_equal(o.ledger.merges, 1);
    const struct oracle_drop *one = &o.drops[0], *a = &twin.drops[0], *b = &twin.drops[1];
    const struct oracle_drop *lower = a->y_mm < b->y_mm ? a : b;
    assert_equals(one->mass_mg, 80);
    assert_equals(one->x_mm, lower->x_mm);
    assert_equals(one->y_mm, lower->y_mm);
    assert_below(fabs(one->vy_mm_s - (50 * a->vy_mm_s + 30 * b->vy_mm_s) / 80), 1e-9);
    assert_below(fabs(one->vx_mm_s - (50 * a->vx_mm_s + 30 * b->vx_mm_s) / 80), 1e-9);
    assert_differs(a->vx_mm_s, 0);
    assert_differs(b->vx_mm_s, 0);
    assert_int_equal(one->id, 3);
    // The hemisphere on the map has a radius of 3.37 mm, of 50 mg it would have 2.88 mm.
    const struct oracle_drops_cell at = oracle_drops_cell_at(&o, one->x_mm, one->y_mm);
    assert_below(fabs(o.height_mm[at.row * 61 + at.column] - 3.36), 0.02);
    assert_int_equal(owner(&o, one->x_mm, one->y_mm), 3);
    oracle_drops_close(&o);
    oracle_drops_close(&twin);
}

// Water of dead drops takes the ID of a living neighbour, as far as it is connected, and that drop
// does not change.
static void test_dead_regions(void **state)
{
    (void)state;
    struct oracle_drops_settings s = still(100, 60);
    struct oracle_drops o;
    oracle_drops_open(&o, &s);
    oracle_drops_add(&o, 10, 15, 15); // 1 and 2 touch; 3 is apart
    oracle_drops_add(&o, 13, 15, 15);
    oracle_drops_add(&o, 40, 15, 15);
    oracle_drops_step(&o);
    oracle_drops_delete(&o);
    const int one = owned(&o, 1), two = owned(&o, 2), three = owned(&o, 3);
    assert_true(one && two && three);
    o.settings.merge = true;
    oracle_drops_step(&o); // none lives, so both take one ID
    assert_int_equal(owned(&o, 1), one + two);
    assert_int_equal(owned(&o, 2), 0);
    const uint32_t living = oracle_drops_add(&o, 16.5, 15, 15);
    oracle_drops_step(&o);
    const int four = owned(&o, living), left = owned(&o, 1);
    assert_true(four && left);
    oracle_drops_step(&o); // one lives
    assert_int_equal(owned(&o, living), four + left);
    assert_int_equal(owned(&o, 3), three);
    assert_equals(o.count, 1);
    assert_equals(o.drops[0].id, living);
    assert_equals(o.drops[0].mass_mg, 15);
    assert_int_equal(o.ledger.merges, 0);
    oracle_drops_close(&o);
}

// Paints IDs 0 to 9 on a pane of 10 x 6 cells, and compares them after a merge.
static void check_painted(struct oracle_drops *o, const char *before, const char *after)
{
    for (int i = 0; i < 60; i++) {
        o->id[i] = (uint32_t)(before[i] - '0');
        o->height_mm[i] = o->id[i] ? 0.1 : 0;
    }
    oracle_drops_find_wet(o);
    oracle_drops_merge(o);
    for (int i = 0; i < 60; i++)
        assert_int_equal(o->id[i], after[i] - '0');
}

// A merge recolours connected cells, through their sides, and not past the pane's edge into the
// next row.
static void test_fill(void **state)
{
    (void)state;
    struct oracle_drops_settings s = still(10, 6);
    struct oracle_drops o;
    oracle_drops_open(&o, &s);
    for (int i = 0; i < 4; i++)
        oracle_drops_add(&o, 2.5, 1.5, 1e-9);
    oracle_drops_delete(&o);
    check_painted(&o,
                  "0000000002"
                  "2210000000"
                  "2003000000"
                  "0330000002"
                  "0000011001"
                  "0000020000",
                  "0000000002"
                  "1110000000"
                  "1003000000"
                  "0330000001"
                  "0000011001"
                  "0000010000");
    oracle_drops_add(&o, 1.5, 1.5, 1e-9); // 5 and 6 live
    oracle_drops_add(&o, 3.5, 1, 1e-9);
    check_painted(&o,
                  "0000000005"
                  "0555011000"
                  "0500055110"
                  "0000060000"
                  "0000066000"
                  "5000006006",
                  "0000000005"
                  "0555077000"
                  "0500077770"
                  "0000070000"
                  "0000077000"
                  "5000007006");
    oracle_drops_close(&o);
}

// A residual drop does not merge with its parent, nor with the drop that the parent becomes. A
// stranger in its place does.
static void test_parents(void **state)
{
    (void)state;
    for (int stranger = 0; stranger <= 1; stranger++) {
        struct oracle_drops_settings s = quiet(61, 100);
        s.residual_beta = 1e3;
        s.residual_share_low = s.residual_share_high = 0.5;
        struct oracle_drops o;
        oracle_drops_open(&o, &s);
        oracle_drops_add(&o, 15.25, 40, 40.5);
        o.settings.residual = true;
        oracle_drops_step(&o); // tau is 0
        assert_int_equal(o.ledger.residuals, 0);
        oracle_drops_step(&o);
        assert_int_equal(o.ledger.residuals, 1);
        o.settings.residual = false;
        assert_equals(o.drops[0].mass_mg, 20.5);
        assert_equals(o.drops[1].mass_mg, 20);
        assert_int_equal(o.drops[1].parent_id, 1);
        if (stranger)
            o.drops[1].parent_id = 0;
        // From now on all drops rest, the parent between the other two.
        o.settings.tilt_deg = 0;
        o.drops[1].x_mm += 2.5;
        oracle_drops_add(&o, o.drops[0].x_mm - 2.5, o.drops[0].y_mm, 15);
        for (int i = 0; i < 10; i++)
            oracle_drops_step(&o);
        assert_int_equal(o.count, stranger ? 1 : 2);
        assert_int_equal(o.ledger.merges, stranger ? 2 : 1);
        if (!stranger)
            assert_int_equal(o.drops[0].parent_id, o.drops[1].id);
        oracle_drops_close(&o);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_merge),
        cmocka_unit_test(test_dead_regions),
        cmocka_unit_test(test_fill),
        cmocka_unit_test(test_parents),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
