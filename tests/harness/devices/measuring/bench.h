// Jobs on a device of fake.h, measured: the test can work out by hand which frames are timed, how
// often and in which order.
#ifndef RG_TESTS_HARNESS_DEVICES_MEASURING_BENCH_H
#define RG_TESTS_HARNESS_DEVICES_MEASURING_BENCH_H

#include <string.h>

#include "core/base/log.h"
#include "harness/console/interrupt.h"
#include "harness/devices/measure/measure.h"
#include "tests/harness/devices/measuring/fake.h"
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

static inline void ignore_line(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)line;
    (void)user;
}

static inline void begin(struct bench *bench)
{
    memset(bench, 0, sizeof(*bench));
    bench->fake = fake_open();
    rg_log_listen(ignore_line, NULL);
    rg_interrupt_watch();
    fake_forget();
}

static inline struct rg_job *add(struct bench *bench, const struct fake_script *script,
                                 int check_frames)
{
    struct rg_job *job = &bench->jobs[bench->count];
    *job = (struct rg_job){.subject = {&fake_technique, script, 8, 8},
                           .device = &bench->fake->pub,
                           .check_frames = check_frames,
                           .record = &bench->records[bench->count]};
    bench->count++;
    return job;
}

static inline void end(struct bench *bench)
{
    for (int i = 0; i < bench->count; i++)
        rg_job_close(&bench->jobs[i]);
    // A lost device reports the loss once more when it is closed, since its objects cannot be
    // closed.
    const bool is_there =
        bench->fake->waits_left < 0; // compilers differ in which argument comes first
    assert_int_equal(rg_device_close(&bench->fake->pub), is_there);
    rg_log_listen(NULL, NULL);
}

// Opens, warms up and times all jobs.
static inline void measure(struct bench *bench, const struct rg_measure_options *options)
{
    for (int i = 0; i < bench->count; i++)
        assert_true(rg_job_open(&bench->jobs[i]) && rg_job_warm_up(&bench->jobs[i], options));
    fake_forget();
    rg_jobs_measure(bench->jobs, bench->count, options);
}

static const struct rg_measure_options plain = {.most_samples = 40,
                                                .least_samples = 2,
                                                .sample_ms = 20,
                                                .job_ms = 200,
                                                .warm_up_ms = 1e9,
                                                .warm_up_frames = 4,
                                                .passes_ms = 400};

// A machine that gets slower from round to round. One round is disturbed, and each round stands
// still once.
enum { LOADS_A_TIME = 3 };
static int loads;
static inline void run_load(void)
{
    const int time = loads / LOADS_A_TIME + 1, of_time = loads++ % LOADS_A_TIME;
    fake_pass(time == 2 || of_time == 1 ? 500 : 10 + time);
}

#endif
