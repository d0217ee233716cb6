// The records of a gate's shards, written and put together: all of them tell what one gate tells,
// in its order, and records of two gates are kept apart.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/compare/gate/run/running.h"
#include "harness/compare/gate/shards/shards.h"
#include "harness/console/exit.h"
#include "tests/harness/gate/cells/read.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"

// A stand-in: B of both pairs has fixed functions.
bool rg_gate_has_fixed(const struct rg_baseline *baseline, const struct rg_gate_pair *pair)
{
    (void)baseline;
    (void)pair;
    return true;
}

static const char text_of_cells[] = "one raster 16x16 1\ntwo raster 16x16 1\nsix raster 16x16 1\n";
static struct rg_known known;
static const struct rg_gate_pairs pairs = {.count = 2, .all = {{{"cpu", "gl"}}, {{"gl", "vk"}}}};
static const struct rg_gate_inputs inputs = {"b", "e", "t"};

static int set_up(void **state)
{
    return make_folder(state) || read_cells(text_of_cells);
}

static void path_of(int number, char path[128])
{
    snprintf(path, 128, "%s/gate-%d-of-3.json", folder, number);
}

static void forget(void)
{
    char path[128];
    for (int i = 1; i <= 3; i++) {
        path_of(i, path);
        unlink(path);
    }
}

static int tear_down(void **state)
{
    forget();
    rg_gate_cells_free(&cells);
    return remove_folder(state);
}

// --- a gate ---

static struct rg_gate_request request_of(int number, int count)
{
    return (struct rg_gate_request){.cells = &cells,
                                    .pairs = &pairs,
                                    .known = &known,
                                    .margin = 0.05,
                                    .left = {2, {"opencl", "cpu"}},
                                    .shard = {number, count}};
}

// A cell's place decides its result: some fail, one of them on the other side.
static void fill(struct rg_gate_case *c)
{
    c->is_compared = true;
    c->seconds = c->place + 0.25;
    snprintf(c->driver, sizeof(c->driver), "Mesa %s", rg_gate_case_device(c));
    c->agreement.outcome = c->place % 3 == 1 ? RG_FAIL : c->place == 6 ? RG_CRASH : RG_OK;
    c->agreement.device = c->place == 6 ? c->devices[0] : NULL;
    c->agreement.pixels = c->place % 3 == 1 ? c->place : NAN;
    c->agreement.difference = c->place % 3 == 1 ? 0.5 : NAN;
}

// Adds what fixed functions leave, as rg_gate_hold_fixed does.
static void add_fixed(struct rg_gate *gate, const char *device)
{
    static const char *const names[] = {"fixed/linear", "fixed"};
    for (int i = 0; i < 2; i++) {
        char *name = rg_gate_case_name(names[i], device);
        assert_true(rg_report_add(&gate->report, &(struct rg_report_case){.name = name,
                                                                          .technique = "fixed",
                                                                          .devices = &device,
                                                                          .device_count = 1,
                                                                          .ending = RG_ENDING_PASS,
                                                                          .is_compared = true,
                                                                          RG_UNMEASURED}));
        free(name);
    }
    gate->results[gate->result_count++] = (struct rg_known_result){.cell = "fixed/linear",
                                                                   .device = device,
                                                                   .driver = "Mesa",
                                                                   .outcome = RG_OK,
                                                                   .pixels = NAN,
                                                                   .difference = NAN};
}

static void run(const struct rg_gate_request *request, struct rg_gate *gate)
{
    struct rg_running_gate running = {.asked = request, .gate = gate};
    *gate = (struct rg_gate){.results = NULL};
    assert_true(rg_gate_choose(&running));
    for (int i = 0; i < gate->case_count; i++)
        fill(&gate->cases[i]);
    assert_true(rg_gate_report(request, gate));
    for (int pair = 0; pair < pairs.count; pair++)
        if (running.sides[pair * RG_SIDES + RG_SIDE_B].has_fixed)
            add_fixed(gate, pairs.all[pair].names[RG_SIDE_B]);
    assert_true(rg_report_set_passport(&gate->report, "{\"devices\": []}"));
    gate->note = strdup(request->shard.number == 2 ? "A  cpu\nB  vk\n" : "A  cpu\nB  gl\n");
}

static void write_shards(int exit_of_second)
{
    forget();
    for (int number = 1; number <= 3; number++) {
        const struct rg_gate_request request = request_of(number, 3);
        struct rg_gate gate;
        run(&request, &gate);
        assert_true(rg_gate_part_write(&request, &inputs, &gate,
                                       number == 2 ? exit_of_second : RG_EXIT_PASS, folder));
        rg_gate_free(&gate);
    }
}

