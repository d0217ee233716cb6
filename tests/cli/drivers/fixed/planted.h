// Faults of fixed functions, planted into a real driver: what the program asks of it is edited, so
// that one of its units seems to work otherwise. RG_PLANTED names one of the rows of planted.py;
// all other calls go to the real driver as they are.
#ifndef RG_TESTS_CLI_DRIVERS_FIXED_PLANTED_H
#define RG_TESTS_CLI_DRIVERS_FIXED_PLANTED_H

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static inline bool is_planted(const char *fault)
{
    const char *asked = getenv("RG_PLANTED");
    return asked && !strcmp(asked, fault);
}

#endif
