// What is no result on disk, or a damaged one, is refused in one line that says where.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/record/disk/stored.h"
#include "harness/record/passport/passport.h"
#include "harness/tables/print.h"
#include "tests/harness/record/made.h"
#include "tests/tools/expect.h"

static json_t *document_of_test(void)
{
    struct rg_result made = make_result();
    json_t *document = rg_result_json(&made);
    rg_result_free(&made);
    return document;
}

// The object or array that holds the last name of a path such as "cells.3.status".
static json_t *holder_of(json_t *document, const char *path, const char **last)
{
    json_t *at = document;
    static char copy[128];
    snprintf(copy, sizeof(copy), "%s", path);
    char *rest = NULL, *name = strtok_r(copy, ".", &rest);
    for (char *next; (next = strtok_r(NULL, ".", &rest)); name = next)
        at = json_is_array(at) ? json_array_get(at, (size_t)atoi(name)) : json_object_get(at, name);
    *last = name;
    return at;
}

static void expect_refusal(const char *path, json_t *value, const char *says)
{
    char why[RG_WHY_SIZE];
    const char *last;
    struct rg_result result = {0};
    json_t *document = document_of_test(), *holder = holder_of(document, path, &last);
    assert_non_null(json_is_object(holder) ? json_object_get(holder, last)
                                           : json_array_get(holder, (size_t)atoi(last)));
    if (json_is_array(holder))
        json_array_set_new(holder, (size_t)atoi(last), value);
    else if (value)
        json_object_set_new(holder, last, value);
    else
        json_object_del(holder, last);
    if (rg_result_from_json(document, "f", &result, why) || !strstr(why, says))
        fail_msg("%s: '%s' instead of '%s'", path, why, says);
    json_decref(document);
}

static void test_refusals(void **state)
{
    (void)state;
    expect_refusal("format", json_integer(2), "f: format is 2, and this raingauge reads 1; ");
    expect_refusal("format", json_string("1"), "f: format is no whole number");
    expect_refusal("table", NULL, "f: is no table's result; ");
    expect_refusal("table", json_string("../x"), "f: table is no name");
    expect_refusal("rows", json_pack("[ii]", 4, 2), "f: rows is no range");
    expect_refusal("rows", json_pack("[iii]", 1, 2, 3), "f: rows is no pair");
    expect_refusal("variants", json_array(), "f: variants has not 1 to 10 elements");
    expect_refusal("passport.devices.1.name", json_integer(1),
                   "f: passport.devices[1].name is no text");
    expect_refusal("passport.devices.0.software", json_null(),
                   "f: passport.devices[0].software is neither true nor false");
    expect_refusal("works.1.saves", NULL, "f: works[1].saves is missing");
    expect_refusal("passport", NULL, "f: passport is missing"); // not of the last work
    expect_refusal("cells.3.status", json_string("good"), "f: cells[3].status is no outcome");
    expect_refusal("cells.3.detail", NULL, "f: cells[3].detail is missing");
    expect_refusal("cells.3.device", json_string("vulkan"), "f: cells[3].device is 'vulkan'");
    expect_refusal("cells.1.row_number", json_integer(5), "f: cells[1].row_number is no whole");
    expect_refusal("cells.1.row_number", json_integer(3), "f: cells[");
    expect_refusal("cells.0.device", json_string("gl"), "f: cells[1] stands there twice");
    expect_refusal("cells.0.measured.samples_ms.2", json_real(-1),
                   "f: cells[0].measured.samples_ms has an element");
    expect_refusal("cells.0.measured.samples_ms.6", json_integer(0),
                   "f: cells[0].measured.samples_ms has an element that is no number above 0");
    expect_refusal("cells.0.measured.passes_ms.flow_move", json_string("x"),
                   "f: cells[0].measured.passes_ms has 'flow_move'");
    expect_refusal("cells.0.counters.drops", json_real(1.5), "f: cells[0].counters has 'drops'");
    expect_refusal("cells.0.tally.runs", json_integer(-1), "f: cells[0].tally.runs is no whole");
    expect_refusal("cells.0.tally.items", NULL, "f: cells[0].tally.items is missing");
    expect_refusal("cells.0.tally", NULL, "f: cells[0].tally is missing");
    expect_refusal("cells.0.error.max", json_integer(256), "f: cells[0].error.max is no whole");
    expect_refusal("cells.0.set", json_array(), "f: cells[0].set is no text");
}

