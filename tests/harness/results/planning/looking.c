// What budgets, forecasts and sweeps learn of tables by opening some of their cells: devices and a
// technique that take time by a script, and a clock that only they move.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>

#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/measure/sampling.h"
#include "harness/tables/measuring/cell.h"
#include "harness/tables/measuring/measure.h"
#include "harness/tables/runs/budget.h"
#include "harness/tables/runs/forecast.h"
#include "harness/tables/sweep/plan.h"
#include "tests/harness/measuring/fake.h"
#include "tests/harness/results/planning/slow.h"

#define assert_ms(value, ms) assert_near(value, ms, 1e-6)

static const struct rg_table_row rows[] = {
    {"fixed_ms=2", {1}, "a"}, {"fixed_ms=4", {2}, "b"}, {"fixed_ms=10", {3}, "c"}};
static const struct rg_table table = {.id = "slow-1",
                                      .technique = "slow",
                                      .columns = {"fixed_ms"},
                                      .key_count = 1,
                                      .variants = {{"full", "", NULL}},
                                      .width = 1024,
                                      .height = 512,
                                      .check_frames = 5,
                                      .row_count = 3,
                                      .rows = rows,
                                      .note = "a note"};

// How many times as long as on cpu frames take, on each device.
static const double slowness[] = {1, 10, 3};

// A frame of the first and of the last row, which differ by the same factor at each size.
static double frame_ms(int row, enum rg_budget_size size)
{
    const double pixels[] = {32768, 131072, 524288};
    const double last_ms = 11 + 1.25e-4 * pixels[size], smallest_ms = 11 + 1.25e-4 * pixels[0];
    return row ? last_ms : (3 + 1.25e-4 * pixels[0]) * last_ms / smallest_ms;
}

// Opened, and drawn after four steps, with rain on cpu:reference, which takes ten times as long,
// and without on cpu.
static double check_ms(enum rg_budget_size size)
{
    const double dry_share = (1 + 1.25e-4 * 32768) / (11 + 1.25e-4 * 32768);
    const double ms = (frame_ms(0, size) + frame_ms(1, size)) / 2;
    return 10 * (40 + 4 + ms) + 40 + 4 + dry_share * ms;
}

static void expect_cells(const struct rg_budget_table *costs)
{
    for (int d = 0; d < 3; d++)
        for (enum rg_budget_size size = 0; size < RG_BUDGET_SIZES; size++) {
            double few_ms = 0, all_ms = 0;
            for (int row = 0; row < 2; row++) {
                const struct rg_cell_frames f = {40 * slowness[d], slowness[d],
                                                 frame_ms(row, size) * slowness[d]};
                few_ms += rg_cell_ms(&table, &f, rg_table_few_samples()) / 2;
                all_ms += rg_cell_ms(&table, &f, rg_table_options(false)) / 2;
            }
            assert_ms(costs->cells[d][size].few_s * 1e3, few_ms);
            assert_ms(costs->cells[d][size].all_s * 1e3, all_ms);
        }
}

// Costs follow from rows, sizes and devices; what is known of a technique is not looked at again.
static void what_a_table_takes_is_what_was_seen(void **state)
{
    (void)state;
    struct slow_rig rig;
    struct rg_budget_kind kind = {0};
    struct rg_budget_table costs, again;
    slow_begin(&rig);
    assert_true(rg_budget_probe(&table, &rig.kept, false, &kind, &costs));
    assert_int_equal(costs.rows, 3);
    assert_int_equal(costs.needed_rows, 3);
    assert_int_equal(costs.smallest, RG_BUDGET_FOURTH);
    expect_cells(&costs);
    for (enum rg_budget_size size = 0; size < RG_BUDGET_SIZES; size++)
        assert_ms(costs.check_s[size] * 1e3, check_ms(size));
    // On cpu both ends, a larger picture and a dry one; on others a small and a larger one.
    // Both ends once more for frames behind those that check.
    assert_int_equal(slow_opened, 4 + 2 + 2 + 2);
    slow_opened = 0;
    assert_true(rg_budget_probe(&table, &rig.kept, false, &kind, &again));
    assert_int_equal(slow_opened, 2 + 2); // both ends
    expect_cells(&again);
    slow_end(&rig);
}

