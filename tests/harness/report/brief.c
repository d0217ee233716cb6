// The page in short, from records that are made up: how claims stand, on one machine or several,
// what fails, and the badge.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/report/page.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

// The JSON of a text with single quotation marks; the caller owns it.
static json_t *json_of(const char *text)
{
    char copy[4096];
    snprintf(copy, sizeof(copy), "%s", text);
    for (char *c = copy; *c; c++)
        *c = *c == '\'' ? '"' : *c;
    json_error_t error;
    json_t *json = json_loads(copy, 0, &error);
    if (!json)
        fail_msg("%s: %s", error.text, text);
    return json;
}

#define ON(device, machine, verdict)                                                               \
    "{'device': '" device "', 'machine': '" machine "', 'verdict': '" verdict "'}"
#define ONCE(device, machine, figures)                                                             \
    "{'device': '" device "', 'machine': '" machine "', 'verdict': 'one launch', 'figures': "      \
    "'" figures "'}"
#define CLAIM(table, words, part, verdicts)                                                        \
    "{'table': '" table "', 'paper': 'creus', 'words': '" words "', 'part': " part                 \
    ", 'verdicts': [" verdicts "]}"

// --- how claims stand ---

#define MIXED                                                                                      \
    ON("cpu", "A", "reproduced")                                                                   \
    "," ON("gl", "A", "not reproduced") "," ON("cpu", "B", "undecided")
#define HELD                  ON("cpu", "A", "reproduced") "," ONCE("cpu", "B", "misses")
#define FAILED                ON("cpu", "A", "not reproduced") "," ONCE("gl", "A", "fits")
#define ONE                   ONCE("cpu", "A", "fits") "," ONCE("gl", "B", "misses")
#define SMALL(word, verdicts) CLAIM("t", word, "null", verdicts)
static const char counted[] = "[" SMALL("a", MIXED) "," SMALL("b", HELD) "," SMALL(
    "c", FAILED) "," SMALL("d", ONE) "," SMALL("e", "") "]";

static void claims_are_counted_on_each_machine(void **state)
{
    (void)state;
    static const struct {
        const char *machine;
        int all, holds, mixed, fails, fits, misses, open;
    } due[] = {{NULL, 5, 1, 1, 1, 0, 1, 1},
               {"A", 4, 1, 1, 1, 1, 0, 0},
               {"B", 3, 0, 0, 0, 0, 2, 1},
               {"C", 0, 0, 0, 0, 0, 0, 0}};
    json_t *claims = json_of(counted);
    for (size_t i = 0; i < sizeof(due) / sizeof(due[0]); i++) {
        int stands[RG_STANDS];
        memset(stands, 1, sizeof(stands));
        assert_int_equal(rg_page_stands(claims, due[i].machine, stands), due[i].all);
        assert_int_equal(stands[RG_STAND_HOLDS], due[i].holds);
        assert_int_equal(stands[RG_STAND_MIXED], due[i].mixed);
        assert_int_equal(stands[RG_STAND_FAILS], due[i].fails);
        assert_int_equal(stands[RG_STAND_FITS], due[i].fits);
        assert_int_equal(stands[RG_STAND_MISSES], due[i].misses);
        assert_int_equal(stands[RG_STAND_OPEN], due[i].open);
    }
    json_decref(claims);
}

// Verdicts of one device on several machines differ, or figures where these are alone; what is not
// seen differs from nothing.
static void verdicts_of_a_device_differ(void **state)
{
    (void)state;
    static const struct {
        const char *verdicts;
        bool differs;
    } cases[] = {{ON("cpu", "A", "reproduced") "," ON("cpu", "B", "not reproduced"), true},
                 {ON("cpu", "A", "reproduced") "," ON("cpu", "B", "reproduced"), false},
                 {ON("cpu", "A", "reproduced") "," ON("gl", "B", "not reproduced"), false},
                 {ON("gl", "A", "reproduced") "," ON("gl", "B", "not reproduced"), false},
                 {ON("cpu", "A", "reproduced") "," ON("cpu", "B", "not seen"), false},
                 {ON("cpu", "A", "not seen") "," ON("cpu", "B", "reproduced"), false},
                 {ON("cpu", "A", "reproduced") "," ON("cpu", "B", "reproduced") "," ON("cpu", "C",
                                                                                       "undecided"),
                  true},
                 {ONCE("cpu", "A", "fits") "," ONCE("cpu", "B", "misses"), true},
                 {ONCE("cpu", "A", "fits") "," ONCE("cpu", "B", "fits"), false},
                 {ONCE("cpu", "A", "fits") "," ON("cpu", "B", "one launch"), false},
                 {ONCE("cpu", "A", "fits") "," ON("cpu", "B", "reproduced"), true},
                 {"", false}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        char text[1024];
        snprintf(text, sizeof(text), "{'verdicts': [%s]}", cases[i].verdicts);
        json_t *claim = json_of(text);
        if (rg_page_differs(claim, "cpu") != cases[i].differs)
            fail_msg("%s", cases[i].verdicts);
        json_decref(claim);
    }
}

