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

// Of `words`, and after them each byte alone.
static const char *word_at(int i, char byte[2])
{
    byte[0] = (char)(i - WORDS + 1);
    byte[1] = 0;
    return i < WORDS ? words[i] : byte;
}

static void expect_words(FILE *read)
{
    char found[64], byte[2];
    for (int i = 0; i < WORDS + BYTES; i++) {
        size_t size = 0;
        for (int c; (c = fgetc(read)) > 0 && size < sizeof(found) - 1;)
            found[size++] = (char)c;
        found[size] = 0;
        assert_string_equal(found, word_at(i, byte));
    }
    assert_int_equal(fgetc(read), EOF);
}

// Plain words have no quotes, so that a command stays easy to read.
static void a_shell_reads_each_word(void **state)
{
    (void)state;
    char *command = NULL, byte[2], longer[64];
    size_t size;
    FILE *out = open_memstream(&command, &size);
    assert_non_null(out);
    fprintf(out, "printf '%%s\\0'");
    for (int i = 0; i < WORDS + BYTES; i++) {
        const int length = snprintf(longer, sizeof(longer), "%s", word_at(i, byte));
        strcat(longer, " more"); // what is no part of the word is not written
        fputc(' ', out);
        rg_shell_word(out, longer, (size_t)length);
    }
    fclose(out);
    assert_non_null(strstr(command, " plain-1.5_x,y=z:/@%+ "));
    FILE *read = popen(command, "r");
    assert_non_null(read);
    expect_words(read);
    assert_int_equal(pclose(read), 0);
    free(command);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_shell_reads_each_word)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
