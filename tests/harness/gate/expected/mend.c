// A mended file of expectations is true: it expects the results that it was mended by.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <math.h>

#include "harness/compare/gate/expected/expected.h"
#include "harness/compare/gate/text/date.h"

static int day(const char *text)
{
    int number;
    assert_true(rg_date_read(text, &number));
    return number;
}

// The mended text, which the caller frees; a copy if nothing changes.
static char *mended(const char *text, enum rg_known_form form,
                    const struct rg_known_result *results, int64_t count, const char *today)
{
    struct rg_known known = {.count = 0};
    char *now, *again;
    assert_true(rg_known_add_text(&known, "my.txt", text, strlen(text), form));
    assert_true(rg_known_mend(&known, 0, results, count, day(today), true, &now));
    rg_known_free(&known);
    if (!now)
        return strdup(text);
    // It is true: mending it again changes nothing.
    assert_string_not_equal(now, text);
    assert_true(rg_known_add_text(&known, "my.txt", now, strlen(now), form));
    assert_true(rg_known_mend(&known, 0, results, count, day(today), true, &again));
    assert_null(again);
    rg_known_free(&known);
    return now;
}

static void expect(const char *text, enum rg_known_form form, const struct rg_known_result *results,
                   int64_t count, const char *today, const char *wanted)
{
    char *now = mended(text, form, results, count, today);
    assert_string_equal(now, wanted);
    free(now);
}

#define ROW(pattern, pixels, until)                                                                \
    "fail " pattern "\n  outcome fail\n  pixels " pixels "\n  # why\n  reason r\n  since "         \
    "2026-01-01\n  until " until "\n"

static void what_is_true_stays(void **state)
{
    (void)state;
    static const struct rg_known_result results[] = {
        {"a", "gl", "M", RG_FAIL, 15, 1, false},
        {"b", "gl", "M", RG_OK, 0, 0, false},
        {"c", "gl", "M", RG_UNSUPPORTED, NAN, NAN, false}};
    static const char text[] = ROW("a", "10..20", "2026-02-01");
    expect(text, RG_FORM_OWN, results, 3, "2026-02-01", text);
}

// Another side failed, not the device that the file would blame.
static void what_fails_elsewhere_stands_in_no_file(void **state)
{
    (void)state;
    static const struct rg_known_result results[] = {{"a", "gl", "M", RG_CRASH, NAN, NAN, true},
                                                     {"b", "gl", "M", RG_FAIL, 1, 1, false},
                                                     {"c", "gl", "M", RG_CRASH, NAN, NAN, true}};
    expect("", RG_FORM_OWN, results, 1, "2026-01-15", "");
    expect("", RG_FORM_FAILS, results, 1, "2026-01-15", "");
    expect("fail [abc]\n  outcome fail\n  reason r\n  since 2026-01-01\n  until 2026-02-01\n",
           RG_FORM_OWN, results, 1, "2026-01-15",
           "fail [abc]\n  outcome fail\n  reason r\n  since 2026-01-01\n  until 2026-02-01\n");
    // A row gets this device's new outcome; another side's failure adds nothing and removes
    // nothing.
    expect("fail *\n  outcome timeout\n  reason r\n  since 2026-01-01\n  until 2026-02-01\n",
           RG_FORM_OWN, results, 3, "2026-01-15",
           "fail *\n  outcome    fail timeout\n  reason r\n  since 2026-01-01\n"
           "  until 2026-02-01\n");
    expect("fail *\n  outcome timeout\n  reason r\n  since 2026-01-01\n  until 2026-02-01\n",
           RG_FORM_OWN, results + 1, 1, "2026-01-15",
           "fail *\n  outcome    fail\n  reason r\n  since 2026-01-01\n  until 2026-02-01\n");
}

