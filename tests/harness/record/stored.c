// Results on disk are read back as they were written. A file that is no result is refused in one
// line that says where.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/record/disk/stored.h"
#include "harness/tables/print.h"
#include "tests/harness/record/made.h"
#include "tests/tools/expect.h"

// Each record is the same to the last bit, except for fields that a file does not hold.
static void assert_same_records(const struct rg_result *a, const struct rg_result *b)
{
    for (struct rg_place at = rg_result_start(a); rg_result_next(a, &at);) {
        const struct rg_record *x = rg_result_at(a, at), *y = rg_result_at(b, at);
        assert_string_equal(x->set, y->set);
        assert_string_equal(x->work, y->work);
        assert_string_equal(x->device.driver, y->device.driver);
        assert_memory_equal(x->row, y->row, sizeof(x->row));
        assert_memory_equal(x->published, y->published, sizeof(x->published));
        assert_memory_equal(x->facts, y->facts, sizeof(x->facts));
        assert_memory_equal(x->counters, y->counters, sizeof(x->counters));
        assert_int_equal(x->counted_count, y->counted_count);
        assert_memory_equal(x->counted, y->counted, sizeof(x->counted));
        assert_int_equal(x->has_tally, y->has_tally);
        assert_true(!x->has_tally || !memcmp(&x->tally, &y->tally, sizeof(x->tally)));
        assert_memory_equal(x->passes, y->passes, sizeof(x->passes));
        assert_memory_equal(x->samples_ms, y->samples_ms, sizeof(x->samples_ms));
        assert_memory_equal(&x->frame_ms, &y->frame_ms, sizeof(x->frame_ms));
        assert_equals(x->create_ms, y->create_ms);
        assert_equals(x->api_over_wall, y->api_over_wall);
        assert_equals(x->calibration_begin_ms, y->calibration_begin_ms);
        assert_equals(x->calibration_end_ms, y->calibration_end_ms);
        assert_equals(x->truth_error.flip_mask_mean, y->truth_error.flip_mask_mean);
        assert_int_equal(x->outcome, y->outcome);
        assert_string_equal(x->detail, y->detail);
    }
}

static void test_round_trip(void **state)
{
    (void)state;
    char why[RG_WHY_SIZE];
    struct rg_result made = make_result(), found = {0};
    char *text = print_result(&made, RG_RESULT_JSON);
    json_t *document = json_loads(text, JSON_REJECT_DUPLICATES, NULL);
    if (!rg_result_from_json(document, "file", &found, why))
        fail_msg("%s", why);
    assert_false(rg_result_has(&found, 2));
    assert_same_records(&made, &found);
    assert_prints_same(&made, &found);
    json_decref(document);
    free(text);
    rg_result_free(&made);
    rg_result_free(&found);
}

// A budget's choices are read back. A row that the budget left out is not missing; another row
// without a record is.
static void test_budget(void **state)
{
    (void)state;
    char why[RG_WHY_SIZE];
    struct rg_result made = make_result(), found = {0};
    made.budget_s = 240;
    made.size_divisor = 4;
    made.few_samples = true;
    assert_false(rg_result_is_of_print(&made, 0));
    assert_int_equal(rg_result_first_missing(&made), 2);
    made.left_out[1] = true;
    assert_int_equal(rg_result_first_missing(&made), 4);
    json_t *document = rg_result_json(&made);
    assert_false(json_boolean_value(json_object_get(document, "interrupted")));
    if (!rg_result_from_json(document, "file", &found, why))
        fail_msg("%s", why);
    assert_equals(found.budget_s, 240);
    assert_equals(found.size_divisor, 4);
    assert_true(found.few_samples);
    assert_true(!found.left_out[0] && found.left_out[1] && !found.left_out[2]);
    assert_same_records(&made, &found);
    assert_prints_same(&made, &found);
    // Rows that are kept keep their marks.
    assert_true(rg_result_keep_rows(&found, 2, 3));
    assert_true(found.left_out[0] && !found.left_out[1]);
    rg_result_free(&found);
    json_array_append_new(json_object_get(json_object_get(document, "budget"), "left_out"),
                          json_integer(99));
    assert_false(rg_result_from_json(document, "file", &found, why));
    assert_non_null(strstr(why, "left_out"));
    json_decref(document);
    rg_result_free(&made);
    rg_result_free(&found);
}

// Quick mode's choice of rows is read back, too.
static void test_quick_choice(void **state)
{
    (void)state;
    char why[RG_WHY_SIZE];
    struct rg_result made = make_result(), found = {0};
    made.full = false;
    made.left_out[1] = true;
    json_t *document = rg_result_json(&made);
    if (!rg_result_from_json(document, "file", &found, why))
        fail_msg("%s", why);
    assert_true(!found.left_out[0] && found.left_out[1] && !found.left_out[2]);
    assert_int_equal(rg_result_first_missing(&found), 4);
    rg_result_free(&found);
    json_array_append_new(json_object_get(document, "left_out"), json_integer(99));
    assert_false(rg_result_from_json(document, "file", &found, why));
    assert_non_null(strstr(why, "left_out"));
    json_decref(document);
    rg_result_free(&made);
    rg_result_free(&found);
}

// --- refusals ---

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
    expect_refusal("cells.3.status", json_string("good"), "f: cells[3].status is no outcome");
    expect_refusal("cells.3.detail", NULL, "f: cells[3].detail is missing");
    expect_refusal("cells.3.device", json_string("vulkan"), "f: cells[3].device is 'vulkan'");
    expect_refusal("cells.1.row_number", json_integer(5), "f: cells[1].row_number is no whole");
    expect_refusal("cells.1.row_number", json_integer(3), "f: cells[");
    expect_refusal("cells.0.device", json_string("gl"), "f: cells[1] stands there twice");
    expect_refusal("cells.0.measured.samples_ms.2", json_real(-1),
                   "f: cells[0].measured.samples_ms has an element");
    expect_refusal("cells.0.measured.passes_ms.flow_move", json_string("x"),
                   "f: cells[0].measured.passes_ms has 'flow_move'");
    expect_refusal("cells.0.counters.drops", json_real(1.5), "f: cells[0].counters has 'drops'");
    expect_refusal("cells.0.tally.runs", json_integer(-1), "f: cells[0].tally.runs is no whole");
    expect_refusal("cells.0.tally.items", NULL, "f: cells[0].tally.items is missing");
    expect_refusal("cells.0.tally", NULL, "f: cells[0].tally is missing");
    expect_refusal("cells.0.error.max", json_integer(256), "f: cells[0].error.max is no whole");
    expect_refusal("cells.0.set", json_array(), "f: cells[0].set is no text");
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
        cmocka_unit_test(test_round_trip),   cmocka_unit_test(test_budget),
        cmocka_unit_test(test_quick_choice), cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_files),
    };
    snprintf(path, sizeof(path), "/tmp/raingauge-test-stored-%d.json", (int)getpid());
    return cmocka_run_group_tests(tests, NULL, NULL);
}