// --- all together ---

static void assert_results(const struct rg_gate *is, const struct rg_gate *due)
{
    assert_int_equal(is->result_count, due->result_count);
    for (int64_t i = 0; i < due->result_count; i++) {
        const struct rg_known_result *a = &is->results[i], *b = &due->results[i];
        assert_string_equal(a->cell, b->cell);
        assert_string_equal(a->device, b->device);
        assert_string_equal(a->driver ? a->driver : "none", b->driver ? b->driver : "none");
        assert_int_equal(a->outcome, b->outcome);
        assert_int_equal(a->is_foreign, b->is_foreign);
        assert_true(isnan(b->pixels) ? isnan(a->pixels) : a->pixels == b->pixels);
        assert_true(isnan(b->difference) ? isnan(a->difference) : a->difference == b->difference);
    }
}

static void shards_tell_what_one_gate_tells(void **state)
{
    (void)state;
    const struct rg_gate_request request = request_of(1, 1);
    struct rg_gate whole, merged = {.results = NULL};
    struct rg_parts parts = {.count = 0};
    run(&request, &whole);
    assert_int_equal(whole.report.case_count, 10);
    write_shards(RG_EXIT_HARNESS);
    assert_true(rg_parts_read(&parts, "gate", folder));
    assert_true(parts.count == 3 && !parts.missing);
    assert_true(rg_gate_merge(&parts, &merged));
    assert_int_equal(merged.beyond, RG_EXIT_HARNESS);
    assert_int_equal(merged.chosen, 8);
    assert_true(merged.is_told);
    assert_string_equal(merged.note, "A  cpu\nB  gl\nB  vk\n");
    assert_string_equal(merged.report.passport, "{\"devices\": []}");
    assert_string_equal(rg_json_text_of(parts.of, "expectations"), "e");
    assert_int_equal(merged.report.case_count, whole.report.case_count);
    for (int i = 0; i < whole.report.case_count; i++) {
        const struct rg_report_case *a = &merged.report.cases[i], *b = &whole.report.cases[i];
        assert_string_equal(a->name, b->name);
        assert_int_equal(a->ending, b->ending);
        assert_true(a->is_compared == b->is_compared && a->seconds == b->seconds);
    }
    assert_results(&merged, &whole);
    rg_gate_free(&merged);
    rg_gate_free(&whole);
    rg_parts_free(&parts);
}

// Where a shard is missing, the others are told.
static void a_shard_that_is_missing_leaves_the_others(void **state)
{
    (void)state;
    struct rg_gate merged = {.results = NULL};
    struct rg_parts parts = {.count = 0};
    char path[128];
    write_shards(RG_EXIT_PASS);
    path_of(1, path);
    assert_int_equal(unlink(path), 0);
    assert_true(rg_parts_read(&parts, "gate", folder));
    assert_int_equal(parts.missing, 1);
    assert_true(rg_gate_merge(&parts, &merged));
    assert_int_equal(merged.beyond, RG_EXIT_PASS);
    assert_string_equal(merged.report.cases[0].name, "two.gl");
    assert_string_equal(merged.results[0].cell, "two"); // what was left out stands in the first
    rg_gate_free(&merged);
    rg_parts_free(&parts);
}

// --- records of two gates ---

// Makes the second shard that of another gate.
static void spoil(int what, struct rg_gate_request *request, struct rg_gate_inputs *other,
                  struct rg_gate_cells *others, struct rg_gate_pairs *other_pairs)
{
    switch (what) {
    case 0:
        request->margin = 0.06;
        break;
    case 1:
        request->filter = "*";
        break;
    case 2:
        request->pictures_only = true;
        break;
    case 3:
        request->strict = true;
        break;
    case 4:
        request->require = "gl";
        break;
    case 5:
        snprintf(other->baseline, RG_DIGEST_SIZE, "x");
        break;
    case 6:
        snprintf(other->expectations, RG_DIGEST_SIZE, "x");
        break;
    case 7:
        snprintf(other->times, RG_DIGEST_SIZE, "x");
        break;
    case 8:
        others->cells[2].frames++;
        break;
    case 9:
        snprintf(other_pairs->all[1].names[RG_SIDE_A], RG_DEVICE_NAME_SIZE, "opencl");
        break;
    default:
        snprintf(others->cells[2].name, RG_GATE_NAME_SIZE, "seven");
    }
}