static void what_is_fixed_goes(void **state)
{
    (void)state;
    static const struct rg_known_result results[] = {{"b", "gl", "M", RG_OK, 0, 0, false}};
    expect("# head\n" ROW("a", "1", "2026-02-01") "\n" ROW("b", "2", "2026-02-01") "\n" ROW(
               "c", "3", "2026-02-01"),
           RG_FORM_OWN, results, 1, "2026-01-15",
           "# head\n" ROW("a", "1", "2026-02-01") "\n" ROW("c", "3", "2026-02-01"));
    expect(ROW("b", "2", "2026-02-01"), RG_FORM_OWN, results, 1, "2027-01-15", "");
    // It goes from all rows that expect it; a pattern that also expects other cells loses only the
    // fixed one.
    expect(ROW("b", "2", "2026-02-01") ROW("[b]", "1", "2026-02-01") ROW("b*", "2", "2026-02-01"),
           RG_FORM_OWN, results, 1, "2026-01-15", ROW("[b]", "1", "2026-02-01"));
    expect("b,Fail\nc,Fail\nb,Crash\n", RG_FORM_FAILS, results, 1, "2026-01-15", "c,Fail\n");
    static const struct rg_known_result both[] = {{"b", "gl", "M", RG_OK, 0, 0, false},
                                                  {"b2", "gl", "M", RG_FAIL, 2, 1, false}};
    expect(ROW("b", "2", "2026-02-01") ROW("b*", "2", "2026-02-01"), RG_FORM_OWN, both, 2,
           "2026-01-15",
           "fail b2\n  device     gl\n  outcome    fail\n  pixels     2\n  reason     r\n"
           "  since      2026-01-01\n  until      2026-02-01\n");
}

static void what_fails_otherwise_gets_the_new_evidence(void **state)
{
    (void)state;
    static const struct rg_known_result results[] = {{"a1", "gl", "M", RG_FAIL, 25, 1, false},
                                                     {"a2", "gl", "M", RG_FAIL, 5, 1, false}};
    expect(ROW("a*", "10..20", "2026-02-01"), RG_FORM_OWN, results, 1, "2026-01-15",
           "fail a*\n  outcome fail\n  pixels     10..25\n  # why\n  reason r\n  since "
           "2026-01-01\n  until 2026-02-01\n");
    expect(ROW("a*", "10..20", "2026-02-01"), RG_FORM_OWN, results, 2, "2026-01-15",
           "fail a*\n  outcome fail\n  pixels     5..25\n  # why\n  reason r\n  since "
           "2026-01-01\n  until 2026-02-01\n");
    expect(ROW("a*", "10..20", "2026-02-01"), RG_FORM_OWN, results + 1, 1, "2026-01-15",
           "fail a*\n  outcome fail\n  pixels     5..20\n  # why\n  reason r\n  since "
           "2026-01-01\n  until 2026-02-01\n");
    static const struct rg_known_result crashes[] = {{"a1", "gl", "M", RG_CRASH, NAN, NAN, false}};
    expect(ROW("a*", "10..20", "2026-02-01"), RG_FORM_OWN, crashes, 1, "2026-01-15",
           "fail a*\n  outcome    crash\n  # why\n  reason r\n  since "
           "2026-01-01\n  until 2026-02-01\n");
}

static void what_has_expired_gets_ninety_days(void **state)
{
    (void)state;
    static const struct rg_known_result results[] = {{"a", "gl", "M", RG_FAIL, 15, 1, false}};
    expect(ROW("a", "10..20", "2026-02-01"), RG_FORM_OWN, results, 1, "2026-02-02",
           "fail a\n  outcome fail\n  pixels 10..20\n  # why\n  reason r\n  since 2026-01-01\n"
           "  until      2026-05-03\n");
    static const char rest[] = "skip a\n  reason r\n  since 2026-01-01\n  until 2026-02-01\n";
    expect(rest, RG_FORM_OWN, results, 0, "2026-02-02", rest); // without a result nothing is known
    static const struct rg_known_result passes[] = {{"a", "gl", "M", RG_OK, 0, 0, false}};
    expect(rest, RG_FORM_OWN, passes, 1, "2026-02-02", "");
    expect("flake a\n  reason r\n  since 2026-01-01\n  until 2026-02-01", RG_FORM_OWN, passes, 1,
           "2026-02-02", "");
}

