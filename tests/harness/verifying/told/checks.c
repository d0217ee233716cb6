// The checks of `verify`: lines, machine form and exit status; the units into which a verification
// is divided; and the checks of all shards together.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/verify/course.h"
#include "harness/console/exit.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/printed.h"

// --- lines and machine forms ---

static struct rg_checks three_checks(void)
{
    struct rg_checks checks = {0};
    rg_checks_add(&checks, "flow", "state", "cpu", RG_OK, "%d runs", 3);
    rg_checks_add(&checks, "raster", "mutants", "gl", RG_UNSUPPORTED, "none");
    rg_checks_add(&checks, "flow", "image", "cpu:reference", RG_FAIL, "another");
    return checks;
}

static void lines_have_columns_and_a_count(void **state)
{
    (void)state;
    struct rg_checks checks = three_checks();
    printed_begin();
    rg_checks_print(&checks, "a note\n", json_array(), false);
    const char *text = printed_end();
    assert_string_equal(text, "a note\n"
                              "ok           flow    state    cpu            3 runs\n"
                              "unsupported  raster  mutants  gl             none\n"
                              "fail         flow    image    cpu:reference  another\n"
                              "3 checks, 1 ok, 1 fail, 1 unsupported\n");
    rg_checks_free(&checks);
}

static void a_document_has_each_check(void **state)
{
    (void)state;
    struct rg_checks checks = three_checks();
    rg_checks_add(&checks, "flow", "device", "vulkan", RG_SETUP, "broken");
    printed_begin();
    rg_checks_print(&checks, "a note\n", json_pack("[s]", "a device"), true);
    const char *text = printed_end();
    json_t *found = json_loads(text, 0, NULL);
    json_t *due = json_pack("{si s[s] s[{ssssssssss}{ssssssssss}{ssssssssss}{ssssssssssss}]}",
                            "format", 1, "devices", "a device", "checks",                     //
                            "technique", "flow", "check", "state", "device", "cpu",           //
                            "status", "ok", "detail", "3 runs",                               //
                            "technique", "raster", "check", "mutants", "device", "gl",        //
                            "status", "unsupported", "detail", "none",                        //
                            "technique", "flow", "check", "image", "device", "cpu:reference", //
                            "status", "fail", "detail", "another",                            //
                            "technique", "flow", "check", "device", "device", "vulkan",       //
                            "status", "error", "detail", "broken", "fault", "set-up");
    assert_non_null(due);
    assert_true(json_equal(found, due));
    json_decref(found);
    json_decref(due);
    rg_checks_free(&checks);
}

// A row is read back as it was, whatever its outcome; what is no row is refused.
static void rows_are_read_back(void **state)
{
    (void)state;
    for (int outcome = 0; outcome < RG_OUTCOME_COUNT; outcome++) {
        struct rg_checks checks = {0}, read = {0};
        rg_checks_add(&checks, "flow", "image", "gl", (enum rg_outcome)outcome, "so");
        json_t *document = rg_checks_document(&checks, json_array());
        json_t *row = json_array_get(json_object_get(document, "checks"), 0);
        assert_true(rg_checks_read(&read, row));
        assert_int_equal(read.count, 1);
        assert_int_equal(read.rows[0].status, outcome);
        assert_string_equal(read.rows[0].technique, "flow");
        assert_string_equal(read.rows[0].check, "image");
        assert_string_equal(read.rows[0].device, "gl");
        assert_string_equal(read.rows[0].detail, "so");
        rg_log_hold(true);
        json_object_set_new(row, "status", json_string("odd"));
        assert_false(rg_checks_read(&read, row));
        json_object_set_new(row, "status", json_string("ok"));
        json_object_del(row, "device");
        assert_false(rg_checks_read(&read, row));
        rg_log_hold(false);
        assert_int_equal(read.count, 1);
        json_decref(document);
        rg_checks_free(&checks);
        rg_checks_free(&read);
    }
}

// A driver's text may be no UTF-8.
static void foreign_bytes_are_replaced(void **state)
{
    (void)state;
    struct rg_checks checks = {0}, read = {0};
    rg_checks_add(&checks, "flow", "image", "g\xffl", RG_FAIL, "it \xfe fell");
    json_t *document = rg_checks_document(&checks, json_array());
    assert_true(rg_checks_read(&read, json_array_get(json_object_get(document, "checks"), 0)));
    assert_string_equal(read.rows[0].device, "g?l");
    assert_string_equal(read.rows[0].detail, "it ? fell");
    json_decref(document);
    rg_checks_free(&checks);
    rg_checks_free(&read);
}

