#define _GNU_SOURCE // RLIMIT_AS
#include "core/base/text/limits.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

// Drivers compile with LLVM, whose libraries alone take hundreds of megabytes of addresses, and
// they cache compiled code in files of some megabytes.
static const struct {
    __rlimit_resource_t resource;
    char option;
    rlim_t unit, enough; // bytes, or a plain count
} limits[] = {
    {RLIMIT_AS, 'v', 1 << 10, (rlim_t)2 << 30},
    {RLIMIT_DATA, 'd', 1 << 10, (rlim_t)1 << 30},
    {RLIMIT_STACK, 's', 1 << 10, 1 << 20},
    {RLIMIT_FSIZE, 'f', 1 << 10, 16 << 20},
    {RLIMIT_NOFILE, 'n', 1, 64},
    {RLIMIT_NPROC, 'u', 1, 64},
    {RLIMIT_CPU, 't', 1, 60},
};

const char *rg_limits_low(char text[RG_LIMITS_TEXT])
{
    struct rlimit now;
    *text = 0;
    for (size_t i = 0; i < sizeof(limits) / sizeof(limits[0]); i++) {
        if (getrlimit(limits[i].resource, &now) || now.rlim_cur >= limits[i].enough)
            continue;
        const size_t used = strlen(text);
        // Rounded up: dash counts a file in 512 bytes and bash in 1024, and neither means 0 by 1.
        const rlim_t units = (now.rlim_cur + limits[i].unit - 1) / limits[i].unit;
        snprintf(text + used, RG_LIMITS_TEXT - used, "%s-%c %llu", used ? ", " : "under ulimit ",
                 limits[i].option, (unsigned long long)units);
    }
    return *text ? text : NULL;
}
