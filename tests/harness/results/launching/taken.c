// Launches on a device that only takes time, by a script: which frames are timed, in which order
// and how often, and what a record gets.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/devices/devices.h"
#include "harness/devices/measure/others.h"
#include "harness/tables/launching/launches.h"
#include "tests/harness/devices/measuring/fake.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

#define assert_ms(value, ms) assert_near(value, ms, 1e-6)

// --- stand-ins for the product's own functions ---

// The technique of fake.h, with the script's members as parameters; a letter is its code.
#define AT(field) offsetof(struct fake_script, field)
static const struct rg_param params[] = {
    {"letter", RG_PARAM_INT, AT(letter), 'a', 0, 127, "1", "of its events", NULL},
    {"open_ms", RG_PARAM_FLOAT, AT(open_ms), 0, 0, 1e6, "ms", "of opening", NULL},
    {"draw_ms", RG_PARAM_FLOAT, AT(draw_ms), 0, 0, 1e6, "ms", "of a frame", NULL},
    {"cold_ms", RG_PARAM_FLOAT, AT(cold_ms), 0, 0, 1e6, "ms", "after others' frames", NULL}};
static const struct rg_param_table param_table = {
    .technique = "fake", .rows = params, .count = 4, .settings_size = sizeof(struct fake_script)};
static struct rg_technique technique;

const struct rg_technique *rg_technique_find(const char *name)
{
    (void)name;
    return &technique;
}

// A device named "lost" is lost at its first wait, and one named "none" cannot be opened.
struct rg_device *rg_devices_open_one(const char *name)
{
    if (!strcmp(name, "none"))
        return rg_driver_error_null("none: is not there");
    struct fake_device *fake = fake_open();
    rg_text_copy(fake->pub.info.name, sizeof(fake->pub.info.name), name);
    fake->waits_left = strcmp(name, "lost") ? -1 : 0;
    return &fake->pub;
}

static struct rg_taken taken;

struct rg_taken rg_taken_between(const struct rg_processors *before,
                                 const struct rg_processors *after)
{
    (void)before;
    (void)after;
    return taken;
}

// --- a table ---

static const struct rg_table_row rows[] = {{"letter=97", {1}, NULL},
                                           {"letter=98", {2}, NULL},
                                           {"letter=99", {3}, NULL},
                                           {"letter=100", {4}, NULL}};
static const struct rg_table four = {.id = "made-up",
                                     .technique = "fake",
                                     .columns = {"size"},
                                     .key_count = 1,
                                     .variants = {{"full", "", NULL}},
                                     .width = 8,
                                     .height = 8,
                                     .check_frames = 2,
                                     .row_count = 4,
                                     .rows = rows,
                                     .note = "a note"};

// The table on devices of these names; its frames have these settings.
static void begin(struct rg_result *result, struct rg_table *table, const char *set,
                  const char *name, const char *other)
{
    struct rg_device one = {.info = {.name = ""}}, two = one;
    const struct rg_devices devices = {.count = other ? 2 : 1, .devices = {&one, &two}};
    rg_text_copy(one.info.name, sizeof(one.info.name), name);
    rg_text_copy(two.info.name, sizeof(two.info.name), other ? other : "");
    *table = four;
    table->variants[0].set = set;
    *result = (struct rg_result){0};
    rg_table_begin(result, table, &(struct rg_table_part){.last_row = 3, .full = true}, &devices);
    for (int row = 0; row < 4; row++)
        assert_true(rg_table_add_row(result, table, row));
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);) {
        struct rg_record *record = rg_result_at(result, at);
        record->sample_count = 1;
        record->samples_ms[0] = at.row + 1;
        rg_record_settle(record);
    }
    taken = (struct rg_taken){0, 0};
    *logged = 0;
    rg_log_listen(log_all, NULL);
    fake_forget();
}

static void end(struct rg_result *result)
{
    rg_log_listen(NULL, NULL);
    rg_result_free(result);
}

static const struct rg_record *record_at(const struct rg_result *result, int row, int device)
{
    return rg_result_at(result, (struct rg_place){.row = row, .device = device});
}

// Cells of the first rows, with their groups as letters.
static struct rg_launch_cells cells_of(const char *groups)
{
    struct rg_launch_cells cells = {0};
    for (; groups[cells.count]; cells.count++) {
        const int group = groups[cells.count] - 'A';
        cells.cells[cells.count] =
            (struct rg_launch_cell){.at = {.row = cells.count}, .group = group};
        cells.group_count = group >= cells.group_count ? group + 1 : cells.group_count;
    }
    return cells;
}

