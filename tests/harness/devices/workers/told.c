// How the end of a worker is told: each way to end, as an outcome and in words, and what the
// process was doing.
#define _GNU_SOURCE // MAP_ANONYMOUS
#include "harness/devices/workers/end.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include "harness/console/exit.h"
#include "harness/devices/workers/calls.h"
#include "harness/devices/workers/held.h"
#include "tests/tools/expect.h"

#define EXITED(status) ((status) << 8)
#define MORE_MEMORY    "; ask for a smaller --size, or allow more memory (ulimit -v)"

static const struct way {
    enum rg_worker_verdict verdict;
    int status;
    enum rg_outcome outcome, if_limited;
    const char *line, *mend;
    bool is_limited; // a low limit may be the cause
} ways[] = {
    {RG_WORKER_BY_ITSELF, SIGSEGV, RG_CRASH, RG_LACKING, "its driver crashed (Segmentation fault)",
     "", true},
    {RG_WORKER_BY_ITSELF, EXITED(5), RG_CRASH, RG_LACKING,
     "its driver ended the process with status 5", "", true},
    {RG_WORKER_BY_ITSELF, EXITED(RG_EXIT_HARNESS), RG_LACKING, RG_LACKING,
     "its process ended, for it had no memory for a message", MORE_MEMORY, false},
    {RG_WORKER_HANGS, SIGKILL, RG_TIMEOUT, RG_TIMEOUT, "its driver did not come back within 7 s",
     "", false},
    {RG_WORKER_HANGS, EXITED(RG_EXIT_HARNESS), RG_TIMEOUT, RG_TIMEOUT,
     "its driver did not come back within 7 s", "", false},
    {RG_WORKER_HOLDS_TOO_MUCH, SIGKILL, RG_CRASH, RG_CRASH,
     "it took more than 1536 MiB of memory and was ended", "", false},
    {RG_WORKER_HOLDS_TOO_MUCH, EXITED(RG_EXIT_HARNESS), RG_CRASH, RG_CRASH,
     "it took more than 1536 MiB of memory and was ended", "", false},
    {RG_WORKER_LIES, SIGKILL, RG_CRASH, RG_CRASH,
     "it sent no message that can be taken, and was ended; a driver may have written over it", "",
     false},
    {RG_WORKER_NO_ROOM, SIGKILL, RG_LACKING, RG_LACKING,
     "raingauge has no memory for what it replied", MORE_MEMORY, false},
};
enum { WAYS = sizeof(ways) / sizeof(ways[0]) };

static void expect(const struct way *way, enum rg_outcome outcome, const char *line,
                   const char *mend)
{
    char why[400], due[400];
    FILE *printed = tmpfile();
    assert_non_null(printed);
    fputs("first words\nlast words\n----\n", printed);
    const struct rg_worker_end end = {.verdict = way->verdict,
                                      .status = way->status,
                                      .memory_bytes = INT64_C(1536) << 20,
                                      .timeout_s = 7,
                                      .printed = printed};
    assert_int_equal(rg_worker_end_outcome(&end), outcome);
    rg_worker_tell_end(&end, " while waiting", why, sizeof(why));
    snprintf(due, sizeof(due), "%s while waiting: last words%s", line, mend);
    assert_string_equal(why, due);
    fclose(printed);
}

static void each_end_has_an_outcome_and_a_line(void **state)
{
    (void)state;
    for (int i = 0; i < WAYS; i++)
        expect(&ways[i], ways[i].outcome, ways[i].line, ways[i].mend);
}

// Where a limit is low, a driver that ends its process is not at fault.
static void a_low_limit_is_told_instead(void **state)
{
    (void)state;
    struct rlimit before;
    assert_int_equal(getrlimit(RLIMIT_NOFILE, &before), 0);
    const struct rlimit low = {40, before.rlim_max};
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &low), 0);
    for (int i = 0; i < WAYS; i++)
        expect(&ways[i], ways[i].if_limited,
               ways[i].is_limited ? "its process ended under ulimit -n 40" : ways[i].line,
               ways[i].is_limited ? "; allow more" : ways[i].mend);
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &before), 0);
}

static void a_status_says_that_memory_was_lacking(void **state)
{
    (void)state;
    assert_true(rg_worker_ended_lacking(EXITED(RG_EXIT_HARNESS)));
    assert_false(rg_worker_ended_lacking(EXITED(0)));
    assert_false(rg_worker_ended_lacking(EXITED(RG_EXIT_FAIL)));
    assert_false(rg_worker_ended_lacking(RG_EXIT_HARNESS)); // a signal's number
}

