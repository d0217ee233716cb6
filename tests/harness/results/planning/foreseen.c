// A dry run of a sweep learns about its cells by opening some of them, and a cell's time follows
// from its frames'. Devices and a technique take time by a script, and only they move the clock.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/tables/measuring/cell.h"
#include "harness/tables/measuring/measure.h"
#include "harness/tables/own/estimate.h"
#include "tests/harness/devices/measuring/fake.h"
#include "tests/harness/results/planning/slow.h"
#include "tests/tools/expect.h"

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

// Each device's time of a frame, relative to cpu.
static const double slowness[] = {1, 10, 3};

static const struct rg_table_row late_rows[] = {{"fixed_ms=2 late_ms=7 late_frame=4", {1}, "a"},
                                                {"fixed_ms=10 late_ms=90 late_frame=4", {3}, "c"}};

// The last two of three steps after the second frame are late.
static struct rg_cell_frames late_frames(int row, int device)
{
    const double late_ms = row ? 90 : 7, slow = slowness[device];
    const double drawn_ms = (row ? 10 : 2) + late_ms + 1.25e-4 * 1024 * 512;
    return (struct rg_cell_frames){40 * slow, (1 + late_ms * 2 / 3) * slow,
                                   (1 + late_ms + drawn_ms) * slow};
}

// Frames are expected to take their time with full rain, and steps their average until then.
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
            const struct rg_cell_frames f = late_frames(row, d);
            ms += rg_cell_ms(&sweep, &f, rg_table_options(true));
        }
        assert_ms(plan.device_s[d] * 1e3, ms);
    }
    slow_end(&rig);
}

// A row's frames on a device: 65.536 ms are those of its pixels.
static struct rg_cell_frames frames_of(double step_ms, double frame_ms, int device)
{
    const double slow = slowness[device];
    return (struct rg_cell_frames){40 * slow, step_ms * slow, frame_ms * slow};
}

// Only the ends are opened. What both have of a time grows by equal factors, and what one of them
// lacks by equal steps.
static void rows_between_the_ends_are_interpolated(void **state)
{
    (void)state;
    static const struct rg_table_row ends[] = {{"fixed_ms=2 step_ms=0", {1}, "a"},
                                               {"fixed_ms=400 step_ms=9", {2}, "b"},
                                               {"fixed_ms=10 step_ms=4", {3}, "c"}};
    const double first_ms = 2 + 65.536, last_ms = 4 + 10 + 65.536;
    const double frames_ms[] = {first_ms, sqrt(first_ms * last_ms), last_ms};
    struct slow_rig rig;
    struct rg_plan plan;
    struct rg_table sweep = table;
    sweep.rows = ends;
    slow_begin(&rig);
    assert_true(rg_plan_make(&sweep, NULL, true, &rig.kept, &plan));
    assert_int_equal(slow_opened, 2 * 3);
    assert_int_equal(plan.rows, 3);
    assert_int_equal(plan.devices, 3);
    assert_int_equal(plan.failed, 0);
    assert_equals(plan.check_s, 0); // cpu:reference draws the images as one of the devices
    for (int d = 0; d < 3; d++) {
        double ms = 0;
        for (int row = 0; row < 3; row++) {
            const struct rg_cell_frames f = frames_of(2 * row, frames_ms[row], d);
            ms += rg_cell_ms(&sweep, &f, rg_table_options(true));
        }
        assert_ms(plan.device_s[d] * 1e3, ms);
    }
    slow_end(&rig);
}

