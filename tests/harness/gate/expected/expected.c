// Expectations are read from text, and judge results on a given day.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <math.h>

#include "core/base/log.h"
#include "harness/compare/gate/cells/cells.h"
#include "harness/compare/gate/expected/expected.h"
#include "harness/compare/gate/cells/unused.h"
#include "harness/compare/gate/text/date.h"
#include "harness/compare/gate/text/glob.h"
#include "tests/tools/process/logged.h"

static bool add(struct rg_known *expected, const char *text, enum rg_known_form form)
{
    log_forget();
    return rg_known_add_text(expected, "my.txt", text, strlen(text), form);
}

static int day(const char *text)
{
    int number;
    assert_true(rg_date_read(text, &number));
    return number;
}

// --- days and patterns ---

static void days_are_those_of_the_calendar(void **state)
{
    (void)state;
    assert_int_equal(day("1970-01-01"), 0);
    assert_int_equal(day("2000-03-01"), 11017); // from date(1)
    assert_int_equal(day("2026-11-23"), 20780);
    assert_int_equal(day("2100-03-01") - day("2100-02-28"), 1);
    assert_int_equal(day("2024-03-01") - day("2024-02-28"), 2);
    static const char *const wrong[] = {"",           "2026-2-01",   "2026-02-29", "2026-13-01",
                                        "2026-00-01", "2026-01-00",  "2026-04-31", "2026-01-011",
                                        "1969-12-31", " 2026-01-01", "2026/01/01", "20260101"};
    int number;
    for (size_t i = 0; i < sizeof(wrong) / sizeof(wrong[0]); i++)
        if (rg_date_read(wrong[i], &number))
            fail_msg("'%s' is a day", wrong[i]);
    char text[RG_DATE_SIZE];
    for (int d = day("1999-12-25"); d < day("2004-03-05"); d++) {
        rg_date_write(d, text);
        assert_int_equal(day(text), d);
    }
}

static void patterns_describe_whole_names(void **state)
{
    (void)state;
    static const struct {
        const char *pattern, *text;
        bool is_one;
    } rows[] = {
        {"", "", true},          {"", "a", false},      {"*", "", true},
        {"a", "a", true},        {"a", "ab", false},    {"a", "b", false},
        {"a*", "a/b", true},     {"*b", "aab", true},   {"*ab", "aab", true},
        {"a?c", "abc", true},    {"a?c", "ac", false},  {"a*b*c", "axxbyybzc", true},
        {"a*b*c", "acb", false}, {"[a]", "[a]", true},  {"[a]", "a", false},
        {"**a", "ba", true},     {"\\*", "\\zz", true}, {"Mesa 22.3.*", "Mesa 22.3.6", true},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        if (rg_glob(rows[i].pattern, rows[i].text) != rows[i].is_one)
            fail_msg("'%s' and '%s'", rows[i].pattern, rows[i].text);
}

// --- judging ---

static const char own[] = "# known\n"
                          "fail streaks/*\n"
                          "  device     vulkan*\n"
                          "  driver     Mesa 22.3.*\n"
                          "  outcome    fail\n"
                          "\n"
                          "  # at the edges\n"
                          "  pixels     10..40\n"
                          "  difference 0.002..0.01\n"
                          "  reason     blends half floats by truncating\n"
                          "  link       https://example.org/1\n"
                          "  since      2026-11-01\n"
                          "  until      2026-12-31\n"
                          "fail raster/crash\n"
                          "\toutcome crash timeout\n"
                          "\treason it crashes\n"
                          "\tsince 2026-11-01\n"
                          "\tuntil 2026-11-30\n"
                          "flake streaks/odd\n"
                          "  reason scheduling\n"
                          "  since 2026-11-01\n"
                          "  until 2026-12-31\n"
                          "flake drops/odd\n"
                          "  outcome timeout\n"
                          "  reason slow\n"
                          "  since 2026-11-01\n"
                          "  until 2026-12-31\n"
                          "skip */slow\n"
                          "  reason takes an hour\n"
                          "  since 2026-11-01\n"
                          "  until 2026-12-31\n";

struct judged {
    struct rg_known_result result;
    const char *today;
    const char *word; // as rg_judged_word gives it
};

static void judge(const struct rg_known *expected, const struct judged *rows, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const struct rg_known_result *r = &rows[i].result;
        const int64_t row =
            rg_known_row(expected, r->cell, r->device, r->driver, day(rows[i].today));
        const enum rg_ending alone = rg_ending_of(r->outcome);
        const struct rg_judged judged = rg_known_judge(expected, row, r, alone, day(rows[i].today));
        const char *word = rg_judged_word(&judged);
        if (strcmp(word, rows[i].word) != 0)
            fail_msg("row %zu: '%s', not '%s'", i, word, rows[i].word);
        const bool fails = strstr("fixed, fails differently, expired", word);
        if (rg_ending_fails(judged.ending) != (*word ? fails : rg_ending_fails(alone)))
            fail_msg("row %zu, %s: ends as %s", i, word, rg_ending_name(judged.ending));
    }
}

