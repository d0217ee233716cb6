// What a budget of time chooses, as a function of what cells are expected to take.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "harness/tables/measuring/cell.h"
#include "harness/tables/runs/needed.h"
#include "harness/tables/runs/plan.h"
#include "harness/tables/claims/claim.h"
#include "harness/tables/papers/papers.h"

enum { TABLES = 5, DEVICES = 3, FIRST = 1u << 0, REFERENCE = 1u << 2, ALL = 7 };
static const struct rg_budget_devices devices = {.all = ALL, .first = FIRST, .last = REFERENCE};

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
                                      .has_claims = i % 2 == 1};
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
    return rg_budget_plan(costs, TABLES, &devices, budget_s, choices);
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

// How much there is of each stage, in their order.
enum { STAGES = 10 };
static void count_stages(const struct rg_budget_choice choices[TABLES], int counts[STAGES])
{
    memset(counts, 0, STAGES * sizeof(*counts));
    for (int i = 0; i < TABLES; i++) {
        const struct rg_budget_choice *c = &choices[i];
        const bool is_on_both = (c->devices & ~REFERENCE) == (ALL & ~REFERENCE);
        counts[0] += c->devices != 0;
        counts[1] += i % 2 == 1 && is_on_both;
        counts[2] += is_on_both;
        counts[3] += c->size >= RG_BUDGET_HALF;
        counts[4] += c->all_samples;
        counts[5] += c->size == RG_BUDGET_WHOLE;
        counts[6] += c->all_rows;
        counts[7] += c->all_variants;
        counts[8] += c->all_works;
        counts[9] += (c->devices & REFERENCE) != 0;
    }
}

