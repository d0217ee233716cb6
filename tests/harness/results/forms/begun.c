// A table's result before it is measured has a head, the table's works and variants, and the rows
// with their settings and print.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/devices/measure/expected.h"
#include "harness/tables/papers/papers.h"
#include "harness/tables/table.h"
#include "tests/tools/expect.h"

static const struct rg_table_row rows[] = {{"drops=1", {16, 800, 12}, "small"},
                                           {"drops=2", {64, 700, 13}, "large"}};
static const struct rg_table table = {
    .id = "begun",
    .technique = "flow",
    .hardware = "an old machine",
    .names = "scene",
    .columns = {"resolution_px", "fps", "faces"},
    .key_count = 1,
    .variants = {{"full", "model=none", "fps"}, {"few", "seed=3", NULL}},
    .works = {{"paper", "move=paper", "", .reading = "six maps"},
              {"reading", "move=fast", "", .reading = "one map"},
              {"ours", "", "less is moved"},
              {"queries", "panes=glass", "", .elsewhere = "panes=mirror"}},
    .truth = "drops=9",
    .quick = "environment_px=16",
    .is_of_textures = true,
    .width = 640,
    .height = 480,
    .check_frames = 7,
    .row_count = 2,
    .rows = rows,
    .note = "a note",
};

static struct rg_device cpu = {.info = {.name = "cpu"}},
                        gl = {.info = {.name = "gl", .limits = {.has_queries = true}}};

static struct rg_result begin(const struct rg_table *of, struct rg_table_part part, bool has_gl)
{
    const struct rg_devices devices = {
        .count = has_gl ? 2 : 1,
        .devices = {&cpu, &gl},
        .absent_count = 2,
        .absent = {{"vulkan", RG_UNSUPPORTED, "vulkan: is not there"},
                   {"opencl", RG_ERROR, "opencl: its driver fails"}}};
    struct rg_result result = {0};
    rg_table_begin(&result, of, &part, &devices);
    return result;
}

static const struct rg_record *record_at(const struct rg_result *result, struct rg_place at)
{
    return rg_result_at(result, at);
}

// --- the head ---

static void a_head_has_what_its_table_has(void **state)
{
    (void)state;
    struct rg_result r =
        begin(&table, (struct rg_table_part){.first_row = 1, .last_row = 1, .set = "seed=2"}, true);
    assert_string_equal(r.table, "begun");
    assert_string_equal(r.technique, "flow");
    assert_string_equal(r.hardware, "an old machine");
    assert_string_equal(r.truth, "drops=9");
    assert_string_equal(r.quick, "environment_px=16");
    assert_string_equal(r.changed, "seed=2");
    assert_string_equal(r.note, "a note");
    assert_true(r.is_of_textures && !r.full);
    assert_int_equal(r.width, 640);
    assert_int_equal(r.height, 480);
    assert_int_equal(r.check_frames, 7);
    assert_int_equal(r.first_row, 1);
    assert_int_equal(r.last_row, 1);
    assert_int_equal(r.device_count, 2);
    assert_string_equal(r.devices[0].name, "cpu");
    assert_string_equal(r.devices[1].name, "gl");
    assert_int_equal(json_array_size(json_object_get(r.passport, "devices")), 2);
    assert_int_equal(r.missing_count, 2);
    assert_string_equal(r.missing[0], "vulkan: is not there");
    assert_string_equal(r.missing[1], "opencl: its driver fails");
    rg_result_free(&r);
    struct rg_table bare = table;
    bare.hardware = bare.truth = bare.quick = NULL;
    bare.check_frames = 0;
    bare.is_of_textures = false;
    r = begin(&bare, (struct rg_table_part){.last_row = 1, .full = true}, false);
    assert_string_equal(r.hardware, "");
    assert_string_equal(r.truth, "");
    assert_string_equal(r.quick, "");
    assert_string_equal(r.changed, "");
    assert_true(r.full && !r.is_of_textures);
    assert_int_equal(r.check_frames, RG_CHECK_FRAMES);
    rg_result_free(&r);
}

// RG_FEW_SAMPLES is for trying: full tables have all samples.
static void few_samples_are_for_quick_tables(void **state)
{
    (void)state;
    for (int few = 0; few < 2; few++)
        for (int full = 0; full < 2; full++) {
            if (few)
                setenv("RG_FEW_SAMPLES", "1", 1);
            struct rg_result r = begin(&table, (struct rg_table_part){.full = full}, false);
            unsetenv("RG_FEW_SAMPLES");
            assert_int_equal(r.few_samples, few && !full);
            rg_result_free(&r);
        }
}

// --- works and variants ---

// The API's own queries are counted by if a device has them, unless the work is to be done
// anywhere.
static void works_are_those_that_devices_can_do(void **state)
{
    (void)state;
    static const struct {
        bool has_gl, is_everywhere;
        const char *work, *due;
    } cases[] = {{false, false, NULL, "paper reading ours "},
                 {true, false, NULL, "paper reading ours queries "},
                 {true, true, NULL, "paper reading ours "},
                 {false, false, "ours", "ours "},
                 {false, false, "queries", "queries "}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        char names[128] = "";
        const struct rg_table_part part = {.work = cases[i].work,
                                           .is_everywhere = cases[i].is_everywhere};
        struct rg_result r = begin(&table, part, cases[i].has_gl);
        for (int w = 0; w < r.work_count; w++) {
            const size_t used = strlen(names);
            snprintf(names + used, sizeof(names) - used, "%s ", r.works[w].name);
            const bool is_ours = !strcmp(r.works[w].name, "ours");
            assert_string_equal(r.works[w].saves, is_ours ? "less is moved" : "");
            assert_string_equal(r.works[w].reading, !strcmp(r.works[w].name, "paper") ? "six maps"
                                                    : !strcmp(r.works[w].name, "reading")
                                                        ? "one map"
                                                        : "");
        }
        assert_string_equal(names, cases[i].due);
        rg_result_free(&r);
    }
}

