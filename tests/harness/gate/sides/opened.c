// Which sides a gate has, what is known of one that does not open, and which devices must be there.
// A stand-in opens devices.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/compare/gate/sides/pairs.h"
#include "harness/compare/gate/sides/sides.h"
#include "harness/console/exit.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

// --- stand-ins ---

static struct rg_device device;
static int closed, opened; // devices
static bool closes_well;

// A name says how opening the device ends.
struct rg_device *rg_devices_open_one(const char *name)
{
    opened++;
    switch (*name) {
    case 'i':
        return rg_error_null("no such name");
    case 'u':
        return rg_unsupported_null("no driver");
    case 'd':
        return rg_driver_error_null("it refuses");
    case 'h':
        return rg_harness_error_null("no memory");
    case 's':
        rg_setup_error("a file is broken");
        return NULL;
    default:
        return &device;
    }
}

bool rg_device_close(struct rg_device *of)
{
    closed += of != NULL;
    return !of || closes_well;
}

void rg_devices_list(struct rg_device_list *list)
{
    *list = (struct rg_device_list){.count = 2, .infos = {{.name = "cpu"}, {.name = "gl"}}};
}

static int complaint;

int rg_devices_complain(const struct rg_device_list *list)
{
    (void)list;
    return complaint;
}

// --- a side ---

static void a_side_is_closed_before_it_is_opened_again(void **state)
{
    (void)state;
    struct rg_side side = {.name = "gl"};
    closes_well = true;
    opened = closed = 0;
    assert_true(rg_side_launch(&side));
    assert_true(side.device == &device && opened == 1 && closed == 0);
    assert_true(rg_side_launch(&side));
    assert_true(opened == 2 && closed == 1 && !side.was_closed_badly);
    closes_well = false;
    rg_side_close(&side);
    assert_true(!side.device && closed == 2 && side.was_closed_badly);
    closes_well = true;
    assert_true(rg_side_launch(&side));
    rg_side_close(&side);
    assert_true(side.was_closed_badly); // it stays so
    assert_false(side.was_lacking);
}

static void a_side_that_does_not_open_is_known_by_its_failure(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        bool is_name, is_there, is_ours, lacks;
        enum rg_outcome outcome;
        const char *why;
    } rows[] = {
        {"input", false, true, true, false, RG_ERROR, "no such name"},
        {"unsupported", true, false, false, false, RG_UNSUPPORTED, "no driver"},
        {"driver", true, true, false, false, RG_ERROR, "it refuses"},
        {"harness", true, true, true, true, RG_LACKING, "no memory"},
        {"set-up", true, true, true, false, RG_SETUP, "a file is broken"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_side side = {.name = rows[i].name};
        bool is_ours;
        char why[40];
        rg_side_look(&side);
        assert_ptr_equal(side.name, rows[i].name);
        assert_string_equal(side.why, rows[i].why);
        assert_string_equal(side.info.name, "");
        assert_null(side.device);
        if (side.is_name != rows[i].is_name || side.is_there != rows[i].is_there ||
            side.was_lacking != rows[i].lacks)
            fail_msg("%s", rows[i].name);
        assert_int_equal(rg_side_failure(&is_ours, why, sizeof(why)), rows[i].outcome);
        assert_int_equal(is_ours, rows[i].is_ours);
        assert_string_equal(why, rows[i].why);
    }
    struct rg_side side = {.name = "gl"};
    snprintf(device.info.name, sizeof(device.info.name), "gl");
    rg_side_look(&side);
    assert_true(side.is_name && side.is_there && side.device && !*side.why);
    assert_string_equal(side.info.name, "gl");
}

// --- required devices ---

// cpu is open, gl@X=1 is not there, vulkan is there and fails.
static void required_devices_must_be_there(void **state)
{
    (void)state;
    static const struct rg_side seen[] = {
        {.name = NULL}, // A's place beside a baseline
        {.name = "cpu", .is_name = true, .is_there = true, .info.name = "cpu"},
        {.name = "gl@X=1", .is_name = true, .why = "no driver"},
        {.name = "vulkan", .is_name = true, .is_there = true, .why = "it fails"}};
    static const struct {
        const char *require, *first, *said, *details, *device;
        int added;
    } rows[] = {
        {NULL, NULL, NULL, NULL, NULL, 0},
        {"cpu", NULL, NULL, NULL, NULL, 0},
        {"cpu,vulkan", NULL, NULL, NULL, NULL, 0},
        {"gl", "required.gl", "--require gl: 'gl@X=1' is not there", "no driver", "gl@X=1", 1},
        {"opencl", "required.opencl", "--require opencl: it is not among the devices of this gate",
         "", NULL, 1},
        {"gl,cpu,opencl", "required.gl", "--require gl: 'gl@X=1' is not there", "no driver",
         "gl@X=1", 2},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_report report = {.case_count = 0};
        logged_lines = 0;
        assert_int_equal(rg_sides_have(seen, 4, rows[i].require, &report), rows[i].added == 0);
        assert_int_equal(report.case_count, rows[i].added);
        assert_int_equal(logged_lines, rows[i].added);
        if (rows[i].added) {
            const struct rg_report_case *c = &report.cases[0];
            assert_string_equal(c->name, rows[i].first);
            assert_string_equal(c->message, rows[i].said);
            assert_string_equal(c->details, rows[i].details);
            assert_int_equal(c->ending, RG_ENDING_ERROR);
            assert_int_equal(c->device_count, rows[i].device != NULL);
            if (rows[i].device)
                assert_string_equal(c->devices[0], rows[i].device);
        }
        rg_report_free(&report);
    }
    struct rg_report report = {.case_count = 0};
    assert_false(rg_sides_have(seen, 4, "cpu,", &report));
    assert_int_equal(report.case_count, 0);
    rg_report_free(&report);
}

