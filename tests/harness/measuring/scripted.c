// What is timed, how often and in which order, by a clock that stands still but for what the script
// says: each number can be worked out by hand.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/interrupt.h"
#include "harness/measure/measure.h"
#include "tests/harness/measuring/fake.h"
#include "tests/tools/expect.h"

#define assert_ms(value, ms) assert_near(value, ms, 1e-6)

enum { MOST_JOBS = 4 };

// Jobs on one device, each with a script and a record of its own.
struct bench {
    struct fake_device *fake;
    struct rg_job jobs[MOST_JOBS];
    struct rg_record records[MOST_JOBS];
    int count;
};

static void ignore_line(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)line;
    (void)user;
}

static void begin(struct bench *bench)
{
    memset(bench, 0, sizeof(*bench));
    bench->fake = fake_open();
    rg_log_listen(ignore_line, NULL);
    rg_interrupt_watch();
    fake_forget();
}

static struct rg_job *add(struct bench *bench, const struct fake_script *script, int check_frames)
{
    struct rg_job *job = &bench->jobs[bench->count];
    *job = (struct rg_job){.subject = {&fake_technique, script, 8, 8},
                           .device = &bench->fake->pub,
                           .check_frames = check_frames,
                           .record = &bench->records[bench->count]};
    bench->count++;
    return job;
}

static void end(struct bench *bench)
{
    for (int i = 0; i < bench->count; i++)
        rg_job_close(&bench->jobs[i]);
    // One that is lost says so once more, for what is closed with it cannot.
    assert_int_equal(rg_device_close(&bench->fake->pub), bench->fake->waits_left < 0);
    rg_log_listen(NULL, NULL);
}

// Opens, warms up and times all jobs.
static void measure(struct bench *bench, const struct rg_measure_options *options)
{
    for (int i = 0; i < bench->count; i++)
        assert_true(rg_job_open(&bench->jobs[i]) && rg_job_warm_up(&bench->jobs[i], options));
    fake_forget();
    rg_jobs_measure(bench->jobs, bench->count, options);
}

// --- opening and warming up ---

// What the driver does when it opens, in the first frame and in a later one stands apart.
static void test_open(void **state)
{
    (void)state;
    static const double frames_ms[] = {40};
    const struct fake_script script = {.letter = 'A',
                                       .open_ms = 30,
                                       .step_ms = 2,
                                       .draw_ms = 5,
                                       .frames_ms = frames_ms,
                                       .frame_count = 1};
    struct bench bench;
    begin(&bench);
    struct rg_job *job = add(&bench, &script, 4), *alone = add(&bench, &script, 1);
    assert_true(rg_job_open(job));
    assert_string_equal(fake_events(), "(|A.|AA|A.|");
    assert_ms(job->record->create_ms, 30);
    assert_ms(job->record->first_frame_ms, 42);
    assert_ms(job->warm_frame_ms, 7);
    fake_forget();
    assert_true(rg_job_open(alone));
    assert_string_equal(fake_events(), "(|A.|");
    assert_ms(alone->warm_frame_ms, 42);
    end(&bench);
}

// The frames that a warm-up takes where the drawings behind the first take so long, and then 9 ms.
static int warm_up_frames(const double *frames_ms, int count, double most_ms)
{
    const struct fake_script script = {
        .letter = 'A', .draw_ms = 9, .frames_ms = frames_ms, .frame_count = count};
    struct bench bench;
    begin(&bench);
    struct rg_job *job = add(&bench, &script, 1);
    assert_true(rg_job_open(job));
    fake_forget();
    assert_true(rg_job_warm_up(
        job, &(struct rg_measure_options){.warm_up_ms = most_ms, .warm_up_frames = 4}));
    int frames = 0;
    for (const char *event = fake_events(); *event; event += 3, frames++)
        assert_memory_equal(event, "A.|", 3);
    if (frames < count)
        assert_ms(job->warm_frame_ms, frames_ms[frames]);
    end(&bench);
    return frames;
}

