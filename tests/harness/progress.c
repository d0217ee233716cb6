// How long something takes, from its first units.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/duration.h"
#include "harness/console/progress.h"

static char told[256];
static int lines;

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)user;
    assert_int_equal(level, RG_LOG_INFO);
    snprintf(told, sizeof(told), "%s", line);
    lines++;
}

static void durations_have_two_digits(void **state)
{
    (void)state;
    char text[RG_DURATION_TEXT];
    assert_string_equal(rg_duration_text(8.54, text), "8.5 s");
    assert_string_equal(rg_duration_text(48, text), "48 s");
    assert_string_equal(rg_duration_text(170, text), "2.8 min");
    assert_string_equal(rg_duration_text(9720, text), "2.7 h");
    assert_string_equal(rg_duration_text(720000, text), "200 h");
}

// The first units, which took 5 s, say nothing of the others, of which 20 took 2 s.
static void the_first_units_count_for_themselves(void **state)
{
    (void)state;
    struct rg_progress p = {.total = 110, .start_ms = 1000};
    assert_true(rg_progress_all_ms(&p, 5000) == 0);
    p.first_ms = 6000;
    p.first_done = p.done = 10;
    assert_true(rg_progress_all_ms(&p, 7000) == 0);
    p.done = 30;
    assert_true(rg_progress_all_ms(&p, 8000) == 5000 + 100 * 100);
    assert_true(rg_progress_is_long(&p, 8000, 14999));
    assert_false(rg_progress_is_long(&p, 8000, 15000));
    p.total = 1000010; // longer by far, and a tenth of what is long has not passed
    assert_true(rg_progress_is_long(&p, 8000, 20000));
    assert_false(rg_progress_is_long(&p, 8000, 20001));
}

// What was told is told anew where it was off by more than half, once twice the time has passed.
static void what_is_off_is_told_anew(void **state)
{
    (void)state;
    struct rg_progress p = {.total = 100, .start_ms = 1000, .first_ms = 1000, .done = 10};
    p.told_ms = 10000; // 90 of them were to take another 9 s
    p.told_after_ms = 1000;
    p.done = 50;
    assert_false(rg_progress_is_off(&p, 1000 + 2500)); // 5 s in all
    assert_true(rg_progress_is_off(&p, 1000 + 2499));
    assert_false(rg_progress_is_off(&p, 1000 + 10000)); // 20 s
    assert_true(rg_progress_is_off(&p, 1000 + 10001));
    p.told_after_ms = 1250;
    assert_false(rg_progress_is_off(&p, 1000 + 2499));
}

static void run(const char *long_s, int units)
{
    struct rg_progress p;
    setenv("RG_LONG_S", long_s, 1);
    lines = 0;
    rg_progress_start(&p, 1000);
    rg_progress_label(&p, "flow");
    rg_log_listen(hear, NULL);
    for (int i = 0; i < units; i++) {
        nanosleep(&(struct timespec){0, 2000000}, NULL);
        rg_progress_add(&p, 1);
    }
    rg_log_listen(NULL, NULL);
    rg_progress_end(&p);
}

// Once, unless the machine is busy: then what was told may be off, once with each doubling of time.
static void what_is_long_is_told(void **state)
{
    (void)state;
    run("0.001", 20);
    assert_in_range(lines, 1, 5);
    assert_non_null(strstr(told, " in all; now: flow"));
    assert_ptr_equal(strstr(told, "about "), told);
    run("1e9", 20);
    assert_int_equal(lines, 0);
    run("0.001", 1); // nothing is known yet
    assert_int_equal(lines, 0);
    rg_progress_told();
    run("0.001", 20);
    assert_int_equal(lines, 0);
}

// Of 1000 units that were to take 10 ms each, what is known beforehand counts as 100 of them.
static void what_was_expected_counts_as_a_tenth(void **state)
{
    (void)state;
    struct rg_progress p = {.total = 1000, .start_ms = 500, .expected_unit_ms = 10};
    assert_true(rg_progress_unit_ms(&p, 500) == 10);
    p.done = 100;
    assert_true(rg_progress_unit_ms(&p, 500 + 2000) == 15); // they took 20 ms each
    p.done = 900;
    assert_true(rg_progress_unit_ms(&p, 500 + 18000) == 19);
    p.expected_unit_ms = 0;
    assert_true(rg_progress_unit_ms(&p, 500 + 18000) == 20);
    p.done = 0;
    assert_true(rg_progress_unit_ms(&p, 500 + 18000) == 0);
}

static void hear_all(enum rg_log_level level, const char *line, void *user)
{
    (void)user;
    assert_int_equal(level, RG_LOG_INFO);
    snprintf(told + strlen(told), sizeof(told) - strlen(told), "%s\n", line);
    lines++;
}

// At once, and with every tenth how long the rest takes.
static void what_was_expected_is_told_at_once(void **state)
{
    (void)state;
    struct rg_progress p;
    setenv("RG_LONG_S", "900", 1);
    told[0] = 0;
    lines = 0;
    rg_log_listen(hear_all, NULL);
    rg_progress_start_expected(&p, 100, 9e6);
    rg_progress_label(&p, "creus-5.4, row 2");
    rg_progress_add(&p, 9);
    assert_string_equal(told, "about 250 h in all\n");
    rg_progress_add(&p, 1);
    assert_int_equal(lines, 2);
    rg_progress_grow(&p, 100);
    rg_progress_add(&p, 30); // two tenths of twice as many
    rg_progress_add(&p, 1);
    assert_int_equal(lines, 3);
    rg_progress_add(&p, 160);
    assert_int_equal(lines, 3);
    assert_non_null(strstr(told, " left; now: creus-5.4, row 2\n"));
    lines = 0;
    rg_progress_start_expected(&p, 100, 8e3); // which is not long
    rg_progress_add(&p, 50);
    assert_int_equal(lines, 0);
    rg_log_listen(NULL, NULL);
}

int main(void)
{
    if (!freopen("/dev/null", "w", stderr)) // no terminal
        return 1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(durations_have_two_digits),
        cmocka_unit_test(the_first_units_count_for_themselves),
        cmocka_unit_test(what_is_off_is_told_anew),
        cmocka_unit_test(what_is_long_is_told),
        cmocka_unit_test(what_was_expected_counts_as_a_tenth),
        cmocka_unit_test(what_was_expected_is_told_at_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
