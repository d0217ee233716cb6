// The order in which tables are measured follows from earlier measurements and their times. Curves
// and claims need certain rows.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "harness/tables/claims/claim.h"
#include "harness/tables/papers/papers.h"
#include "harness/tables/runs/needed.h"
#include "harness/tables/runs/order.h"
#include "tests/tools/expect.h"

enum { CPU = 1, GL = 2, REFERENCE = 4 };
#define LEFT_S 1e6

// Three tables of five rows. The first and the last share a technique, and claims are about the
// last.
enum { TABLES = 3 };
static const struct rg_table tables[TABLES] = {{.id = "a", .technique = "one"},
                                               {.id = "b", .technique = "other"},
                                               {.id = "c", .technique = "one"}};

static struct rg_order begin(struct rg_standing standings[TABLES])
{
    for (int i = 0; i < TABLES; i++)
        standings[i] = (struct rg_standing){.table = &tables[i],
                                            .has_claims = i == 2,
                                            .needed_rows = 3,
                                            .quick_rows = 5,
                                            .needed_variants = 1,
                                            .variants = 2,
                                            .works = 3,
                                            .share = {.divisor = 4}};
    return (struct rg_order){standings, TABLES, CPU | GL | REFERENCE, CPU, REFERENCE};
}

// Takes the next step as done: each of its cells took this long on cpu, and twice as long on other
// devices.
static struct rg_step next(struct rg_order *order, double cell_s)
{
    struct rg_step step;
    assert_true(rg_order_next(order, LEFT_S, &step));
    struct rg_standing *s = &order->tables[step.table];
    const int rows = step.turn == RG_TURN_FIRST    ? 2
                     : step.turn == RG_TURN_NEEDED ? 1
                     : step.turn == RG_TURN_ROWS   ? 2
                                                   : 0;
    const double times = step.devices == CPU ? 1 : 2;
    rg_order_learn(order, &step, step.cells, step.cells * times * cell_s);
    s->share = step.share;
    s->rows += rows;
    return step;
}

static void expect(struct rg_order *order, enum rg_turn turn, int table, unsigned on, double cell_s)
{
    const struct rg_step step = next(order, cell_s);
    if (step.turn != turn || step.table != table || step.devices != on)
        fail_msg("turn %d of table %d on %u, not turn %d of table %d on %u", step.turn, step.table,
                 step.devices, turn, table, on);
}

// Each table has its first rows before any has more. Then come the needed rows, claims first, and
// cheap ones before dear ones.
static void the_order_is_that_of_priority(void **state)
{
    (void)state;
    struct rg_standing s[TABLES];
    struct rg_order order = begin(s);
    expect(&order, RG_TURN_FIRST, 0, CPU, 5);
    expect(&order, RG_TURN_FIRST, 1, CPU,
           1); // of another technique, so nothing is known
    expect(&order, RG_TURN_FIRST, 2, CPU, 3);
    expect(&order, RG_TURN_NEEDED, 1, CPU, 1);
    expect(&order, RG_TURN_NEEDED, 2, CPU, 3);
    expect(&order, RG_TURN_NEEDED, 0, CPU, 5);
    expect(&order, RG_TURN_CLAIMED, 2, GL, 3);
    expect(&order, RG_TURN_DEVICES, 1, GL, 1);
    expect(&order, RG_TURN_DEVICES, 0, GL, 5);
    expect(&order, RG_TURN_BETTER, 1, CPU | GL, 1);
    expect(&order, RG_TURN_BETTER, 2, CPU | GL, 3);
    expect(&order, RG_TURN_BETTER, 0, CPU | GL, 5);
    for (enum rg_turn turn = RG_TURN_ROWS; turn <= RG_TURN_WORKS; turn++)
        for (int i = 0; i < TABLES; i++)
            assert_int_equal(next(&order, 1).turn, turn);
    for (int i = 0; i < TABLES; i++)
        assert_int_equal(next(&order, 1).devices, REFERENCE);
    struct rg_step none;
    assert_false(rg_order_next(&order, LEFT_S, &none));
    for (int i = 0; i < TABLES; i++) {
        assert_int_equal(s[i].share.devices, order.all);
        assert_int_equal(s[i].share.divisor, 1);
        assert_true(s[i].share.all_samples);
        assert_true(s[i].share.all_variants);
        assert_true(s[i].share.all_works);
        assert_equals(s[i].rows, 5);
    }
}

// If nothing is known, light tables come first, by their pixels, their frames and the work that
// smaller pictures leave out.
static void what_looks_light_comes_first(void **state)
{
    (void)state;
    struct rg_standing s[TABLES];
    struct rg_table looks[TABLES];
    struct rg_order order = begin(s);
    for (int i = 0; i < TABLES; i++) {
        looks[i] = (struct rg_table){.technique = i ? "other" : "one", .width = 100, .height = 100};
        s[i].table = &looks[i];
    }
    looks[0].smaller[0] = "sparse=16";
    looks[1].check_frames = 20;
    for (int i = TABLES - 1; i >= 0; i--) {
        struct rg_step step;
        assert_true(rg_order_next(&order, LEFT_S, &step));
        assert_int_equal(step.table, i);
    }
}

// A step that was tried without a result is not tried again, and a table without rows is not
// refined.
static void what_was_tried_is_not_tried_again(void **state)
{
    (void)state;
    struct rg_standing s[TABLES];
    struct rg_step step;
    struct rg_order order = begin(s);
    for (int i = 0; i < TABLES; i++) {
        assert_true(rg_order_next(&order, LEFT_S, &step));
        assert_int_equal(step.turn, RG_TURN_FIRST);
    }
    assert_false(rg_order_next(&order, LEFT_S, &step));
}