#define VK "vulkan@A=b", "Mesa 22.3.6"

static void results_meet_what_is_expected(void **state)
{
    (void)state;
    struct rg_known expected = {.count = 0};
    if (!add(&expected, own, RG_FORM_OWN))
        fail_msg("%s", logged);
    static const struct judged rows[] = {
        {{"streaks/a", VK, RG_FAIL, 10, 0.01, false}, "2026-12-31", "expected"},
        {{"streaks/a", VK, RG_FAIL, 40, 0.002, false}, "2026-12-31", "expected"},
        {{"streaks/a", VK, RG_FAIL, 9, 0.01, false}, "2026-12-31", "fails differently"},
        {{"streaks/a", VK, RG_FAIL, 41, 0.01, false}, "2026-12-31", "fails differently"},
        {{"streaks/a", VK, RG_FAIL, 20, 0.011, false}, "2026-12-31", "fails differently"},
        {{"streaks/a", VK, RG_FAIL, NAN, 0.01, false}, "2026-12-31", "fails differently"},
        {{"streaks/a", VK, RG_CRASH, NAN, NAN, false}, "2026-12-31", "fails differently"},
        {{"streaks/a", VK, RG_OK, 0, 0, false}, "2026-12-31", "fixed"},
        {{"streaks/a", VK, RG_OK, 0, 0, false}, "2027-01-01", "fixed"},
        {{"streaks/a", VK, RG_FAIL, 20, 0.01, false}, "2027-01-01", "expired"},
        {{"streaks/a", VK, RG_UNSUPPORTED, NAN, NAN, false}, "2026-12-31", ""},
        {{"streaks/a", "gl", "Mesa 22.3.6", RG_FAIL, 20, 0.01, false}, "2026-12-31", ""},
        {{"streaks/a", "vulkan", "Mesa 23.0.1", RG_FAIL, 20, 0.01, false}, "2026-12-31", ""},
        {{"raster/crash", "gl", "", RG_TIMEOUT, NAN, NAN, false}, "2026-11-30", "expected"},
        {{"raster/crash", "gl", "", RG_FAIL, 1, 1, false}, "2026-11-30", "fails differently"},
        {{"streaks/odd", VK, RG_FAIL, 99, 9, false}, "2026-12-31", "flaky"},
        {{"streaks/odd", VK, RG_OK, 0, 0, false}, "2026-12-31", "flaky"},
        {{"streaks/odd", VK, RG_OK, 0, 0, false}, "2027-01-01", "expired"},
        {{"drops/odd", "gl", "", RG_TIMEOUT, 0, 0, false}, "2026-12-31", "flaky"},
        {{"drops/odd", "gl", "", RG_CRASH, 0, 0, false}, "2026-12-31", "fails differently"},
        {{"streaks/a", VK, RG_FAIL, 20, 0.01, true}, "2026-12-31", ""},
        {{"streaks/odd", VK, RG_FAIL, 99, 9, true}, "2026-12-31", ""},
        {{"streaks/a", VK, RG_FAIL, 20, 0.01, true}, "2027-01-01", ""},
        {{"streaks/slow", VK, RG_FAIL, 0, 0, false}, "2026-12-31", "skipped"},
        {{"streaks/slow", VK, RG_FAIL, 0, 0, false}, "2027-01-01", "expired"},
        {{"streaks/slow", VK, RG_OK, 0, 0, false}, "2027-01-01", "expired"},
        {{"streaks/slow", VK, RG_UNSUPPORTED, 0, 0, false}, "2026-12-31", "skipped"},
        {{"streaks/slow", VK, RG_UNSUPPORTED, 0, 0, false}, "2027-01-01", ""},
    };
    judge(&expected, rows, sizeof(rows) / sizeof(rows[0]));
    const int64_t slow = rg_known_row(&expected, "a/slow", "gl", "", day("2026-12-31"));
    assert_true(rg_known_skips(&expected, slow, day("2026-12-31")));
    assert_false(rg_known_skips(&expected, slow, day("2027-01-01")));
    assert_false(rg_known_skips(&expected, 0, day("2026-11-23")));
    assert_false(rg_known_skips(&expected, -1, 0));
    rg_known_free(&expected);
}

