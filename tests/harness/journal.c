// A table that is interrupted, and goes on: what its journal keeps, and what it does not.
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
#include "harness/record/journal.h"

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
    .variants = {{"full", "", "fps"}, {"bare", "rain_drops_s=0", NULL}},
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
    char folder[64];
    struct rg_devices devices;
    struct rg_kept kept;
    int messages;
    bool interrupts; // at the first message, which is about the second row's file
};

static int setup(void **state)
{
    struct rig *rig = calloc(1, sizeof(*rig));
    snprintf(rig->folder, sizeof(rig->folder), "/tmp/raingauge-test-XXXXXX");
    rig->devices = (struct rg_devices){.count = 1, .devices = {rg_device_open("cpu")}};
    rig->kept.devices = &rig->devices;
    rg_interrupt_watch();
    *state = rig;
    return mkdtemp(rig->folder) && rig->devices.devices[0] ? 0 : -1;
}

static int teardown(void **state)
{
    struct rig *rig = *state;
    const bool clean = rg_kept_free(&rig->kept) && rg_device_close(rig->devices.devices[0]);
    char path[128];
    snprintf(path, sizeof(path), "%s/test-quick.journal", rig->folder);
    unlink(path);
    const bool empty = rmdir(rig->folder) == 0;
    free(rig);
    return clean && empty ? 0 : -1;
}

static void hear(enum rg_log_level level, const char *line, void *user)
{
    struct rig *rig = user;
    (void)level;
    (void)line;
    if (!rig->messages++ && rig->interrupts)
        raise(SIGINT);
}

// Runs the table with its journal, which stays on disk, and returns its JSON. Other tables follow,
// so that all rows are kept.
static json_t *run_table(struct rig *rig, struct rg_table_run *run, bool fresh)
{
    *run = (struct rg_table_run){.table = &table, .devices = &rig->devices, .last_row = 1};
    rig->messages = 0;
    rg_interrupt_watch();
    rg_log_listen(hear, rig);
    struct rg_journal *journal = rg_journal_open(run, rig->folder, fresh, true);
    assert_true(rg_table_measure(run, &rig->kept, journal));
    rg_log_listen(NULL, NULL);
    rg_journal_close(journal);
    return rg_table_json(run);
}

static const json_t *cell_at(const json_t *json, size_t cell)
{
    return json_array_get(json_object_get(json, "cells"), cell);
}

static int resumed_rows(const json_t *json)
{
    return (int)json_integer_value(json_object_get(json, "resumed_rows"));
}

// The first row is whole when the second interrupts the run; the next run takes it to the last
// digit.
static void test_resumes(void **state)
{
    struct rig *rig = *state;
    struct rg_table_run run;
    rig->interrupts = true;
    json_t *first = run_table(rig, &run, false);
    assert_int_equal(rg_interrupt_signal(), SIGINT);
    assert_int_equal(rg_table_first_missing(&run), 1);
    assert_true(json_is_true(json_object_get(first, "interrupted")));
    assert_int_equal(json_array_size(json_object_get(first, "cells")), 2);
    assert_int_equal(resumed_rows(first), 0);
    rg_table_run_free(&run);

    rig->interrupts = false;
    json_t *second = run_table(rig, &run, false);
    assert_int_equal(rg_table_first_missing(&run), 2);
    assert_true(json_is_false(json_object_get(second, "interrupted")));
    assert_int_equal(json_array_size(json_object_get(second, "cells")), 4);
    assert_int_equal(resumed_rows(second), 1);
    for (size_t i = 0; i < 2; i++)
        assert_true(json_equal(cell_at(first, i), cell_at(second, i)));
    struct rg_sheet sheet;
    rg_table_sheet(&run, &sheet);
    bool is_told = false;
    for (int n = 0; n < sheet.note_count; n++)
        is_told =
            is_told || strstr(sheet.notes[n], "1 were measured by a run that was interrupted");
    assert_true(is_told);
    rg_sheet_free(&sheet);
    rg_table_run_free(&run);
    json_decref(first);
    json_decref(second);
}

// A row with an error is measured again; --fresh takes nothing.
static void test_keeps_no_errors(void **state)
{
    struct rig *rig = *state;
    struct rg_table_run run;
    json_t *first = run_table(rig, &run, false);
    assert_int_equal(rig->messages, 2); // the second row's two variants
    rg_table_run_free(&run);
    json_t *second = run_table(rig, &run, false);
    assert_int_equal(rig->messages, 2);
    assert_int_equal(resumed_rows(second), 1);
    rg_table_run_free(&run);
    json_t *third = run_table(rig, &run, true);
    assert_int_equal(resumed_rows(third), 0);
    rg_table_run_free(&run);
    json_decref(first);
    json_decref(second);
    json_decref(third);
}

// --- what is no journal of this run ---

// The journal's JSON, of a run that ended in the second row.
static json_t *make_journal(struct rig *rig, char path[128])
{
    struct rg_table_run run;
    rig->interrupts = true;
    json_decref(run_table(rig, &run, true));
    rig->interrupts = false;
    rg_table_run_free(&run);
    snprintf(path, 128, "%s/test-quick.journal", rig->folder);
    json_t *json = json_load_file(path, 0, NULL);
    assert_non_null(json);
    return json;
}

