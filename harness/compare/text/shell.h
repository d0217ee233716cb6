// Words of a shell command line.
#ifndef RG_HARNESS_COMPARE_TEXT_SHELL_H
#define RG_HARNESS_COMPARE_TEXT_SHELL_H

#include <stddef.h>
#include <stdio.h>

// Writes the first `length` bytes of a text so that a shell reads them as one word, quoted if
// necessary.
void rg_shell_word(FILE *out, const char *text, size_t length);

#endif