// --- Markdown ---

// A page of a record of each kind and document; rg_page_free ends it.
static struct rg_page page_of(const char *const records[][2])
{
    struct rg_page page = {.records = json_array()};
    for (int i = 0; records[i][0]; i++)
        json_array_append_new(page.records,
                              json_pack("{ss ss so}", "kind", records[i][0], "file", "a.json",
                                        "document", json_of(records[i][1])));
    return page;
}

static void expect_markdown(const char *const records[][2], const char *due)
{
    struct rg_page page = page_of(records);
    char *text = rg_page_markdown(&page);
    assert_string_equal(text, due);
    free(text);
    rg_page_free(&page);
}

static void machines_are_told_side_by_side(void **state)
{
    (void)state;
    static const char *const records[][2] = {
        {"claims",
         "{'machines': [{'name': 'A', 'text': 'First CPU'}, {'name': 'C', 'text': 'Third CPU'}, "
         "{'name': 'B', 'text': 'Second CPU'}], 'claims': [" CLAIM(
             "t1", "w1", "null",
             ON("cpu", "A", "reproduced") "," ON("cpu", "B", "not reproduced") "," ON(
                 "gl", "A",
                 "undecided") "," ON("gl", "B",
                                     "undecided")) "," CLAIM("t2", "w2", "'p2'",
                                                             ONCE("cpu", "A", "fits") "," ONCE(
                                                                 "cpu", "B", "misses")) "]}"},
        {"claims", "{'claims': []}"}, // the first claims count
        {NULL}};
    expect_markdown(records,
                    "## raingauge\n\n"
                    "Of 2 claims that papers make, 1 holds on some devices only, 1 misses by one "
                    "launch alone. One launch is no verdict.\n"
                    "- On A (First CPU), of 2: 1 holds, 1 fits by one launch alone.\n"
                    "- On B (Second CPU), of 2: 1 does not hold, 1 misses by one launch alone.\n"
                    "\n| table | claim | verdicts that differ between machines |\n|---|---|---|\n"
                    "| t1 | w1 | cpu on A: reproduced, cpu on B: not reproduced |\n"
                    "| t2 | w2, p2 | cpu on A: one launch fits, cpu on B: one launch misses |\n"
                    "\n<details><summary>Claim by claim</summary>\n\n"
                    "| table | claim | verdicts |\n|---|---|---|\n"
                    "| t1 | w1 | cpu on A: reproduced, cpu on B: not reproduced, gl on A: "
                    "undecided, gl on B: undecided |\n"
                    "| t2 | w2, p2 | cpu on A: one launch fits, cpu on B: one launch misses |\n"
                    "\n</details>\n");
}

// A single machine is not named, and several of one state are many.
static void one_machine_is_not_named(void **state)
{
    (void)state;
    static const char *const records[][2] = {
        {"claims", "{'machines': [{'name': 'A', 'text': 'First CPU'}], 'claims': [" CLAIM(
                       "t1", "w1", "null",
                       ON("cpu", "A", "reproduced") "," ONCE(
                           "gl", "A", "fits")) "," CLAIM("t1", "w2", "null",
                                                         ON("cpu", "A", "reproduced")) "]}"},
        {NULL}};
    static const char *const nothing[][2] = {{"render", "{'file': 'a.png'}"}, {NULL}};
    expect_markdown(records, "## raingauge\n\nOf 2 claims that papers make, 2 hold.\n"
                             "\n<details><summary>Claim by claim</summary>\n\n"
                             "| table | claim | verdicts |\n|---|---|---|\n"
                             "| t1 | w1 | cpu: reproduced, gl: one launch |\n"
                             "| t1 | w2 | cpu: reproduced |\n\n</details>\n");
    expect_markdown(nothing, "## raingauge\n\nThe records hold no claim, no gate and no check.\n");
}

