// Catches what functions print to standard output.
#ifndef RG_TESTS_HARNESS_VERIFYING_TOLD_PRINTED_H
#define RG_TESTS_HARNESS_VERIFYING_TOLD_PRINTED_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

struct printed {
    FILE *file;
    int kept; // standard output as it was
};

static inline void printed_begin(struct printed *printed)
{
    fflush(stdout);
    printed->file = tmpfile();
    printed->kept = dup(STDOUT_FILENO);
    assert_non_null(printed->file);
    assert_int_equal(dup2(fileno(printed->file), STDOUT_FILENO), STDOUT_FILENO);
}

// Ends catching, and returns the text; the caller frees it.
static inline char *printed_end(struct printed *printed)
{
    fflush(stdout);
    dup2(printed->kept, STDOUT_FILENO);
    close(printed->kept);
    fseek(printed->file, 0, SEEK_END);
    const size_t size = (size_t)ftell(printed->file);
    char *text = calloc(1, size + 1);
    assert_non_null(text);
    rewind(printed->file);
    assert_int_equal(fread(text, 1, size, printed->file), size);
    fclose(printed->file);
    return text;
}

#endif