// Nothing is planned beyond the budget, what is told is the sum of what is chosen, and a larger
// budget measures no less of a stage where it measures the same of those before.
static void a_budget_is_kept_and_more_of_it_is_never_less(void **state)
{
    (void)state;
    struct rg_budget_table costs[TABLES];
    struct rg_budget_choice choices[TABLES];
    int before[STAGES] = {0}, counts[STAGES], changes = 0;
    make_costs(costs);
    for (double budget_s = 0; budget_s < 3000; budget_s += 0.7) {
        const double planned_s = plan(budget_s, choices);
        double sum_s = 0;
        int stage = 0;
        assert_true(planned_s <= budget_s);
        for (int i = 0; i < TABLES; i++) {
            assert_true(choices[i].expected_s == rg_budget_expect(&costs[i], &choices[i]));
            sum_s += choices[i].expected_s;
        }
        assert_true(fabs(sum_s - planned_s) < 1e-9 * (1 + sum_s));
        count_stages(choices, counts);
        while (stage < STAGES - 1 && counts[stage] == before[stage])
            stage++;
        if (counts[stage] < before[stage])
            fail_msg("%.1f s has less of stage %d: %d, not %d", budget_s, stage, counts[stage],
                     before[stage]);
        changes += counts[stage] > before[stage];
        memcpy(before, counts, sizeof(before));
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

// What the least of a table takes, by its cells.
static double least_s(const struct rg_budget_table *table)
{
    const struct rg_budget_choice least = {.devices = FIRST};
    return rg_budget_expect(table, &least);
}

// No table is left out that there was time for on the first device: others are not on a second one,
// nor in larger pictures, nor with more samples, while it is not there.
static void each_table_comes_before_more_of_another(void **state)
{
    (void)state;
    struct rg_budget_table costs[TABLES];
    make_costs(costs);
    int partial = 0;
    for (double budget_s = 0.5; budget_s < 100; budget_s += 0.5) {
        struct rg_budget_choice choices[TABLES];
        double due_s = 0;
        bool fits = true;
        plan(budget_s, choices);
        // Table 0 is cheapest, table 4 is dearest.
        for (int i = 0; i < TABLES; i++) {
            due_s += least_s(&costs[i]);
            assert_true(choices[i].devices == 0 || choices[i].devices & FIRST);
            assert_int_equal(choices[i].devices != 0, due_s <= budget_s);
            fits = fits && due_s <= budget_s;
        }
        partial += !fits && choices[0].devices;
    }
    assert_true(partial > 10);
}

// A table that is too dear on any device keeps nothing from the others, which get all there is.
static void what_is_too_dear_starves_no_other(void **state)
{
    (void)state;
    struct rg_budget_table costs[TABLES];
    struct rg_budget_choice choices[TABLES];
    make_costs(costs);
    for (int d = 0; d < DEVICES; d++)
        for (int size = 0; size < RG_BUDGET_SIZES; size++)
            costs[1].cells[d][size].few_s = costs[1].cells[d][size].all_s = 1e6;
    rg_budget_plan(costs, TABLES, &devices, 1e5, choices);
    assert_int_equal(choices[1].devices, 0);
    assert_true(choices[1].expected_s == 0 && !choices[1].all_samples);
    for (int i = 0; i < TABLES; i++)
        assert_true(i == 1 || (choices[i].devices == ALL && choices[i].size == RG_BUDGET_WHOLE &&
                               choices[i].all_samples && choices[i].all_rows));
    // Too dear on the second device alone, it is on the first.
    make_costs(costs);
    for (int size = 0; size < RG_BUDGET_SIZES; size++)
        costs[1].cells[1][size].few_s = costs[1].cells[1][size].all_s = 1e6;
    rg_budget_plan(costs, TABLES, &devices, 1e5, choices);
    assert_int_equal(choices[1].devices, FIRST | REFERENCE);
    assert_int_equal(choices[3].devices, ALL);
}

// Rows and devices that are needed may take all of the budget; what is more than that leaves a
// fifth of it, for cells that take longer.
static void a_fifth_is_left_for_what_takes_longer(void **state)
{
    (void)state;
    struct rg_budget_table costs[TABLES];
    struct rg_budget_choice choices[TABLES];
    make_costs(costs);
    double needed_s = 0, whole_s = 0;
    for (int i = 0; i < TABLES; i++) {
        const struct rg_budget_choice needed = {.devices = 3};
        const struct rg_budget_choice whole = {ALL, RG_BUDGET_WHOLE, true, true, true, true, 0};
        needed_s += rg_budget_expect(&costs[i], &needed);
        whole_s += rg_budget_expect(&costs[i], &whole);
    }
    rg_budget_plan(costs, TABLES, &devices, needed_s + 1e-6, choices);
    for (int i = 0; i < TABLES; i++)
        assert_true(choices[i].devices == 3 && choices[i].size == RG_BUDGET_FOURTH);
    int more = 0;
    for (double budget_s = needed_s; budget_s < 1.2 * whole_s; budget_s += 3) {
        const double planned_s = rg_budget_plan(costs, TABLES, &devices, budget_s, choices);
        assert_true(planned_s <= fmax(0.8 * budget_s, needed_s) + 1e-6);
        more += planned_s > needed_s + 1e-6;
    }
    assert_true(more > 20);
    assert_true(fabs(rg_budget_plan(costs, TABLES, &devices, whole_s / 0.79, choices) - whole_s) <
                1e-6 * whole_s);
}

// Just enough for the second device of tables that claims are about leaves nothing for others,
// however little they would take.
static void what_claims_need_comes_first(void **state)
{
    (void)state;
    struct rg_budget_choice choices[TABLES];
    struct rg_budget_table costs[TABLES];
    make_costs(costs);
    double due_s = 1e-6;
    for (int i = 0; i < TABLES; i++) {
        struct rg_budget_choice due = {.devices = i % 2 == 1 ? 3 : FIRST,
                                       .size = costs[i].smallest};
        for (int size = 0; size < RG_BUDGET_SIZES && i % 2 == 0; size++)
            costs[i].cells[1][size].few_s = 0.01;
        due_s += rg_budget_expect(&costs[i], &due);
    }
    rg_budget_plan(costs, TABLES, &devices, due_s, choices);
    for (int i = 0; i < TABLES; i++)
        assert_int_equal(choices[i].devices, i % 2 == 1 ? 3 : FIRST);
    // With a little more all have it, and none the last one.
    rg_budget_plan(costs, TABLES, &devices, due_s + 0.1, choices);
    for (int i = 0; i < TABLES; i++)
        assert_int_equal(choices[i].devices, 3);
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
    const struct rg_measure_options o = {.most_samples = 15,
                                         .least_samples = 6,
                                         .sample_ms = 15,
                                         .job_ms = 1000,
                                         .warm_up_ms = 200,
                                         .warm_up_frames = 4,
                                         .passes_ms = 400};
    struct rg_measure_options few = o;
    const struct rg_table plain = {.check_frames = 10}, alone = {.check_frames = 1};
    const struct rg_table window = {.check_frames = 10, .window_frames = 5};
    const struct rg_cell_frames slow = {7, 3, 500}, fast = {7, 0.25, 1}, middling = {7, 3, 60};
    few.warm_up_frames = 1;
    few.passes_ms = 0;
    // The first and the last of 10, the one that is counted, one of warm-up, 6 samples, and 2
    // frames of 1.5 for the passes; 8 steps.
    assert_true(fabs(rg_cell_ms(&plain, &slow, &o) - (7 + 8 * 3 + 13 * 500)) < 1e-6);
    // One of 1.5 for the passes.
    assert_true(fabs(rg_cell_ms(&plain, &slow, &few) - (7 + 8 * 3 + 11.5 * 500)) < 1e-6);
    assert_true(fabs(rg_cell_ms(&alone, &slow, &o) - (7 + 12 * 500)) < 1e-6);
    // 3 + 4 + 4 + 15 samples of 15 + 1 frames + 40 frames of 1.5.
    assert_true(fabs(rg_cell_ms(&plain, &fast, &o) - (7 + 8 * 0.25 + 311)) < 1e-6);
    // 3, 4 of warm-up in 200 ms, 8 samples and a frame before each, 5 frames of 1.5.
    assert_true(fabs(rg_cell_ms(&plain, &middling, &o) - (7 + 8 * 3 + (3 + 4 + 16 + 7.5) * 60)) <
                1e-6);
    // 11 frames in windows of 5: opened twice more, each with nine steps and a frame.
    assert_true(fabs(rg_cell_ms(&window, &slow, &o) -
                     (7 + 8 * 3 + 13 * 500 + 2 * (7 + 9 * 3 + 500))) < 1e-6);
    assert_true(fabs(rg_cell_image_ms(&plain, &slow) - (7 + 9 * 3 + 500)) < 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(times_are_those_of_the_cells),
        cmocka_unit_test(a_budget_is_kept_and_more_of_it_is_never_less),
        cmocka_unit_test(enough_is_everything),
        cmocka_unit_test(each_table_comes_before_more_of_another),
        cmocka_unit_test(what_is_too_dear_starves_no_other),
        cmocka_unit_test(a_fifth_is_left_for_what_takes_longer),
        cmocka_unit_test(what_claims_need_comes_first),
        cmocka_unit_test(rows_of_curves_and_claims_are_needed),
        cmocka_unit_test(a_cell_takes_what_its_frames_take),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
