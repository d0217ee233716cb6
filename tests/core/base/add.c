// Appending text to memory of a fixed size.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "core/base/text/add.h"

static void what_fits_is_appended(void **state)
{
    (void)state;
    static const struct {
        const char *before, *between, *added, *due;
    } rows[] = {
        {"", ", ", "abc", "abc"},
        {"a", ", ", "b", "a, b"},
        {"a", "", "b", "ab"},
        {"abcd", ", ", "efg", "abcd, e"},
        {"abcde", ", ", "f", "abcde, "},
        {"abcdef", ", ", "g", "abcdef,"},
        {"abcdefg", ", ", "h", "abcdefg"},
        {"", ", ", "abcdefghi", "abcdefg"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        char text[9];
        text[8] = '!';
        strcpy(text, rows[i].before);
        rg_text_add(text, 8, rows[i].between, "%s", rows[i].added);
        if (strcmp(text, rows[i].due) != 0 || text[8] != '!')
            fail_msg("'%s' and '%s': '%s'", rows[i].before, rows[i].added, text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_fits_is_appended)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
