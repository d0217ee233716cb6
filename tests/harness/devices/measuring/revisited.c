// Jobs that are visited again, the API's own clock, passes, and runs that end early, by a clock
// that moves only as the script says.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "tests/harness/devices/measuring/bench.h"
#include "tests/tools/expect.h"

// --- jobs that are visited again ---

static int count_of(char event)
{
    int count = 0;
    for (const char *at = fake_events(); *at; at++)
        count += *at == event;
    return count;
}

// Each visit takes its share, opens closed jobs again, and skips the calibration of rounds without
// work. Only the last visit tells passes apart and reads the API's clock.
static void test_visits(void **state)
{
    (void)state;
    const struct fake_script often = {.letter = 'A', .open_ms = 400, .draw_ms = 50};
    const struct fake_script seldom = {.letter = 'B', .open_ms = 400, .draw_ms = 98};
    static const int samples[3][2] = {{4, 2}, {8, 4}, {12, 6}};
    struct rg_measure_options options = plain;
    options.job_ms = 1200; // 12 samples of A, 6 of B
    options.load = run_load;
    struct bench bench;
    begin(&bench);
    add(&bench, &often, 2);
    add(&bench, &seldom, 2);
    loads = 2 * LOADS_A_TIME;
    for (int visit = 0; visit < 3; visit++) {
        const int loads_before = loads;
        options.share = (visit + 1) / 3.0;
        options.sample_ms = visit ? 500 : 20; // the first visit settled how jobs are sampled
        if (!visit)
            measure(&bench, &options);
        else
            rg_jobs_measure(bench.jobs, 2, &options);
        // Before the first round, and after each of four.
        assert_int_equal(loads - loads_before, 5 * LOADS_A_TIME);
        assert_int_equal(count_of('('), visit ? 2 : 0);
        assert_int_equal(count_of('t'), visit == 2 ? 4 : 0);
        for (int i = 0; i < 2; i++) {
            assert_int_equal(bench.records[i].outcome, RG_OK);
            assert_int_equal(bench.records[i].sample_count, samples[visit][i]);
            assert_int_equal(bench.records[i].wanted_samples, samples[2][i]);
            assert_int_equal(bench.records[i].frames_a_sample, 1);
            assert_int_equal(bench.records[i].pass_frames > 0, visit == 2);
            assert_int_equal(rg_record_is_whole(&bench.records[i]), visit == 2);
            assert_ms(bench.records[i].calibration_begin_ms, 13.5); // 13 and 14, of the first visit
            rg_job_close(&bench.jobs[i]);
        }
        fake_forget();
    }
    assert_ms(bench.records[0].calibration_end_ms, 26.5);
    for (int i = 0; i < 12; i++)
        assert_ms(bench.records[0].samples_ms[i], 50);
    rg_jobs_measure(bench.jobs, 2, &options); // nothing is left to take
    assert_int_equal(bench.records[0].sample_count, 12);
    end(&bench);
}

// The remaining samples are expected to take as long as they do.
static void test_expected(void **state)
{
    (void)state;
    const struct fake_script script = {.letter = 'A', .draw_ms = 50};
    struct rg_measure_options options = plain;
    options.job_ms = 1200; // 12 samples, each after another frame
    struct bench bench;
    begin(&bench);
    add(&bench, &script, 2);
    add(&bench, &script, 2)->record->outcome = RG_FAIL;
    assert_true(rg_job_open(&bench.jobs[0]) && rg_job_warm_up(&bench.jobs[0], &options));
    bench.jobs[1].warm_frame_ms = 1;
    const double passes_ms = 6 * 75; // until 400 ms have passed
    assert_ms(rg_jobs_expected_ms(bench.jobs, 2, &options), 12 * 2 * 50 + passes_ms);
    options.share = 0.25;
    rg_jobs_measure(bench.jobs, 2, &options);
    assert_int_equal(bench.records[0].sample_count, 3);
    assert_ms(rg_jobs_expected_ms(bench.jobs, 2, &options), 9 * 2 * 50 + passes_ms);
    end(&bench);
}

// --- the API's own clock ---

static double api_over_wall(double rate, bool has_clock, int64_t *reads)
{
    const struct fake_script script = {.letter = 'A', .draw_ms = 10};
    struct bench bench;
    begin(&bench);
    bench.fake->clock_rate = rate;
    bench.fake->pub.info.limits.has_clock = has_clock;
    add(&bench, &script, 1);
    measure(&bench, &plain);
    const double ratio = bench.records[0].api_over_wall;
    *reads = bench.fake->clock_reads;
    const char *last = strrchr(fake_events(), 't'); // only passes follow the last sample
    assert_true(!last || !strncmp(last + 1, "A|.||", 5));
    assert_int_equal(bench.records[0].outcome, RG_OK);
    end(&bench);
    return ratio;
}

static void test_api_clock(void **state)
{
    (void)state;
    int64_t reads;
    assert_near(api_over_wall(1, true, &reads), 1, 1e-4);
    assert_int_equal(reads, 2);
    assert_near(api_over_wall(0.85, true, &reads), 0.85, 1e-4);
    assert_equals(api_over_wall(1, false, &reads), 0);
    assert_int_equal(reads, 0);
}

// --- passes ---

