// Sweeps: the values of axes, and the rows that they make.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/techniques/technique.h"
#include "harness/tables/own/grid.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

static void expect_axis(const char *text, const char *name, const char *const *values)
{
    struct rg_axis axis;
    int count = 0;
    assert_true(rg_axis_read("--axis", text, &axis));
    assert_string_equal(axis.name, name);
    for (; values[count]; count++)
        assert_string_equal(axis.values[count], values[count]);
    assert_int_equal(axis.count, count);
}

static void axes_have_values_and_ranges(void **state)
{
    (void)state;
    expect_axis("a=1", "a", (const char *const[]){"1", NULL});
    expect_axis("model=bunny,none", "model", (const char *const[]){"bunny", "none", NULL});
    expect_axis("r=5,10..40", "r",
                (const char *const[]){"5", "10", "15", "20", "25", "30", "35", "40", NULL});
    expect_axis("r=0.1,0.2..0.5", "r",
                (const char *const[]){"0.1", "0.2", "0.3", "0.4", "0.5", NULL});
    expect_axis("r=3,2..-1,7", "r", (const char *const[]){"3", "2", "1", "0", "-1", "7", NULL});
    expect_axis("r=5,10..24", "r", (const char *const[]){"5", "10", "15", "20", NULL});
    expect_axis("f=../a.png,b", "f", (const char *const[]){"../a.png", "b", NULL});
}

static void other_axes_are_refused(void **state)
{
    (void)state;
    static const char *const wrong[] = {
        "",         "a",        "a=",       "=1",    "a=1,",      "a=10..40",  "a=1,1..4",
        "a=1,2..0", "a=x,2..3", "a=1,2..y", "a=1 2", "a=1,2..65", "a=1,2..1e9"};
    struct rg_axis axis;
    for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++)
        if (rg_axis_read("--axis", wrong[i], &axis))
            fail_msg("'%s' is taken", wrong[i]);
}

// A name has less than 48 letters, a value less than 96, and an axis at most 64 values.
static void axes_have_limits(void **state)
{
    (void)state;
    static const struct {
        int name, value;
        const char *more;
        const char *says; // NULL: the axis is taken
    } cases[] = {{47, 95, "", NULL},
                 {48, 1, "", "write it as NAME=VALUE,VALUE or NAME=5,10..40"},
                 {1, 96, "", "write it as NAME=VALUE,VALUE or NAME=5,10..40"},
                 {1, 1, ",2..64", NULL},
                 {1, 1, ",2..65", ": more than 64 values"},
                 {1, 1, ",2..64,7", ": more than 64 values"},
                 {1, 1, ",4..3", ": 3 does not come after 1 and 4"},
                 {1, 1, ",3,1..3", ": 3 does not come after 3 and 1"},
                 {1, 1, ",x,2..3", ": a range goes on from a number before it, as in 5,10..40"}};
    struct rg_axis axis;
    rg_log_listen(log_last, NULL);
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        char text[256];
        memset(text, '1', sizeof(text));
        text[cases[i].name] = '=';
        snprintf(text + cases[i].name + 1 + cases[i].value, 32, "%s", cases[i].more);
        *logged = 0;
        assert_int_equal(rg_axis_read("--axis", text, &axis), !cases[i].says);
        if (cases[i].says && !strstr(logged, cases[i].says))
            fail_msg("'%s' is told of '%s'", logged, text);
        assert_true(!cases[i].says || strstr(logged, "--axis 1") == logged);
    }
    rg_log_listen(NULL, NULL);
}

static struct rg_grid *grid_of(const char *const *axes)
{
    struct rg_grid *grid = calloc(1, sizeof(*grid));
    assert_non_null(grid);
    for (; axes[grid->axis_count]; grid->axis_count++)
        assert_true(rg_axis_read("--axis", axes[grid->axis_count], &grid->axes[grid->axis_count]));
    return grid;
}

static void rows_are_all_combinations(void **state)
{
    (void)state;
    struct rg_grid *grid = grid_of((const char *const[]){
        "model=none,bunny", "resolution_px=64,128..192", "panes=glass,mirror", NULL});
    const struct rg_table *table = &grid->table;
    assert_true(rg_grid_make(grid, rg_technique_find("flow")));
    assert_int_equal(table->row_count, 12);
    assert_int_equal(table->key_count, 2);
    assert_string_equal(table->names, "model");
    assert_false(rg_table_is_published(table));
    for (int row = 0; row < 12; row++) {
        char mirror[16];
        assert_string_equal(table->rows[row].name, row < 6 ? "none" : "bunny");
        assert_equals(rg_table_value(table, row, "resolution_px"), 64 * (row / 2 % 3 + 1));
        rg_table_value_text(table, row, 1, mirror, sizeof(mirror));
        assert_string_equal(mirror, row % 2 ? "mirror" : "glass");
    }
    assert_string_equal(table->rows[11].set, "model=bunny resolution_px=192 panes=mirror");
    assert_string_equal(table->id, "sweep-flow");
    assert_string_equal(table->note,
                        "A sweep: a row for each combination of model=none,bunny and "
                        "resolution_px=64,128,192 and panes=glass,mirror, in their order.");
    free(grid);
}

