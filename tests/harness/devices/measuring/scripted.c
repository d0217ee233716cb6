// How often and in which order frames are timed, by a clock that moves only as the script says:
// every number can be worked out by hand.
#include <stddef.h>
#include <stdint.h>

#include "tests/harness/devices/measuring/bench.h"
#include "tests/tools/expect.h"

// --- opening and warming up ---

// The times of opening, of the first frame and of a later frame are kept apart.
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
    job->record->outcome = RG_CRASH; // of an earlier try
    assert_true(rg_job_open(job));
    assert_int_equal(job->record->outcome, RG_OK);
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

// The number of frames of a warm-up whose drawings take these times, and 9 ms after them.
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

// A sample is whole frames of 3 ms, though a frame after another job's takes 50 ms more.
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
    // A frame of more than 100 ms has no untimed frame before it: two samples, and those of the
    // passes.
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

// Opening a session anew for its window is not timed.
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

// A session is opened anew only where the next frames do not fit into its window: two samples of
// six frames do, and twelve frames in which passes are timed.
static void test_windows_are_used_up(void **state)
{
    (void)state;
    const struct fake_script script = {.letter = 'A', .draw_ms = 4};
    struct bench bench;
    begin(&bench);
    add(&bench, &script, 3)->window_frames = 12;
    measure(&bench, &plain);
    assert_int_equal(bench.records[0].frames_a_sample, 5);
    assert_int_equal(bench.records[0].sample_count, 8);
    assert_int_equal(bench.records[0].pass_frames, 40);
    int opened = 0;
    for (const char *event = fake_events(); *event; event++)
        opened += *event == '(';
    assert_int_equal(opened, 4 + 4);
    end(&bench);
}

// The load runs before the first round and after each: nine times for eight rounds. The first three
// took 11, 500 and 13 ms, the last three 17, 18 and 19. It does not affect the samples.
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
    measure(&bench, &plain); // without a load no calibration is kept
    assert_equals(bench.records[0].calibration_begin_ms, 0);
    assert_equals(bench.records[0].calibration_end_ms, 0);
    end(&bench);
}

// --- the order of samples ---

// Reads the order of samples from the events. Each sample is one frame, with a frame before it.
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

// Every job has one sample a round, and each place in a round about as often as any other.
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
            assert_between(at[job][place], ROUNDS / 8, ROUNDS * 3 / 8);
    }
    for (int round = 0; round < ROUNDS; round++)
        for (char letter = 'A'; letter <= 'D'; letter++)
            assert_non_null(memchr(order + (size_t)4 * (size_t)round, letter, 4));
    int stays = 0; // by chance a job keeps its place one time in four
    for (int i = 4; i < 4 * ROUNDS; i++)
        stays += order[i] == order[i - 4];
    assert_between(stays, ROUNDS / 2, ROUNDS * 3 / 2);
    measure_four(again, 4 * ROUNDS);
    assert_memory_equal(order, again, sizeof(order));
}

// A job with fewer samples spreads them over the run.
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
    for (int i = 0; i < 18; i += 3) { // A A B or A B A, two rounds
        int seen = 0;
        for (int j = 0; j < 3; j++)
            seen += order[i + j] == 'B';
        assert_int_equal(seen, 1);
        assert_int_equal(order[i], 'A');
    }
    end(&bench);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_open),
        cmocka_unit_test(test_warm_up),
        cmocka_unit_test(test_samples),
        cmocka_unit_test(test_bounds_of_samples),
        cmocka_unit_test(test_window_is_not_timed),
        cmocka_unit_test(test_windows_are_used_up),
        cmocka_unit_test(test_calibration),
        cmocka_unit_test(test_order),
        cmocka_unit_test(test_spread),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