// --- Mesa's files ---

static void mesas_files_are_read_as_they_are(void **state)
{
    (void)state;
    struct rg_known expected = {.count = 0};
    assert_true(add(&expected,
                    "# fails\r\n\r\nstreaks.a,Fail\r\nstreaks.b [x] y,Crash\r\nstreaks.c,Pass\r\n"
                    "streaks.d,Timeout,1.5\r\nstreaks.s,Fail\r\nstreaks.e,Flake\r\n"
                    "streaks.g,KnownFlake\r\nstreaks.h,ExpectedFail\r\n"
                    "streaks.i,UnexpectedImprovement(Fail)\r\n"
                    "streaks.k,UnexpectedImprovement(Skip)",
                    RG_FORM_FAILS));
    assert_true(add(&expected, "# flakes\n^streaks\\.f\\d+$\nodd.*copy\n", RG_FORM_FLAKES));
    assert_true(add(&expected, "streaks.s\n(?:raster|drops)\\.[a-c]+?$\n", RG_FORM_SKIPS));
    static const struct judged rows[] = {
        {{"streaks.g", VK, RG_CRASH, 0, 0, false}, "2026-11-30", "flaky"},
        {{"streaks.h", VK, RG_FAIL, 0, 0, false}, "2026-11-30", "expected"},
        {{"streaks.i", VK, RG_FAIL, 0, 0, false}, "2026-11-30", "expected"},
        {{"streaks.k", VK, RG_FAIL, 0, 0, false}, "2026-11-30", ""},
        {{"streaks.a", "gl", "", RG_FAIL, 5, 5, false}, "2026-12-31", "expected"},
        {{"streaks.a", "gl", "", RG_ERROR, 5, 5, false}, "2026-12-31", "expected"},
        {{"streaks.a", "gl", "", RG_CRASH, 5, 5, false}, "2026-12-31", "fails differently"},
        {{"streaks.a", "gl", "", RG_OK, 0, 0, false}, "2026-12-31", "fixed"},
        {{"streaks.ab", "gl", "", RG_FAIL, 5, 5, false}, "2026-12-31", ""},
        {{"streaks.b [x] y", "gl", "", RG_CRASH, 5, 5, false}, "9999-12-31", "expected"},
        {{"streaks.c", "gl", "", RG_FAIL, 5, 5, false}, "2026-12-31", ""},
        {{"streaks.d", "gl", "", RG_TIMEOUT, 5, 5, false}, "2026-12-31", "expected"},
        {{"streaks.e", "gl", "", RG_FAIL, 5, 5, false}, "2026-12-31", "flaky"},
        {{"streaks.f12", "gl", "", RG_CRASH, 5, 5, false}, "2026-12-31", "flaky"},
        {{"streaks.f", "gl", "", RG_CRASH, 5, 5, false}, "2026-12-31", ""},
        {{"an odd.copy here", "gl", "", RG_CRASH, 5, 5, false}, "2026-12-31", "flaky"},
        {{"x.streaks.s.y", "gl", "", RG_FAIL, 5, 5, false}, "2026-12-31", "skipped"},
        {{"streaks.s", "gl", "", RG_FAIL, 5, 5, false}, "2026-12-31", "skipped"}, // skip beats fail
        {{"raster.abc", "gl", "", RG_FAIL, 5, 5, false}, "2026-12-31", "skipped"},
        {{"raster.", "gl", "", RG_FAIL, 5, 5, false}, "2026-12-31", ""},
        {{"raster.d", "gl", "", RG_FAIL, 5, 5, false}, "2026-12-31", ""},
    };
    judge(&expected, rows, sizeof(rows) / sizeof(rows[0]));
    rg_known_free(&expected);
}

