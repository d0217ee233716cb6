// Published tables: their numbers are those of the papers' CSV files, and their settings are taken.
// papers FOLDER reads the files there.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/techniques/technique.h"
#include "harness/record/result.h"
#include "harness/tables/papers/papers.h"

static const char *folder;

enum { LINE = 512, MAX_FIELDS = RG_TABLE_VALUES + 1 };

// --- the published numbers ---

extern const struct rg_table rg_table_stuppacher_1; // needs parameters that flow may lack

// Splits a line of CSV without quotes in place.
static int split(char *line, char *fields[MAX_FIELDS])
{
    char *rest = NULL;
    int count = 0;
    for (char *one = strtok_r(line, ",\r\n", &rest); one; one = strtok_r(NULL, ",\r\n", &rest)) {
        assert_true(count < MAX_FIELDS);
        fields[count++] = one;
    }
    return count;
}

// A field of the file is in the table under the same name, and nothing else is.
static void compare_row(const struct rg_table *table, int row, char *names[], char *fields[],
                        int count)
{
    int columns = table->names ? 1 : 0;
    for (int c = 0; table->columns[c]; c++)
        columns++;
    assert_int_equal(columns, count);
    for (int i = 0; i < count; i++) {
        if (table->names && !strcmp(names[i], table->names))
            assert_string_equal(fields[i], table->rows[row].name);
        else if (strtod(fields[i], NULL) != rg_table_value(table, row, names[i]))
            fail_msg("%s, row %d: %s is %s in print, %g in the table", table->id, row + 1, names[i],
                     fields[i], rg_table_value(table, row, names[i]));
    }
}

static void compare(const struct rg_table *table)
{
    char path[1024], header[LINE], line[LINE], *names[MAX_FIELDS], *fields[MAX_FIELDS];
    snprintf(path, sizeof(path), "%s/%s.csv", folder, table->id);
    FILE *file = fopen(path, "r");
    if (!file)
        fail_msg("%s: cannot be read", path);
    assert_non_null(fgets(header, sizeof(header), file));
    const int count = split(header, names);
    int rows = 0;
    for (; fgets(line, sizeof(line), file); rows++) {
        assert_true(rows < table->row_count);
        assert_int_equal(split(line, fields), count);
        compare_row(table, rows, names, fields, count);
    }
    assert_int_equal(rows, table->row_count);
    fclose(file);
}

static void test_published(void **state)
{
    (void)state;
    assert_non_null(rg_table_find("stuppacher-2"));
    compare(&rg_table_stuppacher_1);
    for (int i = 0; rg_tables[i]; i++)
        if (rg_table_is_published(rg_tables[i]))
            compare(rg_tables[i]);
}

static int count_variants(const struct rg_table *table)
{
    int count = 0;
    while (table->variants[count].name)
        count++;
    return count;
}

// Every assignment of every table is one that its technique takes, and every variant has its
// column.
static void test_settings(void **state)
{
    (void)state;
    for (int i = 0; rg_tables[i]; i++) {
        const struct rg_table *table = rg_tables[i];
        const struct rg_technique *technique = rg_technique_find(table->technique);
        assert_non_null(technique);
        assert_in_range(table->row_count, 1, RG_TABLE_ROWS);
        const int variants = count_variants(table);
        assert_in_range(variants, 1, RG_TABLE_VARIANTS);
        assert_true(table->names || table->key_count > 0);
        assert_in_range(strlen(table->note), 1, RG_NOTE_SIZE - 1); // a result holds it whole
        void *defaults = rg_settings_create(technique);
        for (int j = 0; j < table->row_count * variants; j++) {
            const int row = j % table->row_count, variant = j / table->row_count;
            void *of_row = rg_settings_copy(technique, defaults, table->rows[row].set);
            assert_non_null(of_row);
            void *all = rg_settings_copy(technique, of_row, table->variants[variant].set);
            assert_non_null(all);
            void *quick = rg_settings_copy(technique, all, table->quick ? table->quick : "");
            assert_non_null(quick);
            void *truth = rg_settings_copy(technique, quick, table->truth ? table->truth : "");
            assert_non_null(truth);
            if (table->is_of_textures)
                assert_true(table->rows[row].name && rg_table_value(table, row, "level") >= 0);
            else if (rg_table_is_published(table))
                assert_true(rg_table_published_fps(table, row, variant) > 0);
            free(truth);
            free(quick);
            free(all);
            free(of_row);
        }
        free(defaults);
    }
}

int main(int argc, char **argv)
{
    folder = argc > 1 ? argv[1] : "results/published";
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_published),
        cmocka_unit_test(test_settings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
