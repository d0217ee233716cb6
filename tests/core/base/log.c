// A logged line is one line of plain characters, whatever its text holds.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "core/base/log.h"
#include "core/base/outcome.h"

static char heard[1024];

static void listen(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)user;
    snprintf(heard, sizeof(heard), "%s", line);
}

static void lines_hold_no_control_characters(void **state)
{
    (void)state;
    rg_log_listen(listen, NULL);
    for (int c = 1; c < 256; c++) {
        rg_error("a%cb", c);
        const char plain = c == '\n' || c == '\r' || c == '\t' ? ' '
                           : c < 32 || c == 127                ? '?'
                                                               : (char)c;
        assert_int_equal(heard[1], plain);
    }
    rg_warning("%s", "\033]0;title\a \xc2\x9b"
                     "2J \xc3\xa9 \xc2\xb5");
    assert_string_equal(heard, "?]0;title? ??2J \xc3\xa9 \xc2\xb5");
    rg_log_listen(NULL, NULL);
}

// How often the file holds a line.
static int printed(FILE *file, const char *line)
{
    char read[256];
    int count = 0;
    rewind(file);
    while (fgets(read, sizeof(read), file))
        count += !strncmp(read, line, strlen(line)) && read[strlen(line)] == '\n';
    return count;
}

// Several devices and cells can meet one error. It is printed once; a listener hears each.
static void an_error_is_printed_once(void **state)
{
    (void)state;
    FILE *file = tmpfile();
    fflush(stderr);
    const int kept = dup(2);
    dup2(fileno(file), 2);
    for (int i = 0; i < 3; i++) {
        rg_error("%s is lost", "the device");
        rg_warning("the device is old");
        rg_info("frame %d", 1);
    }
    rg_error("another is lost");
    assert_string_equal(rg_last_error(), "another is lost");
    rg_error("the device is lost"); // not printed again, but still the last error
    fflush(stderr);
    dup2(kept, 2);
    close(kept);
    assert_string_equal(rg_last_error(), "the device is lost");
    assert_int_equal(printed(file, "raingauge: the device is lost"), 1);
    assert_int_equal(printed(file, "raingauge: another is lost"), 1);
    assert_int_equal(printed(file, "raingauge: warning: the device is old"), 1);
    assert_int_equal(printed(file, "raingauge: frame 1"), 3);
    fclose(file);
}

static void a_relayed_error_has_its_kind(void **state)
{
    (void)state;
    rg_log_listen(listen, NULL);
    rg_log_relay(RG_LOG_ERROR, RG_FAULT_NONE, RG_UNSUPPORTED, "100 %d of it is missing");
    assert_string_equal(heard, "100 %d of it is missing");
    assert_int_equal(rg_failure_take().fault, RG_FAULT_NONE);
    rg_log_relay(RG_LOG_WARNING, RG_FAULT_INPUT, RG_ERROR, "beware");
    assert_string_equal(heard, "beware");
    assert_int_equal(rg_failure_take().fault, RG_FAULT_NONE);
    rg_timeout_error("it hangs");
    assert_int_equal(rg_failure_take().outcome, RG_TIMEOUT);
    rg_crash_error("it fell");
    assert_int_equal(rg_failure_take().outcome, RG_CRASH);
    rg_log_listen(NULL, NULL);
}

// Many devices can meet one cause. A line is news once; a listener hears each.
static void a_line_is_news_once(void **state)
{
    (void)state;
    assert_true(rg_log_is_news(RG_LOG_ERROR, "a.obj: no such file"));
    assert_true(rg_log_is_news(RG_LOG_ERROR, "b.obj: no such file"));
    assert_false(rg_log_is_news(RG_LOG_ERROR, "a.obj: no such file"));
    assert_true(rg_log_is_news(RG_LOG_WARNING, "c.obj: old"));
    assert_false(rg_log_is_news(RG_LOG_WARNING, "c.obj: old"));
    assert_true(rg_log_is_news(RG_LOG_INFO, "done") && rg_log_is_news(RG_LOG_INFO, "done"));
    heard[0] = 0;
    rg_log_listen(listen, NULL);
    rg_error("a.obj: no such file");
    rg_log_listen(NULL, NULL);
    assert_string_equal(heard, "a.obj: no such file");
}

// An error while lines are held is not heard, but stays the last error.
static void held_lines_are_not_heard(void **state)
{
    (void)state;
    heard[0] = 0;
    rg_log_listen(listen, NULL);
    rg_log_hold(true);
    rg_error("meanwhile");
    rg_log_hold(false);
    assert_string_equal(heard, "");
    assert_string_equal(rg_last_error(), "meanwhile");
    rg_warning("after");
    rg_log_listen(NULL, NULL);
    assert_string_equal(heard, "after");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_hold_no_control_characters),
        cmocka_unit_test(an_error_is_printed_once),
        cmocka_unit_test(a_relayed_error_has_its_kind),
        cmocka_unit_test(a_line_is_news_once),
        cmocka_unit_test(held_lines_are_not_heard),
    };
    return cmocka_run_group_tests_name("log", tests, NULL, NULL);
}
