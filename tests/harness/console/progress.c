// How long a task takes is estimated from its first units.
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
#include "tests/tools/expect.h"

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
    assert_string_equal(rg_duration_text(99.4, text), "99 s");
    assert_string_equal(rg_duration_text(99.6, text), "1.7 min");
    assert_string_equal(rg_duration_text(5964, text), "99 min");
    assert_string_equal(rg_duration_text(5976, text), "1.7 h");
    assert_string_equal(rg_duration_text(357840, text), "99 h");
    assert_string_equal(rg_duration_text(360000, text), "100 h");
}

static char refused[256];

static void hear_refusal(enum rg_log_level level, const char *line, void *user)
{
    (void)user;
    assert_int_equal(level, RG_LOG_ERROR);
    snprintf(refused, sizeof(refused), "%s", line);
}

static void durations_are_read_with_their_unit(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double s; // 0: it is refused
    } rows[] = {{"90s", 90}, {"4m", 240},     {"1h", 3600}, {"1.5h", 5400}, {"0.25s", 0.25},
                {"90", 0},   {"90 s", 0},     {"s", 0},     {"-1s", 0},     {"0s", 0},
                {"1d", 0},   {"4min", 0},     {"nans", 0},  {"infs", 0},    {"", 0},
                {"278h", 0}, {"277h", 997200}};
    rg_log_listen(hear_refusal, NULL);
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        double s = -1;
        char due[256] = "";
        *refused = 0;
        assert_int_equal(rg_duration_read(rows[i].text, "--budget", &s), rows[i].s > 0);
        if (rows[i].s > 0)
            assert_equals(s, rows[i].s);
        else
            snprintf(due, sizeof(due), "--budget '%s': is no time; write it as 90s, 4m or 1h",
                     rows[i].text);
        assert_string_equal(refused, due);
    }
    rg_log_listen(NULL, NULL);
}

static void what_is_long_can_be_said(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double s;
    } rows[] = {{"5", 5}, {"0.5", 0.5}, {"0", 30}, {"-1", 30}, {"x", 30}, {"", 30}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        setenv("RG_LONG_S", rows[i].text, 1);
        assert_equals(rg_long_s(), rows[i].s);
    }
    unsetenv("RG_LONG_S");
    assert_equals(rg_long_s(), 30);
}

#define assert_about(ms, due) assert_true((ms) > (due)-1e-6 && (ms) < (due) + 1e-6)

// 100 of 1000 units took 10 s, and the last 60 of them last_ms.
static struct rg_progress after(double last_ms)
{
    return (struct rg_progress){.total = 1000,
                                .done = 100,
                                .start_ms = 500,
                                .first = {0, 500},
                                .marks = {{40, 500 + 10000 - last_ms}}};
}

// The time left follows from all units and from the last ones, once a tenth of it has passed.
static void what_is_left_follows_from_what_was_done(void **state)
{
    (void)state;
    const double now_ms = 500 + 10000;
    struct rg_progress p = after(6000);
    assert_about(rg_progress_left_ms(&p, now_ms), 90000);
    assert_about(rg_progress_unit_ms(&p, now_ms), 100);
    p.total = 1001; // less than a tenth is done
    assert_equals(rg_progress_left_ms(&p, now_ms), 0);
    p = after(6000);
    p.first = (struct rg_progress_mark){20, 500 + 4000}; // the other 80 took 75 ms each
    p.total = 800;
    p.marks[0] = (struct rg_progress_mark){40, 500 + 5500};
    assert_about(rg_progress_left_ms(&p, now_ms), 700 * 75);
    p = after(6000);
    rg_progress_due(&p, -1); // not even the units tell
    assert_equals(rg_progress_left_ms(&p, now_ms), 0);
    p = after(6000);
    p.marks[0].done = 0; // no mark yet: the last units cannot be told from all
    assert_equals(rg_progress_left_ms(&p, now_ms), 0);
    assert_equals(rg_progress_unit_ms(&(struct rg_progress){.total = 9}, now_ms), 0);
}

// Nothing is estimated if the last units took more than twice or less than half as long as all.
// Drivers may compile in the first ones, or later ones may be heavier.
static void units_that_are_not_alike_tell_nothing(void **state)
{
    (void)state;
    const double now_ms = 500 + 10000;
    struct rg_progress p = after(3001); // half as long as the average; 45 s are left, or 90 s
    assert_above(rg_progress_left_ms(&p, now_ms), 0);
    p = after(2999);
    assert_equals(rg_progress_left_ms(&p, now_ms), 0);
    p = after(9999);
    p.total = 160; // 1.67 times as long
    assert_above(rg_progress_left_ms(&p, now_ms), 0);
    p.marks[0].done = 60; // 2.5 times
    assert_equals(rg_progress_left_ms(&p, now_ms), 0);
    p.marks[0].done = 40;
    rg_progress_unlike(&p, true);
    assert_equals(rg_progress_left_ms(&p, now_ms), 0);
}

static void run(const char *long_s, int units)
{
    struct rg_progress p;
    setenv("RG_LONG_S", long_s, 1);
    lines = 0;
    rg_progress_start(&p, 100);
    rg_progress_label(&p, "flow");
    rg_log_listen(hear, NULL);
    for (int i = 0; i < units; i++) {
        nanosleep(&(struct timespec){0, 2000000}, NULL);
        rg_progress_add(&p, 1);
    }
    rg_log_listen(NULL, NULL);
    rg_progress_end(&p);
}

// A line comes at most every tenth of the time, and the first says how long all takes.
static void what_is_long_is_told(void **state)
{
    (void)state;
    run("0.001", 90);
    assert_between(lines, 2, 9);
    assert_non_null(strstr(told, " left; now: flow"));
    assert_ptr_equal(strstr(told, "about "), told);
    run("0.001", 15);
    assert_between(lines, 0, 2);
    assert_true(!lines || strstr(told, " in all; now: flow") || strstr(told, " left; now: flow"));
    run("1e9", 90);
    assert_int_equal(lines, 0);
    run("0.001", 5); // less than a tenth
    assert_int_equal(lines, 0);
    rg_progress_told();
    run("0.001", 90);
    assert_int_equal(lines, 0);
}

int main(void)
{
    if (!freopen("/dev/null", "w", stderr)) // no terminal
        return 1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(durations_have_two_digits),
        cmocka_unit_test(durations_are_read_with_their_unit),
        cmocka_unit_test(what_is_long_can_be_said),
        cmocka_unit_test(what_is_left_follows_from_what_was_done),
        cmocka_unit_test(units_that_are_not_alike_tell_nothing),
        cmocka_unit_test(what_is_long_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