// A cell's time is estimated from its own table's, or from its technique's, by how that device
// compares with others there. Otherwise it is the device's time elsewhere.
static void what_cells_take_follows_from_others(void **state)
{
    (void)state;
    struct rg_standing s[TABLES];
    struct rg_order order = begin(s);
    next(&order, 5);
    struct rg_step step = next(&order, 1);
    assert_equals(step.table, 1);
    assert_equals(step.expected_s, 0);
    step = next(&order, 3);
    assert_equals(step.table, 2);
    assert_equals(step.expected_s, 5);
    for (int i = 0; i < 3; i++)
        next(&order, 3);
    // Three rows on gl, about which nothing is known: at least as long as on cpu.
    step = next(&order, 3);
    assert_equals(step.turn, RG_TURN_CLAIMED);
    assert_equals(step.expected_s, 3 * 3);
    // gl takes twice as long for the other table of the technique, too, whose cells now take 3 s.
    struct rg_step of = {.table = 0, .turn = RG_TURN_DEVICES};
    for (int i = 0; i < 2; i++) {
        assert_true(rg_order_next(&order, LEFT_S, &step));
        of = step.table == 0 ? step : of;
    }
    assert_equals(of.expected_s, 3 * 2 * 3);
}

// Pictures are whole if there is time for those of all tables, and half the size otherwise.
static void pictures_grow_as_far_as_there_is_time(void **state)
{
    (void)state;
    for (int much = 0; much < 2; much++) {
        struct rg_standing s[TABLES];
        struct rg_step step;
        struct rg_order order = begin(s);
        for (int i = 0; i < 9; i++)
            next(&order, 1);
        // Three tables of three rows, on cpu and, twice as slow, on gl; 16 times the pixels and
        // twice the samples.
        const double left_s = 3 * (9 * 16 * 2) * (much ? 1.01 : 0.99);
        assert_true(rg_order_next(&order, left_s, &step));
        assert_int_equal(step.turn, RG_TURN_BETTER);
        assert_int_equal(step.share.divisor, much ? 1 : 2);
        assert_equals(step.expected_s, 9 * 2 * (much ? 16 : 4));
    }
}

// A table's part of the time is the rest, divided by the number of waiting tables.
static void time_is_shared_among_those_that_wait(void **state)
{
    (void)state;
    struct rg_standing s[TABLES];
    struct rg_order order = begin(s);
    for (int waiting = TABLES; waiting; waiting--) {
        struct rg_step step;
        assert_true(rg_order_next(&order, 60, &step));
        assert_equals(step.part_s, 60 / waiting);
        s[step.table].rows = 1;
    }
    assert_equals(next(&order, 1).part_s, LEFT_S);
}

// Needed are the ends and the middle of each table, and the rows without which claims have no
// verdict.
static void rows_of_curves_and_claims_are_needed(void **state)
{
    (void)state;
    bool rows[RG_TABLE_ROWS], variants[RG_TABLE_VARIANTS];
    for (int i = 0; rg_tables[i]; i++) {
        const struct rg_table *t = rg_tables[i];
        int counted = 0;
        const int count = rg_needed_rows(t, rows);
        for (int row = 0; row < RG_TABLE_ROWS; row++)
            counted += rows[row];
        assert_int_equal(counted, count);
        const int last = t->quick_rows ? t->quick_rows : t->row_count;
        bool between = last < 3;
        for (int row = 1; row < last - 1; row++)
            between = between || rows[row];
        assert_true(rows[0] && between && rows[last - 1]);
        assert_at_most(count, t->row_count);
        assert_at_least(rg_needed_variants(t, variants), 1);
        assert_true(variants[0]);
        for (const struct rg_claim *c = rg_claims; c->table; c++) {
            if (strcmp(c->table, t->id) != 0)
                continue;
            const bool is_of_each = c->test == RG_CLAIM_FASTER || c->test == RG_CLAIM_RATE;
            assert_true(rows[c->first - 1] &&
                        rows[(is_of_each && c->last > last ? last : c->last) - 1]);
            assert_true(!c->knee || rows[c->knee - 1]);
            for (int v = 0; t->variants[v].name; v++)
                if (!strcmp(t->variants[v].name, c->variant) ||
                    (c->other && !strcmp(t->variants[v].name, c->other)))
                    assert_true(variants[v] || c->can_wait);
        }
    }
    // The second camera's curve has its own ends and middle.
    const struct rg_table *cameras = rg_table_find("creus-5.3");
    static const int due[] = {1, 4, 8, 9, 10, 13, 17, 18};
    assert_int_equal(rg_needed_rows(cameras, rows), 8);
    for (int i = 0; i < 8; i++)
        assert_true(rows[due[i] - 1]);
    assert_int_equal(rg_most_divisor(rg_table_find("chin-timing")), 1);
    assert_int_equal(rg_most_divisor(cameras), 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_order_is_that_of_priority),
        cmocka_unit_test(what_looks_light_comes_first),
        cmocka_unit_test(what_was_tried_is_not_tried_again),
        cmocka_unit_test(what_cells_take_follows_from_others),
        cmocka_unit_test(pictures_grow_as_far_as_there_is_time),
        cmocka_unit_test(time_is_shared_among_those_that_wait),
        cmocka_unit_test(rows_of_curves_and_claims_are_needed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
