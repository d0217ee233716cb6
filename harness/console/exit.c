#include "harness/console/exit.h"

#include "core/base/log.h"

int rg_exit_of(enum rg_outcome outcome)
{
    switch (outcome) {
    case RG_OK:
        return RG_EXIT_PASS;
    case RG_UNSUPPORTED:
        return RG_EXIT_UNSUPPORTED;
    case RG_NOTHING:
        return RG_EXIT_NOTHING;
    case RG_LACKING:
        return RG_EXIT_HARNESS;
    default:
        return RG_EXIT_FAIL;
    }
}

int rg_exit_of_all(const int counts[RG_OUTCOME_COUNT])
{
    bool failed = false;
    for (int i = 0; i < RG_OUTCOME_COUNT; i++)
        failed = failed || (counts[i] && rg_exit_of((enum rg_outcome)i) == RG_EXIT_FAIL);
    if (failed)
        return RG_EXIT_FAIL;
    if (counts[RG_LACKING])
        return RG_EXIT_HARNESS;
    if (counts[RG_OK] && !counts[RG_NOTHING])
        return RG_EXIT_PASS;
    return counts[RG_UNSUPPORTED] && !counts[RG_NOTHING] ? RG_EXIT_UNSUPPORTED : RG_EXIT_NOTHING;
}

int rg_exit_with(int exit, int64_t count)
{
    return exit == RG_EXIT_PASS && count <= 0 ? RG_EXIT_NOTHING : exit;
}

int rg_exit_of_error(void)
{
    const struct rg_failure failure = rg_failure_take();
    return failure.fault == RG_FAULT_INPUT ? RG_EXIT_USAGE : rg_exit_of(failure.outcome);
}

int rg_exit_worse(int a, int b)
{
    static const int order[] = {RG_EXIT_USAGE,        RG_EXIT_FAIL,    RG_EXIT_HARNESS,
                                RG_EXIT_INCONCLUSIVE, RG_EXIT_NOTHING, RG_EXIT_UNSUPPORTED};
    if (a > RG_EXIT_SIGNALLED || b > RG_EXIT_SIGNALLED)
        return a > b ? a : b;
    for (int i = 0; i < (int)(sizeof(order) / sizeof(order[0])); i++)
        if (a == order[i] || b == order[i])
            return order[i];
    return RG_EXIT_PASS;
}

int rg_exit_of_record(const json_t *status)
{
    const json_int_t number = json_integer_value(status);
    const int exit = number >= 0 && number < RG_EXIT_SIGNALLED ? (int)number : RG_EXIT_FAIL;
    return !exit || rg_exit_worse(exit, RG_EXIT_PASS) ? exit : RG_EXIT_FAIL;
}

bool rg_stdout_error(void)
{
    return rg_harness_error("standard output: cannot be written; is it closed, or the disk full?");
}
