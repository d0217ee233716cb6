// How a budget plans anew as tables take longer or shorter than they were to: costs that are given,
// and a clock that only this moves.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/tables/measuring/measure.h"
#include "harness/tables/runs/budget.h"
#include "tests/harness/measuring/fake.h"
#include "tests/harness/results/planning/slow.h"

#define assert_ms(value, ms) assert_near(value, ms, 1e-6)

static const struct rg_table_row rows[] = {{"", {1}, "a"}, {"", {2}, "b"}, {"", {3}, "c"}};
static const struct rg_table table = {.id = "slow-1",
                                      .technique = "slow",
                                      .columns = {"fixed_ms"},
                                      .key_count = 1,
                                      .variants = {{"full", "", NULL}},
                                      .width = 1024,
                                      .height = 512,
                                      .row_count = 3,
                                      .rows = rows,
                                      .note = "a note"};

enum { TABLES = 3 };

// Three tables of three rows on one device, a cell 4 s, of all samples 8 s: all of it takes 72 s.
struct plan {
    struct slow_rig rig;
    struct rg_table tables[TABLES];
    const struct rg_table *of[TABLES];
    struct rg_budget budget;
    struct rg_result result;
    FILE *out;
    char *told;
    size_t size;
};

static void begin_plan(struct plan *p, double seconds)
{
    memset(p, 0, sizeof(*p));
    slow_begin(&p->rig);
    p->rig.devices.count = 1;
    p->out = open_memstream(&p->told, &p->size);
    p->budget = (struct rg_budget){.tables = p->of,
                                   .count = TABLES,
                                   .devices = &p->rig.devices,
                                   .seconds = seconds,
                                   .start_ms = rg_now_ms(),
                                   .bits = {.all = 1, .first = 1}};
    for (int i = 0; i < TABLES; i++) {
        p->tables[i] = table;
        p->of[i] = &p->tables[i];
        p->budget.costs[i] = (struct rg_budget_table){.rows = 3,
                                                      .needed_rows = 3,
                                                      .variants = 1,
                                                      .needed_variants = 1,
                                                      .works = 1,
                                                      .smallest = RG_BUDGET_WHOLE,
                                                      .cells = {{[RG_BUDGET_WHOLE] = {4, 8}}}};
    }
    p->budget.planned_s =
        rg_budget_plan(p->budget.costs, TABLES, &p->budget.bits, seconds, p->budget.choices);
}

// Measures a table, so many of its rows, which takes so long.
static void run(struct plan *p, int i, int count, double seconds)
{
    const double start_ms = rg_now_ms();
    assert_true(rg_budget_next(&p->budget, i, &p->result, p->out));
    for (int row = 0; row < count; row++)
        assert_true(rg_result_add_row(&p->result, row));
    fake_pass(1000 * seconds);
    rg_budget_done(&p->budget, i, &p->result, start_ms);
    rg_result_free(&p->result);
    p->result = (struct rg_result){0};
}

// Whether a table is there, with few samples.
static void expect_next(struct plan *p, int i, bool is_there, bool has_few)
{
    assert_int_equal(rg_budget_next(&p->budget, i, &p->result, p->out), is_there);
    assert_true(!is_there || p->result.few_samples == has_few);
    rg_result_free(&p->result);
    p->result = (struct rg_result){0};
}

static void expect_told(struct plan *p, const char *words)
{
    fflush(p->out);
    if (words ? !strstr(p->told, words) : *p->told)
        fail_msg("told, not %s: %s", words ? words : "nothing", p->told);
}

static void end_plan(struct plan *p)
{
    fclose(p->out);
    free(p->told);
    free(p->budget.quick);
    p->rig.devices.count = 3;
    slow_end(&p->rig);
}

// What takes as long as it was to, or less, changes nothing.
static void a_plan_that_is_kept_is_not_made_anew(void **state)
{
    (void)state;
    for (double seconds = 12; seconds <= 24; seconds += 12) {
        struct plan p;
        begin_plan(&p, 91);
        run(&p, 0, 3, seconds);
        expect_next(&p, 1, true, false);
        expect_told(&p, NULL);
        end_plan(&p);
    }
}

// 40 s for 24: of 51 s that are left those behind it may take 30.6 by the plan, which is 24 of the
// fewest, and not 12 more for all samples of one.
static void cells_that_take_longer_have_the_rest_planned_anew(void **state)
{
    (void)state;
    struct plan p;
    begin_plan(&p, 91);
    run(&p, 0, 3, 40);
    expect_next(&p, 1, true, true);
    expect_told(&p, "as cells take 1.67 times as long as they were to");
    end_plan(&p);
    // 60 s: of 31 s they may take 12.4, which is one table.
    begin_plan(&p, 91);
    run(&p, 0, 3, 60);
    expect_next(&p, 1, true, true);
    run(&p, 1, 3, 30);
    expect_next(&p, 2, false, false);
    expect_told(&p, "2.50 times");
    end_plan(&p);
    // Though cells take what they were to: of 91 s 60 have passed beside them.
    begin_plan(&p, 91);
    fake_pass(60000);
    expect_next(&p, 1, true, true);
    expect_told(&p, "planned anew, as less time is left than the rest was to take:\n");
    end_plan(&p);
    // No time at all.
    begin_plan(&p, 91);
    run(&p, 0, 3, 92);
    expect_next(&p, 1, false, false);
    end_plan(&p);
}

