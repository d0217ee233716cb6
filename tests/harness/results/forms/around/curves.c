// Curves of block characters below a table.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "harness/tables/sheet/curve.h"
#include "tests/harness/results/forms/rig.h"

// Characters from the least to the most, by the share of the logarithms between them.
#define LEAST  "\u2581"
#define THIRD  "\u2583" // 8/3
#define HALF   "\u2585" // 8/2, and what is the same in all rows
#define THIRDS "\u2586" // 16/3
#define MOST   "\u2588"

// The curves of the first work and variant, until the next call.
static const char *curves(const struct rig *rig)
{
    static char text[4096];
    memset(text, 0, sizeof(text));
    FILE *out = fmemopen(text, sizeof(text), "w");
    assert_non_null(out);
    rg_curves_print(&rig->result, (struct rg_place){0}, out);
    assert_int_equal(fclose(out), 0);
    return text;
}

// Print's curve, and each device's.
static void test_print(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure_on(&rig, &sheet_axis_table, (double[]){10, 40, 1, 1, 10, 20, 1, 1, 10, 40, 1, 1},
                     2);
    assert_string_equal(curves(&rig),
                        "Curves from 5 to 20: print " MOST HALF LEAST ", cpu " HALF HALF HALF
                        ", cpu:reference " MOST LEAST MOST "\n\n");
    rg_result_free(&rig.result);
}

static const struct rg_table growth = {
    .id = "growth",
    .technique = "flow",
    .columns = {"drops"},
    .key_count = 1,
    .variants = {{"full", "", NULL}},
    .row_count = 4,
    .rows =
        (const struct rg_table_row[]){
            {"", {10}, NULL}, {"", {100}, NULL}, {"", {1000}, NULL}, {"", {10000}, NULL}},
    .note = "a note",
};

// Without print there are devices' curves alone. A cell without a number is a dot, and so is a
// missing row; where the last is missing, no ends are told.
static void test_growth(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure(&rig, &growth, (double[]){8, 0, 2, 1});
    assert_string_equal(curves(&rig), "Curves from 10 to 10000: cpu " MOST "." THIRD LEAST "\n\n");
    rg_result_drop_row(&rig.result, 3);
    assert_string_equal(curves(&rig), "Curves: cpu " MOST "." LEAST ".\n\n");
    rg_result_drop_row(&rig.result, 0);
    assert_string_equal(curves(&rig), "");
    rg_result_free(&rig.result);
    sheet_measure(&rig, &growth, (double[]){1, 2, 4, 8});
    assert_string_equal(curves(&rig),
                        "Curves from 10 to 10000: cpu " LEAST THIRD THIRDS MOST "\n\n");
    rg_result_free(&rig.result);
}

// A blank stands where the axis begins anew.
static void test_restart(void **state)
{
    (void)state;
    static const struct rg_table_row rows[] = {
        {"", {10}, NULL}, {"", {20}, NULL}, {"", {10}, NULL}, {"", {30}, NULL}, {"", {30}, NULL}};
    struct rg_table table = growth;
    struct rig rig;
    table.rows = rows;
    table.row_count = 5;
    sheet_measure(&rig, &table, (double[]){4, 1, 4, 1, 1});
    assert_string_equal(curves(&rig),
                        "Curves from 10 to 30: cpu " MOST LEAST " " MOST LEAST LEAST "\n\n");
    rg_result_free(&rig.result);
}

// Two rows are no curve, and neither are rows that have names alone.
static void test_none(void **state)
{
    (void)state;
    struct rg_table two = growth;
    struct rig rig;
    two.row_count = 2;
    sheet_measure(&rig, &two, (double[]){1, 2});
    assert_string_equal(curves(&rig), "");
    rg_result_free(&rig.result);
    sheet_measure(&rig, &sheet_names_table, (double[]){50, 10, 11, 20});
    assert_string_equal(curves(&rig), "");
    rg_result_free(&rig.result);
}

// Lines are at most 100 columns long.
static void test_lines(void **state)
{
    (void)state;
    struct rig rig;
    char due[1024] = "";
    sheet_measure_on(&rig, &growth, (double[]){8, 8, 8, 8, 4, 4, 4, 4, 2, 2, 2, 2, 1, 1, 1, 1}, 4);
    for (int d = 0; d < 4; d++) {
        char *name = rig.result.devices[d].name;
        memset(name, 'a' + d, 36);
        name[36] = 0;
        // The first line begins with 25 columns, the others with 8; a curve has 41, and ", " two.
        snprintf(due + strlen(due), sizeof(due) - strlen(due), "%s%s " MOST THIRDS THIRD LEAST,
                 d == 0   ? "Curves from 10 to 10000: "
                 : d == 2 ? ", "
                          : "\n        ",
                 name);
    }
    strcat(due, "\n\n");
    assert_string_equal(curves(&rig), due);
    rg_result_free(&rig.result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_print), cmocka_unit_test(test_growth), cmocka_unit_test(test_restart),
        cmocka_unit_test(test_none),  cmocka_unit_test(test_lines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
