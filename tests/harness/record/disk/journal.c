// An interrupted table goes on: which rows its journal keeps, and which it does not.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <dirent.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/console/interrupt.h"
#include "harness/record/disk/journal.h"
#include "harness/record/disk/seal.h"
#include "harness/record/disk/stored.h"
#include "harness/record/schema/schema.h"
#include "harness/tables/sheet/sheet.h"
#include "harness/tables/measuring/measure.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/interrupt.h"

#define CHEAP                                                                                      \
    "view=pane panes=mirror environment=sky environment_px=16 reflection_px=16 resolution_px=64"

static const struct rg_table_row rows[] = {
    {CHEAP " drops=40", {1, 160}, NULL},
    {CHEAP " environment=/nonexistent.exr", {2, 50}, NULL},
};
static const struct rg_table table = {
    .id = "test",
    .technique = "flow",
    .about = "a test",
    .hardware = "paper",
    .columns = {"row", "fps"},
    .key_count = 1,
    .variants = {{"full", "", "fps"}, {"bare", "pane_rain_mm_h=0", NULL}},
    .truth = "drops=20",
    .quick = "drops=25",
    .rows_at_once = 1,
    .check_frames = 2,
    .width = 32,
    .height = 32,
    .row_count = 2,
    .rows = rows,
    .note = "a note",
};

struct rig {
    struct rg_devices devices;
    struct rg_kept kept;
    int messages;
    bool interrupts; // at the first message, which is about the second row's file
    bool is_last;    // no table follows
};

static int setup(void **state)
{
    struct rig *rig = calloc(1, sizeof(*rig));
    rig->devices = (struct rg_devices){.count = 1, .devices = {rg_device_open("cpu")}};
    rig->kept.devices = &rig->devices;
    rg_interrupt_watch();
    *state = rig;
    return rig->devices.devices[0] ? make_folder(NULL) : -1;
}

static int teardown(void **state)
{
    struct rig *rig = *state;
    const bool clean = rg_kept_free(&rig->kept) && rg_device_close(rig->devices.devices[0]);
    char path[128];
    snprintf(path, sizeof(path), "%s/test-quick.journal", folder);
    unlink(path);
    const bool empty = remove_folder(NULL) == 0;
    free(rig);
    return clean && empty ? 0 : -1;
}

static void hear(enum rg_log_level level, const char *line, void *user)
{
    struct rig *rig = user;
    (void)level;
    (void)line;
    if (!rig->messages++ && rig->interrupts)
        interrupt_by(SIGINT);
}

static void begin(struct rig *rig, struct rg_result *result, int last_row)
{
    const struct rg_table_part part = {.last_row = last_row};
    *result = (struct rg_result){0};
    rg_table_begin(result, &table, &part, &rig->devices);
}

// Runs the table with its journal, which stays on disk, and returns its JSON. The journal keeps all
// rows, unless no other table follows.
static json_t *run_table(struct rig *rig, struct rg_result *result, bool fresh)
{
    begin(rig, result, 1);
    rig->messages = 0;
    rg_interrupt_watch();
    rg_log_listen(hear, rig);
    struct rg_journal *journal = rg_journal_open(result, folder, fresh, !rig->is_last);
    assert_true(rg_table_measure(result, &table, &rig->kept, journal, NULL, NULL));
    rg_log_listen(NULL, NULL);
    rg_journal_close(journal);
    return rg_result_json(result);
}

static const json_t *cell_at(const json_t *json, size_t cell)
{
    return json_array_get(json_object_get(json, "cells"), cell);
}

static int resumed_rows(const json_t *json)
{
    return (int)json_integer_value(json_object_get(json, "resumed_rows"));
}

// Whether a note of the result's sheet says that an earlier run measured rows.
static bool tells_of_earlier_run(const struct rg_result *result)
{
    struct rg_sheet sheet;
    bool is_told = false;
    rg_result_sheet(result, &sheet);
    for (int n = 0; n < sheet.note_count; n++)
        is_told =
            is_told || strstr(sheet.notes[n], "1 were measured by a run that was interrupted");
    rg_sheet_free(&sheet);
    return is_told;
}

// The second row cannot be opened and is not kept. The first row is kept, and the next run takes it
// to the last digit.
static void test_resumes(void **state)
{
    struct rig *rig = *state;
    struct rg_result result;
    json_t *first = run_table(rig, &result, false);
    assert_true(json_is_false(json_object_get(first, "interrupted")));
    assert_int_equal(json_array_size(json_object_get(first, "cells")), 4);
    assert_int_equal(resumed_rows(first), 0);
    assert_false(tells_of_earlier_run(&result));
    rg_result_free(&result);

    json_t *second = run_table(rig, &result, false);
    assert_int_equal(rg_result_first_missing(&result), 2);
    assert_int_equal(resumed_rows(second), 1);
    for (size_t i = 0; i < 2; i++)
        assert_true(json_equal(cell_at(first, i), cell_at(second, i)));
    assert_true(tells_of_earlier_run(&result));
    rg_result_free(&result);
    json_decref(first);
    json_decref(second);
}

