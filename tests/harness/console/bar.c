// The bar of progress on a terminal, and its lines elsewhere, by a clock that only the test moves.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/progress.h"
#include "tests/harness/console/pty.h"
#include "tests/tools/expect.h"

static double clock_ms;

double rg_now_ms(void)
{
    return clock_ms;
}

#define WIPED  "\r\033[K"
#define BLANKS "........................"

// --- a terminal ---

static struct pty terminal;
static int stderr_fd;

static int put_terminal(void **state)
{
    (void)state;
    terminal = pty_open();
    stderr_fd = dup(STDERR_FILENO);
    clock_ms = 1000;
    return terminal.reader < 0 || dup2(terminal.writer, STDERR_FILENO) < 0;
}

static int restore(void **state)
{
    (void)state;
    dup2(stderr_fd, STDERR_FILENO);
    close(stderr_fd);
    pty_close(terminal);
    rg_log_listen(NULL, NULL);
    return 0;
}

#define expect_shown(text) assert_string_equal(pty_read(terminal), text)

// It is drawn at once, with each label, and with progress ten times a second at most.
static void a_bar_shows_what_is_done(void **state)
{
    (void)state;
    struct rg_progress p;
    rg_progress_start(&p, 8);
    expect_shown(WIPED "[" BLANKS "]   0 %  ");
    rg_progress_label(&p, "row %d", 3);
    expect_shown(WIPED "[" BLANKS "]   0 %  row 3");
    clock_ms += 100;
    rg_progress_add(&p, 2);
    expect_shown("");
    clock_ms += 1;
    rg_progress_add(&p, 1);
    expect_shown(WIPED "[#########...............]  37 %  row 3");
    rg_progress_grow(&p, -2);
    clock_ms += 101;
    rg_progress_add(&p, 0);
    expect_shown(WIPED "[############............]  50 %  row 3");
    clock_ms += 101;
    rg_progress_add(&p, 6);
    expect_shown(WIPED "[########################] 150 %  row 3");
    rg_progress_hide(&p);
    expect_shown(WIPED);
    rg_progress_end(&p);
    expect_shown(WIPED);
    assert_false(p.shown);
    rg_progress_end(&p);
    rg_progress_hide(&p);
    expect_shown("");
}

static void a_bar_of_nothing_is_empty(void **state)
{
    (void)state;
    struct rg_progress p;
    rg_progress_start(&p, 0);
    expect_shown(WIPED "[" BLANKS "]   0 %  ");
    rg_progress_end(&p);
}

// The rest's time stands in minutes and seconds, once a tenth of the whole has passed.
static void a_bar_shows_the_time_left(void **state)
{
    (void)state;
    static const struct {
        double left_ms;
        const char *shown;
    } rows[] = {{125400, "  2:05 left"},
                {125600, "  2:06 left"},
                {9000, "  0:09 left"},
                {900001, ""},
                {899999, "  15:00 left"},
                {-1, ""},
                {400, ""}};
    struct rg_progress p;
    rg_progress_start(&p, 2);
    rg_progress_add(&p, 1);
    clock_ms += 100000;
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        char due[128];
        rg_progress_due(&p, rows[i].left_ms);
        pty_read(terminal);
        rg_progress_label(&p, "x");
        snprintf(due, sizeof(due), WIPED "[############............]  50 %%%s  x", rows[i].shown);
        expect_shown(due);
    }
    rg_progress_due(&p, 5000);
    rg_progress_unlike(&p, true);
    pty_read(terminal);
    rg_progress_label(&p, "y");
    expect_shown(WIPED "[############............]  50 %  y");
    rg_progress_end(&p);
}

// A message takes the bar's line, and the bar is drawn again below. Each error is printed once.
static void messages_stand_above_a_bar(void **state)
{
    (void)state;
    struct rg_progress p;
    rg_progress_start(&p, 2);
    pty_read(terminal);
    rg_warning("%s is wrong", "this");
    expect_shown(WIPED "raingauge: warning: this is wrong\n" WIPED "[" BLANKS "]   0 %  ");
    rg_warning("%s is wrong", "this");
    expect_shown("");
    rg_error("that is lost");
    expect_shown(WIPED "raingauge: that is lost\n" WIPED "[" BLANKS "]   0 %  ");
    rg_progress_end(&p);
    pty_read(terminal);
    rg_info("it is over");
    expect_shown("raingauge: it is over\n");
}

// --- lines ---

static char told[16][128];
static int lines;

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)user;
    snprintf(told[lines++ % 16], sizeof(told[0]), "%s", line);
}

// Units of a second each, of which so many are done.
static void run(const char *long_s, int total, int done, const char *label)
{
    struct rg_progress p;
    setenv("RG_LONG_S", long_s, 1);
    clock_ms = 5000;
    lines = 0;
    rg_progress_start(&p, total);
    if (*label)
        rg_progress_label(&p, "%s", label);
    rg_log_listen(hear, NULL);
    for (int i = 0; i < done; i++) {
        clock_ms += 1000;
        rg_progress_add(&p, 1);
    }
    rg_log_listen(NULL, NULL);
    rg_progress_end(&p);
}

static int put_file(void **state)
{
    (void)state;
    stderr_fd = dup(STDERR_FILENO);
    terminal = (struct pty){-1, open("/dev/null", O_WRONLY)};
    return dup2(terminal.writer, STDERR_FILENO) < 0;
}

// All of the time first, and then what is left, after each tenth of the whole, and each `long`
// seconds at most.
static void long_work_is_told_in_lines(void **state)
{
    (void)state;
    run("30", 100, 100, "flow");
    assert_int_equal(lines, 3);
    assert_string_equal(told[0], "about 1.7 min in all; now: flow");
    assert_string_equal(told[1], "about 60 s left; now: flow");
    assert_string_equal(told[2], "about 30 s left; now: flow");
    run("5", 1000, 1000, "");
    assert_int_equal(lines, 9);
    assert_string_equal(told[0], "about 17 min in all");
    assert_string_equal(told[1], "about 13 min left");
    assert_string_equal(told[8], "about 1.7 min left");
    run("100", 100, 100, "flow"); // no longer than that
    assert_int_equal(lines, 0);
    run("99", 100, 9, "flow"); // less than a tenth
    assert_int_equal(lines, 0);
    run("99", 100, 10, "flow");
    assert_int_equal(lines, 1);
}

#define ON_TERMINAL(test) cmocka_unit_test_setup_teardown(test, put_terminal, restore)

int main(void)
{
    const struct CMUnitTest tests[] = {
        ON_TERMINAL(a_bar_shows_what_is_done),
        ON_TERMINAL(a_bar_of_nothing_is_empty),
        ON_TERMINAL(a_bar_shows_the_time_left),
        ON_TERMINAL(messages_stand_above_a_bar),
        cmocka_unit_test_setup_teardown(long_work_is_told_in_lines, put_file, restore),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
