// What a terminal can show, and how wide it is.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "harness/console/terminal.h"
#include "tests/harness/console/pty.h"
#include "tests/tools/expect.h"

static void set(const char *name, const char *value)
{
    if (value)
        setenv(name, value, 1);
    else
        unsetenv(name);
}

// Colours are for terminals that have them, unless NO_COLOR says anything.
static void colours_are_for_terminals(void **state)
{
    (void)state;
    static const struct {
        const char *term, *no_color;
        bool has_colours;
    } rows[] = {{"xterm", NULL, true}, {"xterm", "", true}, {"xterm", "1", false},
                {"dumb", NULL, false}, {NULL, NULL, true},  {"dumber", NULL, true},
                {NULL, "0", false}};
    struct pty pty = pty_open();
    FILE *out = fdopen(pty.writer, "w"), *file = fopen("/dev/null", "w");
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        set("TERM", rows[i].term);
        set("NO_COLOR", rows[i].no_color);
        assert_int_equal(rg_has_colours(out), rows[i].has_colours);
        assert_false(rg_has_colours(file));
    }
    fclose(file);
    fclose(out);
    close(pty.reader);
}

// A terminal has its own width, 60 columns at least; a file has the same everywhere.
static void lines_are_as_wide_as_a_terminal(void **state)
{
    (void)state;
    static const struct {
        unsigned short columns;
        int width;
    } rows[] = {{80, 80}, {200, 200}, {61, 61}, {60, 60}, {59, 60}, {1, 60}, {0, RG_PAGE_WIDTH}};
    struct pty pty = pty_open();
    FILE *out = fdopen(pty.writer, "w"), *file = fopen("/dev/null", "w");
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const struct winsize size = {.ws_row = 17, .ws_col = rows[i].columns};
        assert_int_equal(ioctl(pty.reader, TIOCSWINSZ, &size), 0);
        assert_int_equal(rg_page_width(out), rows[i].width);
    }
    assert_int_equal(rg_page_width(file), 110);
    fclose(file);
    fclose(out);
    close(pty.reader);
}

// Thirty words of nine letters: ten of them fit beside a lead of 8 columns in 110, not eleven.
static void texts_are_wrapped_behind_their_lead(void **state)
{
    (void)state;
    char text[301] = "", due[512] = "", *printed = NULL;
    size_t size;
    for (int i = 0; i < 30; i++) {
        snprintf(text + strlen(text), sizeof(text) - strlen(text), "%sabcdefg%02d", i ? " " : "",
                 i);
        snprintf(due + strlen(due), sizeof(due) - strlen(due), "%sabcdefg%02d%s",
                 i == 0        ? "a lead: "
                 : i % 10 == 0 ? "        "
                               : " ",
                 i, i % 10 == 9 ? "\n" : "");
    }
    FILE *out = open_memstream(&printed, &size);
    rg_print_wrapped(out, "a lead: ", text);
    assert_int_equal(fclose(out), 0);
    assert_string_equal(printed, due);
    free(printed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colours_are_for_terminals),
        cmocka_unit_test(lines_are_as_wide_as_a_terminal),
        cmocka_unit_test(texts_are_wrapped_behind_their_lead),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
