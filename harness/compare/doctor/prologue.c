#include "harness/compare/doctor/prologue.h"

#include <stdio.h>

#include "core/base/log.h"

// How often Linux has slowed the processors; 0 where it does not tell.
static int64_t throttled(const char *root)
{
    int64_t sum = 0;
    for (int core = 0;; core++) {
        char path[1024];
        long long count;
        snprintf(path, sizeof(path),
                 "%s/sys/devices/system/cpu/cpu%d/thermal_throttle/core_throttle_count", root,
                 core);
        FILE *file = fopen(path, "r");
        if (!file)
            return sum;
        sum += fscanf(file, "%lld", &count) == 1 ? count : 0;
        fclose(file);
    }
}

bool rg_prologue_begin(struct rg_prologue *prologue)
{
    const double share = rg_machine_busy(prologue->watch);
    prologue->throttled = throttled(prologue->root);
    return !(share > 0) ||
           rg_harness_error("this machine takes no cells now: others take %.0f %% of its "
                            "processors; end them, or measure elsewhere",
                            100 * share);
}

bool rg_prologue_end(const struct rg_prologue *prologue)
{
    const int64_t times = throttled(prologue->root) - prologue->throttled;
    return times <= 0 ||
           rg_harness_error("this machine takes no cells now: its processors were slowed %lld "
                            "times, for they are hot; cool it, or measure elsewhere",
                            (long long)times);
}
