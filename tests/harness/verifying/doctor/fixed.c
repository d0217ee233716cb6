// A device's draws of fixed functions, one after the other: the row of each, the device's status,
// and what a driver that fails leaves. The draws are made up.
#include "harness/compare/doctor/fixed.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/exit.h"
#include "harness/devices/devices.h"
#include "harness/devices/measure/serving/fixed_pairs.h"
#include "shaders/fixed/fixed.h"

// --- stand-ins ---

enum { NONE = -1 };

static struct rg_device device = {.info = {.name = "new", .full = "new", .driver = "1.0"}};
// Rows that end so; NONE: no row.
static int lacking, constant, alike, bounded, faulty, broken[2];
static bool closes, is_want; // `is_want`: the broken rows lack something of raingauge's own
static char logged[2048];
static int renewed;

struct rg_device *rg_devices_open_one(const char *name)
{
    if (!strcmp(name, "new"))
        return &device;
    if (!strcmp(name, "tired"))
        rg_driver_error("tired: is tired");
    else if (!strcmp(name, "absent"))
        rg_unsupported("absent: no driver");
    else if (!strcmp(name, "large"))
        rg_harness_error("large: no memory");
    else
        rg_error("device '%s': unknown", name);
    return NULL;
}

bool rg_device_close(struct rg_device *closed)
{
    assert_ptr_equal(closed, &device);
    return closes;
}

double rg_now_ms(void)
{
    static double now_ms;
    return now_ms += 2.5;
}

// A draw leaves another picture than its neighbour, and the two ways of a closed case the same one.
bool rg_fixed_ask(struct rg_device *of, int row, struct rg_fixed_told *told)
{
    assert_ptr_equal(of, &device);
    *told = (struct rg_fixed_told){.digest = (uint64_t)row + 1,
                                   .other = (uint64_t)row + 1 + (row < rg_fixed_count()),
                                   .is_constant = row == constant};
    if (row == alike)
        told->other = row < rg_fixed_count() ? told->digest : 0;
    told->is_bounded = row == bounded || row == faulty;
    if (row == faulty) {
        told->beyond.count = 1;
        snprintf(told->known, sizeof(told->known), "it errs");
    }
    if (row == lacking)
        snprintf(told->lacks, sizeof(told->lacks), "room");
    if (row != broken[0] && row != broken[1])
        return true;
    return is_want ? rg_harness_error("no room for draw %d", row)
                   : rg_driver_error("new: lost in draw %d", row);
}

struct rg_failure rg_fixed_failure(struct rg_device *of)
{
    assert_ptr_equal(of, &device);
    renewed++;
    return rg_failure_take();
}

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)user;
    const size_t used = strlen(logged);
    snprintf(logged + used, sizeof(logged) - used, "%s\n", line);
}

static int begin(void **state)
{
    (void)state;
    lacking = constant = alike = bounded = faulty = broken[0] = broken[1] = NONE;
    closes = true;
    is_want = false;
    renewed = 0;
    *logged = *device.info.limits.no_native = 0;
    rg_log_listen(hear, NULL);
    return 0;
}

// --- the tests' own ---

// Draws on a device; the caller owns its row.
static json_t *draw(const char *name, int exit)
{
    struct rg_device_info info = {.name = ""};
    json_t *rows = json_array();
    assert_int_equal(rg_doctor_fixed(name, &info, rows), exit);
    assert_int_equal(json_array_size(rows), 1);
    assert_string_equal(info.name, !strcmp(name, "new") ? "new" : "");
    json_t *row = json_incref(json_array_get(rows, 0));
    json_decref(rows);
    return row;
}

static void expect_json(const json_t *found, const char *due)
{
    char *text = found ? json_dumps(found, JSON_COMPACT | JSON_ENCODE_ANY) : strdup("nothing");
    assert_string_equal(text, due);
    free(text);
}

static void expect_row(const json_t *row, const char *array, int i, const char *due)
{
    expect_json(json_array_get(json_object_get(row, array), (size_t)i), due);
}

static void expect_ends(const json_t *row, const char *status, const char *why)
{
    assert_string_equal(json_string_value(json_object_get(row, "status")), status);
    assert_string_equal(json_string_value(json_object_get(row, "why")), why);
}