// Every status that deqp-runner writes; those that are no failure expect nothing.
static void every_status_of_mesas_is_known(void **state)
{
    (void)state;
    static const struct {
        const char *status;
        enum rg_outcome outcome;
        const char *word;
    } rows[] = {
        {"Fail", RG_FAIL, "expected"},
        {"Fail", RG_TIMEOUT, "fails differently"},
        {"Crash", RG_CRASH, "expected"},
        {"Crash", RG_FAIL, "fails differently"},
        {"Timeout", RG_TIMEOUT, "expected"},
        {"Timeout", RG_ERROR, "fails differently"},
        {"ExpectedFail", RG_ERROR, "expected"},
        {"ExpectedFail", RG_CRASH, "fails differently"},
        {"UnexpectedImprovement(Fail)", RG_ERROR, "expected"},
        {"Flake", RG_CRASH, "flaky"},
        {"Flake", RG_OK, "flaky"},
        {"KnownFlake", RG_TIMEOUT, "flaky"},
        {"KnownFlake", RG_ERROR, "flaky"},
        {"UnexpectedImprovement(Pass)", RG_FAIL, ""},
        {"UnexpectedImprovement(Skip)", RG_FAIL, ""},
        {"Pass", RG_FAIL, ""},
        {"Warn", RG_FAIL, ""},
        {"Skip", RG_FAIL, ""},
        {"Missing", RG_FAIL, ""},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_known expected = {.count = 0};
        char text[80];
        snprintf(text, sizeof(text), "a,%s\n", rows[i].status);
        assert_true(add(&expected, text, RG_FORM_FAILS));
        const struct judged judged = {
            {"a", "gl", "M", rows[i].outcome, NAN, NAN, false}, "2026-11-30", rows[i].word};
        judge(&expected, &judged, 1);
        rg_known_free(&expected);
    }
}

// --- errors in files ---

#define REST "\n reason r\n since 2026-01-01\n until 2026-02-01\n"

