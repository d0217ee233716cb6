// The results of checks: collected, printed as lines or JSON, and summed up in an exit status.
#ifndef RG_HARNESS_COMPARE_VERIFY_CHECKS_H
#define RG_HARNESS_COMPARE_VERIFY_CHECKS_H

#include <stdbool.h>

#include "core/base/outcome.h"

struct rg_check {
    char technique[32], check[32], device[32];
    enum rg_outcome status;
    char detail[512];
};

// Zeroed: none. The owner calls rg_checks_free.
struct rg_checks {
    int count;
    struct rg_check *rows;
    bool incomplete; // a result was lost for want of memory, which one logged line said
};

void rg_checks_add(struct rg_checks *checks, const char *technique, const char *check,
                   const char *device, enum rg_outcome status, const char *format, ...)
    __attribute__((format(printf, 6, 7)));

// To stdout: a line a check, or one JSON object {"format":1, "checks":[...]}.
void rg_checks_print(const struct rg_checks *checks, bool json);

// An enum rg_exit: failed, in error or incomplete, nothing but unsupported, nothing at all, or
// passed.
int rg_checks_exit(const struct rg_checks *checks);

void rg_checks_free(struct rg_checks *checks);

#endif