static void expect_counts(const json_t *row, int draws, int closed)
{
    assert_int_equal(json_array_size(json_object_get(row, "draws")), draws);
    assert_int_equal(json_array_size(json_object_get(row, "closed")), closed);
}

// --- tests ---

static void each_draw_has_its_row(void **state)
{
    (void)state;
    char due[512];
    const int draws = rg_fixed_count(), closed = rg_fixed_closed_count();
    json_t *row = draw("new", RG_EXIT_PASS);
    expect_ends(row, "ok", "");
    expect_counts(row, draws, closed);
    assert_true(json_real_value(json_object_get(row, "ms")) == 2.5);
    for (int i = 0; i < draws; i++) {
        snprintf(
            due, sizeof(due),
            "{\"feature\":\"%s\",\"status\":\"ok\",\"digest\":\"%016x\",\"neighbour\":\"%016x\""
            ",\"bounds\":\"none\",\"why\":\"\"}",
            rg_fixed_draws[i].feature, i + 1, i + 2);
        expect_row(row, "draws", i, due);
    }
    for (int i = 0; i < closed; i++) {
        snprintf(due, sizeof(due),
                 "{\"feature\":\"%s\",\"case\":\"%s\",\"status\":\"ok\",\"why\":\"\"}",
                 rg_fixed_closed[i].feature, rg_fixed_closed[i].about);
        expect_row(row, "closed", i, due);
    }
    assert_string_equal(logged, "");
    json_decref(row);
}

static void what_a_driver_draws_wrongly_fails(void **state)
{
    (void)state;
    char due[1024], lines[1024];
    const int draws = rg_fixed_count();
    lacking = 0;
    constant = 1;
    alike = draws; // the first closed case
    json_t *row = draw("new", RG_EXIT_FAIL);
    expect_ends(row, "fail", "2 draws fail");
    snprintf(due, sizeof(due),
             "{\"feature\":\"%s\",\"status\":\"unsupported\",\"why\":\"lacks room\"}",
             rg_fixed_draws[0].feature);
    expect_row(row, "draws", 0, due);
    snprintf(due, sizeof(due),
             "{\"feature\":\"%s\",\"status\":\"fail\",\"digest\":\"%016x\",\"neighbour\":\"%016x\","
             "\"bounds\":\"none\",\"why\":\"leaves a picture that is the same everywhere\"}",
             rg_fixed_draws[1].feature, 2, 3);
    expect_row(row, "draws", 1, due);
    snprintf(due, sizeof(due),
             "{\"feature\":\"%s\",\"case\":\"%s\",\"status\":\"fail\",\"why\":\"does not hold: "
             "%s\"}",
             rg_fixed_closed[0].feature, rg_fixed_closed[0].about, rg_fixed_closed[0].about);
    expect_row(row, "closed", 0, due);
    snprintf(lines, sizeof(lines),
             "device 'new': feature '%s': leaves a picture that is the same everywhere\n"
             "device 'new': feature '%s': does not hold: %s\n",
             rg_fixed_draws[1].feature, rg_fixed_closed[0].feature, rg_fixed_closed[0].about);
    assert_string_equal(logged, lines);
    assert_int_equal(renewed, 0);
    json_decref(row);
}

// After a failure the driver is started anew and goes on; after two it draws no more.
static void a_driver_that_fails_is_left(void **state)
{
    (void)state;
    char due[512];
    const int draws = rg_fixed_count(), closed = rg_fixed_closed_count();
    broken[0] = 2;
    json_t *row = draw("new", RG_EXIT_FAIL);
    expect_ends(row, "fail", "1 draw fails");
    expect_counts(row, draws, closed);
    snprintf(due, sizeof(due),
             "{\"feature\":\"%s\",\"status\":\"error\",\"why\":\"new: lost in draw 2\"}",
             rg_fixed_draws[2].feature);
    expect_row(row, "draws", 2, due);
    assert_int_equal(renewed, 1);
    json_decref(row);
    *logged = 0;
    broken[1] = 4;
    row = draw("new", RG_EXIT_FAIL);
    expect_ends(row, "fail", "2 draws fail");
    expect_counts(row, 5, 0);
    snprintf(due, sizeof(due),
             "new: lost in draw 2\nnew: lost in draw 4\ndevice 'new': 2 draws of fixed functions "
             "failed, and %d more are not tried\n",
             rg_fixed_pairs() - 5);
    assert_string_equal(logged, due);
    assert_int_equal(renewed, 3);
    json_decref(row);
}