static void test_warm_up(void **state)
{
    (void)state;
    static const double even[] = {9, 9}, settling[] = {90, 60, 40, 30, 20, 18.1, 5},
                        rising[] = {9, 9, 9, 9, 12, 12.5, 20}, late[] = {90, 60, 40},
                        slowly[] = {90, 60, 40, 30, 24, 23};
    double swinging[40];
    for (int i = 0; i < 40; i++)
        swinging[i] = i % 2 ? 10 : 20;
    assert_int_equal(warm_up_frames(even, 2, 1e9), 4);
    assert_int_equal(warm_up_frames(settling, 7, 1e9), 5);
    assert_int_equal(warm_up_frames(slowly, 6, 1e9), 5);
    assert_int_equal(warm_up_frames(rising, 7, 1e9), 5);
    assert_int_equal(warm_up_frames(swinging, 40, 1e9), 20);
    assert_int_equal(warm_up_frames(late, 3, 99), 2);
    assert_int_equal(warm_up_frames(late, 3, 101), 3);
}

// --- samples ---

static const struct rg_measure_options plain = {.most_samples = 40,
                                                .least_samples = 2,
                                                .sample_ms = 20,
                                                .job_ms = 200,
                                                .warm_up_ms = 1e9,
                                                .warm_up_frames = 4,
                                                .passes_ms = 400};

// A sample is whole frames of 3 ms, though the frame behind another job's takes 50 ms more.
static void test_samples(void **state)
{
    (void)state;
    const struct fake_script fast = {.letter = 'A', .step_ms = 1, .draw_ms = 2, .cold_ms = 50};
    const struct fake_script slow = {.letter = 'B', .step_ms = 50, .draw_ms = 51};
    const struct fake_script brief = {.letter = 'C', .draw_ms = 99, .cold_ms = 50};
    struct bench bench;
    begin(&bench);
    add(&bench, &fast, 2);
    add(&bench, &slow, 2);
    add(&bench, &brief, 2);
    measure(&bench, &plain);
    const int frames[] = {7, 1, 1}, samples[] = {8, 2, 2};
    const double frame_ms[] = {3, 101, 99};
    for (int i = 0; i < bench.count; i++) {
        const struct rg_record *record = &bench.records[i];
        assert_int_equal(record->outcome, RG_OK);
        assert_int_equal(record->frames_a_sample, frames[i]);
        assert_int_equal(record->sample_count, samples[i]);
        for (int j = 0; j < samples[i]; j++)
            assert_ms(record->samples_ms[j], frame_ms[i]);
        assert_ms(record->frame_ms.median, frame_ms[i]);
    }
    // No frame is run before one of more than 100 ms: two samples, and those of the passes.
    int steps = 0;
    for (const char *event = fake_events(); *event; event++)
        steps += *event == 'B';
    assert_int_equal(steps, 2 + bench.records[1].pass_frames);
    end(&bench);
}

static void test_bounds_of_samples(void **state)
{
    (void)state;
    const struct fake_script script = {.letter = 'A', .draw_ms = 20};
    struct rg_measure_options options = plain;
    const struct {
        double job_ms;
        int samples;
    } cases[] = {{119, 3}, {121, 3}, {159, 3}, {161, 4}, {1e4, 6}, {1, 3}};
    options.least_samples = 3;
    options.most_samples = 6;
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct bench bench;
        begin(&bench);
        add(&bench, &script, 1);
        options.job_ms = cases[i].job_ms;
        measure(&bench, &options);
        assert_int_equal(bench.records[0].sample_count, cases[i].samples);
        end(&bench);
    }
}

// A session that is opened anew for its window is not in the time of a sample.
static void test_window_is_not_timed(void **state)
{
    (void)state;
    const struct fake_script script = {.letter = 'A', .open_ms = 500, .draw_ms = 4};
    struct bench bench;
    begin(&bench);
    add(&bench, &script, 3)->window_frames = 5;
    measure(&bench, &plain);
    assert_int_equal(bench.records[0].frames_a_sample, 4);
    for (int i = 0; i < bench.records[0].sample_count; i++)
        assert_ms(bench.records[0].samples_ms[i], 4);
    assert_non_null(strstr(fake_events(), "(AAA.|A.|A.A.A.A.|"));
    end(&bench);
}