// Findings of the last gate and of all that was verified, the three worst first, and then all.
static void findings_are_told_worst_first(void **state)
{
    (void)state;
    static const char *const records[][2] = {
        {"gate", "{'gated': [{'name': 'earlier', 'ending': 'crash', 'message': ''}]}"},
        {"verify",
         "{'checks': [{'technique': 'flow', 'check': 'law', 'device': 'gl', 'status': 'fail', "
         "'detail': 'too much'}, {'technique': 'ye', 'check': 'image', 'device': 'cpu', 'status': "
         "'ok', 'detail': ''}, {'technique': 'ye', 'check': 'image', 'device': 'gl', 'status': "
         "'error', 'detail': ''}]}"},
        {"gate",
         "{'gated': [{'name': 'a', 'ending': 'pass', 'message': ''}, {'name': 'b', 'ending': "
         "'differs', 'message': 'in 3 pixels'}, {'name': 'c', 'ending': 'crash', 'message': "
         "'SIGSEGV'}]}"},
        {NULL}};
#define CRASH   "| crash | c | SIGSEGV |\n"
#define DIFFERS "| differs | b | in 3 pixels |\n"
#define ERRED   "| error | ye, image on gl |  |\n"
    expect_markdown(records,
                    "## raingauge\n\n2 of 3 cases of the gate failed.\n2 of 3 checks failed.\n"
                    "\n| found | where | why |\n|---|---|---|\n" CRASH DIFFERS ERRED
                    "\n<details><summary>All that fail</summary>\n\n| found | where | why |\n"
                    "|---|---|---|\n" CRASH DIFFERS ERRED
                    "| fail | flow, law on gl | too much |\n\n</details>\n");
    // Three of them are all in the table above.
    static const char *const three[][2] = {
        {"gate",
         "{'gated': [{'name': 'b', 'ending': 'differs', 'message': 'in 3 pixels'}, {'name': "
         "'c', 'ending': 'crash', 'message': 'SIGSEGV'}]}"},
        {"verify", "{'checks': [{'technique': 'ye', 'check': 'image', 'device': 'cpu', 'status': "
                   "'ok', 'detail': ''}, {'technique': 'ye', 'check': 'image', 'device': 'gl', "
                   "'status': 'error', 'detail': ''}]}"},
        {NULL}};
    expect_markdown(three,
                    "## raingauge\n\n2 of 2 cases of the gate failed.\n1 of 2 checks failed.\n"
                    "\n| found | where | why |\n|---|---|---|\n" CRASH DIFFERS ERRED);
}

// A text stays in its cell: marks are escaped, line ends are blanks, and it ends after 300 bytes,
// behind the last whole character.
static void texts_stay_in_their_cells(void **state)
{
    (void)state;
    static const struct {
        const char *text, *repeated;
        int times;
        const char *more, *due, *ends;
    } cases[] = {
        {"a|b`c", "", 0, "", "a\\|b\\`c", ""},
        {"@me #1 <b> *x* _y_ ~z~ [l](u) {0} $1 !p &c \\\\", "", 0, "",
         "(at)me \\#1 \\<b\\> \\*x\\* \\_y\\_ \\~z\\~ \\[l\\]\\(u\\) \\{0\\} \\$1 \\!p \\&c \\\\",
         ""},
        {"one\\ntwo\\tthree", "", 0, "", "one two three", ""},
        {"", "x", 300, "yz", "", ""},
        {"", "x", 299, "\xc3\xa9y", "", "\xc3\xa9"},
        {"", "x", 299, "yz", "", "y"}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        char document[2048], due[2048], repeated[512] = "";
        for (int k = 0; k < cases[i].times; k++)
            strcat(repeated, cases[i].repeated);
        snprintf(document, sizeof(document),
                 "{'gated': [{'name': '%s%s%s', 'ending': 'crash', 'message': 'm'}]}",
                 cases[i].text, repeated, cases[i].more);
        snprintf(due, sizeof(due), "| crash | %s%s%s | m |\n", cases[i].due, repeated,
                 cases[i].ends);
        const char *const records[][2] = {{"gate", document}, {NULL}};
        struct rg_page page = page_of(records);
        char *text = rg_page_markdown(&page);
        if (!strstr(text, due))
            fail_msg("%s lacks %s", text, due);
        free(text);
        rg_page_free(&page);
    }
}