// What smaller pictures set is what is opened; a truth, which is of all that a picture shows, is
// looked at once a technique, and counts where pictures are whole.
static void smaller_pictures_show_less(void **state)
{
    (void)state;
    struct slow_rig rig;
    struct rg_budget_kind kind = {0};
    struct rg_budget_table costs, again;
    struct rg_table smaller = table;
    smaller.smaller[0] = "fixed_ms=1";
    smaller.smaller[1] = "fixed_ms=4";
    smaller.shown = "fixed_ms=7";
    smaller.truth = "step_ms=20";
    slow_begin(&rig);
    assert_true(rg_budget_probe(&smaller, &rig.kept, false, &kind, &costs));
    // The ends twice, a larger picture, and one without rain; shown and the truth; two a device.
    assert_int_equal(slow_opened, 4 + 2 + 2 + 2 + 2);
    assert_ms(kind.shown.frame_ms, 1 + 7 + 1.25e-4 * 32768);
    assert_ms(kind.truth.frame_ms, 20 + 7 + 1.25e-4 * 32768);
    // From a sixteenth of the pixels to a quarter it takes 3 ms and 98,304 pixels more.
    const double small_ms = 2 + 1.25e-4 * 32768, a_pixel_ms = (3 + 1.25e-4 * 98304) / 98304;
    const double reference_ms = 10 * (40 + 4), dry_ms = 40 + 4;
    const double dry_share = (1 + 1.25e-4 * 32768) / small_ms;
    for (enum rg_budget_size size = 0; size < RG_BUDGET_SIZES; size++) {
        const double ms = small_ms + a_pixel_ms * ((32768 << 2 * size) - 32768);
        const double due_ms = reference_ms + 10 * ms + dry_ms + dry_share * ms;
        const double error_ms = (40 + 4 + kind.shown.frame_ms) + (40 + 80 + kind.truth.frame_ms);
        assert_ms(costs.check_s[size] * 1e3, due_ms + (size < RG_BUDGET_WHOLE ? 0 : error_ms));
        assert_ms(
            costs.cells[0][size].few_s * 1e3,
            rg_cell_ms(&smaller, &(struct rg_cell_frames){40, 1, ms}, rg_table_few_samples()));
    }
    slow_opened = 0;
    assert_true(rg_budget_probe(&smaller, &rig.kept, false, &kind, &again));
    assert_int_equal(slow_opened, 2 + 2);
    slow_end(&rig);
}

static const struct rg_table_row late_rows[] = {{"fixed_ms=2 late_ms=7 late_frame=4", {1}, "a"},
                                                {"fixed_ms=10 late_ms=90 late_frame=4", {3}, "c"}};

// Of three steps behind the second frame the last two are late.
static struct rg_cell_frames late_frames(int row, enum rg_budget_size size, int device)
{
    const double late_ms = row ? 90 : 7, slow = slowness[device];
    const double pixels = 1024.0 * 512 / (1 << 2 * (2 - (int)size));
    const double drawn_ms = (row ? 10 : 2) + late_ms + 1.25e-4 * pixels;
    return (struct rg_cell_frames){40 * slow, (1 + late_ms * 2 / 3) * slow,
                                   (1 + late_ms + drawn_ms) * slow};
}

