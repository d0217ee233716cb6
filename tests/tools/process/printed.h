// What functions print on standard output.
#ifndef RG_TESTS_TOOLS_PROCESS_PRINTED_H
#define RG_TESTS_TOOLS_PROCESS_PRINTED_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <unistd.h>

#include "tests/tools/expect.h"

static FILE *printed_file;
static int printed_kept; // standard output as it was

// From here on, standard output goes to a file of its own.
static inline void printed_begin(void)
{
    fflush(stdout);
    printed_file = tmpfile();
    printed_kept = dup(STDOUT_FILENO);
    assert_non_null(printed_file);
    assert_int_equal(dup2(fileno(printed_file), STDOUT_FILENO), STDOUT_FILENO);
}

// Ends that, and returns what was printed, until the next call.
static inline const char *printed_end(void)
{
    static char text[1 << 16];
    fflush(stdout);
    dup2(printed_kept, STDOUT_FILENO);
    close(printed_kept);
    rewind(printed_file);
    const size_t size = fread(text, 1, sizeof(text), printed_file);
    fclose(printed_file);
    assert_below(size, sizeof(text));
    text[size] = 0;
    return text;
}

#endif