// --- the badge ---

// Whether a badge of a title and what is said has these widths and this colour.
static void expect_badge(const char *badge, const char *title, const char *said, int a, int b,
                         const char *colour)
{
    char due[5][160];
    snprintf(due[0], sizeof(due[0]),
             " width=\"%d\" height=\"20\" role=\"img\" aria-label=\"%s: %s\">", a + b, title, said);
    snprintf(due[1], sizeof(due[1]), "<rect width=\"%d\" height=\"20\" rx=\"3\" fill=\"#444\"/>",
             a + b);
    snprintf(due[2], sizeof(due[2]),
             "<path d=\"M%d 0h%da3 3 0 0 1 3 3v14a3 3 0 0 1-3 3H%dz\" fill=\"%s\"/>", a, b - 3, a,
             colour);
    snprintf(due[3], sizeof(due[3]), "<text x=\"%d\" y=\"14\">%s</text>", a / 2, title);
    snprintf(due[4], sizeof(due[4]), "<text x=\"%d\" y=\"14\">%s</text>", a + b / 2, said);
    for (int k = 0; k < 5; k++)
        if (!strstr(badge, due[k]))
            fail_msg("%s lacks %s", badge, due[k]);
}

static const char holds[] =
    "{'claims': [" CLAIM("t", "w", "null", ON("cpu", "A", "reproduced")) "," CLAIM(
        "t", "x", "null", ON("cpu", "A", "undecided")) "]}";
static const char open[] = "{'claims': [" CLAIM("t", "w", "null", ON("cpu", "A", "undecided")) "]}";
static const char passes[] = "{'gated': [{'ending': 'pass'}, {'ending': 'inconclusive'}]}";
static const char fails[] = "{'gated': [{'ending': 'pass'}, {'ending': 'crash'}]}";
static const char verified[] =
    "{'checks': [{'status': 'ok'}, {'status': 'unsupported'}, {'status': 'nothing'}]}";
static const char wrong[] = "{'checks': [{'status': 'ok'}, {'status': 'fail'}]}";

// Seven pixels a letter and twelve beside them; red for a failure, green for what holds or passes,
// and grey if there is neither.
static void badges_are_as_wide_as_their_words(void **state)
{
    (void)state;
    static const struct {
        const char *records[3][2], *title, *said, *colour;
        int left_px, right_px;
    } cases[] = {
        {{{"claims", holds}}, "creus", "1 of 2 claims hold", "#17733a", 47, 138},
        {{{"claims", open}}, "creus", "0 of 1 claim holds", "#666", 47, 138},
        {{{"gate", passes}}, "raingauge", "0 of 2 fail", "#17733a", 75, 89},
        {{{"gate", fails}}, "raingauge", "1 of 2 fail", "#b3261e", 75, 89},
        {{{"verify", verified}}, "raingauge", "0 of 3 fail", "#17733a", 75, 89},
        {{{"verify", wrong}}, "raingauge", "1 of 2 fail", "#b3261e", 75, 89},
        {{{"claims", holds}, {"gate", fails}}, "raingauge", "1 of 2 fail", "#b3261e", 75, 89},
        {{{"render", "{}"}}, "raingauge", "nothing measured", "#666", 75, 124}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_page page = page_of(cases[i].records);
        char *text = rg_page_badge(&page);
        expect_badge(text, cases[i].title, cases[i].said, cases[i].left_px, cases[i].right_px,
                     cases[i].colour);
        free(text);
        rg_page_free(&page);
    }
}

// --- what a page takes ---