// One cell of a pattern passes: those that still fail each get a row.
static void a_pattern_that_is_fixed_in_part_is_split(void **state)
{
    (void)state;
    static const struct rg_known_result results[] = {
        {"a1", "gl", "M 1", RG_FAIL, 15, 1, false},
        {"a2", "gl", "M 1", RG_OK, 0, 0, false},
        {"a3", "vulkan", "M 1", RG_FAIL, 35, 1, false}};
    expect("#\n\n" ROW("a*", "10..20", "2026-02-01"), RG_FORM_OWN, results, 3, "2026-01-15",
           "#\n\nfail a1\n  device     gl\n  outcome    fail\n  pixels     10..20\n  reason     "
           "r\n  since      2026-01-01\n  until      2026-02-01\n"
           "\nfail a3\n  device     vulkan\n  outcome    fail\n  pixels     10..35\n  reason     "
           "r\n  since      2026-01-01\n  until      2026-02-01\n");
}

#define APART(cell, device, driver, pixels)                                                        \
    "fail " cell "\n  device     " device "\n" driver "  outcome    fail\n  pixels     " pixels    \
    "\n  reason     r\n  since      2026-01-01\n  until      2026-02-01\n"

// Unsupported, failed by another side, or of a device that is missing or was not asked for.
static void what_nothing_is_known_of_stays_expected(void **state)
{
    (void)state;
    static const struct rg_known_result results[] = {
        {"a1", "gl", "M 1", RG_OK, 0, 0, false},
        {"a2", "gl", "M 1", RG_UNSUPPORTED, NAN, NAN, false},
        {"a3", "gl", "M 1", RG_CRASH, NAN, NAN, true},
        {"a1", "vulkan", NULL, RG_UNSUPPORTED, NAN, NAN, false},
        {"a4", "gl", "M 1", RG_FAIL, 25, 1, false},
        {"b", "gl", "M 1", RG_OK, 0, 0, false}};
    expect(ROW("a*", "10..20", "2026-02-01"), RG_FORM_OWN, results, 6, "2026-01-15",
           APART("a2", "gl", "", "10..20") "\n" APART("a3", "gl", "", "10..20") "\n" APART(
               "a1", "vulkan", "", "10..20") "\n" APART("a4", "gl", "", "10..25"));
    // The same holds if no known cell fails any more.
    expect(ROW("a*", "10..20", "2026-02-01"), RG_FORM_OWN, results, 2, "2026-01-15",
           APART("a2", "gl", "", "10..20"));
    expect(ROW("a1", "10..20", "2026-02-01"), RG_FORM_OWN, results, 4, "2026-01-15",
           APART("a1", "vulkan", "", "10..20"));
    // No other cell has the name, so the row goes.
    expect(ROW("b", "10..20", "2026-02-01"), RG_FORM_OWN, results + 5, 1, "2026-01-15", "");
    // A device that did not tell its driver may have any.
    expect("fail a*\n  driver M*\n  outcome fail\n  reason r\n  since 2026-01-01\n"
           "  until 2026-02-01\n",
           RG_FORM_OWN, results, 4, "2026-01-15",
           "fail a2\n  device     gl\n  driver     M*\n  outcome    fail\n  reason     r\n"
           "  since      2026-01-01\n  until      2026-02-01\n\n"
           "fail a3\n  device     gl\n  driver     M*\n  outcome    fail\n  reason     r\n"
           "  since      2026-01-01\n  until      2026-02-01\n\n"
           "fail a1\n  device     vulkan\n  driver     M*\n  outcome    fail\n  reason     r\n"
           "  since      2026-01-01\n  until      2026-02-01\n");
}

