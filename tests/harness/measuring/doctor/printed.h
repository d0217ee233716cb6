// What a function prints on standard output.
#ifndef RG_TESTS_HARNESS_MEASURING_DOCTOR_PRINTED_H
#define RG_TESTS_HARNESS_MEASURING_DOCTOR_PRINTED_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// The text, which stays until the next call.
static inline const char *printed_by(void (*print)(const void *what), const void *what)
{
    static char text[1 << 16];
    FILE *file = tmpfile();
    const int kept = dup(STDOUT_FILENO);
    assert_non_null(file);
    fflush(stdout);
    dup2(fileno(file), STDOUT_FILENO);
    print(what);
    fflush(stdout);
    dup2(kept, STDOUT_FILENO);
    close(kept);
    rewind(file);
    text[fread(text, 1, sizeof(text) - 1, file)] = 0;
    fclose(file);
    return text;
}

// How many lines of a text are this one.
static inline int lines_like(const char *text, const char *line)
{
    int count = 0;
    for (const char *at = text; *at; at += strcspn(at, "\n") + (at[strcspn(at, "\n")] == '\n'))
        count += strcspn(at, "\n") == strlen(line) && !strncmp(at, line, strlen(line));
    return count;
}

#define assert_line(text, line)                                                                    \
    do {                                                                                           \
        if (lines_like(text, line) != 1)                                                           \
            fail_msg("not one line is '%s':\n%s", line, text);                                     \
    } while (0)

#endif