// Numbers have bounds, and names and words are among those that are known.
static void test_bounds(void **state)
{
    (void)state;
    expect_refusal("size_px", json_pack("[ii]", 640, 0),
                   "f: size_px is no pair of whole numbers "
                   "from 1 to 1048576");
    expect_refusal("size_px", json_pack("[ii]", 1 << 21, 480), "f: size_px is no pair");
    expect_refusal("size_px", json_pack("[ii]", 640, 1 << 21), "f: size_px is no pair");
    expect_refusal("rows", json_pack("[ii]", 2, 258), "f: rows is no range of 1 to 256 rows; ");
    expect_refusal("length", json_string("long"), "f: length is neither quick nor full");
    expect_refusal("check_frames", json_integer(0), "f: check_frames is no whole number from 1 on");
    expect_refusal("resumed_rows", json_integer(257),
                   "f: resumed_rows is no whole number from 0 "
                   "to 256");
    expect_refusal("works.0.name", json_null(), "f: works[0].name is no text");
    expect_refusal("missing.0", json_integer(1), "f: missing has an element that is no line");
    expect_refusal("cells.0.variant", json_string("none"),
                   "f: cells[0].variant is 'none', which "
                   "'variants' does not name");
    expect_refusal("cells.0.work", json_string("none"),
                   "f: cells[0].work is 'none', which 'works' "
                   "does not name");
    expect_refusal("cells.0.row_number", json_integer(1),
                   "f: cells[0].row_number is no whole "
                   "number from 2 to 4");
    expect_refusal("cells.15", json_null(), "f: cells[15].row_number is missing");
    expect_refusal("cells.0.measured.taken.1", json_real(1.01),
                   "f: cells[0].measured.taken has an element that is no number from 0 to 1");
    expect_refusal("cells.0.measured.taken", json_pack("[f]", 0.5),
                   "f: cells[0].measured.taken has not a number for each sample");
    expect_refusal("cells.0.measured.pass_frames", json_integer(0),
                   "f: cells[0].measured.pass_frames is no whole number from 1 on");
    expect_refusal("cells.0.measured.create_ms", json_real(-0.5),
                   "f: cells[0].measured.create_ms is no number from 0 on");
    expect_refusal("cells.0.error.status", json_string("?"),
                   "f: cells[0].error.status is no "
                   "outcome");
}

// Names and texts fit where they are kept, and lists have room for so many.
static void test_limits(void **state)
{
    (void)state;
    char text[201];
    memset(text, 'x', 200);
    text[200] = 0;
    expect_refusal("cells.3.detail", json_string(text),
                   "f: cells[3].detail is no text of less than "
                   "200 bytes");
    text[48] = 0;
    expect_refusal("technique", json_string(text), "f: technique is no text of less than 48 bytes");
    expect_refusal("variants.1", json_string(text), "f: variants has an element that is no short");
    expect_refusal("cells.0.facts", json_pack("{si}", text, 1),
                   "f: cells[0].facts has a field whose name has not 1 to 47 bytes");
    expect_refusal("cells.0.facts", json_pack("{ss}", "model", ""),
                   "f: cells[0].facts has 'model', which is of another kind");
    json_t *row = json_object(), *works = json_array();
    for (int i = 0; i < 11; i++) {
        char name[8];
        snprintf(name, sizeof(name), "k%d", i);
        json_object_set_new(row, name, json_integer(i));
    }
    expect_refusal("cells.0.row", row, "f: cells[0].row has more than 10 fields");
    for (int i = 0; i < 5; i++)
        json_array_append_new(works, json_pack("{ss ss}", "name", "a", "saves", ""));
    expect_refusal("works", works, "f: works has not 1 to 4 elements");
}

