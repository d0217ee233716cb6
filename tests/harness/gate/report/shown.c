// What a report shows to the letter: its summary, its lines, and what is read back of its JSON.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/compare/gate/report/forms.h"
#include "harness/compare/gate/report/gtest.h"
#include "harness/compare/gate/report/texts.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

static void add(struct rg_report *report, const char *name, enum rg_ending ending,
                const char *message)
{
    assert_true(rg_report_add(report, &(struct rg_report_case){.name = name,
                                                               .technique = "raster",
                                                               .ending = ending,
                                                               .message = message,
                                                               RG_UNMEASURED}));
}

// The text that a form writes, which the caller frees.
static char *written(const struct rg_report *report, rg_report_writer form)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    assert_true(form(report, out));
    assert_int_equal(fclose(out), 0);
    return text;
}

static void assert_written(const struct rg_report *report, rg_report_writer form, const char *due)
{
    char *text = written(report, form);
    assert_string_equal(text, due);
    free(text);
}

// --- endings and their sums ---

// docs/ci.md: which endings fail, and which exit status each has.
static void endings_have_their_words_elements_and_statuses(void **state)
{
    (void)state;
    static const struct {
        const char *name, *element;
        int exit;
        bool fails;
    } rows[RG_ENDING_COUNT] = {
        {"crash", "error", 1, true},
        {"timeout", "error", 1, true},
        {"error", "error", 1, true},
        {"set-up", "error", 1, true},
        {"lacking", "error", 71, true},
        {"differs", "failure", 1, true},
        {"unexpected pass", "failure", 1, true},
        {"nothing measured", "error", 4, true},
        {"regressed", "failure", 1, true},
        {"inconclusive", "skipped", 3, false},
        {"flake", "skipped", 0, false},
        {"expected failure", "skipped", 0, false},
        {"unsupported", "skipped", 77, false},
        {"skipped", "skipped", 0, false},
        {"improved", NULL, 0, false},
        {"pass", NULL, 0, false},
    };
    for (int i = 0; i < RG_ENDING_COUNT; i++) {
        const enum rg_ending ending = (enum rg_ending)i;
        const char *element = rg_ending_element(ending);
        assert_string_equal(rg_ending_name(ending), rows[i].name);
        assert_string_equal(element ? element : "", rows[i].element ? rows[i].element : "");
        assert_int_equal(rg_ending_exit(ending), rows[i].exit);
        assert_int_equal(rg_ending_fails(ending), rows[i].fails);
    }
    static const enum rg_ending of[RG_OUTCOME_COUNT] = {
        RG_ENDING_PASS,  RG_ENDING_DIFFERS, RG_ENDING_UNSUPPORTED,      RG_ENDING_ERROR,
        RG_ENDING_CRASH, RG_ENDING_TIMEOUT, RG_ENDING_NOTHING_MEASURED, RG_ENDING_LACKING,
        RG_ENDING_SETUP};
    for (int i = 0; i < RG_OUTCOME_COUNT; i++)
        assert_int_equal(rg_ending_of((enum rg_outcome)i), of[i]);
}

static void a_summary_counts_each_ending_worst_first(void **state)
{
    (void)state;
    struct rg_report report = {.case_count = 0};
    char text[RG_REPORT_SUMMARY];
    rg_report_summary(&report, text);
    assert_string_equal(text, "0 cases");
    add(&report, "a", RG_ENDING_PASS, "");
    rg_report_summary(&report, text);
    assert_string_equal(text, "1 case, 1 pass");
    add(&report, "b", RG_ENDING_CRASH, "");
    add(&report, "c", RG_ENDING_FLAKE, "");
    add(&report, "d", RG_ENDING_PASS, "");
    add(&report, "e", RG_ENDING_EXPECTED_FAILURE, "");
    struct rg_report_case compared = {
        .name = "f", .ending = RG_ENDING_FLAKE, .is_compared = true, RG_UNMEASURED};
    assert_true(rg_report_add(&report, &compared));
    rg_report_summary(&report, text);
    assert_string_equal(text, "6 cases, 1 crash, 2 flake, 1 expected failure, 2 pass; 2 of them "
                              "compared nothing");
    static const int order[] = {1, 2, 5, 4, 0, 3};
    for (int i = 0; i < 6; i++)
        assert_int_equal(report.order[i], order[i]);
    rg_report_free(&report);
}