static int count_of(char event)
{
    int count = 0;
    for (const char *at = fake_events(); *at; at++)
        count += *at == event;
    return count;
}

// The cells in the order of their slots; those that follow each other count once.
static const char *order_of_cells(void)
{
    static char order[256];
    size_t used = 0;
    for (const char *at = fake_events(); *at; at++)
        if (*at >= 'a' && *at <= 'd' && (!used || order[used - 1] != *at) &&
            used + 1 < sizeof(order))
            order[used++] = *at;
    order[used] = 0;
    return order;
}

// --- how often ---

// By hand: what a launch of one cell costs. Opening takes two check frames, of which the last is
// drawn, and two frames more.
static void cells_are_timed_long_enough(void **state)
{
    (void)state;
    static const struct {
        const char *set;
        int steps, openings, window;
    } cases[] = {// Two timings of a frame, there and back.
                 {"draw_ms=200", 4 + 2 * 2, 1, 0},
                 // The same with a frame before each timing. Rounds of 2 * 20 ms: four are most.
                 {"draw_ms=10", 4 + 8 * 2 * 2, 1, 0},
                 // Two rounds of 2 * 2 * 32 ms are more than 250 ms.
                 {"draw_ms=32", 4 + 4 * 2 * 2, 1, 0},
                 // Nine timings are most, each of 16 frames.
                 {"draw_ms=0.125", 4 + 8 * 9 * (16 + 1), 1, 0},
                 // A window of 5 frames has room for one timing of 4: each is of a new instance.
                 {"draw_ms=0.125", 4 + 8 * 9 * (2 + 4 + 1), 1 + 8 * 9, 5}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_result result;
        struct rg_table table;
        const struct rg_launch_cells cells = cells_of("A");
        begin(&result, &table, cases[i].set, "fake", NULL);
        table.window_frames = cases[i].window;
        assert_true(rg_launch_take(&result, &table, &cells, 1));
        assert_int_equal(count_of('a'), cases[i].steps);
        assert_int_equal(count_of('('), cases[i].openings);
        end(&result);
    }
}

// --- in which order ---

// There and back again: a launch begins with any of the cells, and the same launch always with the
// same one.
static void cells_of_a_group_go_there_and_back(void **state)
{
    (void)state;
    char first[8] = "";
    for (int number = 1; number <= 12; number++) {
        char orders[2][256];
        for (int again = 0; again < 2; again++) {
            struct rg_result result;
            struct rg_table table;
            const struct rg_launch_cells cells = cells_of("AAA");
            begin(&result, &table, "draw_ms=64", "fake", NULL);
            assert_true(rg_launch_take(&result, &table, &cells, number));
            snprintf(orders[again], sizeof(orders[again]), "%s", order_of_cells());
            end(&result);
        }
        const char *order = orders[0];
        assert_string_equal(orders[1], order);
        assert_int_equal(strlen(order), 5); // the cell at the turn twice in a row
        assert_true(order[0] == order[4] && order[1] == order[3]);
        assert_true(order[0] != order[2] && order[1] != order[2]);
        if (!strchr(first, order[0]))
            snprintf(first + strlen(first), sizeof(first) - strlen(first), "%c", order[0]);
    }
    assert_int_equal(strlen(first), 3);
}

// A group is done before the next one begins, and its cells are then closed.
static void groups_follow_each_other(void **state)
{
    (void)state;
    int b_first = 0;
    for (int number = 1; number <= 12; number++) {
        struct rg_result result;
        struct rg_table table;
        const struct rg_launch_cells cells = cells_of("ABAB");
        begin(&result, &table, "draw_ms=100", "fake", NULL);
        assert_true(rg_launch_take(&result, &table, &cells, number));
        const char *order = order_of_cells();
        assert_int_equal(strlen(order), 6); // as in acabdb
        const bool is_b = order[0] == 'b' || order[0] == 'd';
        for (int i = 0; i < 6; i++)
            assert_int_equal(order[i] == 'b' || order[i] == 'd', (i < 3) == is_b);
        assert_int_equal(count_of('('), 4);
        b_first += is_b;
        end(&result);
    }
    assert_int_equal(b_first, 9); // as the numbers' chance has it
}

// --- what a record gets ---

