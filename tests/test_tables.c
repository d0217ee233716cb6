// The published numbers in harness/tables are those of the papers' CSV files.
// test_tables FOLDER reads them there.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/tables/tables.h"

static const char *folder;

enum { LINE = 512 };

// The number in the column of this name; fails the test where there is none.
static double field(const char *header, const char *line, const char *column)
{
    char names[LINE], values[LINE], *name_rest, *value_rest;
    snprintf(names, sizeof(names), "%s", header);
    snprintf(values, sizeof(values), "%s", line);
    char *name = strtok_r(names, ",\r\n", &name_rest);
    char *value = strtok_r(values, ",\r\n", &value_rest);
    while (name && value && strcmp(name, column)) {
        name = strtok_r(NULL, ",\r\n", &name_rest);
        value = strtok_r(NULL, ",\r\n", &value_rest);
    }
    if (!name || !value)
        fail_msg("no column '%s' in: %s", column, line);
    return strtod(value, NULL);
}

static void compare(const struct rg_table *table)
{
    char path[1024], header[LINE], line[LINE];
    snprintf(path, sizeof(path), "%s/%s.csv", folder, table->id);
    FILE *file = fopen(path, "r");
    if (!file)
        fail_msg("%s: cannot be read", path);
    assert_non_null(fgets(header, sizeof(header), file));
    int rows = 0;
    for (; fgets(line, sizeof(line), file); rows++) {
        assert_true(rows < table->row_count);
        assert_true(field(header, line, table->axis) == table->rows[rows].axis);
        assert_true(field(header, line, "fps") == table->rows[rows].fps);
    }
    assert_int_equal(rows, table->row_count);
    fclose(file);
}

static void test_stuppacher_2(void **state)
{
    (void)state;
    const struct rg_table *table = rg_table_find("stuppacher-2");
    assert_non_null(table);
    assert_int_equal(table->row_count, 3);
    compare(table);
}

int main(int argc, char **argv)
{
    folder = argc > 1 ? argv[1] : "results/published";
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_stuppacher_2)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
