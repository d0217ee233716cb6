#define _GNU_SOURCE // MAP_ANONYMOUS, prlimit, usleep
// A worker gives the harness a result, or a line that says how it ended.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/base/doing.h"
#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"
#include "harness/devices/workers/serve.h"
#include "harness/devices/workers/worker.h"
#include "tests/tools/process/interrupt.h"

// --- in the worker ---

enum { MANY = 10 << 20 };

static bool double_it(struct rg_message *request, struct rg_message *reply)
{
    rg_put_int(reply, 2 * rg_take_int(request));
    return true;
}

static bool send_many(struct rg_message *request, struct rg_message *reply)
{
    const int first = (int)rg_take_int(request);
    char *bytes = malloc(MANY);
    for (int i = 0; bytes && i < MANY; i++)
        bytes[i] = (char)(first + i / 3);
    rg_put_block(reply, bytes, MANY);
    free(bytes);
    return true;
}

static bool refuse(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    (void)reply;
    printf("noise\n");
    rg_warning("a worry");
    return rg_unsupported("this device has no soul");
}

static bool end(struct rg_message *request, struct rg_message *reply)
{
    (void)reply;
    const int how = (int)rg_take_int(request);
    rg_doing_begin("running kernel", "flow_blur");
    fprintf(stderr, "first\nsecond line\n----\n");
    if (how < 0)
        _exit(-1 - how);
    raise(how);
    return true;
}

static bool hang(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    (void)reply;
    while (pause())
        continue;
    return true;
}

