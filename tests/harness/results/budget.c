// What a budget of time chooses, as a function of what cells are expected to take.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "harness/tables/runs/needed.h"
#include "harness/tables/runs/plan.h"
#include "harness/tables/runs/probe.h"
#include "harness/tables/claims/claim.h"
#include "harness/tables/papers/papers.h"

enum { TABLES = 5, DEVICES = 3, REFERENCE = 1u << 2, ALL = 7 };

// Costs that differ from table to table, device to device and size to size.
static void make_costs(struct rg_budget_table costs[TABLES])
{
    for (int i = 0; i < TABLES; i++) {
        struct rg_budget_table *t = &costs[i];
        *t = (struct rg_budget_table){.rows = 4 + 3 * i,
                                      .needed_rows = 3,
                                      .variants = 1 + i % 3,
                                      .needed_variants = 1,
                                      .works = 1 + i % 2,
                                      .has_claims = i % 2 == 1,
                                      .smallest = i == 2 ? RG_BUDGET_WHOLE : RG_BUDGET_FOURTH};
        for (int size = 0; size < RG_BUDGET_SIZES; size++) {
            t->check_s[size] = 0.1 * (i + 1) * (1 + size);
            for (int d = 0; d < DEVICES; d++) {
                t->cells[d][size].few_s = 0.2 * (1 + d) * (1 + i * i) * (1 + 2 * size);
                t->cells[d][size].all_s = 1.5 * t->cells[d][size].few_s;
            }
        }
    }
}

static double plan(double budget_s, struct rg_budget_choice choices[TABLES])
{
    struct rg_budget_table costs[TABLES];
    make_costs(costs);
    return rg_budget_plan(costs, TABLES, ALL, REFERENCE, budget_s, choices);
}

// By hand: a table of two needed rows of five, on two devices.
static void times_are_those_of_the_cells(void **state)
{
    (void)state;
    const struct rg_budget_table table = {
        .rows = 5,
        .variants = 3,
        .works = 2,
        .needed_rows = 2,
        .needed_variants = 1,
        .cells = {{{1, 10}, {2, 20}, {4, 40}}, {{3, 30}, {6, 60}, {9, 90}}},
        .check_s = {0.5, 0.25, 0.125}};
    struct rg_budget_choice c = {.devices = 3};
    assert_true(rg_budget_expect(&table, &c) == 2 * (1 + 3 + 0.5));
    c.size = RG_BUDGET_HALF;
    c.all_rows = true;
    assert_true(rg_budget_expect(&table, &c) == 5 * (2 + 6 + 0.25));
    c.all_samples = c.all_variants = c.all_works = true;
    c.devices = 2;
    assert_true(rg_budget_expect(&table, &c) == 5 * 3 * 2 * (60 + 0.25));
    c.devices = 0;
    assert_true(rg_budget_expect(&table, &c) == 0);
}

static bool has_at_least(const struct rg_budget_choice *more, const struct rg_budget_choice *less)
{
    return (less->devices & ~more->devices) == 0 && more->size >= less->size &&
           more->all_samples >= less->all_samples && more->all_rows >= less->all_rows &&
           more->all_variants >= less->all_variants && more->all_works >= less->all_works;
}

// Nothing is planned beyond the budget, what is told is the sum of what is chosen, and a larger
// budget measures all that a smaller one does.
static void a_budget_is_kept_and_more_of_it_is_never_less(void **state)
{
    (void)state;
    struct rg_budget_table costs[TABLES];
    struct rg_budget_choice before[TABLES] = {{0}}, choices[TABLES];
    double planned_before = 0;
    int changes = 0;
    make_costs(costs);
    for (double budget_s = 0; budget_s < 3000; budget_s += 0.7) {
        const double planned_s = plan(budget_s, choices);
        double sum_s = 0;
        assert_true(planned_s <= budget_s && planned_s >= planned_before);
        changes += planned_s > planned_before;
        for (int i = 0; i < TABLES; i++) {
            assert_true(has_at_least(&choices[i], &before[i]));
            assert_true(choices[i].expected_s == rg_budget_expect(&costs[i], &choices[i]));
            sum_s += choices[i].expected_s;
        }
        assert_true(fabs(sum_s - planned_s) < 1e-9 * (1 + sum_s));
        memcpy(before, choices, sizeof(before));
        planned_before = planned_s;
    }
    assert_true(changes > 20);
}

