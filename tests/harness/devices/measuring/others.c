#define _GNU_SOURCE // sched_setaffinity
// Other processes' load: how it is read, which samples it has retaken, and when it is reported. It
// comes from a scripted /proc/stat, and from a clock that only the script moves.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/compare/doctor/prologue.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/devices/measure/measure.h"
#include "tests/harness/devices/measuring/fake.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"

#define assert_ms(value, ms) assert_near(value, ms, 1e-6)

// --- a reading ---

// Writes a machine with this many processors, each with these ticks of idle time, waiting and
// steal.
static void write_stat(const char *root, int processors, int idle, int waiting, int stolen)
{
    char path[256];
    snprintf(path, sizeof(path), "%s/proc/stat", root);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "cpu  7 1 2 %d %d 3 4 %d 0 0\n", processors * idle, processors * waiting,
            processors * stolen);
    for (int i = 0; i < processors; i++)
        fprintf(file, "cpu%d 7 1 2 %d %d 3 4 %d 0 0\n", i, idle, waiting, stolen);
    fprintf(file, "intr 1 2 3\nctxt 4\n");
    assert_int_equal(fclose(file), 0);
}

static void test_reading(void **state)
{
    char path[256];
    const int processors = (int)sysconf(_SC_NPROCESSORS_CONF);
    const double tick_ms = 1e3 / (double)sysconf(_SC_CLK_TCK);
    assert_int_equal(make_folder(state), 0);
    assert_int_equal(rg_processors_read(folder, NULL, 0).count, 0);
    snprintf(path, sizeof(path), "%s/proc", folder);
    assert_int_equal(mkdir(path, 0700), 0);
    write_stat(folder, processors, 100, 10, 5);
    const pid_t gone = 0x7ffffff;
    const struct rg_processors before = rg_processors_read(folder, NULL, 0);
    assert_between(before.count, 1, processors);
    assert_ms(before.idle_ms, 110 * before.count * tick_ms);
    assert_ms(before.stolen_ms, 5 * before.count * tick_ms);
    assert_above(before.own_ms, 0);
    assert_true(isnan(rg_processors_read(folder, &gone, 1).own_ms));
    // A line that is cut off says nothing.
    FILE *file = fopen(strcat(path, "/stat"), "w");
    fprintf(file, "cpu  7 1 2\ncpu0 7 1\n");
    fclose(file);
    assert_int_equal(rg_processors_read(folder, NULL, 0).count, 0);
    assert_int_equal(remove_whole_folder(state), 0);
}

// Writes processors whose ticks of idle time and steal differ, and a line of all that is rounded
// otherwise, as Linux does.
static void write_uneven(const char *root, int processors)
{
    char path[256];
    snprintf(path, sizeof(path), "%s/proc/stat", root);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "cpu  0 0 0 5000 50 0 0 500 0 0\n");
    for (int i = 0; i < processors; i++)
        fprintf(file, "cpu%d 0 0 0 %d 0 0 0 %d 0 0\n", i, 100 + i, 10 + i);
    assert_int_equal(fclose(file), 0);
}

// A process that may use one processor reads that one alone; one that may use all, their sum.
static void test_processors_of_this_process(void **state)
{
    char path[256];
    const double tick_ms = 1e3 / (double)sysconf(_SC_CLK_TCK);
    cpu_set_t before, one;
    assert_int_equal(sched_getaffinity(0, sizeof(before), &before), 0);
    int last = CPU_SETSIZE - 1;
    while (!CPU_ISSET(last, &before))
        last--;
    assert_int_equal(make_folder(state), 0);
    snprintf(path, sizeof(path), "%s/proc", folder);
    assert_int_equal(mkdir(path, 0700), 0);
    CPU_ZERO(&one);
    CPU_SET(last, &one);
    assert_int_equal(sched_setaffinity(0, sizeof(one), &one), 0);
    write_uneven(folder, last + 2);
    struct rg_processors now = rg_processors_read(folder, NULL, 0);
    assert_int_equal(now.count, 1);
    assert_ms(now.idle_ms, (100 + last) * tick_ms);
    assert_ms(now.stolen_ms, (10 + last) * tick_ms);
    assert_ms(now.grain_ms, tick_ms);
    assert_int_equal(sched_setaffinity(0, sizeof(before), &before), 0);
    if (CPU_COUNT(&before) == last + 1) {
        write_uneven(folder, last + 1);
        now = rg_processors_read(folder, NULL, 0);
        assert_int_equal(now.count, last + 1);
        assert_ms(now.idle_ms, 5050 * tick_ms);
        assert_ms(now.stolen_ms, 500 * tick_ms);
        assert_ms(now.grain_ms, tick_ms); // that line is rounded once
    }
    assert_int_equal(remove_whole_folder(state), 0);
}

enum { BURNT_MS = 40 };