// If some results are of devices, these alone say whether something was proven. A worse result
// counts whatever it is of, and so does a status that no row tells.
static void devices_decide_the_exit_status(void **state)
{
    enum { NONE = -1 };
    (void)state;
    static const struct {
        int mutants, reference, device; // an enum rg_outcome, or NONE
        int before, exit;
    } cases[] = {
        {RG_OK, RG_OK, RG_OK, 0, RG_EXIT_PASS},
        {RG_OK, RG_OK, RG_UNSUPPORTED, 0, RG_EXIT_UNSUPPORTED},
        {RG_OK, RG_OK, NONE, 0, RG_EXIT_PASS},
        {RG_FAIL, RG_OK, RG_OK, 0, RG_EXIT_FAIL},
        {RG_OK, RG_FAIL, RG_OK, 0, RG_EXIT_FAIL},
        {RG_OK, RG_OK, RG_CRASH, 0, RG_EXIT_FAIL},
        {RG_OK, RG_OK, RG_NOTHING, 0, RG_EXIT_NOTHING},
        {RG_OK, RG_OK, RG_OK, RG_EXIT_USAGE, RG_EXIT_USAGE},
        {NONE, NONE, NONE, 0, RG_EXIT_NOTHING},
    };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_checks checks = {.exit = cases[i].before};
        if (cases[i].mutants != NONE)
            rg_checks_add(&checks, "flow", "mutants", "cpu", (enum rg_outcome)cases[i].mutants,
                          "so");
        if (cases[i].reference != NONE)
            rg_checks_add(&checks, "flow", "water", "cpu:reference",
                          (enum rg_outcome)cases[i].reference, "so");
        if (cases[i].device != NONE)
            rg_checks_add(&checks, "flow", "water", "cpu", (enum rg_outcome)cases[i].device, "so");
        assert_int_equal(rg_checks_exit(&checks), cases[i].exit);
        rg_checks_free(&checks);
    }
}

// --- units ---

static const struct rg_pose poses[] = {{"", 10, 2}, {"", 5, RG_POSE_LEFT_OUT}, {NULL, 0, 0}};
static const struct rg_law laws[] = {{NULL, NULL}};
static const struct rg_mutant mutants[] = {{"one", "a", 1, 1}, {"two", "a", 1, 2}, {NULL}};
static const struct rg_contrast contrasts[] = {{"three", "", ""}, {NULL, NULL, NULL}};
static const struct rg_proof proof = {
    .poses = poses, .laws = laws, .mutants = mutants, .contrasts = contrasts};
static const struct rg_technique rain = {.name = "rain", .proof = &proof},
                                 pane = {.name = "pane", .proof = &proof};
static const struct rg_verify_subject subjects[] = {{&rain, NULL}, {&pane, NULL}};
static struct rg_device reference = {.info = {.name = "cpu:reference"}},
                        gl = {.info = {.name = "gl"}};
static struct rg_devices devices = {.count = 2,
                                    .devices = {&reference, &gl},
                                    .absent_count = 1,
                                    .absent = {{"vulkan", RG_UNSUPPORTED, "vulkan: no driver"}}};
static struct rg_checks checks_of_course;

static struct rg_verify_course course_of(bool stages, enum rg_verify_length length)
{
    checks_of_course = (struct rg_checks){0};
    return (struct rg_verify_course){
        .subjects = subjects,
        .count = 2,
        .devices = &devices,
        .stages = stages,
        .verify = {
            .length = length, .steps = -1, .reference = &reference, .checks = &checks_of_course}};
}

static void expect_units(const struct rg_verify_course *c, const char *due)
{
    char text[512] = "";
    for (int i = 0; i < c->units.count; i++)
        snprintf(text + strlen(text), sizeof(text) - strlen(text), "%s %s %g%s\n",
                 c->units.all[i].technique, c->units.all[i].name, c->units.all[i].steps,
                 c->units.all[i].is_here ? "" : " elsewhere");
    assert_string_equal(text, due);
    free(c->units.all);
}