// A frame that follows another cell's takes longer, which is not kept as its own time.
static void a_launch_is_kept_with_its_circumstances(void **state)
{
    (void)state;
    struct rg_result result;
    struct rg_table table;
    const struct rg_launch_cells cells = cells_of("AA");
    begin(&result, &table, "draw_ms=8 cold_ms=64", "fake", NULL);
    taken = (struct rg_taken){.stolen = 0.25, .others = 0.125};
    assert_true(rg_launch_take(&result, &table, &cells, 3));
    assert_true(rg_launch_take(&result, &table, &cells, 7));
    for (int row = 0; row < 2; row++) {
        const struct rg_record *record = record_at(&result, row, 0);
        assert_int_equal(record->launch_count, 2);
        assert_int_equal(record->launches[0].number, 3);
        assert_int_equal(record->launches[1].number, 7);
        for (int i = 0; i < 2; i++) {
            assert_ms(record->launches[i].ms, 8);
            assert_equals(record->launches[i].stolen, 0.25);
            assert_equals(record->launches[i].others, 0.125);
        }
    }
    assert_int_equal(record_at(&result, 2, 0)->launch_count, 0);
    end(&result);
    // Opening, a check frame, two frames, and two slots of two.
    begin(&result, &table, "open_ms=50 draw_ms=200", "fake", NULL);
    const struct rg_launch_cells one = cells_of("A");
    assert_true(rg_launch_take(&result, &table, &one, 1));
    assert_ms(record_at(&result, 0, 0)->launches[0].seconds, (50 + 7 * 200) / 1000.0);
    end(&result);
}

static void a_launch_that_fails_is_not_kept(void **state)
{
    (void)state;
    struct rg_result result;
    struct rg_table table;
    struct rg_launch_cells cells = cells_of("A");
    cells.cells[0].at.row = 1;
    begin(&result, &table, "draw_ms=8", "lost", NULL);
    assert_false(rg_launch_take(&result, &table, &cells, 5));
    assert_non_null(strstr(logged, "made-up: launch 5 of row 2 on lost failed: "));
    assert_int_equal(record_at(&result, 1, 0)->launch_count, 0);
    assert_int_equal(record_at(&result, 1, 0)->outcome, RG_OK); // of its own measurement
    end(&result);
    begin(&result, &table, "draw_ms=8", "none", NULL);
    assert_false(rg_launch_take(&result, &table, &cells, 5));
    assert_string_equal(logged, "none: is not there\n");
    end(&result);
}

// --- a course ---

static const struct rg_claim claims[] = {{.table = "made-up",
                                          .variant = "full",
                                          .words = "twice as fast",
                                          .test = RG_CLAIM_RATIO,
                                          .first = 1,
                                          .last = 3,
                                          .least = 0.5},
                                         {.table = "another",
                                          .variant = "full",
                                          .words = "of no rows of ours",
                                          .test = RG_CLAIM_FALLS,
                                          .first = 1,
                                          .last = 4},
                                         {.table = NULL}};

static const struct rg_launches_wanted decisions = {.claims = claims};
static const struct rg_launches_wanted three = {.of_each = 3};

static bool take_wanted(struct rg_result *result, const struct rg_table *table,
                        const struct rg_launches_wanted *wanted, double end_ms)
{
    struct rg_progress bar;
    rg_progress_start(&bar, 1);
    bar.shown = false;
    rg_log_listen(log_all, NULL);
    const bool ok = rg_launches_take(result, table, wanted, NULL, &bar, end_ms);
    rg_progress_end(&bar);
    return ok;
}

static bool take(struct rg_result *result, const struct rg_table *table, double end_ms)
{
    return take_wanted(result, table, &decisions, end_ms);
}

// Twelve launches for a look, and as many to confirm it, on each device that works.
static void a_course_takes_what_its_claims_need(void **state)
{
    (void)state;
    struct rg_result result;
    struct rg_table table;
    begin(&result, &table, "draw_ms=100", "fake", "other");
    assert_true(take(&result, &table, 0));
    for (int device = 0; device < 2; device++)
        for (int row = 0; row < 4; row++) {
            const struct rg_record *record = record_at(&result, row, device);
            assert_int_equal(record->launch_count, row == 0 || row == 2 ? 24 : 0);
            for (int i = 0; i < record->launch_count; i++)
                assert_int_equal(record->launches[i].number, i + 1);
        }
    assert_false(rg_launches_are_due(&result, &decisions));
    end(&result);
    begin(&result, &table, "draw_ms=100", "none", "other");
    assert_false(take(&result, &table, 0));
    assert_int_equal(record_at(&result, 0, 0)->launch_count, 0);
    assert_int_equal(record_at(&result, 0, 1)->launch_count, 24);
    end(&result);
}