// Computes for so long on a processor.
static void burn(void)
{
    struct timespec since, now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &since);
    do {
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    } while ((double)(now.tv_sec - since.tv_sec) * 1e3 +
                 (double)(now.tv_nsec - since.tv_nsec) * 1e-6 <
             BURNT_MS + 10);
}

// Our own time is that of this process, of its children that have ended, and of those that are
// named.
static void test_own_time(void **state)
{
    (void)state;
    const pid_t self = getpid();
    struct rg_processors before = rg_processors_now(NULL, 0);
    burn();
    struct rg_processors after = rg_processors_now(NULL, 0);
    assert_at_least(after.own_ms - before.own_ms, BURNT_MS);
    assert_at_most(after.own_ms - before.own_ms, 1000 * BURNT_MS); // in milliseconds
    assert_at_least(rg_processors_now(&self, 1).own_ms - after.own_ms, BURNT_MS);
    before = rg_processors_now(NULL, 0);
    const pid_t child = fork();
    if (child == 0) {
        burn();
        _exit(0);
    }
    assert_int_equal(waitpid(child, NULL, 0), child);
    after = rg_processors_now(NULL, 0);
    assert_at_least(after.own_ms - before.own_ms, BURNT_MS);
    assert_at_most(after.own_ms - before.own_ms, 1000 * BURNT_MS);
}

static void test_taken(void **state)
{
    (void)state;
    const struct rg_processors before = {.count = 2, .grain_ms = 10};
    struct rg_processors after = before;
    after.at_ms = 500; // two processors: 1000 ms
    after.idle_ms = 290;
    after.own_ms = 200;
    after.stolen_ms = 100;
    const struct rg_taken taken = rg_taken_between(&before, &after);
    assert_ms(taken.stolen, 0.09); // both less the grain
    assert_ms(taken.others, 0.4);
    after.idle_ms = 795; // no more than the grain counts as none
    after.stolen_ms = 10;
    assert_equals(rg_taken_between(&before, &after).others, 0);
    assert_equals(rg_taken_between(&before, &after).stolen, 0);
    after.stolen_ms = 100;
    after.idle_ms = 0;
    after.own_ms = NAN; // a process of ours has ended
    assert_equals(rg_taken_between(&before, &after).others, 0);
    after.count = 0; // nothing is known
    assert_equals(rg_taken_between(&before, &after).stolen, 0);
    after.count = 3; // another processor came
    assert_equals(rg_taken_between(&before, &after).stolen, 0);
    after.count = 2;
    assert_above(rg_taken_between(&before, &after).stolen, 0);
    const struct rg_processors unknown = {.grain_ms = 10};
    assert_equals(rg_taken_between(&unknown, &after).stolen, 0);
}

// Ten seconds of two processors. Our process ran and waited on one of them. `busy_ms` counts all
// processes, without steal.
static void expect_shares(double busy_ms, double own_ms, double waited_ms, double stolen_ms,
                          double others)
{
    const struct rg_processors before = {.count = 2, .own_ms = 7000, .ran_ms = 5000};
    struct rg_processors after = before;
    after.at_ms = 10000;
    after.idle_ms = 20000 - busy_ms - stolen_ms;
    after.stolen_ms = stolen_ms;
    after.own_ms += own_ms;
    after.ran_ms += waited_ms < 0 ? 0 : own_ms;
    after.waited_ms = fmax(waited_ms, 0);
    const struct rg_taken taken = rg_taken_between(&before, &after);
    assert_ms(taken.stolen, stolen_ms / 20000);
    assert_ms(taken.others, others);
}

static void test_waiting(void **state)
{
    (void)state;
    expect_shares(10000, 10000, 0, 0, 0);       // alone
    expect_shares(20000, 10000, 0, 0, 0);       // another process has the other core
    expect_shares(20000, 5000, 5000, 0, 0.5);   // it takes half of our time
    expect_shares(10000, 10000, 10000, 0, 0);   // threads of ours wait for each other
    expect_shares(12000, 10000, 10000, 0, 0.1); // another process took a tenth of the machine
    expect_shares(16000, 10000, -1, 0, 0.3);    // a kernel that does not report threads
    expect_shares(10000, 10000, 0, 2000, 0);    // a hypervisor took a tenth
    const pid_t self = getpid();
    const struct rg_processors now = rg_processors_now(&self, 1);
    assert_above(now.ran_ms, 0);
    assert_at_least(rg_processors_now(&self, 1).waited_ms, now.waited_ms);
    assert_equals(rg_processors_now(NULL, 0).ran_ms, 0);
}

// --- samples ---

// Two processors, of which others take a share between two times.
static struct {
    double from_ms, to_ms, share;
    int readings;
    struct rg_processors now;
} machine;

