// What is logged is one line of plain characters, whatever stands in it.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "core/base/log.h"

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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(lines_hold_no_control_characters)};
    return cmocka_run_group_tests_name("log", tests, NULL, NULL);
}