// The reference runs beside each device; a device that is missing here may be there on another
// machine. A mutant and the model take 100 steps each, a contrast 200.
static void a_course_has_a_unit_a_device(void **state)
{
    (void)state;
    struct rg_verify_course c = course_of(false, RG_VERIFY_QUICK);
    assert_true(rg_verify_choose(&c, &(struct rg_shard){1, 1}));
    expect_units(&c, "pane gl 12\npane mutants 500\npane vulkan 12\n"
                     "rain gl 12\nrain mutants 500\nrain vulkan 12\n");
    c = course_of(false, RG_VERIFY_FULL);
    assert_true(rg_verify_choose(&c, &(struct rg_shard){1, 1}));
    expect_units(&c, "pane gl 90\npane mutants 500\npane vulkan 90\n"
                     "rain gl 90\nrain mutants 500\nrain vulkan 90\n");
    c = course_of(true, RG_VERIFY_FULL); // of stages: a run a pose and device, and no mutants
    assert_true(rg_verify_choose(&c, &(struct rg_shard){1, 1}));
    expect_units(&c, "pane gl 4\npane vulkan 4\nrain gl 4\nrain vulkan 4\n");
    // The largest first: 500 each, then the small ones in turn.
    c = course_of(false, RG_VERIFY_QUICK);
    assert_true(rg_verify_choose(&c, &(struct rg_shard){2, 2}));
    expect_units(&c, "pane gl 12 elsewhere\npane mutants 500 elsewhere\npane vulkan 12\n"
                     "rain gl 12 elsewhere\nrain mutants 500\nrain vulkan 12\n");
}

// cpu:reference is a unit of its own if it is alone.
static void the_reference_alone_is_a_unit(void **state)
{
    (void)state;
    const struct rg_devices alone = {.count = 1, .devices = {&reference}};
    struct rg_verify_course c = course_of(false, RG_VERIFY_QUICK);
    c.devices = &alone;
    c.count = 1;
    assert_true(rg_verify_choose(&c, &(struct rg_shard){1, 1}));
    expect_units(&c, "rain cpu:reference 6\nrain mutants 500\n");
}

// A missing device is told by the shard that has its unit.
static void a_missing_device_is_told_once(void **state)
{
    (void)state;
    const struct rg_devices none = {.absent_count = 1,
                                    .absent = {{"vulkan", RG_UNSUPPORTED, "vulkan: no driver"}}};
    int told = 0;
    for (int shard = 1; shard <= 2; shard++) {
        struct rg_verify_course c = course_of(true, RG_VERIFY_QUICK);
        c.devices = &none;
        assert_true(rg_verify_choose(&c, &(struct rg_shard){shard, 2}));
        assert_true(rg_units_have_any(&c.units));
        rg_verify_run_all(&c);
        for (int i = 0; i < checks_of_course.count; i++) {
            const struct rg_check *row = &checks_of_course.rows[i];
            assert_string_equal(row->technique, shard == 1 ? "pane" : "rain");
            assert_string_equal(row->check, "device");
            assert_string_equal(row->device, "vulkan");
            assert_int_equal(row->status, RG_UNSUPPORTED);
            assert_string_equal(row->detail, "vulkan: no driver");
            told++;
        }
        rg_checks_free(&checks_of_course);
        free(c.units.all);
    }
    assert_int_equal(told, 2);
}

static void units_are_found_by_both_names(void **state)
{
    (void)state;
    struct rg_verify_units units = {0};
    assert_false(rg_units_have_any(&units));
    assert_true(rg_units_add(&units, "rain", "gl", 5));
    assert_true(rg_units_add(&units, "pane", "cpu", 9));
    assert_true(rg_units_cut(&units, &(struct rg_shard){1, 2}));
    assert_true(rg_units_have(&units, "pane", "cpu"));
    assert_false(rg_units_have(&units, "rain", "gl")); // the other shard's
    assert_false(rg_units_have(&units, "pane", "gl"));
    assert_false(rg_units_have(&units, "rain", "cpu"));
    assert_true(rg_units_have_any(&units));
    json_t *whole = rg_units_whole(&units, json_pack("{ss}", "length", "quick"));
    json_t *due = json_pack("[[ss][ss]]", "pane", "cpu", "rain", "gl");
    assert_true(json_equal(json_object_get(whole, "units"), due));
    assert_string_equal(
        json_string_value(json_object_get(json_object_get(whole, "options"), "length")), "quick");
    assert_true(rg_units_cut(&units, &(struct rg_shard){3, 3})); // more shards than units
    assert_false(rg_units_have_any(&units));
    json_decref(whole);
    json_decref(due);
    free(units.all);
}