// Frames are expected to take what they do once rain has built up, on all devices, and steps what
// they do on average until then.
static void rain_that_builds_up_takes_longer(void **state)
{
    (void)state;
    struct slow_rig rig;
    struct rg_budget_kind kind = {0};
    struct rg_budget_table costs;
    struct rg_table built_up = table;
    built_up.rows = late_rows;
    built_up.row_count = 2;
    slow_begin(&rig);
    for (int turn = 0; turn < 2; turn++) { // when nothing is known of its technique, and when it is
        assert_true(rg_budget_probe(&built_up, &rig.kept, false, &kind, &costs));
        for (int d = 0; d < 3; d++) {
            double few_ms = 0;
            for (int row = 0; row < 2; row++) {
                const struct rg_cell_frames f = late_frames(row, RG_BUDGET_FOURTH, d);
                few_ms += rg_cell_ms(&built_up, &f, rg_table_few_samples()) / 2;
            }
            assert_ms(costs.cells[d][RG_BUDGET_FOURTH].few_s * 1e3, few_ms);
        }
    }
    slow_end(&rig);
}

// So are those of a sweep, whose rows are opened on each device.
static void a_sweep_is_of_rain_that_has_built_up(void **state)
{
    (void)state;
    struct slow_rig rig;
    struct rg_plan plan;
    struct rg_table sweep = table;
    sweep.rows = late_rows;
    sweep.row_count = 2;
    slow_begin(&rig);
    assert_true(rg_plan_make(&sweep, NULL, true, &rig.kept, &plan));
    for (int d = 0; d < 3; d++) {
        double ms = 0;
        for (int row = 0; row < 2; row++) {
            const struct rg_cell_frames f = late_frames(row, RG_BUDGET_WHOLE, d);
            ms += rg_cell_ms(&sweep, &f, rg_table_options(true));
        }
        assert_ms(plan.device_s[d] * 1e3, ms);
    }
    slow_end(&rig);
}

// Plans a sweep with a hundred thousand steps before the frames that are timed, one opening of
// which is interrupted, or none (0), and returns how long that takes.
static double plan_many_steps(int interrupted, struct rg_plan *plan)
{
    struct slow_rig rig;
    struct rg_table sweep = table;
    sweep.check_frames = 100000;
    slow_begin(&rig);
    slow_interrupted = interrupted;
    const double start_ms = rg_now_ms();
    assert_true(rg_plan_make(&sweep, NULL, true, &rig.kept, plan) || interrupted);
    const double taken_ms = rg_now_ms() - start_ms;
    slow_end(&rig);
    return taken_ms;
}

// They are not all simulated to tell what they take.
static void looking_takes_a_moment(void **state)
{
    (void)state;
    struct rg_plan plan;
    const int looks = 2 * 3; // two rows on three devices
    assert_true(plan_many_steps(0, &plan) < looks * 6000);
    assert_true(plan.device_s[0] > 3 * 1e-3 * 100000); // three rows, a millisecond a step
}

// None of them is simulated once the command was interrupted.
static void an_interrupted_look_ends(void **state)
{
    (void)state;
    struct rg_plan plan;
    rg_interrupt_watch();
    assert_true(plan_many_steps(1, &plan) < 6000);
    assert_true(rg_interrupted());
}

// What the first instance of a table makes for all is no part of what each of them takes.
static void what_instances_share_is_made_once(void **state)
{
    (void)state;
    for (int check_frames = 1; check_frames <= 5; check_frames += 4) {
        struct slow_rig rig;
        struct rg_budget_kind kind = {0};
        struct rg_budget_table alone, sharing;
        struct rg_table shares = table;
        shares.check_frames = check_frames;
        slow_begin(&rig);
        assert_true(rg_budget_probe(&shares, &rig.kept, false, &kind, &alone));
        slow_shares(800);
        assert_true(rg_budget_probe(&shares, &rig.kept, false, &kind, &sharing));
        for (enum rg_budget_size size = 0; size < RG_BUDGET_SIZES; size++)
            assert_ms(sharing.cells[0][size].few_s * 1e3, alone.cells[0][size].few_s * 1e3);
        slow_end(&rig);
    }
}