// A machine that gets slower from round to round, but for one that was disturbed, and stands still
// once in each.
enum { LOADS_A_TIME = 3 };
static int loads;
static void run_load(void)
{
    const int time = loads / LOADS_A_TIME + 1, of_time = loads++ % LOADS_A_TIME;
    fake_pass(time == 2 || of_time == 1 ? 500 : 10 + time);
}

// The load is run before the first round and behind each: nine times of eight rounds. The first
// three took 11, 500 and 13 ms, the last three 17, 18 and 19. Samples know nothing of that.
static void test_calibration(void **state)
{
    (void)state;
    const struct fake_script script = {.letter = 'A', .draw_ms = 3};
    struct rg_measure_options options = plain;
    struct bench bench;
    begin(&bench);
    add(&bench, &script, 1);
    add(&bench, &script, 1);
    options.most_samples = options.least_samples = 8;
    options.load = run_load;
    loads = 0;
    measure(&bench, &options);
    assert_int_equal(loads, 9 * LOADS_A_TIME);
    for (int i = 0; i < 2; i++) {
        assert_ms(bench.records[i].calibration_begin_ms, 13);
        assert_ms(bench.records[i].calibration_end_ms, 18);
        for (int j = 0; j < 8; j++)
            assert_ms(bench.records[i].samples_ms[j], 3);
    }
    end(&bench);
    begin(&bench);
    add(&bench, &script, 1);
    measure(&bench, &plain); // without a load nothing is told
    assert_equals(bench.records[0].calibration_begin_ms, 0);
    assert_equals(bench.records[0].calibration_end_ms, 0);
    end(&bench);
}

// --- the order of samples ---

// Reads the order of samples of one frame each, with a frame before it, from the events.
static int order_of(char *order, int most)
{
    int count = 0;
    for (const char *event = fake_events(); event[0] && count < most; event++)
        if (event[0] >= 'A' && event[0] <= 'Z' && !strncmp(event + 1, ".|", 2) &&
            event[3] == event[0] && !strncmp(event + 4, ".|", 2)) {
            order[count++] = event[0];
            event += 5;
        }
    return count;
}

static void measure_four(char *order, int samples)
{
    static const struct fake_script scripts[] = {{.letter = 'A', .draw_ms = 50},
                                                 {.letter = 'B', .draw_ms = 50},
                                                 {.letter = 'C', .draw_ms = 50},
                                                 {.letter = 'D', .draw_ms = 50}};
    struct rg_measure_options options = plain;
    options.most_samples = options.least_samples = samples / 4;
    struct bench bench;
    begin(&bench);
    bench.fake->pub.info.limits.has_clock = false;
    for (int i = 0; i < 4; i++)
        add(&bench, &scripts[i], 1);
    measure(&bench, &options);
    assert_int_equal(order_of(order, samples), samples);
    end(&bench);
}

// Every job once a round, and at each place of a round about as often as at another.
static void test_order(void **state)
{
    (void)state;
    enum { ROUNDS = 80 };
    char order[4 * ROUNDS], again[4 * ROUNDS];
    int at[4][4] = {{0}};
    measure_four(order, 4 * ROUNDS);
    for (int i = 0; i < 4 * ROUNDS; i++)
        at[order[i] - 'A'][i % 4]++;
    for (int job = 0; job < 4; job++) {
        assert_int_equal(at[job][0] + at[job][1] + at[job][2] + at[job][3], ROUNDS);
        for (int place = 0; place < 4; place++)
            assert_in_range(at[job][place], ROUNDS / 8, ROUNDS * 3 / 8);
    }
    for (int round = 0; round < ROUNDS; round++)
        for (char letter = 'A'; letter <= 'D'; letter++)
            assert_non_null(memchr(order + (size_t)4 * (size_t)round, letter, 4));
    int stays = 0; // as often as a place is had by chance: one of four
    for (int i = 4; i < 4 * ROUNDS; i++)
        stays += order[i] == order[i - 4];
    assert_in_range(stays, ROUNDS / 2, ROUNDS * 3 / 2);
    measure_four(again, 4 * ROUNDS);
    assert_memory_equal(order, again, sizeof(order));
}