// How many rows a run of these rows takes from the journal, and with how many messages.
static int taken(struct rig *rig, int last_row, int messages)
{
    struct rg_table_run run = {.table = &table, .devices = &rig->devices, .last_row = last_row};
    int count = 0;
    run.cells = calloc(4, sizeof(*run.cells));
    run.groups = calloc(4, sizeof(*run.groups));
    run.cell_count = 2 * (last_row + 1);
    rig->messages = 0;
    rg_log_listen(hear, rig);
    struct rg_journal *journal = rg_journal_open(&run, rig->folder, false, false);
    for (int row = 0; row <= last_row; row++)
        count += rg_journal_take(journal, &run, row);
    rg_log_listen(NULL, NULL);
    assert_int_equal(rig->messages, messages);
    rg_table_run_free(&run);
    rg_journal_close(journal);
    return count;
}

static void test_other_keys(void **state)
{
    struct rig *rig = *state;
    char path[128];
    json_t *json = make_journal(rig, path), *key = json_object_get(json, "key");
    assert_int_equal(taken(rig, 1, 0), 1);
    assert_int_equal(taken(rig, 0, 1), 0); // other rows
    static const char *const fields[] = {"settings", "program", "passport", "truth", "length"};
    for (int i = 0; i < 5; i++) {
        json_t *kept = json_incref(json_object_get(key, fields[i]));
        assert_non_null(kept);
        json_object_set_new(key, fields[i], json_string("another"));
        assert_int_equal(0, json_dump_file(json, path, 0));
        assert_int_equal(taken(rig, 1, 1), 0);
        json_object_set_new(key, fields[i], kept);
    }
    assert_int_equal(0, json_dump_file(json, path, 0));
    assert_int_equal(taken(rig, 1, 0), 1);
    json_decref(json);
}

static void test_damage(void **state)
{
    struct rig *rig = *state;
    char path[128];
    json_t *json = make_journal(rig, path);
    char *text = json_dumps(json, 0);
    // Cut anywhere, it is no journal, and harms nothing.
    for (size_t length = 0; length < strlen(text); length += 1 + strlen(text) / 16) {
        FILE *file = fopen(path, "w");
        fwrite(text, 1, length, file);
        fclose(file);
        assert_int_equal(taken(rig, 1, 1), 0);
    }
    free(text);
    // A row with a field of another kind is left out.
    json_t *cell = json_array_get(
        json_object_get(json_object_get(json_object_get(json, "rows"), "0"), "cells"), 1);
    const char *field;
    json_t *value, *copy = json_deep_copy(cell);
    json_object_foreach(copy, field, value)
    {
        json_object_set_new(cell, field, json_true());
        assert_int_equal(0, json_dump_file(json, path, 0));
        assert_int_equal(taken(rig, 1, 1), 0);
        json_object_set(cell, field, value);
    }
    json_array_set_new(json_object_get(cell, "samples_ms"), 0, json_real(-1));
    assert_int_equal(0, json_dump_file(json, path, 0));
    assert_int_equal(taken(rig, 1, 1), 0);
    json_decref(copy);
    json_decref(json);
}

// --- where it is ---

static int files_in(const char *folder)
{
    DIR *dir = opendir(folder);
    int count = 0;
    for (struct dirent *entry = dir ? readdir(dir) : NULL; entry; entry = readdir(dir))
        count += entry->d_name[0] != '.';
    if (dir)
        closedir(dir);
    return count;
}

// A run that ends has nothing to keep but for tables that follow; what is done is removed.
static void test_leaves_nothing(void **state)
{
    struct rig *rig = *state;
    for (int is_followed = 0; is_followed < 2; is_followed++) {
        struct rg_table_run run = {.table = &table, .devices = &rig->devices};
        struct rg_journal *journal = rg_journal_open(&run, rig->folder, false, is_followed);
        assert_true(rg_table_measure(&run, &rig->kept, journal));
        assert_int_equal(files_in(rig->folder), is_followed);
        assert_int_equal(rg_journal_path(journal) != NULL, is_followed);
        rg_journal_remove(journal);
        assert_int_equal(files_in(rig->folder), 0);
        rg_journal_close(journal);
        rg_table_run_free(&run);
    }
}

static void test_quick_settings(void **state)
{
    struct rig *rig = *state;
    struct rg_table_run run = {.table = &table, .devices = &rig->devices};
    char *quick = rg_table_assignments(&run, 0, 1);
    run.full = true;
    char *full = rg_table_assignments(&run, 0, 1);
    assert_string_equal(quick, CHEAP " drops=40 rain_drops_s=0 drops=25");
    assert_string_equal(full, CHEAP " drops=40 rain_drops_s=0");
    free(quick);
    free(full);
    run.full = false;
    assert_true(rg_table_measure(&run, &rig->kept, NULL));
    assert_true(rg_table_cell(&run, 0, 1, 0)->counters[0].value == 25); // drops that landed
    rg_table_run_free(&run);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(test_resumes), TEST(test_keeps_no_errors), TEST(test_other_keys),
        TEST(test_damage),  TEST(test_leaves_nothing),  TEST(test_quick_settings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
