// Rows of a table that are open together, and groups of them that are visited in turn, on devices
// that only take time.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "harness/console/clock.h"
#include "harness/tables/measuring/measure.h"
#include "tests/harness/results/planning/slow.h"
#include "tests/tools/expect.h"

enum { ROWS = 4 };

static const struct rg_table_row rows[] = {
    {"", {1}, NULL}, {"", {2}, NULL}, {"", {3}, NULL}, {"", {4}, NULL}};
static const struct rg_table four = {.id = "slow-1",
                                     .technique = "slow",
                                     .columns = {"fixed_ms"},
                                     .key_count = 1,
                                     .variants = {{"full", "", NULL}},
                                     .width = 64,
                                     .height = 64,
                                     .check_frames = 5,
                                     .row_count = ROWS,
                                     .rows = rows,
                                     .note = "a note"};

// Begins the table on gl alone; the images to check it by are drawn on the others.
static void begin(struct slow_rig *rig, const struct rg_table *table, struct rg_result *result)
{
    slow_begin(rig);
    const struct rg_devices gl = {.count = 1, .devices = {rig->devices.devices[2]}};
    *result = (struct rg_result){0};
    rg_table_begin(result, table, &(struct rg_table_part){.last_row = ROWS - 1}, &gl);
}

static void end(struct slow_rig *rig, struct rg_result *result)
{
    rg_result_free(result);
    slow_end(rig);
}

// Each row is opened by its two images, and on gl once; or once a visit, of three, if not all rows
// are open together: for the table says so, or the device has no room.
static void groups_are_visited_three_times(void **state)
{
    (void)state;
    static const struct {
        int at_once, objects, visits;
    } cases[] = {{0, INT_MAX, 1}, {4, INT_MAX, 3}, {3, INT_MAX, 3}, {1, INT_MAX, 3},
                 {0, 400, 1},     {0, 399, 3},     {0, 200, 3},     {0, 1, 3}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_table table = four;
        struct slow_rig rig;
        struct rg_result result;
        table.rows_at_once = cases[i].at_once;
        begin(&rig, &table, &result);
        result.devices[0].limits.max_objects = cases[i].objects;
        assert_true(rg_table_measure(&result, &table, &rig.kept, NULL, NULL, NULL));
        const int visits = cases[i].at_once == ROWS ? 1 : cases[i].visits;
        assert_int_equal(slow_opened, ROWS * (2 + visits));
        for (int row = 0; row < ROWS; row++) {
            const struct rg_record *record = rg_result_at(&result, (struct rg_place){.row = row});
            assert_int_equal(record->outcome, RG_OK);
            assert_true(rg_record_is_whole(record));
        }
        end(&rig, &result);
    }
}

// Each cell of a row counts twice: when it is opened, and when it is sampled.
static void units_are_of_rows_that_are_wanted(void **state)
{
    (void)state;
    static const bool left_out[][ROWS] = {{0}, {false, true}, {true, false, true, true}};
    static const int wanted[] = {4, 3, 1};
    for (int i = 0; i < 3; i++) {
        struct slow_rig rig;
        struct rg_result result;
        struct rg_table table = four;
        table.variants[1] = (struct rg_table_variant){"bare", "", NULL};
        begin(&rig, &table, &result);
        memcpy(result.left_out, left_out[i], sizeof(left_out[i]));
        assert_equals(rg_table_units(&result, NULL), 2 * 1000 * 2 * wanted[i]);
        end(&rig, &result);
    }
}

// Rows that are left out are not measured, and the others are.
static void rows_that_are_left_out_stay_out(void **state)
{
    (void)state;
    struct slow_rig rig;
    struct rg_result result;
    begin(&rig, &four, &result);
    result.left_out[0] = result.left_out[2] = true;
    assert_true(rg_table_measure(&result, &four, &rig.kept, NULL, NULL, NULL));
    for (int row = 0; row < ROWS; row++)
        assert_int_equal(rg_result_has(&result, row), row % 2);
    assert_int_equal(slow_opened, 2 * 3);
    assert_int_equal(rg_result_first_missing(&result), ROWS);
    end(&rig, &result);
}

// Few samples are taken where they were asked for.
static void lengths_decide_how_many_samples(void **state)
{
    (void)state;
    static const struct {
        bool full, few;
        int samples;
    } cases[] = {{false, false, 15}, {true, false, 61}, {false, true, 6}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_table table = four;
        struct slow_rig rig;
        struct rg_result result;
        table.variants[0].set = "fixed_ms=2 step_ms=0 pixel_us=0";
        begin(&rig, &table, &result);
        result.full = cases[i].full;
        result.few_samples = cases[i].few;
        result.last_row = 0;
        assert_true(rg_table_measure(&result, &table, &rig.kept, NULL, NULL, NULL));
        const struct rg_record *record = rg_result_at(&result, (struct rg_place){0});
        // On gl a frame takes 6 ms: 15 ms are 3 frames, and 60 ms are 10.
        assert_int_equal(record->frames_a_sample, cases[i].full ? 10 : 3);
        assert_at_most(record->sample_count, cases[i].samples);
        assert_int_equal(record->sample_count, cases[i].few ? 6 : cases[i].full ? 30 : 15);
        end(&rig, &result);
    }
}

int main(void)
{
    setenv("RG_LONG_S", "1e9", 1);
    unsetenv("RG_FEW_SAMPLES");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(groups_are_visited_three_times),
        cmocka_unit_test(units_are_of_rows_that_are_wanted),
        cmocka_unit_test(rows_that_are_left_out_stay_out),
        cmocka_unit_test(lengths_decide_how_many_samples),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