static const json_t *samples_of(const json_t *json, size_t cell)
{
    return json_object_get(json_object_get(cell_at(json, cell), "measured"), "samples_ms");
}

// The first row has some of its samples when the second interrupts the run, which prints no row.
// The next run takes those samples and measures the others.
static void test_goes_on(void **state)
{
    struct rig *rig = *state;
    struct rg_result result;
    char path[128];
    rig->interrupts = rig->is_last = true;
    json_t *first = run_table(rig, &result, false);
    rig->interrupts = false;
    assert_int_equal(rg_interrupt_signal(), SIGINT);
    assert_true(json_is_true(json_object_get(first, "interrupted")));
    assert_int_equal(json_array_size(json_object_get(first, "cells")), 0);
    rg_result_free(&result);
    json_decref(first);

    snprintf(path, sizeof(path), "%s/test-quick.journal", folder);
    json_t *kept = json_load_file(path, 0, NULL);
    assert_int_equal(json_array_size(json_object_get(kept, "cells")), 2);
    struct rg_stored stored = {0};
    assert_true(rg_stored_read(&stored, path)); // it holds no row that could be printed
    assert_int_equal(rg_result_first_missing(&stored.results[0]), 0);
    rg_stored_free(&stored);
    begin(rig, &result, 1);
    struct rg_journal *journal = rg_journal_open(&result, folder, false, true);
    assert_true(rg_journal_has_part(journal, 0) && !rg_journal_has(journal, 0));
    assert_false(rg_journal_has_part(journal, 1));
    rg_journal_close(journal);
    rg_result_free(&result);

    json_t *second = run_table(rig, &result, false);
    assert_int_equal(resumed_rows(second), 1);
    for (size_t i = 0; i < 2; i++) {
        const json_t *some = samples_of(kept, i), *all = samples_of(second, i);
        const struct rg_place at = {.variant = (int)i};
        assert_int_equal(json_array_size(all), rg_result_at(&result, at)->wanted_samples);
        assert_int_equal(json_array_size(some), (json_array_size(all) + 2) / 3);
        for (size_t k = 0; k < json_array_size(some); k++)
            assert_true(json_equal(json_array_get(some, k), json_array_get(all, k)));
    }
    rg_result_free(&result);
    json_decref(kept);
    json_decref(second);
}

// A row with an error is measured again; --fresh takes nothing.
static void test_keeps_no_errors(void **state)
{
    struct rig *rig = *state;
    struct rg_result result;
    json_t *first = run_table(rig, &result, false);
    assert_int_equal(rig->messages, 2); // the second row's two variants
    rg_result_free(&result);
    json_t *second = run_table(rig, &result, false);
    assert_int_equal(rig->messages, 2);
    assert_int_equal(resumed_rows(second), 1);
    rg_result_free(&result);
    json_t *third = run_table(rig, &result, true);
    assert_int_equal(resumed_rows(third), 0);
    rg_result_free(&result);
    json_decref(first);
    json_decref(second);
    json_decref(third);
}

// --- files that are no journal of this run ---

// The journal's JSON, of a run whose second row could not be opened.
static json_t *make_journal(struct rig *rig, char path[128])
{
    struct rg_result result;
    json_t *printed = run_table(rig, &result, true);
    rg_result_free(&result);
    snprintf(path, 128, "%s/test-quick.journal", folder);
    json_t *json = json_load_file(path, 0, NULL);
    // A cell in it is the same as in the printed result.
    char *text = json_dumps(cell_at(printed, 1), RG_JSON_FLAGS);
    json_t *cell = json_loads(text, 0, NULL);
    assert_true(json_equal(cell_at(json, 1), cell));
    json_decref(cell);
    free(text);
    json_decref(printed);
    return json;
}

// The number of rows that a run of these rows takes from the journal; it logs this many messages.
static int taken(struct rig *rig, int last_row, int messages)
{
    struct rg_result result;
    int count = 0;
    begin(rig, &result, last_row);
    rig->messages = 0;
    rg_log_listen(hear, rig);
    struct rg_journal *journal = rg_journal_open(&result, folder, false, false);
    for (int row = 0; row <= last_row; row++) {
        assert_true(rg_table_add_row(&result, &table, row));
        count += rg_journal_take(journal, &result, row);
    }
    rg_log_listen(NULL, NULL);
    assert_int_equal(rig->messages, messages);
    rg_result_free(&result);
    rg_journal_close(journal);
    return count;
}