static void a_measure_is_told_as_far_as_it_is_known(void **state)
{
    (void)state;
    static const struct {
        struct rg_bounded ratio;
        double visible;
        const char *said;
    } rows[] = {
        {{1.05234, 1.0314, 1.0741}, 0.0234, "ratio 1.052 (1.031 to 1.074), would have seen 2.34 %"},
        {{1.5, NAN, 2}, NAN, "ratio 1.5"},
        {{1.5, 1, NAN}, 0.1, "ratio 1.5, would have seen 10 %"},
        {{NAN, 1, 2}, 0.1, ""},
    };
    struct rg_report report = {.case_count = 0};
    for (int i = 0; i < 4; i++) {
        struct rg_report_case c = {.name = "a", RG_UNMEASURED};
        c.ratio = rows[i].ratio;
        c.smallest_visible = rows[i].visible;
        assert_true(rg_report_add(&report, &c));
        assert_string_equal(report.cases[i].measured, rows[i].said);
    }
    assert_string_equal(report.cases[3].name, "a (4)");
    rg_report_free(&report);
}

// --- text ---

#define TEN "0123456789"

// Lines break at the last space that fits, or within a word that is longer than a line.
static void text_breaks_between_words(void **state)
{
    (void)state;
    struct rg_report report = {.case_count = 0};
    const char *const pictures[] = {"out/a.png", "out/b.png"};
    struct rg_report_case c = {.name = "rain.gl",
                               .ending = RG_ENDING_DIFFERS,
                               .message = TEN TEN TEN TEN TEN TEN TEN TEN TEN TEN " abcdef",
                               .details = "one\ntwo\tthree ##[x",
                               .attachments = pictures,
                               .attachment_count = 2,
                               RG_UNMEASURED};
    c.ratio.value = 2;
    add(&report, "flow.gl", RG_ENDING_PASS,
        TEN TEN TEN TEN TEN TEN TEN TEN TEN TEN
        " abcde fghij " TEN TEN TEN TEN TEN TEN TEN TEN TEN TEN "01234567");
    assert_true(rg_report_add(&report, &c));
    assert_written(&report, rg_report_text,
                   "differs           rain.gl\n"
                   "  | " TEN TEN TEN TEN TEN TEN TEN TEN TEN TEN "\n"
                   "  | abcdef\n"
                   "  | ratio 2\n"
                   "  | one\n"
                   "  | two three ##(x\n"
                   "  | picture: out/a.png\n"
                   "  | picture: out/b.png\n"
                   "pass              flow.gl\n"
                   "  | " TEN TEN TEN TEN TEN TEN TEN TEN TEN TEN " abcde\n"
                   "  | fghij\n"
                   "  | " TEN TEN TEN TEN TEN TEN TEN TEN TEN TEN "012345\n"
                   "  | 67\n"
                   "2 cases, 1 differs, 1 pass\n");
    rg_report_free(&report);
}

// --- GitHub ---

static void markdown_names_drivers_and_pictures(void **state)
{
    (void)state;
    char path[] = "/tmp/raingauge-summary-XXXXXX", text[1024] = "";
    const char *const pictures[] = {"out/a_b.png", "out/b.png"};
    struct rg_report report = {.case_count = 0};
    struct rg_report_case c = {.name = "rain.gl",
                               .ending = RG_ENDING_DIFFERS,
                               .message = "it differs",
                               .attachments = pictures,
                               .attachment_count = 2,
                               RG_UNMEASURED};
    const int made = mkstemp(path);
    assert_true(made >= 0 && !close(made));
    assert_true(rg_report_add(&report, &c));
    add(&report, "flow.gl", RG_ENDING_IMPROVED, "faster");
    assert_true(rg_report_set_drivers(&report, "A  gl: Mesa 22\nB  gl: Mesa 25\n"));
    assert_true(rg_report_append(&report, &rg_report_forms[RG_AS_SUMMARY], path));
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof(text) - 1, file)] = 0;
    fclose(file);
    assert_string_equal(text, "## raingauge gate: 2 cases, 1 differs, 1 improved\n\n"
                              "```text\nA  gl: Mesa 22\nB  gl: Mesa 25\n```\n\n"
                              "| outcome | case | why | measured |\n|---|---|---|---|\n"
                              "| differs | rain.gl | it differs |  |\n"
                              "| improved | flow.gl | faster |  |\n"
                              "\n### rain.gl\n\n- picture: out/a\\_b.png\n- picture: out/b.png\n");
    unlink(path);
    rg_report_free(&report);
    assert_false(rg_report_can_append("/nonexistent/out", "MY_FILE"));
    assert_non_null(strstr(logged, "/nonexistent/out: cannot be opened: "));
    assert_non_null(strstr(logged, "; $MY_FILE must name a file"));
}

static void a_summary_of_what_passed_is_one_line(void **state)
{
    (void)state;
    char text[256] = "";
    struct rg_report report = {.case_count = 0};
    FILE *file = tmpfile();
    assert_non_null(file);
    add(&report, "rain.gl", RG_ENDING_PASS, "of what passed no row is told");
    assert_true(rg_report_markdown(&report, file));
    rewind(file);
    text[fread(text, 1, sizeof(text) - 1, file)] = 0;
    fclose(file);
    assert_string_equal(text, "## raingauge gate: 1 case, 1 pass\n\n");
    rg_report_free(&report);
}