// The settings over all rows count, and the reference that is not among the devices draws each
// row's image.
static void images_are_foreseen_apart(void **state)
{
    (void)state;
    struct slow_rig rig;
    struct rg_plan plan;
    slow_begin(&rig);
    const struct rg_devices two = {.count = 2, .devices = {&rig.fakes[0]->pub, &rig.fakes[2]->pub}};
    rig.kept.devices = &two;
    rig.kept.own[0] = &rig.fakes[1]->pub; // as if it had been opened in addition
    assert_true(rg_plan_make(&table, "fixed_ms=5 step_ms=3", false, &rig.kept, &plan));
    rig.kept.own[0] = NULL;
    const struct rg_cell_frames image = frames_of(3, 3 + 5 + 65.536, 1);
    assert_int_equal(plan.devices, 2);
    assert_ms(plan.check_s * 1e3, 3 * rg_cell_image_ms(&table, &image));
    for (int d = 0; d < 2; d++) {
        const struct rg_cell_frames f = frames_of(3, 3 + 5 + 65.536, d ? 2 : 0);
        assert_ms(plan.device_s[d] * 1e3, 3 * rg_cell_ms(&table, &f, rg_table_options(false)));
    }
    slow_end(&rig);
}

// A device that fails is left out, unless none is left, and the user's input ends the plan.
static void devices_that_fail_are_left_out(void **state)
{
    (void)state;
    struct slow_rig rig;
    struct rg_plan plan;
    slow_begin(&rig);
    rig.fakes[2]->waits_left = 0;
    assert_true(rg_plan_make(&table, NULL, true, &rig.kept, &plan));
    assert_int_equal(plan.failed, 1);
    assert_true(isnan(plan.device_s[2]));
    assert_above(plan.device_s[0], 0);
    assert_above(plan.device_s[1], plan.device_s[0]);
    const struct rg_devices gl = {.count = 1, .devices = {&rig.fakes[2]->pub}};
    rig.kept.devices = &gl;
    assert_false(rg_plan_make(&table, NULL, true, &rig.kept, &plan));
    rig.kept.devices = &rig.devices;
    rig.fakes[2]->waits_left = -1;
    assert_false(rg_plan_make(&table, "nonsense=1", true, &rig.kept, &plan));
    assert_int_equal(plan.failed, 1);
    slow_end(&rig);
}

static void expect_printed(const struct rg_plan *plan, const struct rg_devices *devices,
                           const char *due)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    rg_plan_print(plan, devices, out);
    assert_int_equal(fclose(out), 0);
    assert_string_equal(text, due);
    free(text);
}

static void a_plan_is_one_line(void **state)
{
    (void)state;
    struct slow_rig rig;
    struct rg_plan plan = {.rows = 8,
                           .devices = 3,
                           .failed = 1,
                           .device_s = {14, NAN, 20},
                           .check_s = 6,
                           .row_bytes = 5.4e6,
                           .all_bytes = 12.3e6};
    slow_begin(&rig);
    expect_printed(&plan, &rig.devices,
                   "plan: 8 rows on cpu, cpu:reference, gl, 24 cells; about 40 s (cpu 14 s, "
                   "cpu:reference not known, gl 20 s, images to check by 6 s), about 12 MB with "
                   "all rows open in turn\n");
    plan.devices = 1;
    plan.check_s = 0;
    plan.all_bytes = 1e18;
    expect_printed(&plan, &rig.devices,
                   "plan: 8 rows on cpu, 8 cells; about 14 s (cpu 14 s), about 5 MB a row, of "
                   "which as many are open as memory holds\n");
    slow_end(&rig);
}

// Plans a sweep with a hundred thousand steps before its timed frames, and returns how long
// planning takes. Opening number `interrupted` is interrupted; 0: none.
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

// Planning does not simulate all steps.
static void looking_takes_a_moment(void **state)
{
    (void)state;
    struct rg_plan plan;
    const int looks = 2 * 3; // two rows on three devices
    assert_below(plan_many_steps(0, &plan), looks * 6000);
    assert_above(plan.device_s[0], 3 * 1e-3 * 100000); // three rows, a millisecond a step
}

// No step is simulated after an interruption.
static void an_interrupted_look_ends(void **state)
{
    (void)state;
    struct rg_plan plan;
    rg_interrupt_watch();
    assert_below(plan_many_steps(1, &plan), 6000);
    assert_true(rg_interrupted());
}

