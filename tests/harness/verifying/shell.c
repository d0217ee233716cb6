#define _GNU_SOURCE // open_memstream, popen
// A shell reads each word of a printed command as it was.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/compare/text/shell.h"

static const char *const words[] = {"",           "plain-1.5_x,y=z:/@%+",
                                    "two words",  "$HOME",
                                    "$(echo no)", "`echo no`",
                                    "a;b&c|d",    "~",
                                    "it's",       "''",
                                    "\"",         "*",
                                    "<a >b",      "new\nline",
                                    "#no",        "tab\t",
                                    "\\",         "!",
                                    "{a,b}",      "über"};
enum { WORDS = sizeof(words) / sizeof(words[0]), BYTES = 255 };

static void expect_words(FILE *read)
{
    char found[64];
    for (int i = 0; i < WORDS + BYTES; i++) {
        const char byte[] = {(char)(i - WORDS + 1), 0};
        const char *word = i < WORDS ? words[i] : byte;
        size_t size = 0;
        for (int c; (c = fgetc(read)) > 0 && size < sizeof(found) - 1;)
            found[size++] = (char)c;
        found[size] = 0;
        assert_string_equal(found, word);
    }
    assert_int_equal(fgetc(read), EOF);
}

static void a_shell_reads_each_word(void **state)
{
    (void)state;
    char *command = NULL;
    size_t size;
    FILE *out = open_memstream(&command, &size);
    assert_non_null(out);
    fprintf(out, "printf '%%s\\0'");
    for (int i = 0; i < WORDS + BYTES; i++) {
        const char byte[] = {(char)(i - WORDS + 1), 0};
        fputc(' ', out);
        rg_shell_word(out, i < WORDS ? words[i] : byte, i < WORDS ? strlen(words[i]) : 1);
    }
    fclose(out);
    FILE *read = popen(command, "r");
    assert_non_null(read);
    expect_words(read);
    assert_int_equal(pclose(read), 0);
    free(command);
}

// A command stays easy to read.
static void plain_words_have_no_quotes(void **state)
{
    (void)state;
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    rg_shell_word(out, "vulkan@DRIVER=/opt/mesa-25,new", 26);
    fclose(out);
    assert_string_equal(text, "vulkan@DRIVER=/opt/mesa-25");
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_shell_reads_each_word),
        cmocka_unit_test(plain_words_have_no_quotes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