static void what_is_wrong_is_said_with_its_line(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        enum rg_known_form form;
        const char *said;
    } rows[] = {
        {"fial a" REST, RG_FORM_OWN, "my.txt:1: 'fial': write fail, flake or skip"},
        {"\n device gl", RG_FORM_OWN, "my.txt:2: a field of nothing"},
        {"skip" REST, RG_FORM_OWN, "my.txt:1: 'skip' has no pattern"},
        {"skip a b" REST, RG_FORM_OWN, "my.txt:1: 'skip' has more than one word"},
        {"skip a\n devic gl" REST, RG_FORM_OWN, "my.txt:2: field 'devic': unknown"},
        {"skip a\n device gl\n device vk" REST, RG_FORM_OWN,
         "my.txt:3: field 'device' stands twice"},
        {"skip a\n device" REST, RG_FORM_OWN, "my.txt:2: field 'device' has no value"},
        {"fail a\n outcome ok" REST, RG_FORM_OWN, "my.txt:2: outcome 'ok'"},
        {"fail a\n outcome fail\n pixels 3..2" REST, RG_FORM_OWN, "my.txt:3: pixels '3..2'"},
        {"fail a\n outcome fail\n pixels -1" REST, RG_FORM_OWN, "my.txt:3: pixels '-1'"},
        {"fail a\n outcome crash error\n pixels 1" REST, RG_FORM_OWN, "my.txt:3: 'pixels' is of"},
        {"flake a\n difference 1\n outcome timeout" REST, RG_FORM_OWN,
         "my.txt:2: 'difference' is of outcome fail alone"},
        {"fail a\n outcome fail\n pixels 0x10" REST, RG_FORM_OWN, "my.txt:3: pixels '0x10'"},
        {"fail a\n outcome fail\n pixels 1.. 2" REST, RG_FORM_OWN, "my.txt:3: pixels '1.. 2'"},
        {"fail a\n outcome fail\n difference nan" REST, RG_FORM_OWN, "my.txt:3: difference 'nan'"},
        {"fail a\n outcome fail\n pixels 1..2x" REST, RG_FORM_OWN, "my.txt:3: pixels '1..2x'"},
        {"#\nfail a" REST, RG_FORM_OWN, "my.txt:2: fail a: no field 'outcome'"},
        {"skip a\n since 2026-01-01\n until 2026-02-01", RG_FORM_OWN,
         "my.txt:1: skip a: no field 'reason'"},
        {"skip a\n reason r\n since 2026-01-01", RG_FORM_OWN, "my.txt:1: skip a: no field 'until'"},
        {"skip a\n since 2026-02-30" REST, RG_FORM_OWN, "my.txt:2: since '2026-02-30': no day"},
        {"skip a\n reason r\n since 2026-02-02\n until 2026-02-01", RG_FORM_OWN,
         "my.txt:1: skip a: it ends"},
        {"skip a" REST "skip b\x7f" REST, RG_FORM_OWN,
         "my.txt:5: control character 0x7f in column 7"},
        {"a", RG_FORM_FAILS, "my.txt:1: 'a': write TEST,Fail"},
        {",Fail", RG_FORM_FAILS, "my.txt:1: ',Fail': write TEST,Fail"},
        {"\na,Broken", RG_FORM_FAILS, "my.txt:2: status 'Broken'"},
        {"a\n(?=a)", RG_FORM_SKIPS, "my.txt:2: regular expression: this group at '(?=a)'"},
        {"a\n(a", RG_FORM_FLAKES, "my.txt:2: regular expression '(a': missing closing"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_known expected = {.count = 0};
        const bool ok = add(&expected, rows[i].text, rows[i].form);
        if (ok || expected.file_count || expected.count || logged_lines != 1 ||
            strncmp(logged, rows[i].said, strlen(rows[i].said)) != 0)
            fail_msg("row %zu said: %s", i, logged);
        rg_known_free(&expected);
    }
}

static void an_empty_file_expects_nothing(void **state)
{
    (void)state;
    struct rg_known expected = {.count = 0};
    for (int form = RG_FORM_OWN; form <= RG_FORM_SKIPS; form++)
        assert_true(add(&expected, form % 2 ? "" : "\n\r\n# nothing", (enum rg_known_form)form));
    assert_int_equal(expected.file_count, 4);
    assert_int_equal(rg_known_row(&expected, "a", "", "", 0), -1);
    rg_known_free(&expected);
    for (int i = 0; i < 16; i++)
        assert_true(add(&expected, "", RG_FORM_OWN));
    assert_false(add(&expected, "", RG_FORM_OWN));
    assert_non_null(strstr(logged, "my.txt: more than 16 files"));
    rg_known_free(&expected);
    assert_false(rg_known_add(&expected, "/nowhere/x.txt", RG_FORM_OWN));
    assert_non_null(strstr(logged, "/nowhere/x.txt: No such file"));
}