static struct rg_processors watch(const pid_t *ours, int our_count)
{
    (void)ours;
    (void)our_count;
    struct rg_processors *now = &machine.now;
    const double at_ms = rg_now_ms(), passed_ms = at_ms - now->at_ms;
    const double busy_ms = fmax(fmin(at_ms, machine.to_ms) - fmax(now->at_ms, machine.from_ms), 0);
    now->idle_ms += 2 * (passed_ms - machine.share * busy_ms);
    now->at_ms = at_ms;
    machine.readings++;
    return *now;
}

static void begin_machine(double from_ms, double to_ms, double share)
{
    memset(&machine, 0, sizeof(machine));
    machine.now = (struct rg_processors){.count = 2, .at_ms = rg_now_ms()};
    machine.from_ms = machine.now.at_ms + from_ms;
    machine.to_ms = machine.now.at_ms + to_ms;
    machine.share = share;
}

enum { SAMPLES = 12, JOBS = 2 };
static struct rg_record records[JOBS];

// Two jobs with samples of 50 ms, and a frame of 50 ms before each: three samples make a batch,
// which takes 500 ms of two processors.
static void measure_until(double end_ms)
{
    static const struct fake_script scripts[JOBS] = {{.letter = 'A', .draw_ms = 50},
                                                     {.letter = 'B', .draw_ms = 50}};
    const struct rg_measure_options options = {.most_samples = SAMPLES,
                                               .least_samples = SAMPLES,
                                               .sample_ms = 20,
                                               .warm_up_ms = 1,
                                               .warm_up_frames = 1,
                                               .watch = watch,
                                               .end_ms = end_ms > 0 ? rg_now_ms() + end_ms : 0};
    struct fake_device *fake = fake_open();
    struct rg_job jobs[JOBS];
    rg_interrupt_watch();
    memset(records, 0, sizeof(records));
    for (int i = 0; i < JOBS; i++) {
        jobs[i] = (struct rg_job){.subject = {&fake_technique, &scripts[i], 8, 8},
                                  .device = &fake->pub,
                                  .check_frames = 1,
                                  .record = &records[i]};
        assert_true(rg_job_open(&jobs[i]) && rg_job_warm_up(&jobs[i], &options));
    }
    fake_forget();
    const double start_ms = rg_now_ms();
    machine.from_ms += start_ms - machine.now.at_ms;
    machine.to_ms += start_ms - machine.now.at_ms;
    rg_jobs_measure(jobs, JOBS, &options);
    for (int i = 0; i < JOBS; i++) {
        assert_int_equal(records[i].outcome, RG_OK);
        assert_int_equal(records[i].sample_count, SAMPLES);
        assert_true(records[i].is_watched);
        rg_job_close(&jobs[i]);
    }
    assert_true(rg_device_close(&fake->pub));
}

static void measure(void)
{
    measure_until(0);
}

static void test_quiet(void **state)
{
    (void)state;
    char mark[RG_MARK_SIZE];
    begin_machine(0, 1e9, 0.04);
    measure();
    for (int i = 0; i < JOBS; i++) {
        assert_int_equal(records[i].retaken, 0);
        assert_int_equal(rg_record_disturbed(&records[i]), 0);
        assert_ms(records[i].taken[3], 0.04);
        rg_record_mark(&records[i], mark);
        assert_string_equal(mark, "");
    }
}

// Counts the retaken samples. The events must show all samples that the records name: two frames
// each, besides one frame in which passes are timed.
static int retaken_of_all(void)
{
    int frames = 0;
    const int retaken = records[0].retaken + records[1].retaken;
    for (const char *event = fake_events(); *event; event++)
        frames += *event == 'A' || *event == 'B';
    assert_int_equal(frames, 2 * (JOBS * SAMPLES + retaken) + JOBS);
    return retaken;
}

// Others are there for a short while: only the samples of that batch are retaken.
static void test_disturbed_once(void **state)
{
    (void)state;
    begin_machine(300, 450, 0.5);
    measure();
    for (int i = 0; i < JOBS; i++) {
        assert_int_equal(rg_record_disturbed(&records[i]), 0);
        for (int k = 0; k < SAMPLES; k++)
            assert_ms(records[i].samples_ms[k], 50);
    }
    assert_int_equal(retaken_of_all(), 3);
}

// Others stay: samples are retaken twice, and then kept, whatever their times.
static void test_disturbed_always(void **state)
{
    (void)state;
    char mark[RG_MARK_SIZE];
    begin_machine(0, 1e9, 0.5);
    measure();
    assert_int_equal(retaken_of_all(), 3 * 2 * 3); // three batches of three samples, twice
    for (int i = 0; i < JOBS; i++) {
        assert_int_equal(rg_record_disturbed(&records[i]), SAMPLES);
        rg_record_mark(&records[i], mark);
        assert_string_equal(mark, "busy");
    }
}

