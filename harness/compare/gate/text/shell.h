// Words of a shell's line.
#ifndef RG_HARNESS_COMPARE_GATE_TEXT_SHELL_H
#define RG_HARNESS_COMPARE_GATE_TEXT_SHELL_H

#include <stddef.h>
#include <stdio.h>

// Writes the first bytes of a text such that a shell reads them as one word, in quotes where it
// needs them.
void rg_shell_word(FILE *out, const char *text, size_t length);

#endif
