// Results of checks: collected, printed as lines or JSON, and summed up in an exit status.
#ifndef RG_HARNESS_COMPARE_VERIFY_CHECKS_H
#define RG_HARNESS_COMPARE_VERIFY_CHECKS_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>

#include "backends/backend.h"
#include "core/base/log.h"
#include "core/base/outcome.h"

struct rg_check {
    char technique[32], check[32], device[RG_DEVICE_NAME_SIZE];
    enum rg_outcome status;
    char detail[512];
};

// Zeroed: none. The owner calls rg_checks_free.
struct rg_checks {
    int count;
    int64_t room; // capacity of the rows, for rg_array_fit
    struct rg_check *rows;
    int exit; // an enum rg_exit: the final status is at least as bad
};

// When memory for a result runs out, one line is logged and all checks count as failed.
void rg_checks_add(struct rg_checks *checks, const char *technique, const char *check,
                   const char *device, enum rg_outcome status, const char *format, ...)
    __attribute__((format(printf, 6, 7)));

// A failure as a result. The user's is bad usage of the command.
void rg_checks_add_failure(struct rg_checks *checks, const char *technique, const char *check,
                           const char *device, const struct rg_failure *failure);
// The same of the failure that was just met (rg_failure_take).
void rg_checks_add_error(struct rg_checks *checks, const char *technique, const char *check,
                         const char *device);

// Adds a check from its JSON form. False, and one logged line, if it is none.
bool rg_checks_read(struct rg_checks *checks, const json_t *row);

// The JSON form, "verify" in docs/records.schema.json, which the caller owns; takes over `devices`.
json_t *rg_checks_document(const struct rg_checks *checks, json_t *devices);
// Prints to stdout: `note` and a line for each check, or the JSON form; takes over `devices`.
void rg_checks_print(const struct rg_checks *checks, const char *note, json_t *devices, bool json);

// An enum rg_exit: the worse of `exit` and rg_exit_of_all of the results. If some results are of
// devices, only these count, because a good model proves no device.
int rg_checks_exit(const struct rg_checks *checks);

void rg_checks_free(struct rg_checks *checks);

#endif