static void records_are_taken_by_their_kind(void **state)
{
    (void)state;
    static const struct {
        const char *text, *kind, *says;
    } cases[] = {
        {"{\"format\":1,\"gated\":[]}", "gate", NULL},
        {"{\"format\":1,\"file\":\"none.png\"}", "render", NULL},
        {"{\"format\":1,\"candidates\":3}", "bisect", NULL},
        {"{\"format\":1,\"candidates\":\"3\"}", NULL,
         "in/a.json: is no record of raingauge; name what a command wrote with --json or -o "
         "(docs/records.md)"},
        {"{\"format\":1,\"gated\":[],\"shard\":{}}", NULL,
         "in/a.json: is the record of a shard; name what `raingauge gate --from --json` makes of "
         "all of them"},
        {"{\"format\":7,\"gated\":[]}", NULL,
         "in/a.json: is of format 7, and this raingauge knows format 1; use the raingauge that "
         "wrote it, or a newer one"}};
    rg_log_listen(log_last, NULL);
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_page page = {0};
        assert_int_equal(rg_page_add_text(&page, "in/a.json", cases[i].text), !cases[i].says);
        const json_t *record = json_array_get(page.records, 0);
        assert_int_equal(json_array_size(page.records), !cases[i].says);
        if (cases[i].says)
            assert_string_equal(logged, cases[i].says);
        else
            assert_true(rg_page_is(record, "kind", cases[i].kind) &&
                        rg_page_is(record, "file", "in/a.json"));
        rg_page_free(&page);
    }
    rg_log_listen(NULL, NULL);
}

static void expect_json(json_t *found, const char *due)
{
    json_t *wanted = json_of(due);
    char *text = json_dumps(found, JSON_COMPACT);
    if (!json_equal(found, wanted))
        fail_msg("%s", text);
    free(text);
    json_decref(wanted);
}

// What papers print: columns, rows with their names, choices in words, and each variant's column.
static void printed_rows_are_those_of_papers(void **state)
{
    (void)state;
    assert_null(rg_page_printed("nonsense"));
    json_t *parts = rg_page_printed("chin-operations"), *rates = rg_page_printed("creus-5.4");
    json_t *rows = json_object_get(parts, "rows");
    expect_json(json_object_get(parts, "columns"), "['erode', 'merge', 'residual', 'smooth']");
    assert_int_equal(json_array_size(rows), 6);
    expect_json(json_array_get(rows, 1),
                "{'name': 'no erosion', 'values': ['off', 'on', 'on', 'on']}");
    expect_json(json_object_get(parts, "variants"), "[{'name': 'full', 'column': null}]");
    expect_json(json_object_get(rates, "columns"),
                "['culling_radius_m', 'particles', 'fps', 'fps_no_geometry']");
    expect_json(json_array_get(json_object_get(rates, "rows"), 6),
                "{'name': null, 'values': [35, 2190468, 12.5, 14]}");
    expect_json(json_object_get(rates, "variants"),
                "[{'name': 'full', 'column': 'fps'}, {'name': 'no_geometry', 'column': "
                "'fps_no_geometry'}]");
    static const char *const fields[] = {"about", "columns", "rows", "variants"};
    for (int i = 0; i < 4; i++) {
        json_object_del(parts, fields[i]);
        json_object_del(rates, fields[i]);
    }
    expect_json(parts, "{'technique': 'drops', 'paper': 'chin', 'is_published': false, 'names': "
                       "'operations', 'keys': 4}");
    expect_json(rates, "{'technique': 'streaks', 'paper': 'creus', 'is_published': true, 'names': "
                       "null, 'keys': 1}");
    json_decref(parts);
    json_decref(rates);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(claims_are_counted_on_each_machine),
        cmocka_unit_test(verdicts_of_a_device_differ),
        cmocka_unit_test(machines_are_told_side_by_side),
        cmocka_unit_test(one_machine_is_not_named),
        cmocka_unit_test(findings_are_told_worst_first),
        cmocka_unit_test(texts_stay_in_their_cells),
        cmocka_unit_test(badges_are_as_wide_as_their_words),
        cmocka_unit_test(records_are_taken_by_their_kind),
        cmocka_unit_test(printed_rows_are_those_of_papers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