// Launches have rising numbers, each with a time above 0 and three numbers that are not negative.
static void test_launches(void **state)
{
    (void)state;
    static const char *const wrong[] = {
        "[[0, 2, 0, 0, 1]]",                  // numbers count from 1
        "[[1, 2, 0, 0, 1], [1, 2, 0, 0, 1]]", // and rise
        "[[1, 0, 0, 0, 1]]",                  // no time
        "[[1, 2, -0.1, 0, 1]]",               // a negative share
        "[[1, 2, 0, -0.1, 1]]",
        "[[1, 2, 0, 0, -1]]",
        "[[1, 2, 0, 0]]",
        "[[1, 2, 0, 0, 1, 1]]",
        "[[1.5, 2, 0, 0, 1]]",
        "[[1, 2, 0, 0, \"1\"]]",
        "[]",
    };
    char why[RG_WHY_SIZE];
    for (size_t i = 0; i <= sizeof(wrong) / sizeof(wrong[0]); i++) {
        const bool is_right = i == sizeof(wrong) / sizeof(wrong[0]);
        struct rg_result result = {0};
        json_t *document = document_of_test();
        json_t *cell = json_array_get(json_object_get(document, "cells"), 0);
        json_t *launches =
            json_loads(is_right ? "[[1, 2, 0, 0, 0], [4, 3, 0.5, 1, 9]]" : wrong[i], 0, NULL);
        json_object_set_new(json_object_get(cell, "measured"), "launches", launches);
        assert_int_equal(rg_result_from_json(document, "f", &result, why), is_right);
        assert_true(is_right || strstr(why, "f: cells[0].measured.launches has "));
        json_decref(document);
        rg_result_free(&result);
    }
}

static char path[64];

static void write_text(const char *text, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, size, file), size);
    fclose(file);
}

static void count_lines(enum rg_log_level level, const char *line, void *count)
{
    (void)level;
    if (strncmp(line, "raingauge: ", 11) == 0 || strstr(line, path))
        ++*(int *)count;
}

// Whether a file is taken; if not, one line names it.
static bool read_path(int expected_results)
{
    struct rg_stored stored = {0};
    int lines = 0;
    rg_log_listen(count_lines, &lines);
    const bool ok = rg_stored_read(&stored, path);
    rg_log_listen(NULL, NULL);
    assert_int_equal(lines, !ok);
    assert_true(!ok || !expected_results || stored.count == expected_results);
    rg_stored_free(&stored);
    return ok;
}

// A file may hold several results, one after the other. A file that is no result, or is missing, is
// reported.
static void test_files(void **state)
{
    (void)state;
    struct rg_result made = make_result();
    char *text = print_result(&made, RG_RESULT_JSON), twice[65536];
    snprintf(twice, sizeof(twice), "%s\n%s\n", text, text);
    write_text(twice, strlen(twice));
    assert_true(read_path(2));
    snprintf(twice, sizeof(twice), "%s\nand more", text);
    write_text(twice, strlen(twice));
    assert_false(read_path(0));
    write_text("", 0);
    assert_false(read_path(0));
    write_text("{\"format\": 1, \"pairs\": []}", 26);
    assert_false(read_path(0));
    unlink(path);
    assert_false(read_path(0));
    free(text);
    rg_result_free(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_refusals), cmocka_unit_test(test_bounds),
        cmocka_unit_test(test_limits),   cmocka_unit_test(test_launches),
        cmocka_unit_test(test_files),
    };
    snprintf(path, sizeof(path), "/tmp/raingauge-test-refused-%d.json", (int)getpid());
    return cmocka_run_group_tests(tests, NULL, NULL);
}