static bool is_of_others(struct rig *rig, int last_row)
{
    struct rg_result result;
    begin(rig, &result, last_row);
    rg_log_listen(hear, rig);
    struct rg_journal *journal = rg_journal_open(&result, folder, false, false);
    rg_log_listen(NULL, NULL);
    const bool is_others = rg_journal_is_of_others(journal);
    rg_journal_close(journal);
    rg_result_free(&result);
    return is_others;
}

// Writes the journal with a field of an object changed, and counts the rows that are taken.
static int taken_with(struct rig *rig, json_t *journal, const char *path, json_t *object,
                      const char *field, json_t *value, int messages)
{
    json_t *kept = json_incref(json_object_get(object, field));
    assert_non_null(kept);
    json_object_set_new(object, field, value);
    // The checksum shows any change. With a new checksum, only the key shows it.
    assert_int_equal(0, json_dump_file(journal, path, RG_JSON_FLAGS));
    assert_int_equal(taken(rig, 1, 1), 0);
    assert_true(rg_seal(journal));
    assert_int_equal(0, json_dump_file(journal, path, RG_JSON_FLAGS));
    const int count = taken(rig, 1, messages);
    json_object_set_new(object, field, kept);
    return count;
}

static void test_other_runs(void **state)
{
    struct rig *rig = *state;
    char path[128];
    json_t *json = make_journal(rig, path);
    assert_int_equal(taken(rig, 1, 0), 1);
    assert_int_equal(taken(rig, 0, 1), 0); // other rows
    assert_false(is_of_others(rig, 1));
    assert_true(is_of_others(rig, 0)); // so that a run with a fallen driver spares it
    static const char *const fields[] = {"technique", "truth", "quick", "note"};
    for (int i = 0; i < 4; i++)
        assert_int_equal(taken_with(rig, json, path, json, fields[i], json_string("another"), 1),
                         0);
    assert_int_equal(taken_with(rig, json, path, json, "length", json_string("full"), 1), 0);
    json_t *passport = json_object_get(json, "passport");
    json_t *build = json_object_get(passport, "raingauge");
    assert_int_equal(taken_with(rig, json, path, build, "program", json_string("0123"), 1), 0);
    assert_int_equal(taken_with(rig, json, path, passport, "machine", json_object(), 1), 0);
    // A row with other settings is not taken, whoever wrote it.
    json_t *cell = json_array_get(json_object_get(json, "cells"), 1);
    assert_int_equal(taken_with(rig, json, path, cell, "set", json_string("drops=1"), 0), 0);
    assert_true(rg_seal(json));
    assert_int_equal(0, json_dump_file(json, path, RG_JSON_FLAGS));
    assert_int_equal(taken(rig, 1, 0), 1);
    json_decref(json);
}

// Each row, and each of its variants, is taken as itself.
static void test_rows_stay_apart(void **state)
{
    struct rig *rig = *state;
    struct rg_result first, second;
    begin(rig, &first, 1);
    begin(rig, &second, 1);
    struct rg_journal *journal = rg_journal_open(&first, folder, true, true);
    double ms = 0;
    for (int row = 0; row < 2; row++) {
        assert_true(rg_table_add_row(&first, &table, row));
        assert_true(rg_table_add_row(&second, &table, row));
        for (struct rg_place at = rg_result_start_row(row); rg_result_next_in_row(&first, &at);) {
            rg_result_at(&first, at)->create_ms = ++ms;
            rg_result_at(&first, at)->sample_count = 1; // a record without samples is not kept
        }
    }
    rg_journal_add(journal, &first, 0, 1);
    for (int row = 1; row >= 0; row--) {
        assert_true(rg_journal_take(journal, &second, row));
        for (struct rg_place at = rg_result_start_row(row); rg_result_next_in_row(&second, &at);)
            assert_equals(rg_result_at(&second, at)->create_ms,
                          rg_result_at(&first, at)->create_ms);
    }
    rg_journal_remove(journal);
    rg_journal_close(journal);
    rg_result_free(&first);
    rg_result_free(&second);
}

// A table whose axis has another value, or print another number, takes no row of the first.
static void test_other_values(void **state)
{
    struct rig *rig = *state;
    char path[128];
    json_decref(make_journal(rig, path));
    static const double changed[][2] = {{1, 160}, {3, 160}, {1, 170}};
    for (int i = 0; i < 3; i++) {
        struct rg_table_row others[2] = {rows[0], rows[1]};
        struct rg_table other = table;
        struct rg_result result;
        memcpy(others[0].values, changed[i], sizeof(changed[i]));
        other.rows = others;
        begin(rig, &result, 1);
        struct rg_journal *journal = rg_journal_open(&result, folder, false, false);
        assert_true(rg_table_add_row(&result, &other, 0));
        assert_int_equal(rg_journal_take(journal, &result, 0), i == 0);
        rg_result_free(&result);
        rg_journal_close(journal);
    }
}