// 100,000 lines, each with a name of its own, and names of 10 kB with as many stars.
static void large_files_are_read(void **state)
{
    (void)state;
    char *text = NULL, name[10241];
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    for (int i = 0; i < 100000; i++)
        fprintf(out, "streaks/cell-%d,Fail\n", i);
    for (size_t i = 0; i + 1 < sizeof(name); i += 2) {
        name[i] = 'n';
        name[i + 1] = '*';
    }
    name[sizeof(name) - 1] = 0;
    fprintf(out, "%s,Crash\n", name);
    fclose(out);
    struct rg_known expected = {.count = 0};
    assert_true(rg_known_add_text(&expected, "many.txt", text, size, RG_FORM_FAILS));
    assert_int_equal(expected.count, 100001);
    assert_int_equal(rg_known_row(&expected, "streaks/cell-99999", "", "", 0), 99999);
    assert_int_equal(rg_known_row(&expected, name, "", "", 0), 100000);
    assert_int_equal(rg_known_row(&expected, "streaks/cell-100000", "", "", 0), -1);
    rg_known_free(&expected);
    free(text);
    assert_true(rg_glob(name, name));
    name[sizeof(name) - 2] = 'x';
    assert_false(rg_glob(name, "nnnnnnnnnnnnnnnnnnnnnnnn"));
}

// Two cells, and files whose patterns match one, both or none.
static void an_expectation_of_no_cell_is_told(void **state)
{
    (void)state;
    static const char cells_text[] = "streaks/rain raster 8x8 1\nflow/pane raster 8x8 1\n";
    static const struct {
        const char *text;
        enum rg_known_form form;
        int unused;
        const char *said;
    } rows[] = {
        {"skip streaks/rain" REST "skip *" REST "skip flow/?ane" REST, RG_FORM_OWN, 0, ""},
        {"skip streaks/rian" REST, RG_FORM_OWN, 1, "my.txt:1: 'streaks/rian' is of no cell"},
        {"skip *" REST "skip a" REST "skip b*" REST "skip c" REST, RG_FORM_OWN, 3,
         "my.txt:5: 'a' is of no cell of this gate, and 2 more"},
        {"streaks/rian,Fail", RG_FORM_FAILS, 0, ""},
        {"streaks/rian", RG_FORM_SKIPS, 0, ""},
    };
    struct rg_gate_cells cells;
    assert_true(rg_gate_cells_of("cells.txt", cells_text, strlen(cells_text), &cells));
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_known expected = {.count = 0};
        assert_true(add(&expected, "skip flow/*" REST, RG_FORM_OWN));
        assert_true(add(&expected, rows[i].text, rows[i].form));
        assert_int_equal(rg_gate_warn_of_unused(&expected, &cells), rows[i].unused);
        assert_int_equal(logged_lines, rows[i].unused > 0);
        if (rows[i].unused)
            assert_non_null(strstr(logged, "; mend the pattern, or take the expectation out"));
        if (strncmp(logged, rows[i].said, strlen(rows[i].said)) != 0)
            fail_msg("row %zu said: %s", i, logged);
        rg_known_free(&expected);
    }
    rg_gate_cells_free(&cells);
}

// A day in the future, one more than a year ahead, and both, in files of either form.
static void an_expectation_of_a_far_day_is_told(void **state)
{
    (void)state;
#define DAYS(since, until) "flake *\n reason r\n since " since "\n until " until "\n"
    static const struct {
        const char *text, *said;
        int64_t count;
    } rows[] = {
        {DAYS("2026-11-23", "2027-11-24"), "", 0},
        {DAYS("2026-11-24", "2027-01-01"), "my.txt:3: since 2026-11-24: is to come", 1},
        {DAYS("2026-11-01", "9999-12-31"), "my.txt:4: until 9999-12-31: is more than a year", 1},
        {DAYS("2026-11-01", "2027-11-25") DAYS("2026-11-01", "2027-11-26"),
         "my.txt:4: until 2027-11-25: is more than a year", 2},
        {DAYS("2026-11-24", "9999-12-31"), "my.txt:4: until 9999-12-31", 2},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_known expected = {.count = 0};
        assert_true(add(&expected, rows[i].text, RG_FORM_OWN));
        assert_true(add(&expected, "a,Fail", RG_FORM_FAILS));
        assert_int_equal(rg_gate_warn_of_days(&expected, day("2026-11-23")), rows[i].count);
        if (strncmp(logged, rows[i].said, strlen(rows[i].said)) != 0)
            fail_msg("row %zu said: %s", i, logged);
        rg_known_free(&expected);
    }
}

