// Colours of a terminal.
#ifndef RG_HARNESS_CONSOLE_COLOUR_H
#define RG_HARNESS_CONSOLE_COLOUR_H

#include <stdbool.h>
#include <stdio.h>

#define RG_GREEN  "\033[32m"
#define RG_RED    "\033[31m"
#define RG_YELLOW "\033[33m"
#define RG_PLAIN  "\033[0m"

// Whether to print colours to a stream: it is a terminal, and NO_COLOR is unset or empty.
bool rg_has_colours(FILE *out);

#endif
