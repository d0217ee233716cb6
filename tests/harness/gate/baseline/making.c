// How a baseline is made: which row is taken on which device, in which order rows are timed, and
// what is left of one that fails. Stand-ins run and time the cells.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/devices/measure/serving/fixed_pairs.h"
#include "tests/harness/gate/baseline/made.h"
#include "tests/harness/gate/cells/read.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

// --- stand-ins ---

enum { ROWS = 4 };
static double now_ms;
static char events[1024]; // the rows that are timed, by launch; capitals: taken, checked and drawn
static struct {
    int fails, is_wrong;   // the row that does not run, and whose picture is wrong; -1: none
    int breaks, breaks_at; // the row that cannot be timed from this launch on
    int disturbed, until;  // the row whose launches before this one do not count
    bool devices_close_well, truth_closes_well, sides_close_well;
    enum rg_outcome fixed_failed;
} script;
static struct rg_device devices[2];

double rg_now_ms(void)
{
    return now_ms;
}

static void note(const char *what, const char *name)
{
    snprintf(events + strlen(events), sizeof(events) - strlen(events), "%s%s", what, name);
}

static int row_of(const struct rg_gate_cell *cell, const struct rg_device *device)
{
    return (device == &devices[1]) * 2 + !strcmp(cell->name, "flow");
}

void rg_baseline_take(const struct rg_gate_cell *cell, struct rg_device *device,
                      struct rg_baseline_row *row, struct rg_picture *picture)
{
    const int number = row_of(cell, device);
    now_ms += 250;
    picture->width = 0;
    snprintf(row->cell, sizeof(row->cell), "%s", cell->name);
    row->outcome = number == script.fails ? RG_CRASH : RG_OK;
    if (number == script.fails)
        snprintf(row->why, sizeof(row->why), "it fell");
    note(" T", (const char *[]){"0", "1", "2", "3"}[number]);
}

bool rg_truth_holds(struct rg_truth *truth, const struct rg_gate_cell *cell,
                    struct rg_device *device, const struct rg_picture *picture,
                    struct rg_agreement *agreement)
{
    const int number = row_of(cell, device);
    (void)truth;
    (void)picture;
    note("", "C");
    return number != script.is_wrong || rg_agreement_differs(agreement, "another picture");
}

bool rg_truth_close(struct rg_truth *truth)
{
    (void)truth;
    return script.truth_closes_well;
}

void rg_fixed_draw_all(struct rg_device *device, struct rg_fixed_left *left)
{
    note(" F", device->info.name);
    *left = (struct rg_fixed_left){.failed = script.fixed_failed};
    left->digests = json_pack("{s:s}", "linear", device->info.name);
    left->is_within[2] = !strcmp(device->info.name, "vulkan");
}

bool rg_devices_close(struct rg_devices *of)
{
    (void)of;
    note(" ", "closed");
    return script.devices_close_well;
}

bool rg_yardsticks_open(struct rg_yardstick_room *room)
{
    (void)room;
    note(" ", "open");
    return true;
}

void rg_yardsticks_close(struct rg_yardstick_room *room)
{
    (void)room;
}

void rg_side_close(struct rg_side *side)
{
    side->was_closed_badly = !script.sides_close_well && !strcmp(side->name, "vulkan");
}

bool rg_times_launch(int number, void *user)
{
    struct rg_gate_times *t = user;
    t->launch = number;
    assert_true(t->side_count == 2 && t->room && t->yardsticks);
    note(" ", "");
    return true;
}

bool rg_times_take(int row, bool b_first, struct rg_quads *quads, void *user)
{
    const struct rg_gate_times *t = user;
    struct rg_timed_cell *timed = &t->cells[row];
    assert_false(b_first);
    assert_true(!timed->sides[RG_SIDE_A] && timed->sides[RG_SIDE_B] == &t->sides[row / 2]);
    assert_string_equal(timed->cell->name, row % 2 ? "flow" : "rain");
    note("", (const char *[]){"0", "1", "2", "3"}[row]);
    timed->slot = (struct rg_slot){row + 1, 3};
    timed->seconds += 0.5;
    if (row == script.breaks && t->launch >= script.breaks_at) {
        timed->outcome = RG_TIMEOUT;
        snprintf(timed->why, sizeof(timed->why), "it hung");
        return false;
    }
    *quads = (struct rg_quads){.b_ms = 10 * row + t->launch + 1.0000000001,
                               .is_disturbed = row == script.disturbed && t->launch < script.until};
    return true;
}

// --- a baseline ---

static const char text_of_cells[] = "rain raster 16x16 1\nflow raster 16x16 1\n";
static struct rg_baseline made;
static struct rg_baseline_making how;

static int set_up(void **state)
{
    (void)state;
    snprintf(devices[0].info.name, RG_DEVICE_NAME_SIZE, "gl");
    snprintf(devices[1].info.name, RG_DEVICE_NAME_SIZE, "vulkan");
    snprintf(devices[1].info.driver, sizeof(devices[1].info.driver), "Mesa 25");
    return read_cells(text_of_cells);
}

static int begin(void **state)
{
    (void)state;
    memset(&script, 0, sizeof(script));
    script.fails = script.is_wrong = script.breaks = script.disturbed = -1;
    script.devices_close_well = script.truth_closes_well = script.sides_close_well = true;
    memset(&made, 0, sizeof(made));
    *events = 0;
    return 0;
}

static int end(void **state)
{
    (void)state;
    rg_baseline_free(&made);
    return 0;
}