// --- all shards together ---

// A record of checks, "TECHNIQUE CHECK DEVICE DETAIL;", and of devices by their names.
static json_t *record_of(int exit, const char *rows, const char *names)
{
    struct rg_checks checks = {0};
    json_t *all = json_array();
    for (const char *row = rows; *row; row = strchr(row, ';') + 1) {
        char technique[32], check[32], device[32], detail[32];
        assert_int_equal(sscanf(row, "%31s %31s %31s %31[^;]", technique, check, device, detail),
                         4);
        rg_checks_add(&checks, technique, check, device, *detail == 'b' ? RG_FAIL : RG_OK, "%s",
                      detail);
    }
    for (; *names; names++)
        json_array_append_new(all, json_pack("{ss%}", "name", names, (size_t)1));
    json_t *document = rg_checks_document(&checks, all);
    json_object_set_new(document, "exit", json_integer(exit));
    rg_checks_free(&checks);
    return document;
}

static void expect_checks(const struct rg_checks *checks, const char *due)
{
    char text[8192] = "";
    for (int i = 0; i < checks->count; i++)
        snprintf(text + strlen(text), sizeof(text) - strlen(text), "%s %s %s %s\n",
                 checks->rows[i].technique, checks->rows[i].check, checks->rows[i].device,
                 checks->rows[i].detail);
    assert_string_equal(text, due);
}

// By technique, then in verify's own order, then by the law's name; rows of one check stay in their
// order. What each shard says of cpu:reference is told once, unless they disagree.
static void shards_make_one_run(void **state)
{
    (void)state;
    json_t *documents[] = {
        record_of(RG_EXIT_PASS,
                  "rain water cpu well;rain state gl well;rain order ref well;"
                  "rain mutants cpu killed;pane image gl well;rain order gl well;",
                  "rg"),
        record_of(RG_EXIT_FAIL,
                  "rain order ref well;rain state cpu well;rain water ref bad;rain device vk gone;"
                  "rain order cpu well;rain stages cpu well;rain order ref well;",
                  "rc"),
        record_of(RG_EXIT_UNSUPPORTED, "rain water ref well;rain image cpu well;", "cr")};
    const struct rg_parts parts = {.count = 3, .documents = documents};
    struct rg_checks checks = {0};
    assert_true(rg_checks_merge(&parts, &checks));
    expect_checks(&checks, "pane image gl well\n"
                           "rain device vk gone\n"
                           "rain state gl well\nrain state cpu well\n"
                           "rain image cpu well\n"
                           "rain stages cpu well\n"
                           "rain order ref well\nrain order gl well\nrain order cpu well\n"
                           "rain water cpu well\nrain water ref bad\nrain water ref well\n"
                           "rain mutants cpu killed\n");
    assert_int_equal(checks.exit, RG_EXIT_FAIL);
    json_t *all = rg_checks_merge_devices(&parts),
           *due = json_pack("[{ss}{ss}{ss}]", "name", "r", "name", "g", "name", "c");
    assert_true(json_equal(all, due));
    json_decref(all);
    json_decref(due);
    rg_checks_free(&checks);
    rg_log_hold(true);
    json_array_append_new(json_object_get(documents[1], "checks"), json_object());
    assert_false(rg_checks_merge(&parts, &checks));
    rg_log_hold(false);
    rg_checks_free(&checks);
    for (int i = 0; i < 3; i++)
        json_decref(documents[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_have_columns_and_a_count),
        cmocka_unit_test(a_document_has_each_check),
        cmocka_unit_test(rows_are_read_back),
        cmocka_unit_test(foreign_bytes_are_replaced),
        cmocka_unit_test(devices_decide_the_exit_status),
        cmocka_unit_test(a_course_has_a_unit_a_device),
        cmocka_unit_test(the_reference_alone_is_a_unit),
        cmocka_unit_test(a_missing_device_is_told_once),
        cmocka_unit_test(units_are_found_by_both_names),
        cmocka_unit_test(shards_make_one_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