static void records_of_two_gates_are_not_put_together(void **state)
{
    (void)state;
    static const char *const names[] = {"margin",  "filter",   "pictures",     "strict",
                                        "require", "baseline", "expectations", "times",
                                        "cells",   "pairs",    "cells"};
    for (int i = 0; i < (int)(sizeof(names) / sizeof(names[0])); i++) {
        struct rg_gate_request request = request_of(2, 3);
        struct rg_gate_inputs other = inputs;
        struct rg_gate_pairs other_pairs = pairs;
        struct rg_gate_cells others;
        struct rg_parts parts = {.count = 0};
        struct rg_gate gate;
        char due[80];
        write_shards(RG_EXIT_PASS);
        assert_true(rg_gate_cells_of("cells", text_of_cells, strlen(text_of_cells), &others));
        request.cells = &others;
        request.pairs = &other_pairs;
        spoil(i, &request, &other, &others, &other_pairs);
        run(&request, &gate);
        assert_true(rg_gate_part_write(&request, &other, &gate, RG_EXIT_PASS, folder));
        logged_lines = 0;
        assert_false(rg_parts_read(&parts, "gate", folder));
        snprintf(due, sizeof(due), ": its %s is not that of ", names[i]);
        if (logged_lines != 1 || !strstr(logged, due))
            fail_msg("%d: %s", i, logged);
        rg_parts_free(&parts);
        rg_gate_free(&gate);
        rg_gate_cells_free(&others);
    }
}

// --- what a gate reads ---

static void add_known(struct rg_known *to, const char *text, enum rg_known_form form)
{
    assert_true(rg_known_add_text(to, "known", text, strlen(text), form));
}

static void expectations_have_a_digest_of_all_files_and_their_forms(void **state)
{
    (void)state;
    static const struct {
        const char *first, *second;
        enum rg_known_form form;
        bool is_same;
    } rows[] = {
        {"a#1\n", "b#2\n", RG_FORM_FLAKES, true},  {"a#1\n", "b#2\n", RG_FORM_SKIPS, false},
        {"b#2\n", "a#1\n", RG_FORM_FLAKES, false}, {"a#1\nb#2\n", "", RG_FORM_FLAKES, false},
        {"a#1\n", "b#3\n", RG_FORM_FLAKES, false}, {"a#1\n", "", RG_FORM_FLAKES, false}};
    char first[RG_DIGEST_SIZE], other[RG_DIGEST_SIZE];
    struct rg_known none = {.count = 0};
    rg_gate_digest_known(&none, first);
    assert_string_equal(first, "");
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_known read = {.count = 0};
        add_known(&read, rows[i].first, RG_FORM_FLAKES);
        add_known(&read, rows[i].second, rows[i].form);
        rg_gate_digest_known(&read, i ? other : first);
        if (i && !strcmp(first, other) != rows[i].is_same)
            fail_msg("row %zu", i);
        rg_known_free(&read);
    }
}

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static void times_of_an_earlier_gate_are_read_by_name(void **state)
{
    (void)state;
    char path[128], digest[RG_DIGEST_SIZE], due[RG_DIGEST_SIZE];
    static const char text[] =
        "{\"gated\": [{\"name\": \"a\", \"seconds\": 1.5}, {\"name\": \"b\", "
        "\"seconds\": 0}, {\"name\": \"c\", \"seconds\": 7}, {}]}";
    path_of(1, path);
    write_text(path, text);
    json_t *times = rg_gate_times_read(path);
    assert_int_equal(json_object_size(times), 2);
    assert_true(json_number_value(json_object_get(times, "a")) == 1.5);
    assert_true(json_number_value(json_object_get(times, "c")) == 7);
    json_decref(times);
    assert_true(rg_gate_digest_file(path, digest));
    rg_digest_of(text, strlen(text), due);
    assert_string_equal(digest, due);
    write_text(path, "{\"gated\": 7}");
    logged_lines = 0;
    assert_null(rg_gate_times_read(path));
    assert_true(logged_lines == 1 && strstr(logged, ".json: is no record of a gate; name what"));
    write_text(path, "no JSON");
    assert_null(rg_gate_times_read(path));
    assert_true(logged_lines == 2 && strstr(logged, ".json: line 1 is no JSON"));
    unlink(path);
    assert_false(rg_gate_digest_file(path, digest));
    assert_non_null(strstr(logged, "; name a file that can be read"));
}

int main(void)
{
    rg_log_listen(log_last, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shards_tell_what_one_gate_tells),
        cmocka_unit_test(a_shard_that_is_missing_leaves_the_others),
        cmocka_unit_test(records_of_two_gates_are_not_put_together),
        cmocka_unit_test(expectations_have_a_digest_of_all_files_and_their_forms),
        cmocka_unit_test(times_of_an_earlier_gate_are_read_by_name),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