static void no_launch_begins_after_the_end(void **state)
{
    (void)state;
    struct rg_result result;
    struct rg_table table;
    begin(&result, &table, "draw_ms=100", "fake", NULL);
    assert_true(take(&result, &table, rg_now_ms()));
    assert_int_equal(record_at(&result, 0, 0)->launch_count, 0);
    const double start_ms = rg_now_ms();
    const struct rg_launch_cells cells = cells_of("AA");
    assert_true(rg_launch_take(&result, &table, &cells, 1));
    const double launch_ms = rg_now_ms() - start_ms;
    end(&result);
    begin(&result, &table, "draw_ms=100", "fake", NULL);
    assert_true(take(&result, &table, rg_now_ms() + 2.5 * launch_ms));
    assert_int_equal(record_at(&result, 0, 0)->launch_count, 3);
    assert_true(rg_launches_are_due(&result, &decisions));
    end(&result);
}

// --- launches of each cell ---

// Their times replace those of the samples; a cell that failed has none.
static void each_cell_gets_so_many_launches(void **state)
{
    (void)state;
    struct rg_result result;
    struct rg_table table;
    begin(&result, &table, "draw_ms=100", "fake", "other");
    rg_record_end(rg_result_at(&result, (struct rg_place){.row = 2}), RG_ERROR, "no such thing");
    assert_true(take_wanted(&result, &table, &three, 0));
    for (int device = 0; device < 2; device++)
        for (int row = 0; row < 4; row++) {
            const struct rg_record *record = record_at(&result, row, device);
            assert_int_equal(record->launch_count, device == 0 && row == 2 ? 0 : 3);
            if (record->launch_count)
                assert_ms(record->frame_ms.median, 100);
        }
    assert_false(rg_launches_are_due(&result, &three));
    end(&result);
}

// Where others disturb every launch, a cell gets three more, and its samples are told.
static void disturbed_launches_are_taken_again_once(void **state)
{
    (void)state;
    struct rg_result result;
    struct rg_table table;
    begin(&result, &table, "draw_ms=100", "fake", NULL);
    taken = (struct rg_taken){.others = 0.25};
    assert_true(take_wanted(&result, &table, &three, 0));
    for (int row = 0; row < 4; row++) {
        assert_int_equal(record_at(&result, row, 0)->launch_count, 6);
        assert_ms(record_at(&result, row, 0)->frame_ms.median, row + 1);
    }
    end(&result);
    begin(&result, &table, "draw_ms=100", "fake", NULL);
    taken = (struct rg_taken){.others = 0.25};
    const struct rg_launch_cells cells = cells_of("A");
    assert_true(rg_launch_take(&result, &table, &cells, 1));
    taken = (struct rg_taken){0, 0};
    assert_true(take_wanted(&result, &table, &three, 0));
    for (int row = 0; row < 4; row++)
        assert_int_equal(record_at(&result, row, 0)->launch_count, row ? 3 : 4);
    end(&result);
}

// Rows follow each other, and a row's cells are compared: each is closed before the next opens.
static void rows_are_launched_one_after_the_other(void **state)
{
    (void)state;
    struct rg_result result;
    struct rg_table table;
    struct rg_launch_cells cells;
    begin(&result, &table, "draw_ms=100", "fake", NULL);
    assert_int_equal(rg_launches_next(&result, &three, 0, &cells), 1);
    assert_int_equal(cells.count, 4);
    assert_int_equal(cells.group_count, 4);
    end(&result);
}

int main(void)
{
    technique = fake_technique;
    technique.params = &param_table;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cells_are_timed_long_enough),
        cmocka_unit_test(cells_of_a_group_go_there_and_back),
        cmocka_unit_test(groups_follow_each_other),
        cmocka_unit_test(a_launch_is_kept_with_its_circumstances),
        cmocka_unit_test(a_launch_that_fails_is_not_kept),
        cmocka_unit_test(a_course_takes_what_its_claims_need),
        cmocka_unit_test(no_launch_begins_after_the_end),
        cmocka_unit_test(each_cell_gets_so_many_launches),
        cmocka_unit_test(disturbed_launches_are_taken_again_once),
        cmocka_unit_test(rows_are_launched_one_after_the_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