static void test_passes(void **state)
{
    (void)state;
    static const struct {
        double frame_ms;
        int frames;
    } cases[] = {{5, 40}, {39, 11}, {150, 3}, {500, 2}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        const struct fake_script script = {
            .letter = 'A', .step_ms = 2, .draw_ms = cases[i].frame_ms - 2};
        struct bench bench;
        begin(&bench);
        struct rg_job *job = add(&bench, &script, 1);
        assert_true(rg_job_open(job));
        fake_forget();
        assert_true(rg_job_time_passes(job, 400));
        assert_memory_equal(fake_events(), "A|.||A|.||", 10);
        assert_int_equal(job->record->pass_frames, cases[i].frames);
        assert_int_equal(job->record->pass_count, 2);
        assert_string_equal(job->record->passes[0].name, "stir");
        assert_ms(job->record->passes[0].ms, 2);
        assert_string_equal(job->record->passes[1].name, "show");
        assert_ms(job->record->passes[1].ms, script.draw_ms);
        end(&bench);
    }
}

// The times of passes leave out disturbed frames.
static void test_disturbed_passes(void **state)
{
    (void)state;
    static const double frames_ms[] = {2, 2, 2, 2, 50, 50, 50, 50};
    const struct fake_script script = {
        .letter = 'A', .step_ms = 2, .draw_ms = 2, .frames_ms = frames_ms, .frame_count = 8};
    struct bench bench;
    begin(&bench);
    struct rg_job *job = add(&bench, &script, 1);
    assert_true(rg_job_open(job));
    assert_true(rg_job_time_passes(job, 400));
    assert_int_equal(job->record->pass_frames, 40);
    assert_ms(job->record->passes[1].ms, 2);
    end(&bench);
}

// --- runs that end early ---

static void note_progress(double share, void *user)
{
    *(double *)user = share;
}

// An interrupted run leaves incomplete records, and times no passes.
static void test_interrupted(void **state)
{
    (void)state;
    const struct fake_script quiet = {.letter = 'A', .draw_ms = 10};
    const struct fake_script noisy = {.letter = 'B', .draw_ms = 10, .interrupt_at = 20};
    struct bench bench;
    begin(&bench);
    add(&bench, &quiet, 1);
    add(&bench, &noisy, 1);
    double share = 0;
    struct rg_measure_options options = plain;
    options.progress = note_progress;
    options.user = &share;
    measure(&bench, &options);
    assert_true(rg_interrupted());
    assert_above(share, 0);
    assert_below(share, 0.5); // all rounds are 6/11 of the run, and some are missing
    for (int i = 0; i < 2; i++) {
        assert_below(bench.records[i].sample_count, bench.jobs[i].record->wanted_samples);
        assert_int_equal(bench.records[i].pass_frames, 0);
        assert_equals(bench.records[i].frame_ms.median, 0);
    }
    end(&bench);
    rg_interrupt_watch();
}

// Wherever a signal comes, no sample has fewer frames than it says, and only whole runs settle how
// a job is sampled.
static void test_interrupted_samples(void **state)
{
    (void)state;
    for (int at = 3; at < 60; at++) {
        const struct fake_script script = {.letter = 'A', .draw_ms = 4, .interrupt_at = at};
        struct bench bench;
        begin(&bench);
        add(&bench, &script, 1);
        measure(&bench, &plain);
        const struct rg_record *record = &bench.records[0];
        if (record->wanted_samples)
            assert_int_equal(record->frames_a_sample, 5); // 20 ms
        for (int i = 0; i < record->sample_count; i++)
            assert_ms(record->samples_ms[i], 4);
        end(&bench);
        rg_interrupt_watch();
    }
}

// A lost device ends its own job alone, whatever the job is doing.
static void test_lost(void **state)
{
    (void)state;
    const struct fake_script script = {.letter = 'A', .draw_ms = 10};
    for (int waits = 0; waits < 40; waits++) {
        struct bench bench;
        begin(&bench);
        struct fake_device *other = fake_open();
        struct rg_job *job = add(&bench, &script, 2), *well = add(&bench, &script, 2);
        well->device = &other->pub;
        bench.fake->waits_left = waits;
        const bool opened = rg_job_open(job) && rg_job_warm_up(job, &plain);
        assert_true(rg_job_open(well) && rg_job_warm_up(well, &plain));
        assert_equals(opened, (job->record->outcome == RG_OK));
        rg_jobs_measure(bench.jobs, 2, &plain);
        assert_int_equal(job->record->outcome, RG_ERROR);
        assert_non_null(strstr(job->record->detail, "lost"));
        // The job asks nothing more after the sample in which the device was lost.
        assert_at_most(bench.fake->waits, waits + 3);
        assert_at_most(job->record->sample_count, job->record->wanted_samples);
        assert_int_equal(well->record->outcome, RG_OK);
        assert_int_equal(well->record->sample_count, well->record->wanted_samples);
        rg_job_close(well);
        assert_true(rg_device_close(&other->pub));
        end(&bench);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_visits),
        cmocka_unit_test(test_expected),
        cmocka_unit_test(test_api_clock),
        cmocka_unit_test(test_passes),
        cmocka_unit_test(test_disturbed_passes),
        cmocka_unit_test(test_interrupted),
        cmocka_unit_test(test_interrupted_samples),
        cmocka_unit_test(test_lost),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
