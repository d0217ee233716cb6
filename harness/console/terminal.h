// How a terminal shows text: its colours and its width.
#ifndef RG_HARNESS_CONSOLE_TERMINAL_H
#define RG_HARNESS_CONSOLE_TERMINAL_H

#include <stdbool.h>
#include <stdio.h>

#define RG_GREEN  "\033[32m"
#define RG_RED    "\033[31m"
#define RG_YELLOW "\033[33m"
#define RG_PLAIN  "\033[0m"

// The columns of files, which most terminals show whole.
enum { RG_PAGE_WIDTH = 110 };

// Whether to print colours to a stream: it is a terminal, and NO_COLOR is unset or empty.
bool rg_has_colours(FILE *out);
// The columns of a stream's lines: a terminal's own, 60 at least; else RG_PAGE_WIDTH.
int rg_page_width(FILE *out);
// Prints a text as lines of that width. The first begins with `lead`, the others with as many
// blanks.
void rg_print_wrapped(FILE *out, const char *lead, const char *text);

#endif