// All is measured where there is time for it.
static void enough_is_everything(void **state)
{
    (void)state;
    struct rg_budget_table costs[TABLES];
    struct rg_budget_choice choices[TABLES];
    make_costs(costs);
    plan(1e9, choices);
    for (int i = 0; i < TABLES; i++) {
        const struct rg_budget_choice *c = &choices[i];
        assert_int_equal(c->devices, ALL);
        assert_int_equal(c->size, RG_BUDGET_WHOLE);
        assert_true(c->all_samples && c->all_rows);
        assert_true(c->all_variants || costs[i].variants == costs[i].needed_variants);
        assert_true(c->all_works || costs[i].works == 1);
    }
}

// What is needed comes first, on all devices but the last ones, and those come last of all; a
// table whose size is what it is about keeps it.
static void what_is_needed_comes_first(void **state)
{
    (void)state;
    struct rg_budget_choice choices[TABLES];
    for (double budget_s = 1; budget_s < 3000; budget_s += 3) {
        bool all_claimed = true, any_other = false;
        bool all_needed = true, any_more = false, all_else = true;
        plan(budget_s, choices);
        for (int i = 0; i < TABLES; i++) {
            const struct rg_budget_choice *c = &choices[i];
            const bool is_whole = c->all_samples && c->size == RG_BUDGET_WHOLE && (c->all_rows) &&
                                  (c->all_variants || i % 3 == 0) && (c->all_works || i % 2 == 0);
            all_claimed = all_claimed && (i % 2 == 0 || (c->devices & ~REFERENCE) == 3);
            any_other = any_other || (i % 2 == 0 && c->devices);
            all_needed = all_needed && (c->devices & ~REFERENCE) == (ALL & ~REFERENCE);
            any_more = any_more || c->all_rows || c->all_samples || c->all_works ||
                       (i != 2 && c->size != RG_BUDGET_FOURTH);
            all_else = all_else && is_whole;
            assert_true(i != 2 || c->size == RG_BUDGET_WHOLE);
        }
        assert_true(all_claimed || !any_other);
        assert_true(all_needed || !any_more);
        for (int i = 0; i < TABLES; i++)
            assert_true(all_else || !(choices[i].devices & REFERENCE));
    }
}

// The ends and the middle of each table, and what claims end without.
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
        assert_true(count <= t->row_count && rg_needed_variants(t, variants) >= 1 && variants[0]);
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
                    assert_true(variants[v]);
        }
    }
    // The second camera's curve has ends and a middle of its own.
    const struct rg_table *cameras = rg_table_find("creus-5.3");
    static const int due[] = {1, 4, 8, 9, 10, 13, 17, 18};
    assert_int_equal(rg_needed_rows(cameras, rows), 8);
    for (int i = 0; i < 8; i++)
        assert_true(rows[due[i] - 1]);
    assert_true(rg_needs_size(rg_table_find("chin-timing")));
    assert_false(rg_needs_size(cameras));
}

// By hand: frames that are long, short, and of a window of frames.
static void a_cell_takes_what_its_frames_take(void **state)
{
    (void)state;
    const struct rg_measure_options o = {
        .most_samples = 15, .least_samples = 6, .sample_ms = 15, .job_ms = 1000, .warm_up_ms = 200};
    const struct rg_table plain = {.check_frames = 10};
    const struct rg_table window = {.check_frames = 10, .window_frames = 5};
    // 10 + 1 + 4 of warm-up + 6 samples + 2 frames of 1.5 for the passes.
    assert_true(fabs(rg_budget_cell_ms(&plain, 7, 500, &o) - (7 + 24 * 500)) < 1e-6);
    // 10 + 1 + 10 + 4 + 15 samples of 15 + 1 frames + 10 frames of 1.5.
    assert_true(fabs(rg_budget_cell_ms(&plain, 7, 1, &o) - (7 + 280)) < 1e-6);
    // 14 frames in windows of 5: opened twice more, each with ten frames.
    assert_true(fabs(rg_budget_cell_ms(&window, 7, 500, &o) - (7 + 24 * 500 + 2 * (7 + 5000))) <
                1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(times_are_those_of_the_cells),
        cmocka_unit_test(a_budget_is_kept_and_more_of_it_is_never_less),
        cmocka_unit_test(enough_is_everything),
        cmocka_unit_test(what_is_needed_comes_first),
        cmocka_unit_test(rows_of_curves_and_claims_are_needed),
        cmocka_unit_test(a_cell_takes_what_its_frames_take),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
