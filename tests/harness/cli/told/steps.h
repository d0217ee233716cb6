// The steps of a command, of which one may fail.
#ifndef RG_TESTS_HARNESS_CLI_TOLD_STEPS_H
#define RG_TESTS_HARNESS_CLI_TOLD_STEPS_H

#include <stdbool.h>
#include <string.h>

#include "core/base/log.h"

static const char *broken; // the name of the step that fails; NULL: none does

static inline bool does(const char *step)
{
    return !broken || strcmp(broken, step) != 0 || rg_error("%s fails", step);
}

#endif
