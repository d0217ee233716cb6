// A baseline is read as it was written, and a file that is none is refused in a line with its
// place.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/record/disk/seal.h"
#include "tests/harness/gate/baseline/made.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"

static char path[64];

static int set_up(void **state)
{
    if (make_folder(state))
        return -1;
    snprintf(path, sizeof(path), "%s/b.json", folder);
    return 0;
}

static int tear_down(void **state)
{
    unlink(path);
    return remove_folder(state);
}

// --- reading what was written ---

static void assert_launches(const struct rg_launches *is, const struct rg_launches *due)
{
    assert_int_equal(is->count, due->count);
    for (int i = 0; i < due->count; i++)
        assert_at_most(fabs(is->ms[i] - due->ms[i]), 1e-8 * due->ms[i]);
}

static void assert_row(const struct rg_baseline_row *is, const struct rg_baseline_row *due)
{
    assert_string_equal(is->cell, due->cell);
    assert_string_equal(is->technique, due->technique);
    assert_string_equal(is->settings, due->settings);
    assert_string_equal(is->device, due->device);
    assert_int_equal(is->outcome, due->outcome);
    assert_string_equal(is->why, due->why);
    assert_string_equal(is->picture, due->picture);
    assert_int_equal(is->state_count, due->state_count);
    assert_memory_equal(is->states, due->states, sizeof(is->states[0]) * (size_t)due->state_count);
    assert_int_equal(is->counters.count, due->counters.count);
    for (int i = 0; i < due->counters.count; i++) {
        assert_string_equal(is->counters.counters[i].name, due->counters.counters[i].name);
        assert_int_equal(is->counters.counters[i].value, due->counters.counters[i].value);
    }
    assert_memory_equal(&is->work, &due->work, sizeof(is->work));
    assert_true(is->slot.frames == due->slot.frames && is->slot.timings == due->slot.timings);
    assert_launches(&is->launches, &due->launches);
    assert_equals(is->seconds, due->seconds);
}

static void all_comes_back(void **state)
{
    (void)state;
    struct rg_baseline made = made_baseline(), read = {.count = 0};
    assert_true(rg_baseline_write(&made, path));
    logged_lines = 0;
    assert_true(rg_baseline_read(&read, path));
    assert_int_equal(logged_lines, 0);
    assert_true(json_equal(read.passport, made.passport));
    assert_int_equal(read.device_count, 2);
    for (int i = 0; i < 2; i++) {
        assert_string_equal(read.devices[i].name, made.devices[i].name);
        assert_true(json_equal(read.devices[i].parts, made.devices[i].parts));
    }
    for (int i = 0; i < RG_YARDSTICKS; i++)
        assert_launches(&read.yardsticks[i], &made.yardsticks[i]);
    assert_int_equal(read.count, 4);
    for (int i = 0; i < 4; i++)
        assert_row(&read.rows[i], &made.rows[i]);
    rg_baseline_free(&read);
    assert_false(rg_baseline_write(&made, "/nonexistent/out/b.json"));
    rg_baseline_free(&made);
}

// The file has the names of docs/records.md.
static void fields_have_their_names(void **state)
{
    (void)state;
    struct rg_baseline made = made_baseline();
    char key[RG_KEY_SIZE];
    assert_true(rg_baseline_write(&made, path));
    json_t *document = json_load_file(path, 0, NULL), *row;
    row = json_array_get(json_object_get(document, "baseline"), 2);
    assert_int_equal(json_integer_value(json_object_get(document, "format")), 1);
    rg_key_hash(made.devices[1].parts, key);
    assert_string_equal(json_string_value(json_object_get(
                            json_array_get(json_object_get(document, "devices"), 1), "key")),
                        key);
    assert_int_equal(json_integer_value(json_object_get(row, "frames")), 12);
    assert_int_equal(json_integer_value(json_object_get(row, "timings")), 5);
    assert_true(json_number_value(json_object_get(row, "seconds")) == 2.5);
    assert_string_equal(json_string_value(json_object_get(json_object_get(row, "states"), "dry")),
                        made.rows[2].states[1].digest);
    assert_true(json_is_null(json_object_get(json_object_get(row, "work"), "texels_fetched")));
    json_decref(document);
    rg_baseline_free(&made);
}

// --- what is refused ---

static json_t *of(json_t *document, const char *name, size_t i)
{
    return json_array_get(json_object_get(document, name), i);
}