// By hand: long frames, short frames, and a window of frames.
static void a_cell_takes_what_its_frames_take(void **state)
{
    (void)state;
    const struct rg_measure_options o = {.most_samples = 15,
                                         .least_samples = 6,
                                         .sample_ms = 15,
                                         .job_ms = 1000,
                                         .warm_up_ms = 200,
                                         .warm_up_frames = 4,
                                         .passes_ms = 400};
    struct rg_measure_options few = o;
    const struct rg_table plain = {.check_frames = 10}, alone = {.check_frames = 1};
    const struct rg_table window = {.check_frames = 10, .window_frames = 5};
    const struct rg_cell_frames slow = {7, 3, 500}, fast = {7, 0.25, 1}, middling = {7, 3, 60};
    few.warm_up_frames = 1;
    few.passes_ms = 0;
    // The first and the last of 10, one counted frame, one of warm-up, 6 samples, and 2 frames of
    // 1.5 for the passes; 8 steps.
    assert_below(fabs(rg_cell_ms(&plain, &slow, &o) - (7 + 8 * 3 + 13 * 500)), 1e-6);
    // One frame of 1.5 for the passes.
    assert_below(fabs(rg_cell_ms(&plain, &slow, &few) - (7 + 8 * 3 + 11.5 * 500)), 1e-6);
    assert_below(fabs(rg_cell_ms(&alone, &slow, &o) - (7 + 12 * 500)), 1e-6);
    // 3 + 4 + 4 + 15 samples of 15 + 1 frames + 40 frames of 1.5.
    assert_below(fabs(rg_cell_ms(&plain, &fast, &o) - (7 + 8 * 0.25 + 311)), 1e-6);
    // 3 frames, 4 of warm-up in 200 ms, 8 samples and a frame before each, 5 frames of 1.5.
    assert_below(fabs(rg_cell_ms(&plain, &middling, &o) - (7 + 8 * 3 + (3 + 4 + 16 + 7.5) * 60)),
                 1e-6);
    // 11 frames in windows of 5: two more openings, each with nine steps and a frame.
    assert_below(
        fabs(rg_cell_ms(&window, &slow, &o) - (7 + 8 * 3 + 13 * 500 + 2 * (7 + 9 * 3 + 500))),
        1e-6);
    assert_below(fabs(rg_cell_image_ms(&plain, &slow) - (7 + 9 * 3 + 500)), 1e-6);
}

// As docs/records.md says: at most 15 samples of 15 ms in a second, or 61 of 60 ms in two; at least
// 6, which a tight budget and RG_FEW_SAMPLES take.
static void samples_are_those_of_the_page(void **state)
{
    (void)state;
    const struct rg_measure_options *quick = rg_table_options(false),
                                    *full = rg_table_options(true), *few = rg_table_few_samples();
    assert_int_equal(quick->most_samples, 15);
    assert_int_equal(full->most_samples, 61);
    assert_int_equal(few->most_samples, 6);
    assert_equals(quick->sample_ms, 15);
    assert_equals(full->sample_ms, 60);
    assert_equals(few->sample_ms, 15);
    assert_equals(quick->job_ms, 1000);
    assert_equals(full->job_ms, 2000);
    const struct rg_measure_options *const all[] = {quick, full, few};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(all[i]->least_samples, 6);
        assert_true(all[i]->load && all[i]->watch);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_are_those_of_the_page),
        cmocka_unit_test(a_sweep_is_of_rain_that_has_built_up),
        cmocka_unit_test(rows_between_the_ends_are_interpolated),
        cmocka_unit_test(images_are_foreseen_apart),
        cmocka_unit_test(devices_that_fail_are_left_out),
        cmocka_unit_test(a_plan_is_one_line),
        cmocka_unit_test(looking_takes_a_moment),
        cmocka_unit_test(a_cell_takes_what_its_frames_take),
        cmocka_unit_test(an_interrupted_look_ends), // last, since it stays interrupted
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