static void a_variant_alone_is_itself(void **state)
{
    (void)state;
    struct rg_result r =
        begin(&table, (struct rg_table_part){.last_row = 1, .variant = "few"}, false);
    assert_int_equal(r.variant_count, 1);
    assert_string_equal(r.variants[0], "few");
    assert_true(rg_table_add_row(&r, &table, 1));
    const struct rg_record *record = record_at(&r, (struct rg_place){.row = 1, .work = 1});
    assert_string_equal(record->set, "drops=2 seed=3 move=fast environment_px=16");
    assert_string_equal(record->variant, "few");
    assert_string_equal(record->work, "reading");
    assert_int_equal(record->published_count, 1); // no rate of this variant
    rg_result_free(&r);
}

// --- rows ---

// Assignments follow each other: the row's, the variant's, the work's, quick mode's, the user's.
static void cells_are_described(void **state)
{
    (void)state;
    struct rg_result r =
        begin(&table, (struct rg_table_part){.last_row = 1, .set = "seed=2"}, true);
    assert_true(rg_table_add_row(&r, &table, 0) && rg_table_add_row(&r, &table, 1));
    const struct rg_record *cell =
        record_at(&r, (struct rg_place){.row = 1, .work = 3, .variant = 0, .device = 1});
    assert_string_equal(cell->set, "drops=2 model=none panes=glass environment_px=16 seed=2");
    assert_string_equal(cell->technique, "flow");
    assert_string_equal(cell->variant, "full");
    assert_string_equal(cell->work, "queries");
    assert_string_equal(cell->device.name, "gl");
    assert_int_equal(cell->row_count, 2);
    assert_string_equal(cell->row[0].name, "scene");
    assert_string_equal(cell->row[0].text, "large");
    assert_string_equal(cell->row[1].name, "resolution_px");
    assert_equals(cell->row[1].number, 64);
    assert_int_equal(cell->published_count, 2);
    assert_string_equal(cell->published[0].name, "fps");
    assert_equals(cell->published[0].number, 700);
    assert_string_equal(cell->published[1].name, "faces");
    assert_equals(cell->published[1].number, 13);
    cell = record_at(&r, (struct rg_place){.row = 0, .work = 2});
    assert_string_equal(cell->set, "drops=1 model=none environment_px=16 seed=2");
    assert_string_equal(cell->row[0].text, "small");
    rg_result_free(&r);
    r = begin(&table, (struct rg_table_part){.full = true}, false);
    assert_true(rg_table_add_row(&r, &table, 0));
    cell = record_at(&r, (struct rg_place){.row = 0});
    assert_string_equal(cell->set, "drops=1 model=none move=paper");
    rg_result_free(&r);
}

// Chin's only row: eight keys, of which four are choices, and two printed times.
static void choices_are_told_by_their_names(void **state)
{
    (void)state;
    const struct rg_table *chin = rg_table_find("chin-timing");
    struct rg_result r = begin(chin, (struct rg_table_part){.last_row = 0}, false);
    assert_true(rg_table_add_row(&r, chin, 0));
    const struct rg_record *cell = record_at(&r, (struct rg_place){0});
    assert_int_equal(cell->row_count, 8);
    assert_equals(cell->row[2].number, 0.5);
    assert_string_equal(cell->row[2].text, "");
    assert_string_equal(cell->row[4].name, "erode");
    assert_string_equal(cell->row[4].text, "on");
    assert_int_equal(cell->published_count, 2);
    assert_string_equal(cell->published[1].name, "ms_per_frame_max");
    assert_equals(cell->published[1].number, 31.8);
    rg_result_free(&r);
}

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    snprintf(user, 512, "%s", line);
}

// A record holds all assignments of its cell, or none.
static void settings_that_are_too_long_are_refused(void **state)
{
    (void)state;
    char set[RG_SET_SIZE], heard[512] = "";
    for (int more = 0; more < 2; more++) {
        const int room = RG_SET_SIZE - 1 - (int)strlen("drops=1 model=none move=paper ");
        memset(set, 'a', sizeof(set));
        set[room + more] = 0;
        struct rg_result r =
            begin(&table, (struct rg_table_part){.full = true, .work = "paper", .set = set}, false);
        rg_log_listen(hear, heard);
        assert_int_equal(rg_table_add_row(&r, &table, 0), !more);
        rg_log_listen(NULL, NULL);
        rg_result_free(&r);
    }
    assert_string_equal(heard,
                        "table 'begun': the settings of a row take more than 1023 bytes; set "
                        "less");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_head_has_what_its_table_has),
        cmocka_unit_test(few_samples_are_for_quick_tables),
        cmocka_unit_test(works_are_those_that_devices_can_do),
        cmocka_unit_test(a_variant_alone_is_itself),
        cmocka_unit_test(cells_are_described),
        cmocka_unit_test(choices_are_told_by_their_names),
        cmocka_unit_test(settings_that_are_too_long_are_refused),
    };
    unsetenv("RG_FEW_SAMPLES");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