// Of 63 s three tables may take 50.4, which is 36 of the fewest samples and 12 more for all of the
// first. Where that takes half of the 24 s, the others have 102 s at that speed.
static void time_that_is_left_is_used(void **state)
{
    (void)state;
    struct plan p;
    begin_plan(&p, 63);
    assert_false(p.budget.choices[1].all_samples);
    run(&p, 0, 3, 12);
    expect_next(&p, 1, true, false);
    expect_told(&p, "planned anew, as there is time for more:\n  slow-1 ");
    expect_next(&p, 2, true, false);
    end_plan(&p);
    // Where it takes what it was to, there is none.
    begin_plan(&p, 63);
    run(&p, 0, 3, 24);
    expect_next(&p, 1, true, true);
    expect_told(&p, NULL);
    end_plan(&p);
    // Of the 51.6 s that are left where it takes 20, a fifth stays: a plan of 41.3 has none.
    begin_plan(&p, 63);
    run(&p, 0, 3, 20);
    expect_next(&p, 1, true, true);
    expect_told(&p, NULL);
    end_plan(&p);
    // What comes behind tables that stay as they are is told too: 12 s of 235 are worth a plan.
    begin_plan(&p, 235);
    p.budget.choices[2].all_samples = false;
    p.budget.choices[2].expected_s -= 12;
    run(&p, 0, 3, 24);
    expect_next(&p, 1, true, false);
    expect_told(&p, "planned anew, as there is time for more:\n  slow-1            24.0 s");
    expect_next(&p, 2, true, false);
    end_plan(&p);
    // 12 s of 241 are less than a twentieth.
    begin_plan(&p, 241);
    p.budget.choices[2].all_samples = false;
    p.budget.choices[2].expected_s -= 12;
    run(&p, 0, 3, 24);
    expect_next(&p, 2, true, true);
    expect_told(&p, NULL);
    end_plan(&p);
}

// A table ends in time for the least of those behind it, 12 s each, or as much longer as cells
// take.
static void what_comes_behind_has_its_least_left(void **state)
{
    (void)state;
    static const struct {
        double first_s;
        double left_ms[2]; // to the end of the budget, when the first and the second table end
    } cases[] = {{24, {24000, 12000}}, {36, {24000, 18000}}};
    for (int i = 0; i < 2; i++) {
        struct plan p;
        begin_plan(&p, 91);
        assert_true(rg_budget_next(&p.budget, 0, &p.result, p.out));
        assert_ms(p.budget.start_ms + 91000 - p.result.budget_end_ms, cases[i].left_ms[0]);
        rg_result_free(&p.result);
        p.result = (struct rg_result){0};
        run(&p, 0, 3, cases[i].first_s);
        assert_true(rg_budget_next(&p.budget, 1, &p.result, p.out));
        assert_ms(p.budget.start_ms + 91000 - p.result.budget_end_ms, cases[i].left_ms[1]);
        rg_result_free(&p.result);
        p.result = (struct rg_result){0};
        end_plan(&p);
    }
}

// A third of the rows that was to take 8 s and took 10 is as slow as the whole that takes 30.
static void rows_that_are_not_done_tell_nothing(void **state)
{
    (void)state;
    struct plan p;
    begin_plan(&p, 91);
    run(&p, 0, 1, 10);
    assert_ms(p.budget.due_s, 8);
    assert_ms(p.budget.taken_s, 10);
    expect_next(&p, 1, true, false); // 48 of 81 by 1.25
    end_plan(&p);
    // Textures are no measure of how fast frames are.
    begin_plan(&p, 91);
    p.tables[0].is_of_textures = true;
    run(&p, 0, 3, 10);
    assert_ms(p.budget.due_s, 0);
    assert_ms(p.budget.taken_s, 0);
    assert_int_equal(p.budget.measured, 1);
    end_plan(&p);
}

static void expect_line(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    assert_non_null(strstr(line, user));
    assert_non_null(strstr(line, "slow-1 would take 12.0 s more"));
}

// A budget in which nothing was measured is an error, and one with a table is not.
static void nothing_is_an_error(void **state)
{
    (void)state;
    struct plan p;
    begin_plan(&p, 2);
    expect_next(&p, 0, false, false);
    rg_log_listen(expect_line, "nothing was measured within 2 s");
    assert_false(rg_budget_end(&p.budget, p.out));
    end_plan(&p);
    // The time is over before a row is done.
    begin_plan(&p, 13);
    run(&p, 0, 0, 14);
    rg_log_listen(expect_line, "nothing was measured within 13 s");
    assert_false(rg_budget_end(&p.budget, p.out));
    rg_log_listen(NULL, NULL);
    end_plan(&p);
    begin_plan(&p, 13);
    run(&p, 0, 3, 12);
    assert_true(rg_budget_end(&p.budget, p.out));
    expect_told(&p, "took 12 s, planned 12 s (+0 %), of a budget of 13 s; left out:");
    expect_told(&p, "all of it");
    end_plan(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plan_that_is_kept_is_not_made_anew),
        cmocka_unit_test(cells_that_take_longer_have_the_rest_planned_anew),
        cmocka_unit_test(time_that_is_left_is_used),
        cmocka_unit_test(what_comes_behind_has_its_least_left),
        cmocka_unit_test(rows_that_are_not_done_tell_nothing),
        cmocka_unit_test(nothing_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