// The same for expired quarantine, and for Mesa's lines, which name no device.
static void other_rows_keep_what_nothing_is_known_of(void **state)
{
    (void)state;
    static const struct rg_known_result results[] = {
        {"a1", "gl", "M 1", RG_OK, 0, 0, false},
        {"a1", "vulkan", NULL, RG_UNSUPPORTED, NAN, NAN, false},
        {"a2", "gl", "M 1", RG_CRASH, 0, 0, false},
        {"a2", "vulkan", NULL, RG_UNSUPPORTED, NAN, NAN, false}};
    expect("flake a1\n  reason r\n  since 2026-01-01\n  until 2026-02-01\n", RG_FORM_OWN, results,
           2, "2026-02-02",
           "flake a1\n  device     vulkan\n  reason     r\n  since      2026-01-01\n"
           "  until      2026-02-01\n");
    // It is unknown which of the two drivers the device has.
    static const char *const rows[] = {"fail a1\n  device g*\n  outcome fail\n  reason r\n",
                                       "fail a1\n  driver M 1\n  outcome fail\n  reason r\n",
                                       "fail a1\n  driver M 2\n  outcome fail\n  reason r\n"};
    char text[1024] = "";
    for (int i = 0; i < 3; i++)
        snprintf(text + strlen(text), sizeof(text) - strlen(text),
                 "%s  since 2026-01-01\n  until 2026-02-01\n", rows[i]);
    expect(text, RG_FORM_OWN, results, 2, "2026-01-15",
           "fail a1\n  device     vulkan\n  driver     M 1\n  outcome    fail\n  reason     r\n"
           "  since      2026-01-01\n  until      2026-02-01\n"
           "fail a1\n  driver M 2\n  outcome fail\n  reason r\n  since 2026-01-01\n"
           "  until 2026-02-01\n");
    expect("a1,Fail\na2,Timeout\n", RG_FORM_FAILS, results, 4, "2026-01-15",
           "a1,Fail\na2,Timeout\n");
}

#define NEW(cell, rest)                                                                            \
    "fail " cell "\n  device     gl\n  driver     M\n" rest "  reason     not explained\n"         \
    "  since      2026-01-15\n  until      2026-04-15\n"

static void what_is_new_is_added(void **state)
{
    (void)state;
    static const struct rg_known_result results[] = {{"a", "gl", "M", RG_FAIL, 15, 0.25, false},
                                                     {"b", "gl", "M", RG_CRASH, NAN, NAN, false}};
    static const char added[] =
        NEW("a", "  outcome    fail\n  pixels     15\n  difference 0.25\n") "\n" NEW(
            "b", "  outcome    crash\n");
    expect("", RG_FORM_OWN, results, 2, "2026-01-15", added);
    char text[4096];
    snprintf(text, sizeof(text), "# head\n\n%s", added);
    expect("# head", RG_FORM_OWN, results, 2, "2026-01-15", text); // the last line gets its end
    // A last line that stays, without new lines after it, keeps its missing end.
    expect("a,Fail\nb,Crash", RG_FORM_FAILS, results, 2, "2026-01-15", "a,Fail\nb,Crash");
    expect("c,Fail\nb,Crash", RG_FORM_FAILS, results + 1, 1, "2026-01-15", "c,Fail\nb,Crash");
    expect("c,Fail\na,Fail", RG_FORM_FAILS, results, 2, "2026-01-15", "c,Fail\na,Fail\nb,Crash\n");
    // The last row goes, and new ones replace it.
    static const struct rg_known_result both[] = {{"c", "gl", "M", RG_OK, 0, 0, false},
                                                  {"b", "gl", "M", RG_CRASH, NAN, NAN, false}};
    expect(ROW("c", "1", "2026-02-01"), RG_FORM_OWN, both, 2, "2026-01-15",
           NEW("b", "  outcome    crash\n"));
}

