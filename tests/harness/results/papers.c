// Published tables: their numbers are those of the papers' CSV files, and their techniques take
// their settings. `papers FOLDER` reads the files there.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/techniques/technique.h"
#include "harness/tables/papers/papers.h"
#include "harness/tables/table.h"
#include "tests/tools/expect.h"
#include "tests/tools/instance.h"

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
        assert_below(count, MAX_FIELDS);
        fields[count++] = one;
    }
    return count;
}

static void compare_value(const struct rg_table *table, int row, const char *name,
                          const char *field)
{
    char text[64] = "nothing";
    int c = 0;
    while (table->columns[c] && strcmp(table->columns[c], name) != 0)
        c++;
    if (table->columns[c])
        rg_table_value_text(table, row, c, text, sizeof(text));
    const bool is_same = table->columns[c] && rg_table_is_choice(table, c)
                             ? !strcmp(field, text)
                             : strtod(field, NULL) == rg_table_value(table, row, name);
    if (!is_same)
        fail_msg("%s, row %d: %s is %s in print, %s in the table", table->id, row + 1, name, field,
                 text);
}

// Each field of the file is in the table under the same name, and the table has no others.
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
        else
            compare_value(table, row, names[i], fields[i]);
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
        assert_below(rows, table->row_count);
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

static void check_print(const struct rg_record *record)
{
    double low, high;
    rg_record_published_range(record, &low, &high);
    assert_below(0, low);
    assert_at_most(low, high);
}

// If a key has a parameter's name, its value is the row's setting of it, at full length.
static void check_keys(const struct rg_table *table, int row, const void *settings)
{
    const struct rg_technique *technique = rg_technique_find(table->technique);
    for (int c = 0; c < table->key_count; c++) {
        const struct rg_param *param = rg_params_find(technique->params, table->columns[c]);
        char set[RG_PATH_SIZE], said[RG_PATH_SIZE];
        const bool is_choice = rg_table_is_choice(table, c);
        if (!param || param->kind == RG_PARAM_FILE ||
            (param->kind == RG_PARAM_CHOICE && !is_choice))
            continue;
        rg_params_text(param, settings, set, sizeof(set));
        rg_table_value_text(table, row, c, said, sizeof(said));
        if (is_choice ? strcmp(set, said) != 0 : atof(set) != atof(said))
            fail_msg("%s, row %d: %s is %s, not %s", table->id, row + 1, param->name, set, said);
    }
}

// A cell's technique takes its assignments, in either length, with the truth's added. Its record
// holds all of them.
static void check_cells(const struct rg_table *table, bool full)
{
    static struct rg_device device = {.info = {.name = "cpu"}};
    const struct rg_devices devices = {.count = 1, .devices = {&device}};
    const struct rg_table_part part = {.last_row = table->row_count - 1, .full = full};
    struct rg_result result = {0};
    rg_table_begin(&result, table, &part, &devices);
    assert_string_equal(result.note, table->note);
    for (int row = 0; row < table->row_count; row++)
        assert_true(rg_table_add_row(&result, table, row));
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at);) {
        char *assignments = rg_table_assignments(&result, table, at);
        assert_string_equal(rg_result_at(&result, at)->set, assignments);
        void *settings = settings_of(table->technique, "", assignments);
        void *truth = settings_of(table->technique, assignments, table->truth ? table->truth : "");
        if (table->is_of_textures)
            assert_true(table->rows[at.row].name && rg_table_value(table, at.row, "level") >= 0);
        else if (rg_table_is_published(table))
            check_print(rg_result_at(&result, at));
        if (full)
            check_keys(table, at.row, settings);
        free(truth);
        free(settings);
        free(assignments);
    }
    rg_result_free(&result);
}

static void test_settings(void **state)
{
    (void)state;
    for (int i = 0; rg_tables[i]; i++) {
        const struct rg_table *table = rg_tables[i];
        assert_non_null(rg_technique_find(table->technique));
        assert_between(table->row_count, 1, RG_TABLE_ROWS);
        assert_true(table->names || table->key_count > 0);
        check_cells(table, false);
        check_cells(table, true);
    }
}

// The works that --work chooses among: the printed work, another reading of it, and work that saves
// something and says so. Printed work by the API's queries, which some devices lack, is one, too.
static void check_work(const struct rg_table_work *work)
{
    const bool is_ours = !strcmp(work->name, "ours"), is_first = !strcmp(work->name, "paper");
    const bool is_reading = !strcmp(work->name, "reading"), has_queries = work->elsewhere;
    assert_true(is_ours || is_first || is_reading || has_queries);
    assert_int_equal(is_ours, strlen(work->saves) > 0);
    assert_between(strlen(work->saves), 0, RG_TITLE_SIZE - 1);
    assert_int_equal(has_queries, !strcmp(work->name, "queries"));
    assert_true(!is_reading || work->reading);
    assert_true(!is_ours || !work->reading);
}

static void test_works(void **state)
{
    (void)state;
    int found = 0;
    for (int i = 0; rg_tables[i]; i++) {
        const struct rg_table_work *works = rg_tables[i]->works;
        for (int w = 0; works[w].name; w++) {
            check_work(&works[w]);
            found++;
            assert_int_equal(w == 0, !strcmp(works[w].name, "paper"));
            for (int k = 0; k < w; k++)
                assert_string_not_equal(works[w].set, works[k].set);
            if (!strcmp(works[w].name, "reading")) // each of several says which it is
                assert_true(works[0].reading && strcmp(works[0].reading, works[w].reading) != 0);
        }
    }
    assert_above(found, 0);
}