// A small picture is not made smaller, and a device that fails takes nothing.
static void a_device_that_fails_takes_nothing(void **state)
{
    (void)state;
    struct slow_rig rig;
    struct rg_budget_kind kind = {0};
    struct rg_budget_table costs;
    struct rg_table small = table;
    small.width = 256;
    slow_begin(&rig);
    rig.fakes[2]->waits_left = 0;
    assert_true(rg_budget_probe(&small, &rig.kept, false, &kind, &costs));
    assert_int_equal(costs.smallest, RG_BUDGET_WHOLE);
    assert_true(costs.cells[2][RG_BUDGET_WHOLE].few_s == 0);
    assert_true(costs.cells[0][RG_BUDGET_WHOLE].few_s > 0);
    // Without cpu all cells fail. One tells so: others might have to be waited for as long.
    rig.fakes[0]->waits_left = 0;
    slow_opened = 0;
    assert_false(rg_budget_probe(&small, &rig.kept, false, &kind, &costs));
    assert_int_equal(slow_opened, 1);
    rig.fakes[0]->waits_left = -1;
    slow_end(&rig);
}

// A row that cannot be opened, as where a model is absent, leaves the table to those that can.
static void rows_that_fail_leave_it_to_others(void **state)
{
    (void)state;
    static const struct rg_table_row failing[][3] = {
        {{"fixed_ms=2", {1}, "a"}, {"fixed_ms=4", {2}, "b"}, {"absent=1", {3}, "c"}},
        {{"absent=1", {1}, "a"}, {"fixed_ms=4", {2}, "b"}, {"fixed_ms=10", {3}, "c"}},
        {{"absent=1", {1}, "a"}, {"fixed_ms=4", {2}, "b"}, {"absent=1", {3}, "c"}}};
    static const double fixed_ms[] = {2, 10, 0};
    struct rg_table small = table;
    small.width = 256;
    small.truth = "step_ms=20";
    for (int which = 0; which < 3; which++) {
        struct slow_rig rig;
        struct rg_budget_kind kind = {0};
        struct rg_budget_table costs;
        small.rows = failing[which];
        slow_begin(&rig);
        const bool any = fixed_ms[which] > 0;
        assert_int_equal(rg_budget_probe(&small, &rig.kept, false, &kind, &costs), any);
        for (int d = 0; d < 3; d++) {
            const double ms = 1 + fixed_ms[which] + 1.25e-4 * 256 * 512;
            const struct rg_cell_frames f = {40 * slowness[d], slowness[d], ms * slowness[d]};
            const double due_ms = rg_cell_ms(&small, &f, rg_table_few_samples());
            assert_ms(costs.cells[d][RG_BUDGET_WHOLE].few_s * 1e3, any ? due_ms : 0);
        }
        slow_end(&rig);
    }
}

// On a new machine drivers compile for a while, once, which is no part of what later cells take.
static void what_a_driver_compiles_once_is_not_expected_again(void **state)
{
    (void)state;
    for (int width = 256; width <= 1024; width *= 4) {
        struct slow_rig rig;
        struct rg_budget_kind kind = {0}, cold_kind = {0};
        struct rg_budget_table warm, cold;
        struct rg_table wide = table;
        wide.width = width;
        slow_begin(&rig);
        assert_true(rg_budget_probe(&wide, &rig.kept, false, &kind, &warm));
        const int opened = slow_opened;
        slow_compiles(20000);
        assert_true(rg_budget_probe(&wide, &rig.kept, false, &cold_kind, &cold));
        assert_int_equal(slow_opened, 2 * opened + 1);
        for (enum rg_budget_size size = 0; size < RG_BUDGET_SIZES; size++)
            assert_ms(cold.cells[2][size].few_s * 1e3, warm.cells[2][size].few_s * 1e3);
        slow_end(&rig);
    }
}

