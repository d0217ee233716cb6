// How often a frame is timed and how long that takes, the calibration of a run, and the work that a
// user may be told of in advance: arithmetic alone, without a device.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "harness/devices/measure/calibration.h"
#include "harness/devices/measure/drawing.h"
#include "harness/devices/measure/sampling.h"
#include "harness/devices/measure/yardsticks.h"
#include "tests/harness/devices/measuring/bench.h"
#include "tests/tools/expect.h"

// --- sampling ---

static void a_sample_is_as_long_as_asked_for(void **state)
{
    (void)state;
    // 20 ms a sample, 200 ms in all, 2 to 40 samples
    static const struct {
        double frame_ms;
        int window_frames, frames, samples;
        bool has_run_up;
    } rows[] = {
        {20, 0, 1, 5, true},   // 40 ms with the frame before it
        {19.9, 0, 2, 3, true}, // 59.7 ms
        {3, 0, 7, 8, true},    // 24 ms
        {1, 0, 20, 9, true},   // 21 ms
        {1, 11, 10, 18, true}, // 11 ms
        {1, 2, 1, 40, true},   // 2 ms would be 100
        {99, 0, 1, 2, true},   // 198 ms would be 1
        {100, 0, 1, 2, false}, //
        {60, 0, 1, 2, true},   // 120 ms would be 1
        {150, 9, 1, 2, false}, //
        {1e-9, 0, 100000, 40, true},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const struct rg_sampling s =
            rg_sampling_of(rows[i].frame_ms, rows[i].window_frames, &plain);
        if (s.frames_a_sample != rows[i].frames || s.samples != rows[i].samples)
            fail_msg("%g ms: %d frames, %d samples", rows[i].frame_ms, s.frames_a_sample,
                     s.samples);
        assert_int_equal(s.has_run_up, rows[i].has_run_up);
        assert_int_equal(rg_sampling_has_run_up(rows[i].frame_ms), rows[i].has_run_up);
        assert_ms(s.passes_ms, rg_passes_expected_ms(rows[i].frame_ms, plain.passes_ms));
    }
    struct rg_measure_options many = plain;
    many.most_samples = 10000;
    many.job_ms = 1e9;
    assert_int_equal(rg_sampling_of(1, 0, &many).samples, RG_MAX_SAMPLES);
}

static void its_time_has_all_frames_and_the_passes(void **state)
{
    (void)state;
    const struct rg_sampling with = {
        .frames_a_sample = 3, .has_run_up = true, .samples = 5, .passes_ms = 100};
    const struct rg_sampling without = {.frames_a_sample = 3, .samples = 5};
    assert_ms(rg_sampling_ms(&with, 2), 5 * 4 * 2 + 100);
    assert_ms(rg_sampling_ms(&without, 2), 5 * 3 * 2);
}