// A budget may leave no time to retake samples.
static void test_disturbed_at_the_end(void **state)
{
    (void)state;
    begin_machine(0, 1e9, 0.5);
    measure_until(100);
    assert_int_equal(retaken_of_all(), 0);
    assert_int_equal(rg_record_disturbed(&records[0]), SAMPLES);
}

// Steal counts like other programs.
static void test_marks(void **state)
{
    (void)state;
    static const struct {
        double low, high, taken;
        const char *mark;
    } cases[] = {{10, 10.9, 0, ""},         {10, 11.1, 0, "+-5%"},
                 {10, 14.4, 0.05, "+-20%"}, {10, 14.4, 0.06, "+-20% busy"},
                 {NAN, NAN, 0.06, "busy"},  {NAN, NAN, 0, ""}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        const struct rg_record record = {.frame_ms = {10, cases[i].low, cases[i].high},
                                         .sample_count = 2,
                                         .taken = {0, cases[i].taken}};
        char mark[RG_MARK_SIZE];
        rg_record_mark(&record, mark);
        assert_string_equal(mark, cases[i].mark);
    }
}

// --- the probe ---

static char heard[256];

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)user;
    assert_int_not_equal(level, RG_LOG_INFO);
    snprintf(heard, sizeof(heard), "%s", line);
}

// The clock of this program stands still, so a reading moves it.
static struct rg_processors watch_and_pass(const pid_t *ours, int our_count)
{
    const struct rg_processors now = watch(ours, our_count);
    fake_pass(1000);
    return now;
}

// Writes how often Linux has slowed a core for heat.
static void write_heat(const char *root, int core, int count)
{
    char path[512];
    snprintf(path, sizeof(path), "%s/sys/devices/system/cpu/cpu%d/thermal_throttle", root, core);
    char command[600];
    snprintf(command, sizeof(command), "mkdir -p %s", path);
    assert_int_equal(system(command), 0);
    FILE *file = fopen(strcat(path, "/core_throttle_count"), "w");
    assert_non_null(file);
    fprintf(file, "%d\n", count);
    assert_int_equal(fclose(file), 0);
}

// Before a job measures: a machine that is busy or gets hot takes no cells.
static void test_prologue(void **state)
{
    struct rg_prologue prologue = {.watch = watch_and_pass, .root = folder};
    assert_int_equal(make_folder(state), 0);
    rg_log_listen(hear, NULL);
    *heard = 0;
    begin_machine(0, 1e9, 0.3);
    assert_false(rg_prologue_begin(&prologue));
    assert_non_null(strstr(heard, "takes no cells now: others take 30 % of its processors; "));
    *heard = 0;
    begin_machine(0, 1e9, 0.02);
    assert_true(rg_prologue_begin(&prologue) && rg_prologue_end(&prologue)); // nothing is told
    write_heat(folder, 0, 5);
    write_heat(folder, 1, 7);
    assert_true(rg_prologue_begin(&prologue) && rg_prologue_end(&prologue));
    assert_string_equal(heard, "");
    write_heat(folder, 1, 10);
    assert_false(rg_prologue_end(&prologue));
    assert_non_null(strstr(heard, "takes no cells now: its processors were slowed 3 times"));
    write_heat(folder, 0, 9);
    assert_false(rg_prologue_end(&prologue));
    assert_non_null(strstr(heard, "takes no cells now: its processors were slowed 7 times"));
    rg_log_listen(NULL, NULL);
    assert_int_equal(remove_whole_folder(state), 0);
}

static void test_probe(void **state)
{
    (void)state;
    rg_log_listen(hear, NULL);
    for (int busy = 0; busy < 2; busy++) {
        *heard = 0;
        begin_machine(0, 1e9, busy ? 0.48 : 0.02);
        rg_machine_probe(watch_and_pass);
        assert_int_equal(machine.readings, 2);
        if (!busy)
            assert_string_equal(heard, "");
        else
            assert_non_null(strstr(heard, "others take 48 % of this machine's processors"));
    }
    setenv("RG_PROBE_S", "0", 1);
    *heard = 0;
    begin_machine(0, 1e9, 1);
    rg_machine_probe(watch_and_pass);
    assert_string_equal(heard, "");
    rg_log_listen(NULL, NULL);
}

int main(void)
{
    unsetenv("RG_PROBE_S");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reading),
        cmocka_unit_test(test_processors_of_this_process),
        cmocka_unit_test(test_own_time),
        cmocka_unit_test(test_taken),
        cmocka_unit_test(test_waiting),
        cmocka_unit_test(test_quiet),
        cmocka_unit_test(test_disturbed_once),
        cmocka_unit_test(test_disturbed_always),
        cmocka_unit_test(test_disturbed_at_the_end),
        cmocka_unit_test(test_marks),
        cmocka_unit_test(test_prologue),
        cmocka_unit_test(test_probe),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