// Levels of a texture take what opening it takes, once for those with the same settings.
static void textures_take_what_opening_them_takes(void **state)
{
    (void)state;
    static const struct rg_table_row levels[] = {
        {"", {0}, "a"}, {"", {1}, "a"}, {"fixed_ms=1", {0}, "a"}, {"fixed_ms=1", {1}, "a"}};
    static const double due_ms[] = {40, 400, 120};
    struct slow_rig rig;
    struct rg_budget_kind kind = {0};
    struct rg_budget_table costs;
    struct rg_table textures = table;
    textures.rows = levels;
    textures.row_count = 4;
    textures.is_of_textures = true;
    for (int compiles = 0; compiles < 2; compiles++) { // a driver, which keeps what it compiled
        slow_begin(&rig);
        if (compiles)
            slow_compiles(20000);
        assert_true(rg_budget_probe(&textures, &rig.kept, false, &kind, &costs));
        assert_int_equal(slow_opened, 3 + compiles);
        for (int d = 0; d < 3; d++) {
            const struct rg_budget_choice c = {.devices = 1u << d, .size = RG_BUDGET_WHOLE};
            assert_ms(rg_budget_expect(&costs, &c) * 1e3, 2 * due_ms[d]);
        }
        slow_end(&rig);
    }
}

// A cell takes what it does on the average device, with its share of what the row is checked by. In
// full mode each row is opened as it will be measured.
static void a_forecast_is_of_each_row(void **state)
{
    (void)state;
    static const double fixed_ms[] = {2, 4, 10};
    const struct rg_measure_options *full = rg_table_options(true);
    const double pixels_ms = 1.25e-4 * 524288, dry_share = (1 + pixels_ms) / (11 + pixels_ms);
    const struct rg_table_part all = {.last_row = 2, .full = true};
    struct rg_forecast forecasts[2] = {{.table = &table, .part = all, .rows = {true, true, true}},
                                       {.table = &table, .part = all, .rows = {true, false, true}}};
    struct slow_rig rig;
    slow_begin(&rig);
    rg_forecast(forecasts, 2, &rig.kept);
    for (int row = 0; row < 3; row++) {
        const double ms = 1 + fixed_ms[row] + pixels_ms;
        const struct rg_cell_frames reference = {400, 10, 10 * ms};
        const double reference_ms = rg_cell_ms(&table, &reference, full);
        double open_ms = 10 * (40 + 4 + ms) + 40 + 4 + dry_share * ms, sampling_ms = 0;
        for (int d = 0; d < 3; d++) {
            const struct rg_cell_frames f = {40 * slowness[d], slowness[d], ms * slowness[d]};
            const struct rg_sampling sampling = rg_sampling_of(f.frame_ms, 0, full);
            sampling_ms += rg_sampling_ms(&sampling, f.frame_ms);
            open_ms += rg_cell_ms(&table, &f, full) - rg_sampling_ms(&sampling, f.frame_ms);
        }
        for (int i = 0; i < 2; i++) {
            if (!forecasts[i].rows[row])
                continue;
            assert_ms(forecasts[i].times[row].open_ms, open_ms / 3);
            assert_ms(forecasts[i].times[row].sampling_ms, sampling_ms / 3);
            assert_ms(forecasts[i].times[row].reference_ms, reference_ms);
        }
    }
    // Of the first table each row twice, a dry one, and one on two other devices; of the second two
    // rows twice.
    assert_int_equal(slow_opened, 2 * 3 + 1 + 2 + 2 * 2);
    slow_end(&rig);
    assert_true(rg_forecast_is_worth(1, true));
    assert_false(rg_forecast_is_worth(299, false));
}