// A driver that fell before it told its name stands in no row.
static void what_is_not_known_of_a_driver_is_not_written(void **state)
{
    (void)state;
    static const struct rg_known_result results[] = {{"a", "gl", "", RG_FAIL, NAN, 0.5, false},
                                                     {"b", "gl", NULL, RG_TIMEOUT, 1, 1, false}};
    expect("", RG_FORM_OWN, results, 2, "2026-01-15",
           "fail a\n  device     gl\n  outcome    fail\n  difference 0.5\n  reason     not "
           "explained\n  since      2026-01-15\n  until      2026-04-15\n\n"
           "fail b\n  device     gl\n  outcome    timeout\n  reason     not explained\n"
           "  since      2026-01-15\n  until      2026-04-15\n");
    // Letters beyond ASCII stay, and control characters do not.
    static const struct rg_known_result foreign[] = {
        {"stra\303\237e\x01", "gl", "Ger\303\244t", RG_TIMEOUT, 1, 1, false}};
    expect("", RG_FORM_OWN, foreign, 1, "2026-01-15",
           "fail stra\303\237e?\n  device     gl\n  driver     Ger\303\244t\n  outcome    "
           "timeout\n  reason     not explained\n  since      2026-01-15\n  until      "
           "2026-04-15\n");
    // Names that Mesa's form would read as something else.
    static const struct rg_known_result odd[] = {{"#a", "gl", "M", RG_FAIL, 1, 1, false},
                                                 {"b\x7f", "gl", "M", RG_FAIL, 1, 1, false},
                                                 {"c\n", "gl", "M", RG_FAIL, 1, 1, false},
                                                 {"", "gl", "M", RG_FAIL, 1, 1, false},
                                                 {"d#", "gl", "M", RG_CRASH, 1, 1, false}};
    expect("", RG_FORM_FAILS, odd, 5, "2026-01-15", "d#,Crash\n");
}

#define FLAKE(rest) "flake a*\n" rest "  reason r\n  since 2026-01-01\n  until 2026-02-01\n"

// A flake keeps the outcomes that it had; only a failure has pixels.
static void a_flake_gains_outcomes_and_loses_none(void **state)
{
    (void)state;
    static const struct rg_known_result results[] = {{"a1", "gl", "M", RG_CRASH, NAN, NAN, false},
                                                     {"a2", "gl", "M", RG_FAIL, 7, 0.5, false}};
    expect(FLAKE("  outcome timeout\n"), RG_FORM_OWN, results, 1, "2026-01-15",
           FLAKE("  outcome    crash timeout\n"));
    expect(FLAKE("  outcome fail\n  difference 0.25..1\n  pixels 9\n"), RG_FORM_OWN, results, 2,
           "2026-01-15",
           FLAKE("  outcome    fail crash\n  difference 0.25..1\n  pixels     7..9\n"));
    expect("fail a*\n  outcome fail\n  difference 1..2\n  reason r\n  since 2026-01-01\n"
           "  until 2026-02-01\n",
           RG_FORM_OWN, results + 1, 1, "2026-01-15",
           "fail a*\n  outcome fail\n  difference 0.5..2\n  reason r\n  since 2026-01-01\n"
           "  until 2026-02-01\n");
}

// Of two files each has its own rows; what is new is added only where that is asked for.
static void each_file_is_mended_by_itself(void **state)
{
    (void)state;
    static const struct rg_known_result results[] = {{"a", "gl", "M", RG_OK, 0, 0, false},
                                                     {"b", "gl", "M", RG_OK, 0, 0, false},
                                                     {"c", "gl", "M", RG_CRASH, 0, 0, false}};
    static const char first[] = "a,Fail\nx,Fail\n", second[] = "y,Fail\nb,Fail\nz,Crash\n";
    struct rg_known known = {.count = 0};
    char *now;
    assert_true(rg_known_add_text(&known, "1", first, strlen(first), RG_FORM_FAILS));
    assert_true(rg_known_add_text(&known, "2", second, strlen(second), RG_FORM_FAILS));
    assert_true(rg_known_mend(&known, 1, results, 3, 20500, false, &now));
    assert_string_equal(now, "y,Fail\nz,Crash\n");
    free(now);
    assert_true(rg_known_mend(&known, 0, results, 3, 20500, true, &now));
    assert_string_equal(now, "x,Fail\nc,Crash\n");
    free(now);
    assert_true(rg_known_mend(&known, 0, results + 2, 1, 20500, false, &now));
    assert_null(now);
    rg_known_free(&known);
}

