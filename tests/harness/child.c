// What a child process does to its parent: return a result, or a line that says how it ended.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/devices/child.h"

static int *answer;
static char why[256];

static enum rg_outcome run(void (*work)(void *), int timeout_s)
{
    *why = 0;
    *answer = 0;
    return rg_child_run(work, answer, timeout_s, why, sizeof(why));
}

static void return_seven(void *result)
{
    printf("noise\n");
    rg_error("noise");
    *(int *)result = 7;
}

static void results_come_back(void **state)
{
    (void)state;
    assert_int_equal(run(return_seven, 10), RG_OK);
    assert_int_equal(*answer, 7);
    assert_string_equal(why, "");
}

static void print_and_crash(void *result)
{
    *(int *)result = 3;
    fprintf(stderr, "first\nsecond line\n----\n");
    raise(SIGKILL);
}

static void crashes_are_told_with_the_last_words(void **state)
{
    (void)state;
    assert_int_equal(run(print_and_crash, 10), RG_CRASH);
    assert_string_equal(why, "its driver crashed (Killed): second line");
    assert_int_equal(*answer, 3);
}

static void leave(void *result)
{
    (void)result;
    _exit(5);
}

static void an_exit_is_no_result(void **state)
{
    (void)state;
    assert_int_equal(run(leave, 10), RG_CRASH);
    assert_string_equal(why, "its driver ended the process with status 5");
}

static void hang(void *result)
{
    (void)result;
    for (;;)
        pause();
}

static void a_hang_is_ended(void **state)
{
    (void)state;
    assert_int_equal(run(hang, 0), RG_TIMEOUT);
    assert_string_equal(why, "its driver did not come back within 0 s");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(results_come_back),
        cmocka_unit_test(crashes_are_told_with_the_last_words),
        cmocka_unit_test(an_exit_is_no_result),
        cmocka_unit_test(a_hang_is_ended),
    };
    answer = rg_child_answer_create(sizeof(*answer));
    int failed = answer ? cmocka_run_group_tests(tests, NULL, NULL) : 1;
    rg_child_answer_destroy(answer, sizeof(*answer));
    return failed;
}
