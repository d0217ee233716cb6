// What a function prints to standard output.
#ifndef RG_TESTS_HARNESS_CLI_PRINTED_H
#define RG_TESTS_HARNESS_CLI_PRINTED_H

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static FILE *printed_file;
static int printed_fd;

// From here on, standard output goes to a file of its own.
static inline void printed_begin(void)
{
    fflush(stdout);
    printed_file = tmpfile();
    printed_fd = dup(STDOUT_FILENO);
    dup2(fileno(printed_file), STDOUT_FILENO);
}

// Ends that, and returns what was printed.
static inline const char *printed_end(void)
{
    static char text[1 << 16];
    fflush(stdout);
    dup2(printed_fd, STDOUT_FILENO);
    close(printed_fd);
    rewind(printed_file);
    text[fread(text, 1, sizeof(text) - 1, printed_file)] = 0;
    fclose(printed_file);
    return text;
}

#endif
