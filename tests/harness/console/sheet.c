// A table of cells as Markdown, CSV and LaTeX, to the last character.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/sheet.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

static void add_row(struct rg_sheet *sheet, const char *first, const char *second)
{
    char(*row)[RG_SHEET_CELL] = rg_sheet_row(sheet);
    assert_non_null(row);
    assert_string_equal(row[0], "");
    snprintf(row[0], RG_SHEET_CELL, "%s", first);
    snprintf(row[1], RG_SHEET_CELL, "%s", second);
}

static struct rg_sheet make_sheet(void)
{
    struct rg_sheet sheet = {.title = "T"};
    assert_int_equal(rg_sheet_column(&sheet, "%s", "name"), 0);
    assert_int_equal(rg_sheet_column(&sheet, "value %d", 1), 1);
    add_row(&sheet, "a", "fast");
    add_row(&sheet, "a, \"b\"", "2.5");
    rg_sheet_note(&sheet, "first %s", "note");
    rg_sheet_note(&sheet, "second note");
    return sheet;
}

static void expect(void (*print)(const struct rg_sheet *, FILE *), const struct rg_sheet *sheet,
                   const char *due)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    print(sheet, out);
    assert_int_equal(fclose(out), 0);
    assert_string_equal(text, due);
    free(text);
}

// Columns are eight wide, or sixteen; leading notes stand above.
static void markdown_is_aligned(void **state)
{
    (void)state;
    struct rg_sheet sheet = make_sheet();
    expect(rg_sheet_print_md, &sheet,
           "## T\n\n"
           "|     name |  value 1 |\n"
           "|---------:|---------:|\n"
           "|        a |     fast |\n"
           "|   a, \"b\" |      2.5 |\n"
           "\n- first note\n- second note\n");
    assert_int_equal(rg_sheet_width(&sheet), 23);
    sheet.lead_count = 1;
    snprintf(sheet.cells[0][1], RG_SHEET_CELL, "123456789");
    expect(rg_sheet_print_md, &sheet,
           "## T\n\n- first note\n\n"
           "|     name |          value 1 |\n"
           "|---------:|-----------------:|\n"
           "|        a |        123456789 |\n"
           "|   a, \"b\" |              2.5 |\n"
           "\n- second note\n");
    assert_int_equal(rg_sheet_width(&sheet), 31);
    rg_sheet_free(&sheet);
}

// Columns as wide as needed, notes on several lines, and a heading of a level below.
static void markdown_is_narrow_on_request(void **state)
{
    (void)state;
    struct rg_sheet sheet = make_sheet();
    sheet.width_step = 1;
    sheet.note_width = 11;
    sheet.level = 3;
    expect(rg_sheet_print_md, &sheet,
           "### T\n\n"
           "|   name | value 1 |\n"
           "|-------:|--------:|\n"
           "|      a |    fast |\n"
           "| a, \"b\" |     2.5 |\n"
           "\n- first\n  note\n- second\n  note\n");
    assert_int_equal(rg_sheet_width(&sheet), 20);
    sheet.lead_count = 2;
    sheet.note_width = 13;
    expect(rg_sheet_print_md, &sheet,
           "### T\n\n- first note\n- second note\n\n"
           "|   name | value 1 |\n"
           "|-------:|--------:|\n"
           "|      a |    fast |\n"
           "| a, \"b\" |     2.5 |\n");
    rg_sheet_free(&sheet);
}

static const char *paint(const char *cell)
{
    return strcmp(cell, "fast") && strcmp(cell, "name") ? NULL : "<green>";
}

// Colour is around the text alone, and headings have none.
static void cells_have_colours(void **state)
{
    (void)state;
    struct rg_sheet sheet = make_sheet();
    sheet.paint = paint;
    sheet.lead_count = 2;
    expect(rg_sheet_print_md, &sheet,
           "## T\n\n- first note\n- second note\n\n"
           "|     name |  value 1 |\n"
           "|---------:|---------:|\n"
           "|        a |     <green>fast\033[0m |\n"
           "|   a, \"b\" |      2.5 |\n\n");
    rg_sheet_free(&sheet);
}

// Commas, quotes and line ends put a cell between quotes.
static void csv_is_quoted(void **state)
{
    (void)state;
    struct rg_sheet sheet = make_sheet();
    add_row(&sheet, "two\nlines", "");
    add_row(&sheet, "'a'; b", "c\"");
    expect(rg_sheet_print_csv, &sheet,
           "name,value 1\na,fast\n\"a, \"\"b\"\"\",2.5\n\"two\nlines\",\n'a'; b,\"c\"\"\"\n");
    rg_sheet_free(&sheet);
}

static void latex_is_escaped(void **state)
{
    (void)state;
    struct rg_sheet sheet = make_sheet();
    sheet.title = "a_b \\ ^~";
    snprintf(sheet.cells[0][0], RG_SHEET_CELL, "%%&#${}");
    snprintf(sheet.cells[0][1], RG_SHEET_CELL, "5 +-3+ -");
    expect(rg_sheet_print_tex, &sheet,
           "\\begin{table} % \\usepackage{booktabs}\n"
           "\\caption{a\\_b \\textbackslash{} \\^{}\\~{}}\n"
           "\\centering\\footnotesize\n"
           "\\begin{tabular}{@{}rr@{}}\n"
           "\\toprule\nname & value 1 \\\\\n\\midrule\n"
           "\\%\\&\\#\\$\\{\\} & 5 $\\pm$3+ - \\\\\n"
           "a, \"b\" & 2.5 \\\\\n"
           "\\bottomrule\n\\end{tabular}\n"
           "\n\\noindent first note\n\n\\noindent second note\n"
           "\\end{table}\n");
    rg_sheet_free(&sheet);
}

// A column too many is an error, and the last one is in its place.
static void there_is_room_for_so_many_columns(void **state)
{
    (void)state;
    struct rg_sheet sheet = {.title = "wide"};
    for (int i = 0; i < RG_SHEET_COLUMNS; i++)
        assert_int_equal(rg_sheet_column(&sheet, "c%d", i), i);
    assert_false(sheet.incomplete);
    rg_log_listen(log_last, NULL);
    assert_int_equal(rg_sheet_column(&sheet, "more"), RG_SHEET_COLUMNS - 1);
    rg_log_listen(NULL, NULL);
    assert_true(sheet.incomplete && sheet.column_count == RG_SHEET_COLUMNS);
    assert_string_equal(sheet.columns[31], "c31");
    assert_string_equal(logged, "table 'wide': more than 32 columns; raise RG_SHEET_COLUMNS");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(markdown_is_aligned), cmocka_unit_test(markdown_is_narrow_on_request),
        cmocka_unit_test(cells_have_colours),  cmocka_unit_test(csv_is_quoted),
        cmocka_unit_test(latex_is_escaped),    cmocka_unit_test(there_is_room_for_so_many_columns),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
