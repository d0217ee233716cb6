#include "harness/commands/comparing/outputs.h"

#include <stdio.h>
#include <string.h>

#include "core/base/log.h"

bool rg_gate_outputs_settle(const char *junit, const char *pictures,
                            const struct rg_gtest_asked *gtest, struct rg_gate_outputs *outputs)
{
    enum { ROOM = PATH_MAX - sizeof("-pictures") };
    outputs->prints_gtest = gtest->filter || gtest->output;
    if (!rg_gtest_output(gtest, outputs->junit))
        return false;
    if (junit)
        snprintf(outputs->junit, PATH_MAX, "%s", junit);
    const char *file = outputs->junit, *end = strrchr(file, '.');
    const size_t length = strlen(file);
    const size_t stem = end && !strcmp(end, ".xml") ? (size_t)(end - file) : length;
    if (length >= ROOM || (pictures && strlen(pictures) >= ROOM))
        return rg_error("%.80s...: is too long a path; choose a shorter one",
                        pictures ? pictures : file);
    if (pictures)
        snprintf(outputs->pictures, PATH_MAX, "%s", pictures);
    else if (length)
        snprintf(outputs->pictures, PATH_MAX, "%.*s-pictures", (int)stem, file);
    return true;
}