// --- pairs ---

static void a_pair_has_two_devices(void **state)
{
    (void)state;
    struct rg_gate_pair pair = {{"", ""}};
    assert_true(rg_gate_pair_of("cpu", "gl@X=\"1,2\"", &pair));
    assert_string_equal(pair.names[RG_SIDE_A], "cpu");
    assert_string_equal(pair.names[RG_SIDE_B], "gl@X=\"1,2\"");
    assert_false(rg_gate_pair_of("cpu", "gl,vulkan", &pair));
    assert_string_equal(logged, "gate: 'gl,vulkan' are two devices; name one");
    assert_false(rg_gate_pair_of("cpu,gl", "vulkan", &pair));
    assert_string_equal(logged, "gate: 'cpu,gl' are two devices; name one");
    assert_false(rg_gate_pair_of("", "vulkan", &pair));
    assert_false(rg_gate_pair_of("cpu", "", &pair));
}

static void each_device_of_another_build_is_a_pair(void **state)
{
    (void)state;
    static struct rg_gate_pairs pairs;
    assert_int_equal(rg_gate_pairs_of_builds("/bin/sh", "cpu,gl@X=1", &pairs), RG_EXIT_PASS);
    assert_int_equal(pairs.count, 2);
    assert_string_equal(pairs.all[0].names[RG_SIDE_A], "cpu@RG_PROGRAM=/bin/sh");
    assert_string_equal(pairs.all[0].names[RG_SIDE_B], "cpu");
    assert_string_equal(pairs.all[1].names[RG_SIDE_A], "gl@X=1;RG_PROGRAM=/bin/sh");
    assert_string_equal(pairs.all[1].names[RG_SIDE_B], "gl@X=1");
    complaint = RG_EXIT_FAIL; // "all" are those that are listed; the others are told of
    assert_int_equal(rg_gate_pairs_of_builds("/bin/sh", "all", &pairs), RG_EXIT_PASS);
    assert_true(pairs.count == 2 && pairs.left_out == RG_EXIT_FAIL);
    assert_string_equal(pairs.all[1].names[RG_SIDE_A], "gl@RG_PROGRAM=/bin/sh");
    static const struct {
        const char *program, *names, *said;
    } rows[] = {
        {"/nonexistent", "cpu", "--against '/nonexistent': no program that can be started; name"},
        {"/bin/sh", "cpu,gl,cpu", "--device: 'cpu' stands there twice; name it once"},
        {"/bin/sh", "cpu,", "devices 'cpu,': names no device beside a comma"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        logged_lines = 0;
        assert_int_equal(rg_gate_pairs_of_builds(rows[i].program, rows[i].names, &pairs),
                         RG_EXIT_USAGE);
        assert_int_equal(logged_lines, 1);
        if (strncmp(logged, rows[i].said, strlen(rows[i].said)) != 0)
            fail_msg("%s", logged);
    }
}

// A program in the current folder is no name to be searched for along PATH.
static void a_program_without_a_folder_is_that_of_the_current_one(void **state)
{
    (void)state;
    static struct rg_gate_pairs pairs;
    assert_int_equal(chdir("/bin"), 0);
    assert_int_equal(rg_gate_pairs_of_builds("sh", "cpu", &pairs), RG_EXIT_PASS);
    assert_string_equal(pairs.all[0].names[RG_SIDE_A], "cpu@RG_PROGRAM=./sh");
    assert_int_equal(chdir("/"), 0);
}

// The first device of each backend, and cpu:reference, unless a pair has it, with whatever settings
// or by a short name.
static void devices_that_are_not_gated_are_known(void **state)
{
    (void)state;
    static const char *const held[] = {"cpu",       "cpu:reference", "cpu@X=1",
                                       "c=cpu@Y=1", "gl:1",          "cpu:other"};
    for (size_t i = 0; i < sizeof(held) / sizeof(held[0]); i++) {
        struct rg_gate_pairs pairs = {.count = 1};
        struct rg_gate_left left = {.count = 0};
        bool has_cpu = false, has_reference = false;
        int backends = 0;
        assert_true(rg_gate_pair_of("cpu", held[i], &pairs.all[0]));
        rg_gate_pairs_left(&pairs, &left);
        for (int k = 0; k < left.count; k++) {
            has_cpu = has_cpu || !strcmp(left.names[k], "cpu");
            has_reference = has_reference || !strcmp(left.names[k], "cpu:reference");
        }
        while (rg_backends[backends])
            backends++;
        assert_int_equal(has_reference, i != 1);
        assert_int_equal(has_cpu, i == 1 || i >= 4);
        assert_int_equal(left.count, backends + has_reference - !has_cpu);
        assert_string_equal(left.names[0], has_reference ? "cpu:reference" : rg_backends[0]->name);
    }
}

int main(void)
{
    rg_log_listen(log_last, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_side_is_closed_before_it_is_opened_again),
        cmocka_unit_test(a_side_that_does_not_open_is_known_by_its_failure),
        cmocka_unit_test(required_devices_must_be_there),
        cmocka_unit_test(a_pair_has_two_devices),
        cmocka_unit_test(each_device_of_another_build_is_a_pair),
        cmocka_unit_test(a_program_without_a_folder_is_that_of_the_current_one),
        cmocka_unit_test(devices_that_are_not_gated_are_known),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