static bool make(int launches)
{
    struct rg_devices opened = {.count = 2, .devices = {&devices[0], &devices[1]}};
    return rg_baseline_make(&(struct rg_baseline_request){&cells, launches}, &opened, &made, &how);
}

#define TAKEN " T0C T1C T2C T3C Fgl Fvulkan closed"
#define TIMED TAKEN " open"

// Launches take the rows forwards and backwards in turn, and each begins one row further on than
// the last in its direction.
static void rows_are_taken_then_timed_in_turn(void **state)
{
    (void)state;
    assert_true(make(5));
    assert_string_equal(events, TIMED " 0123 3210 1230 2103 2301");
    assert_true(!how.has_failed && !how.is_lacking && made.count == ROWS && made.device_count == 2);
    for (int i = 0; i < ROWS; i++) {
        const struct rg_baseline_row *row = &made.rows[i];
        assert_string_equal(row->cell, i % 2 ? "flow" : "rain");
        assert_int_equal(row->launches.count, 5);
        for (int k = 0; k < 5; k++)
            assert_equals(row->launches.ms[k], 10 * i + k + 1); // as a file keeps it
        assert_equals(row->seconds, 0.25 + 5 * 0.5);
        assert_int_equal(row->slot.frames, i + 1);
    }
    assert_string_equal(made.devices[1].name, "vulkan");
    assert_string_equal(json_string_value(json_object_get(made.devices[1].parts, "driver")),
                        "Mesa 25");
    assert_string_equal(
        json_string_value(json_object_get(rg_fixed_kept(made.passport, "vulkan"), "linear")),
        "vulkan");
    for (int draw = 0; draw < rg_fixed_count(); draw++) {
        assert_false(rg_fixed_kept_within(made.passport, "gl", draw));
        assert_int_equal(rg_fixed_kept_within(made.passport, "vulkan", draw), draw == 2);
    }
}

static void without_launches_nothing_is_timed(void **state)
{
    (void)state;
    assert_true(make(0));
    assert_string_equal(events, TAKEN);
    assert_true(made.rows[3].launches.count == 0 && made.rows[3].seconds == 0.25);
    assert_int_equal(made.rows[3].slot.frames, 0);
}

// A device that fails a cell draws no fixed functions, and the cell is neither checked nor timed.
static void a_cell_that_fails_is_not_timed(void **state)
{
    (void)state;
    script.fails = 1;
    assert_true(make(2));
    assert_string_equal(events, " T0C T1 T2C T3C Fvulkan closed open 023 320");
    assert_int_equal(made.rows[1].outcome, RG_CRASH);
    assert_string_equal(made.rows[1].why, "it fell");
    assert_true(made.rows[1].launches.count == 0 && made.rows[2].launches.count == 2);
    assert_null(rg_fixed_kept(made.passport, "gl"));
    rg_baseline_free(&made);
    *events = 0;
    script.fails = -1;
    script.is_wrong = 2;
    assert_true(make(1));
    assert_string_equal(events, " T0C T1C T2C T3C Fgl closed open 013");
    assert_int_equal(made.rows[2].outcome, RG_FAIL);
    assert_string_equal(made.rows[2].why, "another picture");
}

// Some launches alone make no baseline.
static void a_cell_that_breaks_off_has_no_times(void **state)
{
    (void)state;
    script.breaks = 3;
    script.breaks_at = 1;
    assert_true(make(3));
    assert_string_equal(events, TIMED " 0123 3210 120");
    assert_int_equal(made.rows[3].outcome, RG_TIMEOUT);
    assert_string_equal(made.rows[3].why, "it hung");
    assert_int_equal(made.rows[3].launches.count, 0);
    assert_int_equal(made.rows[0].launches.count, 3);
    assert_equals(made.rows[3].seconds, 0.25 + 2 * 0.5);
}

// Launches that do not count are taken again, up to as many.
static void disturbed_launches_are_repeated(void **state)
{
    (void)state;
    script.disturbed = 2;
    script.until = 1;
    assert_true(make(2));
    assert_string_equal(events, TIMED " 0123 3210 2");
    assert_true(made.rows[2].launches.ms[0] == 22 && made.rows[2].launches.ms[1] == 23);
    rg_baseline_free(&made);
    *events = 0;
    script.until = 99;
    assert_true(make(2));
    assert_string_equal(events, TIMED " 0123 3210 2 2");
    assert_int_equal(made.rows[2].launches.count, 0);
}

static void failures_beside_the_rows_are_told(void **state)
{
    (void)state;
    for (int i = 0; i < 5; i++) {
        begin(state);
        script.devices_close_well = i != 0;
        script.truth_closes_well = i != 1;
        script.sides_close_well = i != 2;
        script.fixed_failed = i == 3 ? RG_CRASH : i == 4 ? RG_LACKING : RG_OK;
        assert_true(make(1));
        assert_int_equal(how.has_failed, i < 4);
        assert_int_equal(how.is_lacking, i == 4);
        rg_baseline_free(&made);
    }
}

int main(void)
{
    rg_log_listen(log_last, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(rows_are_taken_then_timed_in_turn, begin, end),
        cmocka_unit_test_setup_teardown(without_launches_nothing_is_timed, begin, end),
        cmocka_unit_test_setup_teardown(a_cell_that_fails_is_not_timed, begin, end),
        cmocka_unit_test_setup_teardown(a_cell_that_breaks_off_has_no_times, begin, end),
        cmocka_unit_test_setup_teardown(disturbed_launches_are_repeated, begin, end),
        cmocka_unit_test_setup_teardown(failures_beside_the_rows_are_told, begin, end),
    };
    return cmocka_run_group_tests(tests, set_up, free_cells);
}