static bool swell(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    (void)reply;
    for (char *more = NULL; more != MAP_FAILED;) {
        more = mmap(NULL, 1 << 20, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        memset(more, 1, 1 << 20);
        usleep(500);
    }
    return true;
}

// Waits until the printed text has been truncated, then ends with a last line.
static bool print_much(struct rg_message *request, struct rg_message *reply)
{
    static char much[2 << 20];
    struct stat printed;
    (void)request;
    (void)reply;
    memset(much, 'x', sizeof(much));
    fwrite(much, 1, sizeof(much), stderr);
    do
        usleep(1000);
    while (!fstat(STDERR_FILENO, &printed) && printed.st_size >= (off_t)sizeof(much));
    fprintf(stderr, "and out\n");
    _exit(1);
}

// A child process still holds the channel's descriptors when the worker ends.
static bool leave_a_child(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    (void)reply;
    if (fork() == 0) {
        sleep(2);
        _exit(0);
    }
    _exit(3);
}

static bool tell_variable(struct rg_message *request, struct rg_message *reply)
{
    const char *value = getenv(rg_take_text(request));
    rg_put_text(reply, value ? value : "(none)");
    return true;
}

static bool tell_process(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    rg_put_int(reply, getpid());
    return true;
}

// Waits for the interruption that the harness passes on.
static bool wait_for_signal(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    for (int i = 0; i < 20000 && !rg_interrupted(); i++)
        usleep(1000);
    rg_put_int(reply, rg_interrupt_signal());
    return true;
}

static bool shut(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    rg_put_fields(reply, rg_closed_fields, &(bool){true});
    return true;
}

static bool greet(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    rg_put_text(reply, "these messages");
    return true;
}

static rg_service *const services[RG_CALL_COUNT_OF_CALLS] = {
    [RG_CALL_STEP] = double_it,
    [RG_CALL_READ] = send_many,
    [RG_CALL_DRAW] = refuse,
    [RG_CALL_SYNC] = end,
    [RG_CALL_TIME] = hang,
    [RG_CALL_COUNT] = swell,
    [RG_CALL_OPEN] = leave_a_child,
    [RG_CALL_TELL] = tell_variable,
    [RG_CALL_LIST] = tell_process,
    [RG_CALL_PROBE] = print_much,
    [RG_CALL_HELLO] = greet,
    [RG_CALL_CLOSE] = shut,
    [RG_CALL_FRAMES] = wait_for_signal,
};

// --- in the harness ---

static char logged[4096];

static void keep(enum rg_log_level level, const char *line, void *user)
{
    (void)user;
    const size_t used = strlen(logged);
    snprintf(logged + used, sizeof(logged) - used, "%s%s\n",
             level == RG_LOG_WARNING ? "warning: " : "", line);
}

static int begin(void **state)
{
    *logged = 0;
    rg_workers.timeout_s = 100;
    rg_workers.memory_bytes = 0;
    return !(*state = rg_worker_create("toy", NULL));
}

static int finish(void **state)
{
    rg_worker_destroy(*state);
    return 0;
}

// Sends a number; returns the outcome, and the number of the reply in `result`.
static enum rg_outcome ask(struct rg_worker *worker, enum rg_call call, int64_t number,
                           int64_t *result)
{
    struct rg_message request = {0}, reply;
    rg_put_int(&request, number);
    const bool ok = rg_worker_call(worker, call, &request, &reply);
    if (ok && result)
        *result = rg_take_int(&reply);
    rg_message_free(&request);
    rg_message_free(&reply);
    return ok ? RG_OK : rg_failure_take().outcome;
}

static void results_come_back(void **state)
{
    int64_t result = 0;
    for (int i = 0; i < 100; i++) {
        assert_int_equal(ask(*state, RG_CALL_STEP, i, &result), RG_OK);
        assert_int_equal(result, 2 * i);
    }
    assert_int_equal(rg_worker_life(*state), 1);
    assert_string_equal(logged, "");
}

static void large_results_come_back_and_small_ones_after_them(void **state)
{
    for (int first = 1; first < 4; first++) {
        struct rg_message request = {0}, reply;
        int64_t size, small;
        rg_put_int(&request, first);
        assert_true(rg_worker_call(*state, RG_CALL_READ, &request, &reply));
        char *bytes = rg_take_block(&reply, &size);
        assert_int_equal(size, MANY);
        for (int i = 0; i < MANY; i++)
            if (bytes[i] != (char)(first + i / 3))
                fail_msg("byte %d is %d", i, bytes[i]);
        free(bytes);
        rg_message_free(&request);
        rg_message_free(&reply);
        assert_int_equal(ask(*state, RG_CALL_STEP, first, &small), RG_OK);
        assert_int_equal(small, 2 * first);
    }
}

static void lines_and_kinds_of_errors_come_back(void **state)
{
    struct rg_worker *other = rg_worker_create("other", NULL);
    assert_int_equal(ask(*state, RG_CALL_DRAW, 0, NULL), RG_UNSUPPORTED);
    assert_string_equal(logged, "warning: a worry\ndevice 'toy': this device has no soul\n");
    assert_int_equal(ask(other, RG_CALL_DRAW, 0, NULL), RG_UNSUPPORTED);
    assert_string_equal(logged, "warning: a worry\ndevice 'toy': this device has no soul\n"
                                "warning: a worry\ndevice 'other': this device has no soul\n");
    assert_int_equal(rg_worker_life(*state), 1);
    rg_worker_destroy(other);
}

static void what_is_not_served_is_an_error(void **state)
{
    assert_int_equal(ask(*state, RG_CALL_AUDIT, 0, NULL), RG_ERROR);
    assert_int_equal(rg_worker_life(*state), 1);
}

static void crashes_are_told_with_what_was_done_and_the_last_words(void **state)
{
    assert_int_equal(ask(*state, RG_CALL_SYNC, SIGKILL, NULL), RG_CRASH);
    assert_string_equal(logged, "device 'toy': its driver crashed (Killed) while running kernel "
                                "'flow_blur': second line\n");
}

static void an_exit_is_no_success(void **state)
{
    assert_int_equal(ask(*state, RG_CALL_SYNC, -1, NULL), RG_CRASH);
    assert_non_null(strstr(logged, "its driver ended the process with status 0 while running"));
    assert_int_equal(ask(*state, RG_CALL_SYNC, -6, NULL), RG_CRASH);
    assert_non_null(strstr(logged, "its driver ended the process with status 5 while running"));
    assert_int_equal(ask(*state, RG_CALL_SYNC, -1 - RG_EXIT_HARNESS, NULL), RG_LACKING);
    assert_non_null(strstr(logged, "its process ended, for it had no memory for a message while"));
}

static void a_hang_is_ended(void **state)
{
    rg_workers.timeout_s = 0;
    assert_int_equal(ask(*state, RG_CALL_TIME, 0, NULL), RG_TIMEOUT);
    assert_string_equal(logged,
                        "device 'toy': its driver did not come back within 0 s while asking "
                        "for the device's time\n");
}

static void what_takes_too_much_memory_is_ended(void **state)
{
    rg_workers.memory_bytes = 512 << 20;
    assert_int_equal(ask(*state, RG_CALL_COUNT, 0, NULL), RG_CRASH);
    assert_string_equal(logged, "device 'toy': it took more than 512 MiB of memory and was ended "
                                "while counting a frame's work\n");
}

static void what_is_printed_without_end_is_dropped(void **state)
{
    assert_int_equal(ask(*state, RG_CALL_PROBE, 0, NULL), RG_CRASH);
    assert_non_null(strstr(logged, "ended the process with status 1"));
    assert_non_null(strstr(logged, ": and out\n"));
}

static void the_end_is_seen_though_its_child_holds_the_channel(void **state)
{
    assert_int_equal(ask(*state, RG_CALL_OPEN, 0, NULL), RG_CRASH);
    assert_non_null(strstr(logged, "ended the process with status 3"));
}

static void it_lives_three_times(void **state)
{
    int64_t result;
    for (int life = 1; life <= RG_WORKER_LIVES; life++) {
        assert_int_equal(ask(*state, RG_CALL_STEP, life, &result), RG_OK);
        assert_int_equal(result, 2 * life);
        assert_int_equal(rg_worker_life(*state), life);
        assert_true(rg_worker_has(*state, life));
        assert_false(rg_worker_has(*state, life - 1));
        assert_int_equal(ask(*state, RG_CALL_SYNC, SIGKILL, NULL), RG_CRASH);
        assert_false(rg_worker_has(*state, life));
    }
    *logged = 0;
    assert_int_equal(ask(*state, RG_CALL_STEP, 1, &result), RG_CRASH);
    assert_string_equal(logged, "device 'toy': left out, for its process has ended 3 times\n");
}

// Whoever crashes a driver on purpose starts it anew, as often as needed.
static void it_lives_again_when_it_is_renewed(void **state)
{
    int64_t result;
    assert_string_equal(rg_worker_end_doing(*state), "");
    for (int i = 0; i < RG_WORKER_LIVES; i++)
        assert_int_equal(ask(*state, RG_CALL_SYNC, SIGKILL, NULL), RG_CRASH);
    assert_string_equal(rg_worker_end_doing(*state), " while running kernel 'flow_blur'");
    assert_int_equal(ask(*state, RG_CALL_STEP, 1, &result), RG_CRASH);
    rg_worker_renew(*state);
    for (int i = 0; i < RG_WORKER_LIVES; i++)
        assert_int_equal(ask(*state, RG_CALL_SYNC, SIGKILL, NULL), RG_CRASH);
    rg_worker_renew(*state);
    assert_int_equal(ask(*state, RG_CALL_STEP, 1, &result), RG_OK);
    const int life = rg_worker_life(*state);
    assert_int_equal(life, 2 * RG_WORKER_LIVES + 1);
    rg_worker_renew(*state); // ends one that runs, too
    assert_int_equal(rg_worker_process(*state), 0);
    assert_false(rg_worker_has(*state, life));
    assert_int_equal(ask(*state, RG_CALL_STEP, 1, &result), RG_OK);
    assert_int_equal(rg_worker_life(*state), life + 1);
}

// Objects that were open when a process ended are told as lost, with how it ended.
static void what_was_open_is_lost_with_its_process(void **state)
{
    int64_t result;
    assert_int_equal(ask(*state, RG_CALL_STEP, 1, &result), RG_OK);
    assert_true(rg_worker_still_has(*state, 1));
    rg_workers.timeout_s = 0;
    assert_int_equal(ask(*state, RG_CALL_TIME, 0, NULL), RG_TIMEOUT);
    *logged = 0;
    assert_false(rg_worker_still_has(*state, 1));
    assert_int_equal(rg_failure_take().outcome, RG_TIMEOUT);
    assert_string_equal(logged, "device 'toy': what was open on it has gone with its process\n");
}

// A process that ends badly when all is done is told, and only then.
static void the_end_after_closing_counts(void **state)
{
    (void)state;
    int64_t result;
    for (int badly = 0; badly < 2; badly++) {
        struct rg_worker *worker = rg_worker_create("toy", badly ? "RG_TEST_END=9\0" : NULL);
        assert_true(rg_worker_retire(worker)); // never ran
        assert_int_equal(ask(worker, RG_CALL_STEP, 1, &result), RG_OK);
        assert_true(rg_worker_retire(worker));
        assert_string_equal(logged, "");
        assert_int_equal(rg_worker_destroy(worker), !badly);
    }
    assert_string_equal(logged,
                        "device 'toy': its process ended with status 9 when all was done\n");
    struct rg_worker *worker = rg_worker_create("toy", "RG_TEST_END=9\0");
    assert_int_equal(ask(worker, RG_CALL_STEP, 1, &result), RG_OK);
    rg_worker_closes_badly(worker);
    assert_true(rg_worker_destroy(worker)); // was not asked to close its device
    worker = rg_worker_create("toy", NULL);
    assert_int_equal(ask(worker, RG_CALL_STEP, 1, &result), RG_OK);
    rg_driver_error("a session cannot be closed");
    rg_worker_closes_badly(worker);
    assert_false(rg_worker_retire(worker));
    assert_true(rg_worker_destroy(worker));
    assert_true(rg_worker_destroy(NULL));
}

// An interruption reaches a worker, which is in a group of processes of its own.
static void an_interruption_is_passed_on(void **state)
{
    int64_t number = 0, result = 0;
    assert_int_equal(ask(*state, RG_CALL_STEP, 1, &result), RG_OK);
    rg_interrupt_watch();
    interrupt_by(SIGTERM);
    assert_int_equal(ask(*state, RG_CALL_FRAMES, 0, &number), RG_OK);
    rg_interrupt_watch();
    assert_int_equal(number, SIGINT);
    assert_int_equal(ask(*state, RG_CALL_STEP, 4, &result), RG_OK);
    assert_int_equal(result, 8);
}

static void a_worker_that_is_killed_while_it_waits_crashed(void **state)
{
    int64_t process = 0, result;
    assert_int_equal(ask(*state, RG_CALL_LIST, 0, &process), RG_OK);
    assert_int_equal(rg_worker_process(*state), process);
    kill((pid_t)process, SIGKILL);
    assert_int_equal(ask(*state, RG_CALL_STEP, 1, &result), RG_CRASH);
    assert_int_equal(ask(*state, RG_CALL_STEP, 4, &result), RG_OK);
    assert_int_equal(result, 8);
}

// A crash leaves no core file, which would hold the driver's memory.
static void a_crash_leaves_no_core_file(void **state)
{
    struct rlimit most, found = {1, 1};
    int64_t process = 0;
    assert_int_equal(getrlimit(RLIMIT_CORE, &most), 0);
    if (most.rlim_max == 0) {
        print_message("no process here may leave a core file\n");
        skip();
    }
    most.rlim_cur = most.rlim_max;
    assert_int_equal(setrlimit(RLIMIT_CORE, &most), 0);
    assert_int_equal(ask(*state, RG_CALL_LIST, 0, &process), RG_OK);
    assert_int_equal(prlimit((pid_t)process, RLIMIT_CORE, NULL, &found), 0);
    assert_true(found.rlim_cur == 0 && found.rlim_max == 0);
}

// With SIGCHLD ignored the kernel keeps no status of an ended process, so there is nothing to wait
// for.
static void an_end_is_seen_where_sigchld_is_ignored(void **state)
{
    int64_t result = 0;
    signal(SIGCHLD, SIG_IGN);
    assert_int_equal(ask(*state, RG_CALL_STEP, 4, &result), RG_OK);
    assert_int_equal(ask(*state, RG_CALL_SYNC, SIGKILL, NULL), RG_CRASH);
    assert_int_equal(ask(*state, RG_CALL_STEP, 4, &result), RG_OK);
    rg_worker_destroy(*state);
    signal(SIGCHLD, SIG_DFL);
    *state = NULL;
}

static bool tells(struct rg_worker *worker, const char *variable, const char *value)
{
    struct rg_message request = {0}, reply;
    rg_put_text(&request, variable);
    const bool ok = rg_worker_call(worker, RG_CALL_TELL, &request, &reply);
    const bool same = ok && !strcmp(rg_take_text(&reply), value);
    rg_message_free(&request);
    rg_message_free(&reply);
    return same;
}

static void its_environment_stands_over_the_harness_s(void **state)
{
    (void)state;
    setenv("RG_TEST_KEPT", "kept", 1);
    setenv("RG_TEST_TWO", "ours", 1);
    struct rg_worker *worker = rg_worker_create("toy", "RG_TEST_ONE=a=1\0RG_TEST_TWO=theirs\0");
    assert_true(tells(worker, "RG_TEST_KEPT", "kept"));
    assert_true(tells(worker, "RG_TEST_ONE", "a=1"));
    assert_true(tells(worker, "RG_TEST_TWO", "theirs"));
    assert_string_equal(getenv("RG_TEST_TWO"), "ours");
    assert_null(getenv("RG_TEST_ONE"));
    rg_worker_destroy(worker);
}

static enum rg_outcome ask_program(const char *hello, const char *environment, int64_t *result)
{
    struct rg_worker *worker = rg_worker_create("toy", environment);
    *logged = 0;
    rg_workers.hello = hello;
    const enum rg_outcome outcome = ask(worker, RG_CALL_STEP, 21, result);
    rg_worker_destroy(worker);
    return outcome;
}

static void another_build_is_asked_where_its_messages_are_the_same(void **state)
{
    (void)state;
    int64_t result = 0;
    assert_int_equal(ask_program("these messages", "RG_PROGRAM=/proc/self/exe\0", &result), RG_OK);
    assert_int_equal(result, 42);
    assert_string_equal(logged, "");
    // Without RG_PROGRAM the worker is this very program, whose messages are not checked.
    assert_int_equal(ask_program("other messages", NULL, &result), RG_OK);
}

static void another_build_with_other_messages_is_turned_away(void **state)
{
    (void)state;
    int64_t result = 0;
    static const char *const programs[] = {"RG_PROGRAM=/proc/self/exe\0", "RG_PROGRAM=/bin/true\0",
                                           "RG_PROGRAM=/bin/cat\0"};
    for (size_t i = 0; i < sizeof(programs) / sizeof(*programs); i++) {
        assert_int_not_equal(ask_program("other messages", programs[i], &result), RG_OK);
        assert_int_equal(rg_failure_take().fault, RG_FAULT_INPUT);
        assert_non_null(strstr(logged, "is no raingauge that this one can ask"));
        assert_ptr_equal(strchr(logged, '\n'), logged + strlen(logged) - 1);
    }
    assert_int_not_equal(ask_program("these messages", "RG_PROGRAM=/none/raingauge\0", &result),
                         RG_OK);
    assert_non_null(strstr(logged, "RG_PROGRAM=/none/raingauge cannot be started: No such file"));
}

// Where process 1 is no init, as in some containers, nobody reaps the process, and a zombie stays.
static bool has_ended(pid_t process)
{
    char path[64], text[512];
    snprintf(path, sizeof(path), "/proc/%d/stat", (int)process);
    FILE *file = fopen(path, "r");
    if (!file)
        return true;
    text[fread(text, 1, sizeof(text) - 1, file)] = 0;
    fclose(file);
    const char *name_end = strrchr(text, ')');
    return !name_end || name_end[2] == 'Z';
}

// A worker ends when the harness is killed.
static void no_worker_outlives_the_harness(void **state)
{
    (void)state;
    int told[2], status;
    int64_t process = 0;
    assert_int_equal(pipe(told), 0);
    const pid_t harness = fork();
    if (harness == 0) {
        struct rg_worker *worker = rg_worker_create("toy", NULL);
        ask(worker, RG_CALL_LIST, 0, &process);
        if (write(told[1], &process, sizeof(process)) == sizeof(process))
            raise(SIGKILL);
        _exit(1);
    }
    close(told[1]);
    assert_int_equal(read(told[0], &process, sizeof(process)), sizeof(process));
    close(told[0]);
    waitpid(harness, &status, 0);
    assert_true(WIFSIGNALED(status));
    for (int i = 0; i < 10000 && !has_ended((pid_t)process); i++)
        usleep(1000);
    assert_true(has_ended((pid_t)process));
}

int main(int argc, char **argv)
{
    if (argc == 3 && !strcmp(argv[1], RG_WORKER_ARGUMENT)) {
        const int status = rg_serve(argv[2], services);
        return getenv("RG_TEST_END") ? atoi(getenv("RG_TEST_END")) : status;
    }
    const struct CMUnitTest tests[] = {
#define WITH_WORKER(test) cmocka_unit_test_setup_teardown(test, begin, finish)
        WITH_WORKER(results_come_back),
        WITH_WORKER(large_results_come_back_and_small_ones_after_them),
        WITH_WORKER(lines_and_kinds_of_errors_come_back),
        WITH_WORKER(what_is_not_served_is_an_error),
        WITH_WORKER(crashes_are_told_with_what_was_done_and_the_last_words),
        WITH_WORKER(an_exit_is_no_success),
        WITH_WORKER(a_hang_is_ended),
        WITH_WORKER(what_takes_too_much_memory_is_ended),
        WITH_WORKER(what_is_printed_without_end_is_dropped),
        WITH_WORKER(the_end_is_seen_though_its_child_holds_the_channel),
        WITH_WORKER(it_lives_three_times),
        WITH_WORKER(it_lives_again_when_it_is_renewed),
        WITH_WORKER(what_was_open_is_lost_with_its_process),
        WITH_WORKER(the_end_after_closing_counts),
        WITH_WORKER(an_interruption_is_passed_on),
        WITH_WORKER(a_worker_that_is_killed_while_it_waits_crashed),
        WITH_WORKER(a_crash_leaves_no_core_file),
        WITH_WORKER(an_end_is_seen_where_sigchld_is_ignored),
        cmocka_unit_test(its_environment_stands_over_the_harness_s),
        cmocka_unit_test(another_build_is_asked_where_its_messages_are_the_same),
        cmocka_unit_test(another_build_with_other_messages_is_turned_away),
        cmocka_unit_test(no_worker_outlives_the_harness),
    };
    rg_workers.program = "/proc/self/exe";
    rg_log_listen(keep, NULL);
    return cmocka_run_group_tests_name("workers that end", tests, NULL, NULL);
}