// A work that takes longer is looked at on each device, once for tables whose works are the same; a
// cell takes what it does on average over the works that are asked for.
static void a_forecast_is_of_each_work(void **state)
{
    (void)state;
    const struct rg_table_part all = {.last_row = 2, .full = true};
    const struct rg_table_part one = {.last_row = 2, .full = true, .work = "ours"};
    struct rg_table worked = table;
    worked.works[0] = (struct rg_table_work){.name = "paper", .set = "", .saves = ""};
    worked.works[1] = (struct rg_table_work){.name = "ours", .set = "fixed_ms=90", .saves = ""};
    struct rg_forecast f[4] = {{.table = &table, .part = all, .rows = {true, true, true}},
                               {.table = &worked, .part = all, .rows = {true, true, true}},
                               {.table = &worked, .part = all, .rows = {true, true, true}},
                               {.table = &worked, .part = one, .rows = {true, true, true}}};
    struct slow_rig rig;
    slow_begin(&rig);
    rg_forecast(f, 1, &rig.kept);
    const int first_opened = slow_opened;
    rg_forecast(f + 1, 2, &rig.kept);
    // The dry row and two devices for the technique, three rows a table twice, and the work on
    // three.
    assert_int_equal(first_opened, 2 * 3 + 1 + 2);
    assert_int_equal(slow_opened - first_opened, 2 * 3 + 1 + 2 + 2 * 3 + 3);
    rg_forecast(f + 3, 1, &rig.kept);
    const int last = 2;
    const double first_ms = f[0].times[last].sampling_ms, both_ms = f[1].times[last].sampling_ms;
    const double ours_ms = f[3].times[last].sampling_ms;
    assert_true(ours_ms > first_ms);
    assert_ms(both_ms, (first_ms + ours_ms) / 2);
    for (int row = 0; row <= last; row++)
        assert_ms(f[2].times[row].sampling_ms, f[1].times[row].sampling_ms);
    slow_end(&rig);
}

// Works of more settings than are remembered: what is forgotten is looked at again, and none is
// taken for another.
static void a_forecast_tells_many_works_apart(void **state)
{
    (void)state;
    static const char *const sets[] = {"fixed_ms=20", "fixed_ms=90", "fixed_ms=300",
                                       "fixed_ms=30", "fixed_ms=70", "fixed_ms=500"};
    static const char *const names[] = {"reading", "ours", "queries"};
    const struct rg_table_part all = {.last_row = 2, .full = true};
    struct rg_table worked[2];
    struct rg_forecast both[2], alone[2];
    struct slow_rig rig;
    for (int t = 0; t < 2; t++) {
        worked[t] = table;
        worked[t].works[0] = (struct rg_table_work){.name = "paper", .set = "", .saves = ""};
        for (int w = 0; w < 3; w++)
            worked[t].works[w + 1] =
                (struct rg_table_work){.name = names[w], .set = sets[3 * t + w], .saves = ""};
        both[t] = alone[t] =
            (struct rg_forecast){.table = &worked[t], .part = all, .rows = {true, true, true}};
    }
    slow_begin(&rig);
    rg_forecast(both, 2, &rig.kept);
    for (int t = 0; t < 2; t++)
        rg_forecast(&alone[t], 1, &rig.kept);
    slow_end(&rig);
    for (int t = 0; t < 2; t++)
        for (int row = 0; row < 3; row++)
            assert_ms(both[t].times[row].sampling_ms, alone[t].times[row].sampling_ms);
    assert_true(both[1].times[2].sampling_ms > both[0].times[2].sampling_ms);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_a_table_takes_is_what_was_seen),
        cmocka_unit_test(smaller_pictures_show_less),
        cmocka_unit_test(rain_that_builds_up_takes_longer),
        cmocka_unit_test(a_sweep_is_of_rain_that_has_built_up),
        cmocka_unit_test(looking_takes_a_moment),
        cmocka_unit_test(what_instances_share_is_made_once),
        cmocka_unit_test(a_device_that_fails_takes_nothing),
        cmocka_unit_test(rows_that_fail_leave_it_to_others),
        cmocka_unit_test(what_a_driver_compiles_once_is_not_expected_again),
        cmocka_unit_test(textures_take_what_opening_them_takes),
        cmocka_unit_test(a_forecast_is_of_each_row),
        cmocka_unit_test(a_forecast_is_of_each_work),
        cmocka_unit_test(a_forecast_tells_many_works_apart),
        cmocka_unit_test(an_interrupted_look_ends), // last, for it stays interrupted
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