// Work `paper` of each published table with possible savings is whole: no row has a setting that
// saves work.
static void test_work_of_print(void **state)
{
    (void)state;
    static const struct {
        const char *table, *set;
    } whole[] = {{"creus-5.3", "blocks=all"},    {"creus-5.4", "blocks=all"},
                 {"creus-5.5", "blocks=all"},    {"creus-5.6", "blocks=all"},
                 {"stuppacher-1", "move=paper"}, {"stuppacher-2", "move=paper"}};
    for (size_t i = 0; i < sizeof(whole) / sizeof(whole[0]); i++) {
        const struct rg_table *table = rg_table_find(whole[i].table);
        struct rg_device device = {.info = {.name = "cpu"}};
        const struct rg_devices devices = {.count = 1, .devices = {&device}};
        const struct rg_table_part part = {
            .last_row = table->row_count - 1, .full = true, .work = "paper"};
        struct rg_result result = {0};
        rg_table_begin(&result, table, &part, &devices);
        for (int row = 0; row < table->row_count; row++)
            assert_true(rg_table_add_row(&result, table, row));
        for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at);) {
            const char *set = rg_result_at(&result, at)->set;
            assert_non_null(strstr(set, whole[i].set));
            assert_null(strstr(set, "texels_a_pixel"));
        }
        rg_result_free(&result);
    }
}

// --- what a table tells of itself ---

static const struct rg_table told = {
    .id = "told",
    .technique = "drops",
    .hardware = "paper",
    .columns = {"columns", "merge", "faces", "fps", "fps_few"},
    .key_count = 2,
    .has_choices = true,
    .variants = {{"full", "", "fps"}, {"few", "", "fps_few"}, {"bare", "", NULL}},
    .quick = "a=1",
    .smaller = {"s=16", "s=4"},
    .row_count = 2,
    .rows = (const struct rg_table_row[]){{"", {1234567, 1, 7, 30, 40}, NULL},
                                          {"", {0.25, 0, 8, 31, 41}, NULL}},
};

static void expect_said(const struct rg_table *table, int row, int column, const char *due)
{
    char text[32];
    rg_table_value_text(table, row, column, text, sizeof(text));
    assert_string_equal(text, due);
}

// Choices have names and numbers all their digits; a rate belongs to its variant.
static void test_values(void **state)
{
    (void)state;
    static const bool is_extra[] = {false, false, true, false, false};
    struct rg_table plain = told;
    plain.has_choices = false;
    plain.hardware = NULL;
    expect_said(&told, 0, 0, "1234567");
    expect_said(&told, 1, 0, "0.25");
    expect_said(&told, 0, 1, "on");
    expect_said(&told, 1, 1, "off");
    expect_said(&plain, 0, 1, "1");
    for (int c = 0; c < 5; c++) {
        assert_equals(rg_table_value(&told, 1, told.columns[c]), told.rows[1].values[c]);
        assert_int_equal(rg_table_is_choice(&told, c), c == 1);
        assert_false(rg_table_is_choice(&plain, c));
        assert_int_equal(rg_table_is_extra(&told, c), is_extra[c]);
    }
    assert_true(isnan(rg_table_value(&told, 1, "fps_bare")));
    assert_equals(rg_table_published_fps(&told, 1, 0), 31);
    assert_equals(rg_table_published_fps(&told, 0, 1), 40);
    assert_true(isnan(rg_table_published_fps(&told, 0, 2)));
    assert_true(isnan(rg_table_published_fps(&plain, 0, 0)));
    assert_true(rg_table_is_published(&told) && !rg_table_is_published(&plain));
}

// Settings of quick mode, and behind them those of pictures of a fourth and of half the size.
static void test_quick_settings(void **state)
{
    (void)state;
    static const struct {
        const char *quick, *fourth, *half;
        const char *due[3]; // for the divisors 1, 2 and 4
    } cases[] = {{"a=1", "s=16", "s=4", {"a=1", "a=1 s=4", "a=1 s=16"}},
                 {NULL, "s=16", "s=4", {"", "s=4", "s=16"}},
                 {"a=1", NULL, NULL, {"a=1", "a=1", "a=1"}},
                 {NULL, NULL, NULL, {"", "", ""}}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++)
        for (int k = 0; k < 3; k++) {
            const struct rg_table table = {
                .id = "t", .quick = cases[i].quick, .smaller = {cases[i].fourth, cases[i].half}};
            char *text = rg_table_quick(&table, 1 << k);
            assert_string_equal(text, cases[i].due[k]);
            free(text);
        }
}

static void test_names(void **state)
{
    (void)state;
    struct rg_table own = told;
    assert_string_equal(rg_table_paper(&told), "chin");
    own.is_own = true;
    assert_string_equal(rg_table_paper(&own), "");
    own.is_own = false;
    own.technique = "nonsense";
    assert_string_equal(rg_table_paper(&own), "");
    for (int i = 0; rg_tables[i]; i++)
        assert_ptr_equal(rg_table_find(rg_tables[i]->id), rg_tables[i]);
    assert_null(rg_table_find("creus-5"));
    assert_null(rg_table_find("creus-5.44"));
}

int main(int argc, char **argv)
{
    folder = argc > 1 ? argv[1] : "results/published";
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_published), cmocka_unit_test(test_settings),
        cmocka_unit_test(test_works),     cmocka_unit_test(test_work_of_print),
        cmocka_unit_test(test_values),    cmocka_unit_test(test_quick_settings),
        cmocka_unit_test(test_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