// A frame that waits after each pass takes half as long again; from two to 40 are run, or one.
static void passes_take_the_time_of_whole_frames(void **state)
{
    (void)state;
    static const struct {
        double frame_ms, limit_ms, ms;
    } rows[] = {{10, 90, 90},    {10, 91, 105},   {10, 10, 30}, {10, 0, 15},
                {1000, 0, 1500}, {1000, 5, 3000}, {1, 1000, 60}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        assert_ms(rg_passes_expected_ms(rows[i].frame_ms, rows[i].limit_ms), rows[i].ms);
}

static void few_samples_are_asked_for_by_a_variable(void **state)
{
    (void)state;
    unsetenv("RG_FEW_SAMPLES");
    assert_false(rg_sampling_few());
    setenv("RG_FEW_SAMPLES", "1", 1);
    assert_true(rg_sampling_few());
    unsetenv("RG_FEW_SAMPLES");
}

// --- jobs ---

// Two samples of 4 frames fit into each window of 11 frames, for which a session is opened anew; so
// it is once for the passes.
static void windows_add_the_opening_of_sessions(void **state)
{
    (void)state;
    struct rg_record records[2] = {{.create_ms = 30}, {.create_ms = 30}};
    struct rg_job jobs[2] = {
        {.record = &records[0], .warm_frame_ms = 8, .check_frames = 5, .window_frames = 11},
        {.record = &records[1], .warm_frame_ms = 8, .check_frames = 5}};
    const struct rg_measure_options options = {
        .most_samples = 6, .least_samples = 6, .sample_ms = 24, .passes_ms = 0};
    const double samples_ms = 6 * 4 * 8, passes_ms = 12, open_ms = 30 + 5 * 8;
    assert_ms(rg_jobs_expected_ms(jobs, 2, &options),
              2 * (samples_ms + passes_ms) + open_ms * (1 + 6 / 2));
    jobs[0].window_frames = 5; // one sample alone
    assert_ms(rg_jobs_expected_ms(jobs, 1, &options), samples_ms + passes_ms + open_ms * (1 + 6));
    jobs[0].warm_frame_ms = 0; // of what nothing is known nothing is expected
    assert_ms(rg_jobs_expected_ms(jobs, 1, &options), 0);
}

static struct {
    int count;
    double shares[100];
} heard;

static void hear(double share, void *user)
{
    assert_ptr_equal(user, &heard);
    heard.shares[heard.count++] = share;
}

// Six rounds of 40 ms, and passes of one frame that is expected to take 30 ms.
static void progress_is_the_share_of_the_time(void **state)
{
    (void)state;
    const struct fake_script script = {.letter = 'A', .draw_ms = 20};
    const struct rg_measure_options options = {.most_samples = 6,
                                               .least_samples = 6,
                                               .sample_ms = 20,
                                               .warm_up_ms = 1,
                                               .progress = hear,
                                               .user = &heard};
    struct bench bench;
    begin(&bench);
    add(&bench, &script, 2);
    heard.count = 0;
    measure(&bench, &options);
    assert_int_equal(heard.count, 7);
    for (int i = 0; i < 6; i++)
        assert_near(heard.shares[i], (i + 1) * 40 / 270.0, 1e-9);
    assert_near(heard.shares[6], 1, 1e-9);
    end(&bench);
    // Half of a job's samples, without passes, is all of that visit.
    struct rg_measure_options half = options;
    half.share = 0.5;
    begin(&bench);
    add(&bench, &script, 2);
    heard.count = 0;
    measure(&bench, &half);
    assert_near(heard.shares[0], 1 / 3.0, 1e-9);
    assert_near(heard.shares[2], 1, 1e-9);
    // The other half takes 120 ms and the passes; rounds without a sample count as well.
    half.share = 0;
    heard.count = 0;
    rg_jobs_measure(bench.jobs, 1, &half);
    assert_int_equal(heard.count, 7);
    assert_near(heard.shares[0], 20 / 150.0, 1e-9);
    assert_near(heard.shares[5], 120 / 150.0, 1e-9);
    assert_near(heard.shares[6], 1, 1e-9);
    end(&bench);
}

// --- calibration ---

static void the_ends_of_a_run_are_its_thirds(void **state)
{
    (void)state;
    static const struct {
        int count;
        double begin_ms, end_ms; // of loads that take 1, 2, 3 ms and so on
    } rows[] = {{0, 0, 0},     {1, 1, 1}, {2, 1, 2}, {3, 1, 3},     {4, 1.5, 3.5},
                {6, 1.5, 5.5}, {7, 2, 6}, {9, 2, 8}, {10, 2.5, 8.5}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_calibration calibration = {.count = rows[i].count};
        double begin_ms = -1, end_ms = -1;
        for (int k = 0; k < rows[i].count; k++)
            calibration.ms[k] = k + 1;
        rg_calibration_tell(&calibration, &begin_ms, &end_ms);
        assert_ms(begin_ms, rows[i].begin_ms);
        assert_ms(end_ms, rows[i].end_ms);
    }
}

static void a_full_list_takes_no_more(void **state)
{
    (void)state;
    struct rg_calibration calibration = {.load = run_load}, none = {.count = 0};
    loads = 0;
    for (int i = 0; i < RG_MAX_SAMPLES + 5; i++)
        rg_calibration_take(&calibration);
    assert_int_equal(calibration.count, RG_MAX_SAMPLES + 1);
    assert_int_equal(loads, LOADS_A_TIME * (RG_MAX_SAMPLES + 1));
    assert_ms(calibration.ms[0], 11);
    assert_ms(calibration.ms[RG_MAX_SAMPLES], 11 + RG_MAX_SAMPLES);
    rg_calibration_take(&none);
    assert_int_equal(none.count, 0);
}

// --- what is measured besides ---

static void a_drawing_is_well_by_its_tier(void **state)
{
    (void)state;
    static const struct {
        int differing;
        enum rg_tier tier;
        bool is_well;
    } rows[] = {{0, RG_T0, true},   {1, RG_T0, false}, {0, RG_T1, true},  {12, RG_T1, true},
                {13, RG_T1, false}, {12, RG_T2, true}, {13, RG_T2, false}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        assert_int_equal(
            rg_drawn_is_well(&(struct rg_drawn){RG_RGBA8, rows[i].differing}, rows[i].tier),
            rows[i].is_well);
}

static void yardsticks_have_their_names(void **state)
{
    (void)state;
    static const char *const names[RG_YARDSTICKS] = {"chain", "vector", "copy", "fork_join"};
    for (int i = 0; i < RG_YARDSTICKS; i++)
        assert_string_equal(rg_yardstick_name((enum rg_yardstick)i), names[i]);
}

int main(void)
{
    unsetenv("RG_PROBE_S");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sample_is_as_long_as_asked_for),
        cmocka_unit_test(its_time_has_all_frames_and_the_passes),
        cmocka_unit_test(passes_take_the_time_of_whole_frames),
        cmocka_unit_test(few_samples_are_asked_for_by_a_variable),
        cmocka_unit_test(windows_add_the_opening_of_sessions),
        cmocka_unit_test(progress_is_the_share_of_the_time),
        cmocka_unit_test(the_ends_of_a_run_are_its_thirds),
        cmocka_unit_test(a_full_list_takes_no_more),
        cmocka_unit_test(a_drawing_is_well_by_its_tier),
        cmocka_unit_test(yardsticks_have_their_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