// A row that is copied over another, and a number that is changed, are sound JSON of this run.
static void test_changes(void **state)
{
    struct rig *rig = *state;
    char path[128];
    json_t *json = make_journal(rig, path);
    assert_int_equal(taken(rig, 1, 0), 1);
    json_t *cells = json_object_get(json, "cells");
    json_t *second = json_incref(json_array_get(cells, 1));
    json_t *changed = json_deep_copy(json_array_get(cells, 0));
    json_array_set_new(cells, 1, changed);
    assert_int_equal(0, json_dump_file(json, path, RG_JSON_FLAGS));
    assert_int_equal(taken(rig, 1, 1), 0);
    changed = json_deep_copy(second);
    json_object_set_new(changed, "expected_fps", json_real(1e9));
    json_array_set_new(cells, 1, changed);
    assert_int_equal(0, json_dump_file(json, path, RG_JSON_FLAGS));
    assert_int_equal(taken(rig, 1, 1), 0);
    json_array_set(cells, 1, second);
    assert_int_equal(0, json_dump_file(json, path, RG_JSON_FLAGS));
    assert_int_equal(taken(rig, 1, 0), 1);
    json_object_del(json, "checksum");
    assert_int_equal(0, json_dump_file(json, path, RG_JSON_FLAGS));
    assert_int_equal(taken(rig, 1, 1), 0);
    json_decref(second);
    json_decref(json);
}

static void test_damage(void **state)
{
    struct rig *rig = *state;
    char path[128];
    json_t *json = make_journal(rig, path);
    char *text = json_dumps(json, 0);
    // Cut anywhere, it is no journal, and does no harm.
    for (size_t length = 0; length < strlen(text); length += 1 + strlen(text) / 16) {
        FILE *file = fopen(path, "w");
        fwrite(text, 1, length, file);
        fclose(file);
        assert_int_equal(taken(rig, 1, 1), 0);
    }
    free(text);
    json_decref(json);
}

// --- the journal's file ---

static int files_in(const char *path)
{
    DIR *dir = opendir(path);
    int count = 0;
    for (struct dirent *entry = dir ? readdir(dir) : NULL; entry; entry = readdir(dir))
        count += entry->d_name[0] != '.';
    if (dir)
        closedir(dir);
    return count;
}

// A journal that cannot be written has no file that a run could go on from.
static void test_unwritten(void **state)
{
    struct rig *rig = *state;
    struct rg_result result;
    begin(rig, &result, 0);
    rig->messages = 0;
    rg_log_listen(hear, rig);
    struct rg_journal *journal = rg_journal_open(&result, "/dev/null/no folder", true, true);
    assert_true(rg_table_measure(&result, &table, &rig->kept, journal, NULL, NULL));
    rg_log_listen(NULL, NULL);
    assert_null(rg_journal_path(journal));
    assert_int_equal(rig->messages, 1);
    rg_journal_close(journal);
    rg_result_free(&result);
}

// A run that ends keeps its rows only if other tables follow; then they are removed.
static void test_leaves_nothing(void **state)
{
    struct rig *rig = *state;
    for (int is_followed = 0; is_followed < 2; is_followed++) {
        struct rg_result result;
        begin(rig, &result, 0);
        struct rg_journal *journal = rg_journal_open(&result, folder, false, is_followed);
        assert_true(rg_table_measure(&result, &table, &rig->kept, journal, NULL, NULL));
        assert_int_equal(files_in(folder), is_followed);
        assert_int_equal(rg_journal_path(journal) != NULL, is_followed);
        rg_journal_remove(journal);
        assert_int_equal(files_in(folder), 0);
        rg_journal_close(journal);
        rg_result_free(&result);
    }
}

static void test_quick_settings(void **state)
{
    struct rig *rig = *state;
    struct rg_result result;
    const struct rg_place bare = {.variant = 1};
    begin(rig, &result, 0);
    char *quick = rg_table_assignments(&result, &table, bare);
    result.full = true;
    char *full = rg_table_assignments(&result, &table, bare);
    assert_string_equal(quick, CHEAP " drops=40 pane_rain_mm_h=0 drops=25");
    assert_string_equal(full, CHEAP " drops=40 pane_rain_mm_h=0");
    free(quick);
    free(full);
    result.full = false;
    assert_true(rg_table_measure(&result, &table, &rig->kept, NULL, NULL, NULL));
    assert_equals(rg_result_at(&result, bare)->counters[0].value, 25); // drops that landed
    rg_result_free(&result);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(test_resumes),        TEST(test_goes_on),         TEST(test_keeps_no_errors),
        TEST(test_other_runs),     TEST(test_rows_stay_apart), TEST(test_other_values),
        TEST(test_changes),        TEST(test_damage),          TEST(test_unwritten),
        TEST(test_leaves_nothing), TEST(test_quick_settings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
