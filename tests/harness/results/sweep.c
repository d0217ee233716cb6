// Sweeps: the values of axes, and the rows that they make.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "core/techniques/technique.h"
#include "harness/tables/own/grid.h"
#include "tests/tools/expect.h"

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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(axes_have_values_and_ranges), cmocka_unit_test(other_axes_are_refused),
        cmocka_unit_test(rows_are_all_combinations),   cmocka_unit_test(a_grid_may_be_full),
        cmocka_unit_test(other_grids_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
