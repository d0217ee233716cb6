// Long texts are broken into lines.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "core/base/text/wrap.h"

static void lines_break_at_blanks(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int columns;
        const char *line, *rest;
    } rows[] = {
        {"", 5, "", ""},
        {"abc", 5, "abc", ""},
        {"abcde", 5, "abcde", ""},
        {"abc de", 5, "abc", "de"},
        {"ab cd ef", 5, "ab cd", "ef"},
        {"ab   cdefg", 6, "ab  ", "cdefg"},
        {"a bcdefgh", 5, "a", "bcdefgh"},
        {"abcdefgh i", 5, "abcde", "fgh i"},
        {"abcde fg", 5, "abcde", "fg"},
        {"abc de", 1000, "abc de", ""},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const char *rest;
        const int length = rg_wrap(rows[i].text, rows[i].columns, &rest);
        if ((size_t)length != strlen(rows[i].line) ||
            strncmp(rows[i].text, rows[i].line, (size_t)length) || strcmp(rest, rows[i].rest) != 0)
            fail_msg("'%s' in %d: %d, '%s'", rows[i].text, rows[i].columns, length, rest);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(lines_break_at_blanks)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