// An expectation whose first day is in the future expects nothing yet.
static void an_expectation_to_come_does_not_hold_yet(void **state)
{
    (void)state;
    struct rg_known expected = {.count = 0};
    assert_true(
        add(&expected, "skip *\n reason r\n since 2026-11-24\n until 2026-12-01\n", RG_FORM_OWN));
    assert_int_equal(rg_known_row(&expected, "a", "gl", "", day("2026-11-23")), -1);
    assert_int_equal(rg_known_row(&expected, "a", "gl", "", day("2026-11-24")), 0);
    rg_known_free(&expected);
}

#define DRIVER "skip *\n device vulkan*\n driver "
#define VALUES "\n reason r\n since 2026-01-01\n until 2026-02-01\n"

// Three devices, one of them missing.
static void an_expectation_of_no_device_or_driver_is_told(void **state)
{
    (void)state;
    static const char cells_text[] = "streaks/rain raster 8x8 1\n";
    static const struct rg_gate_target targets[] = {
        {"vulkan@A=b", "llvmpipe Mesa 22.3.6 (LLVM)"}, {"gl", "Mesa 23.0"}, {"opencl", NULL}};
    static const struct {
        const char *text;
        enum rg_known_form form;
        int unused;
        const char *said;
    } rows[] = {
        {"skip *" REST "skip *\n device gl" REST DRIVER "*Mesa 22.3.*" VALUES, RG_FORM_OWN, 0, ""},
        {DRIVER "Mesa 22.3.*" VALUES, RG_FORM_OWN, 1, "my.txt:1: 'Mesa 22.3.*' is of no driver"},
        {"skip *" REST DRIVER "*Mesa 23*" VALUES, RG_FORM_OWN, 1, "my.txt:5: '*Mesa 23*' is of no"},
        {"skip *\n device vulkan" REST DRIVER "x" VALUES, RG_FORM_OWN, 2,
         "my.txt:1: 'vulkan' is of no device of this gate, and 1 more"},
        {"skip *\n device cpu\n driver x" REST, RG_FORM_OWN, 1, "my.txt:1: 'cpu' is of no device"},
        {"skip *\n device opencl\n driver x" REST, RG_FORM_OWN, 0, ""}, // its driver is unknown
        {"skip a\n device cpu" REST, RG_FORM_OWN, 0, ""},               // reported with the cells
        {"streaks/rian,Fail", RG_FORM_FAILS, 0, ""},
    };
    struct rg_gate_cells cells;
    assert_true(rg_gate_cells_of("cells.txt", cells_text, strlen(cells_text), &cells));
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_known expected = {.count = 0};
        assert_true(add(&expected, rows[i].text, rows[i].form));
        assert_int_equal(rg_gate_warn_of_unused_on(&expected, &cells, targets, 3), rows[i].unused);
        assert_int_equal(logged_lines, rows[i].unused > 0);
        if (strncmp(logged, rows[i].said, strlen(rows[i].said)) != 0)
            fail_msg("row %zu said: %s", i, logged);
        rg_known_free(&expected);
    }
    rg_gate_cells_free(&cells);
}

int main(void)
{
    rg_log_listen(log_last, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(days_are_those_of_the_calendar),
        cmocka_unit_test(patterns_describe_whole_names),
        cmocka_unit_test(results_meet_what_is_expected),
        cmocka_unit_test(mesas_files_are_read_as_they_are),
        cmocka_unit_test(every_status_of_mesas_is_known),
        cmocka_unit_test(what_is_wrong_is_said_with_its_line),
        cmocka_unit_test(an_empty_file_expects_nothing),
        cmocka_unit_test(large_files_are_read),
        cmocka_unit_test(an_expectation_of_no_cell_is_told),
        cmocka_unit_test(an_expectation_of_a_far_day_is_told),
        cmocka_unit_test(an_expectation_to_come_does_not_hold_yet),
        cmocka_unit_test(an_expectation_of_no_device_or_driver_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
