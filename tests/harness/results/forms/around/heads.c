// The lines above brief tables: which things are compared, by which drivers, and each table's kind.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "harness/tables/sheet/brief.h"
#include "tests/harness/results/forms/rig.h"

// A printed result, until the next call.
static const char *printed(const struct rg_result *result,
                           bool (*print)(const struct rg_result *result, FILE *out))
{
    static char text[1 << 15];
    memset(text, 0, sizeof(text));
    FILE *out = fmemopen(text, sizeof(text), "w");
    assert_non_null(out);
    assert_true(print(result, out));
    assert_int_equal(fclose(out), 0);
    return text;
}

// The lines that begin so, one after the other, without their beginning.
static const char *lines_with(const char *text, const char *begin)
{
    static char lines[4096];
    *lines = 0;
    for (const char *line = text; *line; line += strcspn(line, "\n") + 1)
        if (!strncmp(line, begin, strlen(begin)))
            snprintf(lines + strlen(lines), sizeof(lines) - strlen(lines), "%.*s\n",
                     (int)(strcspn(line, "\n") - strlen(begin)), line + strlen(begin));
    return lines;
}

static void test_kinds(void **state)
{
    (void)state;
    struct rg_table works = sheet_styles_table;
    struct rig rig;
    sheet_measure(&rig, &sheet_names_table, (double[]){50, 10, 11, 20});
    assert_string_equal(lines_with(printed(&rig.result, rg_brief_print), "### "), "full\n");
    rg_result_free(&rig.result);
    sheet_measure(&rig, &sheet_styles_table, (double[]){50, 100, 60, 110, 45, 50, 60, 110});
    assert_string_equal(lines_with(printed(&rig.result, rg_brief_print), "### "),
                        "paper, full\npaper, no_geometry\nours, full, times paper\n"
                        "ours, no_geometry, times paper\n");
    snprintf(rig.result.works[0].reading, RG_TITLE_SIZE, "two textures");
    assert_string_equal(lines_with(printed(&rig.result, rg_brief_print), "### paper"),
                        ", full: two textures\n, no_geometry: two textures\n");
    rg_result_free(&rig.result);
    works.variants[1].name = NULL;
    sheet_measure(&rig, &works, (double[]){50, 60, 45, 60});
    assert_string_equal(lines_with(printed(&rig.result, rg_brief_print), "### "),
                        "paper\nours, times paper\n");
    rg_result_free(&rig.result);
}

static void expect_begin(const struct rg_result *result, const char *due)
{
    const char *text = printed(result, rg_brief_print);
    if (strncmp(text, due, strlen(due)) != 0)
        fail_msg("%.300s\nbegins not so: %s", text, due);
}

static void test_comparisons(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure(&rig, &sheet_names_table, (double[]){50, 10, 11, 20});
    expect_begin(&rig.result, "## names\n\nFrames a second in the paper (print) and on each "
                              "device, whose rate is also told as a multiple of ");
    *rig.result.hardware = 0;
    expect_begin(&rig.result, "## names\n\nFrames a second on each device.\n\n###");
    rig.result.is_of_textures = true;
    expect_begin(&rig.result,
                 "## names\n\nSizes of textures in pixels, in print and on each device.\n\n###");
    rg_result_free(&rig.result);
}

// Drivers are named where two devices of one API are beside each other, or one has settings of its
// own.
static void test_drivers(void **state)
{
    (void)state;
    static const struct {
        const char *full[3];
        bool are_named;
    } cases[] = {{{"gl", "vulkan"}, false},           {{"cpu", "cpu:reference"}, false},
                 {{"gl:llvmpipe", "gl:other"}, true}, {{"gl", "cpu", "gl@X=1"}, true},
                 {{"vulkan2:a", "vulkan:a"}, false},  {{"cpu", "gl@X=1"}, true},
                 {{"cpu@X=1", "gl"}, true},           {{"gl@X=1"}, false}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rig rig;
        int devices = 0;
        while (devices < 3 && cases[i].full[devices])
            devices++;
        sheet_measure_on(&rig, &sheet_names_table, (double[]){9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9},
                         devices);
        for (int d = 0; d < devices; d++)
            snprintf(rig.result.devices[d].full, sizeof(rig.result.devices[d].full), "%s",
                     cases[i].full[d]);
        char head[1 << 12] = "";
        const char *text = printed(&rig.result, rg_brief_print);
        snprintf(head, sizeof(head), "%.*s", (int)(strstr(text, "\n###") - text), text);
        int lines = 0;
        for (const char *c = lines_with(head, "- "); *c; c++)
            lines += *c == '\n';
        assert_int_equal(lines, cases[i].are_named ? devices : 0);
        rg_result_free(&rig.result);
    }
}

// An article has a table for each kind, with a caption of its own.
static void test_captions(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure(&rig, &sheet_styles_table, (double[]){50, 100, 60, 110, 45, 50, 60, 110});
    rig.result.work_count = 1;
    assert_string_equal(lines_with(printed(&rig.result, rg_brief_print_tex), "\\caption"),
                        "{styles, paper, full. Frames a second; in print on paper}\n"
                        "{styles, paper, no\\_geometry. Frames a second; in print on paper}\n");
    *rig.result.hardware = 0;
    rig.result.is_of_textures = true;
    assert_string_equal(lines_with(printed(&rig.result, rg_brief_print_tex), "\\caption"),
                        "{styles, paper, full. Sizes of textures in pixels}\n"
                        "{styles, paper, no\\_geometry. Sizes of textures in pixels}\n");
    rg_result_free(&rig.result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_kinds),
        cmocka_unit_test(test_comparisons),
        cmocka_unit_test(test_drivers),
        cmocka_unit_test(test_captions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