// A job of fewer samples takes them all through the run, not at its beginning.
static void test_spread(void **state)
{
    (void)state;
    const struct fake_script often = {.letter = 'A', .draw_ms = 50};
    const struct fake_script seldom = {.letter = 'B', .draw_ms = 98};
    struct rg_measure_options options = plain;
    options.job_ms = 1200; // 12 samples of A, 6 of B
    struct bench bench;
    char order[18];
    begin(&bench);
    bench.fake->pub.info.limits.has_clock = false;
    add(&bench, &often, 1);
    add(&bench, &seldom, 1);
    measure(&bench, &options);
    assert_int_equal(bench.records[0].sample_count, 12);
    assert_int_equal(bench.records[1].sample_count, 6);
    assert_int_equal(order_of(order, 18), 18);
    for (int i = 0; i < 18; i += 3) { // A A B or A B A: two rounds
        int seen = 0;
        for (int j = 0; j < 3; j++)
            seen += order[i + j] == 'B';
        assert_int_equal(seen, 1);
        assert_int_equal(order[i], 'A');
    }
    end(&bench);
}

// --- jobs that are visited again ---

static int count_of(char event)
{
    int count = 0;
    for (const char *at = fake_events(); *at; at++)
        count += *at == event;
    return count;
}

// Each visit takes its share, opens again what was closed, and takes no calibration for rounds in
// which there is nothing to do. Only the last tells passes apart and reads the API's clock.
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
        options.sample_ms = visit ? 500 : 20; // how a job is sampled was settled
        if (!visit)
            measure(&bench, &options);
        else
            rg_jobs_measure(bench.jobs, 2, &options);
        // Before the first round, and behind each of four.
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
            assert_ms(bench.records[i].calibration_begin_ms, 13.5); // 13 and 14: of the first visit
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

// What is left to take is expected to last as long as it does.
static void test_expected(void **state)
{
    (void)state;
    const struct fake_script script = {.letter = 'A', .draw_ms = 50};
    struct rg_measure_options options = plain;
    options.job_ms = 1200; // 12 samples, with a frame before each
    struct bench bench;
    begin(&bench);
    add(&bench, &script, 2);
    add(&bench, &script, 2)->record->outcome = RG_FAIL;
    assert_true(rg_job_open(&bench.jobs[0]) && rg_job_warm_up(&bench.jobs[0], &options));
    bench.jobs[1].warm_frame_ms = 1;
    const double passes_ms = 6 * 75; // until 400 ms are over
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
    const char *last = strrchr(fake_events(), 't'); // the passes follow: it was the last sample
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

// Frames that something else disturbs are not told as what a pass takes.
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

// --- what ends early ---

static void note_progress(double share, void *user)
{
    *(double *)user = share;
}

// An interrupted run leaves records that are not whole, and runs no passes for them.
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
    assert_below(share, 0.5); // all rounds are 6/11 of the run, and not all were taken
    for (int i = 0; i < 2; i++) {
        assert_below(bench.records[i].sample_count, bench.jobs[i].record->wanted_samples);
        assert_int_equal(bench.records[i].pass_frames, 0);
        assert_equals(bench.records[i].frame_ms.median, 0);
    }
    end(&bench);
    rg_interrupt_watch();
}

// Wherever it comes, no sample has fewer frames than it says, and how a job is sampled is settled
// by whole runs alone.
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

// A device that is lost ends its own job, in whatever it does then.
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
        // It is asked for no more than the sample in which it was lost.
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
        cmocka_unit_test(test_open),
        cmocka_unit_test(test_warm_up),
        cmocka_unit_test(test_samples),
        cmocka_unit_test(test_bounds_of_samples),
        cmocka_unit_test(test_window_is_not_timed),
        cmocka_unit_test(test_calibration),
        cmocka_unit_test(test_order),
        cmocka_unit_test(test_spread),
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