// --- what it was doing ---

// A kernel that runs is told once.
static void what_it_was_doing_is_told(void **state)
{
    (void)state;
    static const struct {
        const char *what, *queued, *text;
    } rows[] = {
        {"", "", ""},
        {"opening the device", "", " while opening the device"},
        {"running kernel 'a'", "'a'", " while running kernel 'a'"},
        {"running kernel 'b'", "'a'", " while running kernel 'b'; not known to have ended: 'a'"},
        {"running kernel 'a'", "'a', 'b'",
         " while running kernel 'a'; not known to have ended: 'a', 'b'"},
        {"reading 'a'", "'a'", " while reading 'a'; not known to have ended: 'a'"},
        {"", "'a'", "; not known to have ended: 'a'"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_doing doing = {.count = 1};
        char text[RG_WORKER_DOING];
        snprintf(doing.what, sizeof(doing.what), "%s", rows[i].what);
        snprintf(doing.queued, sizeof(doing.queued), "%s", rows[i].queued);
        rg_worker_tell_doing(&doing, text);
        assert_string_equal(text, rows[i].text);
    }
}

// The process may have written over the page.
static void a_page_without_an_end_is_cut(void **state)
{
    (void)state;
    struct rg_doing doing = {.count = 1};
    char text[RG_WORKER_DOING];
    memset(doing.what, 'w', sizeof(doing.what));
    memset(doing.queued, 'q', sizeof(doing.queued));
    rg_worker_tell_doing(&doing, text);
    const size_t what = sizeof(doing.what) - 1, queued = sizeof(doing.queued) - 1;
    assert_int_equal(strspn(text + strlen(" while "), "w"), what);
    assert_int_equal(strlen(strrchr(text, ' ') + 1), queued);
    assert_int_equal(strlen(text), strlen(" while ; not known to have ended: ") + what + queued);
}

static void each_call_has_its_words(void **state)
{
    (void)state;
    static const struct {
        enum rg_call call;
        const char *doing;
    } rows[] = {{RG_CALL_HELLO, "greeting"},
                {RG_CALL_LIST, "listing devices"},
                {RG_CALL_LOAD, "loading the driver"},
                {RG_CALL_OPEN, "opening the device"},
                {RG_CALL_CLOSE, "closing the device"},
                {RG_CALL_SESSION_OPEN, "opening a technique"},
                {RG_CALL_STEP, "simulating a frame"},
                {RG_CALL_READ, "reading the picture"},
                {RG_CALL_COMPILE, "compiling a kernel"}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        assert_string_equal(rg_call_doing(rows[i].call), rows[i].doing);
    for (int i = 0; i < RG_CALL_COUNT_OF_CALLS; i++)
        for (int k = 0; k < i; k++)
            assert_string_not_equal(rg_call_doing((enum rg_call)i), rg_call_doing((enum rg_call)k));
}

// --- memory ---

// Memory that was only asked for does not count, and written memory does until it is given back.
static void memory_is_what_is_resident(void **state)
{
    (void)state;
    enum { BYTES = 64 << 20, NEAR = 4 << 20 };
    const int64_t before = rg_held_bytes(getpid());
    assert_at_least(before, 100000);
    char *more = mmap(NULL, BYTES, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_true(more != MAP_FAILED);
    assert_at_most(rg_held_bytes(getpid()) - before, NEAR);
    for (int64_t at = 0; at < BYTES; at += 4096)
        ((volatile char *)more)[at] = 1;
    assert_at_least(rg_held_bytes(getpid()) - before, BYTES - NEAR);
    assert_at_most(rg_held_bytes(getpid()) - before, BYTES + NEAR);
    assert_int_equal(munmap(more, BYTES), 0);
    assert_at_most(rg_held_bytes(getpid()) - before, NEAR);
    assert_int_equal(rg_held_bytes(0x7ffffff), 0); // there is no such process
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_end_has_an_outcome_and_a_line),
        cmocka_unit_test(a_low_limit_is_told_instead),
        cmocka_unit_test(a_status_says_that_memory_was_lacking),
        cmocka_unit_test(what_it_was_doing_is_told),
        cmocka_unit_test(a_page_without_an_end_is_cut),
        cmocka_unit_test(each_call_has_its_words),
        cmocka_unit_test(memory_is_what_is_resident),
    };
    return cmocka_run_group_tests_name("ends that are told", tests, NULL, NULL);
}