// One thing that is wrong with a document: a field of an object, which is of its second row or
// device, or a part of those.
enum part { DOCUMENT, ROW, STATES, DEVICE, KEY, YARDSTICKS };
static const struct wrong {
    enum part part;
    const char *field, *value; // NULL: there is no such field; "": an array that is too long
    const char *said;
} wrongs[] = {
    {ROW, "picture", "\"0123456789ABCDEF\"", "baseline[1].picture is no digest of 16 digits"},
    {ROW, "settings", "\"0123456789abcde\"", "baseline[1].settings is no digest of 16 digits"},
    {STATES, "dry", "\"x\"", "baseline[1].dry is no digest of 16 digits"},
    {ROW, "launches_ms", "[1, 0]", "baseline[1].launches_ms has an element that is no time"},
    {ROW, "launches_ms", "", "baseline[1].launches_ms has more than 64 elements"},
    {ROW, "frames", "1001", "baseline[1].frames "},
    {ROW, "timings", "0", "baseline[1].timings "},
    {ROW, "timings", "10", "baseline[1].timings "},
    {ROW, "outcome", "\"fine\"", "baseline[1].outcome is no outcome"},
    {ROW, "device", "\"opencl\"", "baseline[1].device is none of its devices"},
    {ROW, "cell", "\"rain\"", "baseline[1] stands there twice"},
    {ROW, "why", NULL, "baseline[1].why is missing"},
    {KEY, "cpu", "7", "devices[1].of has 'cpu', which is no text"},
    {DEVICE, "name", NULL, "devices[1].name is missing"},
    {DOCUMENT, "devices", "[]", "devices has not 1 to 32 elements"},
    {YARDSTICKS, "copy", "[-1]", "yardsticks_ms.copy has an element that is no time"},
    {DOCUMENT, "passport", NULL, "passport is missing"},
    {DOCUMENT, "format", "2", "format is 2, and this raingauge reads 1"},
    {DOCUMENT, "baseline", NULL, "is no baseline"},
    {DOCUMENT, "baseline", "{}", "baseline is no array"},
};

static void spoil(const struct wrong *wrong, json_t *document)
{
    json_t *row = of(document, "baseline", 1), *device = of(document, "devices", 1);
    json_t *const parts[] = {document,
                             row,
                             json_object_get(row, "states"),
                             device,
                             json_object_get(device, "of"),
                             json_object_get(document, "yardsticks_ms")};
    if (!wrong->value) {
        json_object_del(parts[wrong->part], wrong->field);
        return;
    }
    json_t *value = *wrong->value ? json_loads(wrong->value, JSON_DECODE_ANY, NULL) : json_array();
    for (int i = 0; !*wrong->value && i <= RG_SHIFT_SAMPLES; i++)
        json_array_append_new(value, json_real(1));
    assert_int_equal(json_object_set_new(parts[wrong->part], wrong->field, value), 0);
}

static void what_is_no_baseline_is_refused_with_its_place(void **state)
{
    (void)state;
    struct rg_baseline made = made_baseline();
    for (size_t i = 0; i < sizeof(wrongs) / sizeof(wrongs[0]); i++) {
        struct rg_baseline read = {.count = 0};
        char due[200];
        assert_true(rg_baseline_write(&made, path));
        json_t *document = json_load_file(path, 0, NULL);
        spoil(&wrongs[i], document);
        assert_true(rg_seal(document));
        assert_int_equal(json_dump_file(document, path, 0), 0);
        json_decref(document);
        logged_lines = 0;
        assert_false(rg_baseline_read(&read, path));
        rg_baseline_free(&read);
        snprintf(due, sizeof(due), "%s: %s", path, wrongs[i].said);
        if (logged_lines != 1 || strncmp(logged, due, strlen(due)) != 0 ||
            !strstr(logged, "; name a file as `raingauge baseline -o` writes it"))
            fail_msg("row %zu: %s, not %s", i, logged, due);
    }
    rg_baseline_free(&made);
}

// Seconds are missing in older files.
static void an_older_baseline_has_no_seconds(void **state)
{
    (void)state;
    struct rg_baseline made = made_baseline(), read = {.count = 0};
    assert_true(rg_baseline_write(&made, path));
    json_t *document = json_load_file(path, 0, NULL);
    json_object_del(of(document, "baseline", 1), "seconds");
    assert_true(rg_seal(document));
    assert_int_equal(json_dump_file(document, path, 0), 0);
    json_decref(document);
    assert_true(rg_baseline_read(&read, path));
    assert_true(read.rows[0].seconds == 0.5 && read.rows[1].seconds == 0);
    rg_baseline_free(&read);
    rg_baseline_free(&made);
}

int main(void)
{
    rg_log_listen(log_last, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_comes_back),
        cmocka_unit_test(fields_have_their_names),
        cmocka_unit_test(what_is_no_baseline_is_refused_with_its_place),
        cmocka_unit_test(an_older_baseline_has_no_seconds),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