// --- JSON ---

static void a_case_is_read_as_it_was_written(void **state)
{
    (void)state;
    const char *const devices[] = {"cpu", "gl"}, *const pictures[] = {"a.png", "b.png", "c.png"};
    const struct rg_report_case c = {.name = "rain.gl",
                                     .technique = "raster",
                                     .devices = devices,
                                     .device_count = 2,
                                     .seconds = 1.5,
                                     .ending = RG_ENDING_UNSUPPORTED,
                                     .is_compared = true,
                                     .message = "m",
                                     .details = "one\ntwo",
                                     .attachments = pictures,
                                     .attachment_count = 3,
                                     .ratio = {1.5, 1.25, NAN},
                                     .smallest_visible = 0.5,
                                     .time_ms = {4, 3, 5},
                                     .baseline_ms = 7};
    struct rg_report report = {.case_count = 0}, read = {.case_count = 0};
    assert_true(rg_report_add(&report, &c));
    json_t *document = rg_report_document(&report);
    json_t *found = json_array_get(json_object_get(document, "gated"), 0);
    assert_true(json_is_false(json_object_get(found, "over")) &&
                json_is_true(json_object_get(found, "compared")));
    for (int over = 0; over < 2; over++) {
        json_object_set_new(found, "over", json_boolean(over));
        json_object_set_new(found, "compared", json_boolean(!over));
        assert_true(rg_report_read(&read, found));
        const struct rg_report_case *is = &read.cases[over];
        assert_true(is->is_over == over && is->is_compared == !over);
        assert_string_equal(is->technique, "raster");
        assert_string_equal(is->message, "m");
        assert_string_equal(is->details, "one\ntwo");
        assert_true(is->device_count == 2 && !strcmp(is->devices[1], "gl"));
        assert_true(is->attachment_count == 3 && !strcmp(is->attachments[2], "c.png"));
        assert_int_equal(is->ending, RG_ENDING_UNSUPPORTED);
        assert_true(is->seconds == 1.5 && is->smallest_visible == 0.5 && is->baseline_ms == 7);
        assert_true(is->ratio.value == 1.5 && is->ratio.low == 1.25 && isnan(is->ratio.high));
        assert_true(is->time_ms.value == 4 && is->time_ms.low == 3 && is->time_ms.high == 5);
    }
    json_decref(document);
    rg_report_free(&report);
    rg_report_free(&read);
}

// --- googletest ---

static void a_runner_is_told_what_was_measured(void **state)
{
    (void)state;
    struct rg_report report = {.case_count = 0};
    struct rg_report_case c = {.name = "rain.gl", .message = "m", .details = "d", RG_UNMEASURED};
    c.ending = RG_ENDING_REGRESSED;
    c.ratio.value = 2;
    assert_true(rg_report_add(&report, &c));
    char *text = written(&report, rg_gtest_print);
    assert_non_null(
        strstr(text, "| rain.gl\n| regressed\n| m\n| ratio 2\n| d\n[  FAILED  ] rain.gl ("));
    free(text);
    rg_report_free(&report);
}

static void a_long_name_is_cut_where_a_runner_would(void **state)
{
    (void)state;
    char name[300], made[RG_GTEST_NAME], other[RG_GTEST_NAME];
    memset(name, 'n', sizeof(name));
    name[4] = '.';
    name[RG_GTEST_KEPT] = 0;
    rg_gtest_name(name, made);
    assert_string_equal(made, name); // as long as a name may be
    name[RG_GTEST_KEPT] = 'n';
    name[RG_GTEST_KEPT + 1] = 0;
    rg_gtest_name(name, made);
    assert_int_equal(strlen(made), RG_GTEST_KEPT + 17);
    assert_memory_equal(made, name, RG_GTEST_KEPT);
    name[RG_GTEST_KEPT] = 'm';
    rg_gtest_name(name, other);
    assert_string_not_equal(made, other);
    rg_gtest_name("a.b.c", made);
    assert_string_equal(made, "a.b/c");
    rg_gtest_name("ab", made);
    assert_memory_equal(made, "raingauge.ab_", 13);
}

int main(void)
{
    rg_log_listen(log_last, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(endings_have_their_words_elements_and_statuses),
        cmocka_unit_test(a_summary_counts_each_ending_worst_first),
        cmocka_unit_test(a_measure_is_told_as_far_as_it_is_known),
        cmocka_unit_test(text_breaks_between_words),
        cmocka_unit_test(markdown_names_drivers_and_pictures),
        cmocka_unit_test(a_summary_of_what_passed_is_one_line),
        cmocka_unit_test(a_case_is_read_as_it_was_written),
        cmocka_unit_test(a_runner_is_told_what_was_measured),
        cmocka_unit_test(a_long_name_is_cut_where_a_runner_would),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