// Rows far apart are mended, and lines keep their endings.
static void long_files_and_foreign_line_ends_are_kept(void **state)
{
    (void)state;
    static const struct rg_known_result results[] = {{"t.0", "gl", "M", RG_OK, 0, 0, false},
                                                     {"t.7", "gl", "M", RG_CRASH, 0, 0, false},
                                                     {"t.14", "gl", "M", RG_FAIL, 5, 0, false},
                                                     {"t.20", "gl", "M", RG_OK, 0, 0, false},
                                                     {"t.39", "gl", "M", RG_TIMEOUT, 0, 0, false},
                                                     {"new,comma", "gl", "M", RG_FAIL, 0, 0, false},
                                                     {"new", "gl", "M", RG_ERROR, 0, 0, false}};
    char text[4096] = "", wanted[4096] = "";
    for (int i = 0; i < 40; i++) {
        char line[64];
        snprintf(line, sizeof(line), "t.%d,Fail%s", i, i < 39 ? "\r\n" : "");
        strcat(text, line);
        snprintf(line, sizeof(line), "t.%d,%s\r\n", i,
                 i == 7    ? "Crash"
                 : i == 39 ? "Timeout"
                           : "Fail");
        if (i != 0 && i != 20)
            strcat(wanted, line);
    }
    strcat(wanted, "new,Fail\r\n");
    char *now = mended(text, RG_FORM_FAILS, results, 7, "1970-01-01");
    assert_string_equal(now, wanted);
    free(now);
    struct rg_known known = {.count = 0};
    assert_true(rg_known_add_text(&known, "my.txt", "t\n", 2, RG_FORM_SKIPS));
    assert_true(rg_known_mend(&known, 0, results, 7, 0, true, &now));
    assert_null(now);
    rg_known_free(&known);
}

// Names of 10 kB, with blanks and control characters, become patterns that match them.
static void hostile_names_are_matched_by_what_is_written(void **state)
{
    (void)state;
    char cell[10241];
    memset(cell, 'n', sizeof(cell) - 1);
    memcpy(cell, "a b\n<\"'&\x01\t\x7f", 11);
    cell[sizeof(cell) - 1] = 0;
    const struct rg_known_result results[] = {{cell, "d\nreason x", "", RG_FAIL, 1, NAN, false}};
    char *text = mended("", RG_FORM_OWN, results, 1, "2026-01-15");
    struct rg_known known = {.count = 0};
    assert_true(rg_known_add_text(&known, "my.txt", text, strlen(text), RG_FORM_OWN));
    assert_int_equal(rg_known_row(&known, cell, "d\nreason x", "Any", 20500), 0);
    assert_int_equal(rg_known_row(&known, cell, "e", "", 20500), -1);
    rg_known_free(&known);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_true_stays),
        cmocka_unit_test(what_fails_elsewhere_stands_in_no_file),
        cmocka_unit_test(what_is_fixed_goes),
        cmocka_unit_test(what_fails_otherwise_gets_the_new_evidence),
        cmocka_unit_test(what_has_expired_gets_ninety_days),
        cmocka_unit_test(a_pattern_that_is_fixed_in_part_is_split),
        cmocka_unit_test(what_nothing_is_known_of_stays_expected),
        cmocka_unit_test(other_rows_keep_what_nothing_is_known_of),
        cmocka_unit_test(what_is_new_is_added),
        cmocka_unit_test(what_is_not_known_of_a_driver_is_not_written),
        cmocka_unit_test(a_flake_gains_outcomes_and_loses_none),
        cmocka_unit_test(each_file_is_mended_by_itself),
        cmocka_unit_test(long_files_and_foreign_line_ends_are_kept),
        cmocka_unit_test(hostile_names_are_matched_by_what_is_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
