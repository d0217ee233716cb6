// The time left of verify: cases on devices and mutants go at paces of their own.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "harness/compare/verify/verify.h"
#include "harness/console/clock.h"
#include "tests/tools/expect.h"

static double now_s;

// Stands before the library's.
double rg_now_ms(void)
{
    return 1e3 * now_s;
}

static struct rg_progress progress;
static struct rg_verify_phase phase;
static const struct rg_verify verify = {.progress = &progress, .phase = &phase};

// A case of 20 units took so long. Returns the seconds left, 0 if none are told.
static double left_after(double case_s)
{
    now_s += case_s;
    rg_progress_add(&progress, 20);
    rg_verify_advance(&verify, 20);
    return rg_progress_left_ms(&progress, rg_now_ms()) / 1e3;
}

static void start(int64_t total, int64_t cases)
{
    now_s += 1;
    rg_progress_start(&progress, total);
    rg_verify_begin(&verify, cases);
}

static void the_first_case_tells_nothing(void **state)
{
    (void)state;
    start(200, 200);
    assert_equals(left_after(40), 0); // drivers compiled
    assert_near(left_after(10), 8 * 10, 1e-3);
    assert_near(left_after(14), 7 * 12, 1e-3);
}

static void each_phase_has_a_pace_of_its_own(void **state)
{
    (void)state;
    start(180, 100);
    left_after(10);
    assert_equals(left_after(10), 0); // mutants are more than a third of the rest
    left_after(10);
    left_after(10);
    left_after(10);
    rg_verify_begin(&verify, 80);
    assert_equals(left_after(1), 0);
    assert_near(left_after(1), 2, 1e-3);
    assert_near(left_after(1), 1, 1e-3);
}

static void an_unlike_case_silences(void **state)
{
    (void)state;
    start(200, 200);
    left_after(1);
    left_after(10);
    left_after(10);
    assert_above(left_after(10), 0);
    assert_equals(left_after(60), 0);
    assert_equals(left_after(1), 0);
}

// A device that fails takes no steps; the bar counts them as done, or they would be left for ever.
static void steps_that_failed_are_not_left(void **state)
{
    (void)state;
    start(80, 80);
    left_after(10);
    now_s += 10;
    rg_progress_add(&progress, 5);
    rg_verify_advance(&verify, 20);
    assert_int_equal(progress.done, 40);
    assert_near(left_after(10), 10, 1e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_first_case_tells_nothing),
        cmocka_unit_test(each_phase_has_a_pace_of_its_own),
        cmocka_unit_test(an_unlike_case_silences),
        cmocka_unit_test(steps_that_failed_are_not_left),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