// Fractions are kept, and what stands before the axes is in each row.
static void rows_have_settings_before_their_own(void **state)
{
    (void)state;
    struct rg_grid *grid = grid_of((const char *const[]){"zoom=0.5,0.75..1", NULL});
    grid->set = "scene=car";
    assert_true(rg_grid_make(grid, rg_technique_find("cartoon")));
    assert_int_equal(grid->table.row_count, 3);
    assert_equals(grid->table.rows[1].values[0], 0.75);
    assert_string_equal(grid->table.rows[2].set, "scene=car zoom=1");
    free(grid);
}

// As many rows as a table may have are taken, and more are not.
static void a_grid_may_be_full(void **state)
{
    (void)state;
    for (int more = 0; more <= 1; more++) {
        char axis[32];
        snprintf(axis, sizeof(axis), "seed=1,2..%d", RG_TABLE_ROWS / 2 + more);
        struct rg_grid *grid = grid_of((const char *const[]){axis, "panes=glass,mirror", NULL});
        assert_int_equal(rg_grid_make(grid, rg_technique_find("flow")), !more);
        assert_true(more || grid->table.row_count == RG_TABLE_ROWS);
        free(grid);
    }
}

static void other_grids_are_refused(void **state)
{
    (void)state;
    static const char *const wrong[][4] = {
        {"nonsense=1"},       {"resolution_px=1"},
        {"panes=wood"},       {"seed=1,2..9", "drops=1,2..8"},
        {"seed=1", "seed=2"}, {"model=none", "environment=sky"},
    };
    for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++) {
        struct rg_grid *grid = grid_of(wrong[i]);
        if (rg_grid_make(grid, rg_technique_find("flow")))
            fail_msg("'%s' is taken", wrong[i][0]);
        free(grid);
    }
}

// A preset stands first, since it sets what others set.
static void a_preset_is_the_first_axis(void **state)
{
    (void)state;
    for (int second = 0; second <= 1; second++) {
        struct rg_grid *grid = grid_of((const char *const[]){
            second ? "zoom=1,2" : "preset=car,storm", second ? "preset=car" : "zoom=1,2", NULL});
        rg_log_listen(log_last, NULL);
        assert_int_equal(rg_grid_make(grid, rg_technique_find("cartoon")), !second);
        rg_log_listen(NULL, NULL);
        free(grid);
    }
    assert_string_equal(logged,
                        "--axis preset: stands for other parameters; name it before --axis zoom");
}

// Settings over all rows may repeat what an axis has, and change nothing of it.
static void sets_keep_the_axes(void **state)
{
    (void)state;
    static const struct {
        const char *sets[2], *axis; // the axis that is lost; "": the settings are refused
        int by;
    } cases[] = {{{"zoom=3", "turn_deg=4"}, NULL, 0},      {{"seed=7", "seed=7"}, NULL, 0},
                 {{"drops_s=2", "zoom=1"}, "drops_s", 0},  {{"zoom=1", "drops_s=1"}, "drops_s", 1},
                 {{"zoom=1", "preset=storm"}, "scene", 1}, {{"zoom=1", "zoom=x"}, "", 0}};
    struct rg_grid *grid =
        grid_of((const char *const[]){"scene=car", "drops_s=1,2", "seed=7", NULL});
    const struct rg_technique *cartoon = rg_technique_find("cartoon");
    assert_true(rg_grid_make(grid, cartoon));
    rg_log_listen(log_last, NULL);
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        char due[256];
        assert_int_equal(rg_grid_keeps_axes(grid, cartoon, cases[i].sets, 2), !cases[i].axis);
        if (!cases[i].axis || !*cases[i].axis)
            continue;
        snprintf(due, sizeof(due),
                 "--axis %s: --set %s would give all its rows one value; leave one of the two out",
                 cases[i].axis, cases[i].sets[cases[i].by]);
        assert_string_equal(logged, due);
    }
    rg_log_listen(NULL, NULL);
    free(grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(axes_have_values_and_ranges),
        cmocka_unit_test(other_axes_are_refused),
        cmocka_unit_test(axes_have_limits),
        cmocka_unit_test(rows_are_all_combinations),
        cmocka_unit_test(rows_have_settings_before_their_own),
        cmocka_unit_test(a_grid_may_be_full),
        cmocka_unit_test(other_grids_are_refused),
        cmocka_unit_test(a_preset_is_the_first_axis),
        cmocka_unit_test(sets_keep_the_axes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