// What raingauge itself lacks is no fault of the driver.
static void lacks_of_our_own_are_no_failures(void **state)
{
    (void)state;
    broken[0] = 2;
    is_want = true;
    json_t *row = draw("new", RG_EXIT_HARNESS);
    expect_ends(row, "error", "raingauge itself lacked what 1 draw needs");
    assert_string_equal(json_string_value(json_object_get(row, "fault")), "harness");
    json_decref(row);
    alike = 3; // beside a draw that fails
    row = draw("new", RG_EXIT_FAIL);
    expect_ends(row, "fail", "1 draw fails");
    json_decref(row);
}

// What a gate compares: digests of the draws that are OK, whether each is within its bounds, which
// a known fault is not, and what the others ended as.
static void all_draws_keep_how_they_ended(void **state)
{
    (void)state;
    struct rg_fixed_left left;
    const int count = rg_fixed_count();
    bounded = 3;
    faulty = 4;
    lacking = 5;
    alike = 6;
    broken[0] = 7;
    is_want = true;
    rg_fixed_draw_all(&device, &left);
    for (int i = 0; i < count; i++) {
        assert_int_equal(left.outcomes[i], i == lacking     ? RG_UNSUPPORTED
                                           : i == alike     ? RG_FAIL
                                           : i == broken[0] ? RG_LACKING
                                                            : RG_OK);
        assert_int_equal(left.is_within[i], i == bounded);
    }
    assert_int_equal(left.failed, RG_LACKING);
    assert_int_equal(json_object_size(left.digests), count - 3);
    rg_fixed_left_free(&left);
    broken[0] = 1;
    broken[1] = 2;
    is_want = false;
    rg_fixed_draw_all(&device, &left); // which ends after two failures
    assert_int_equal(left.failed, RG_ERROR);
    assert_true(left.outcomes[2] == RG_ERROR && left.outcomes[3] == RG_NOTHING);
    assert_int_equal(json_object_size(left.digests), 1);
    rg_fixed_left_free(&left);
}

static void devices_that_draw_nothing_say_why(void **state)
{
    (void)state;
    json_t *row = draw("tired", RG_EXIT_FAIL);
    expect_json(row, "{\"name\":\"tired\",\"why\":\"tired: is tired\",\"ms\":0.0,\"draws\":[],"
                     "\"closed\":[],\"status\":\"error\"}");
    json_decref(row);
    row = draw("other", RG_EXIT_USAGE);
    expect_ends(row, "error", "device 'other': unknown");
    json_decref(row);
    row = draw("absent", RG_EXIT_UNSUPPORTED);
    expect_ends(row, "unsupported", "absent: no driver");
    json_decref(row);
    row = draw("large", RG_EXIT_HARNESS);
    expect_ends(row, "error", "large: no memory");
    json_decref(row);
    snprintf(device.info.limits.no_native, sizeof(device.info.limits.no_native), "is a CPU");
    row = draw("new", RG_EXIT_UNSUPPORTED);
    expect_json(row, "{\"name\":\"new\",\"why\":\"has no fixed functions\",\"ms\":0.0,\"draws\":[],"
                     "\"closed\":[],\"status\":\"unsupported\"}");
    json_decref(row);
    closes = false;
    row = draw("new", RG_EXIT_FAIL);
    expect_ends(row, "unsupported", "has no fixed functions");
    json_decref(row);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(each_draw_has_its_row, begin),
        cmocka_unit_test_setup(what_a_driver_draws_wrongly_fails, begin),
        cmocka_unit_test_setup(a_driver_that_fails_is_left, begin),
        cmocka_unit_test_setup(lacks_of_our_own_are_no_failures, begin),
        cmocka_unit_test_setup(all_draws_keep_how_they_ended, begin),
        cmocka_unit_test_setup(devices_that_draw_nothing_say_why, begin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
