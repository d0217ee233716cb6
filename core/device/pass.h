// Passes, checked: the way to run any kernel.
#ifndef RG_CORE_DEVICE_PASS_H
#define RG_CORE_DEVICE_PASS_H

#include "backends/backend.h"

// A pass of a kernel by name; NULL and one logged line on failure. Destroying NULL is allowed.
struct rg_pass *rg_pass_create(struct rg_device *device, const char *kernel);
void rg_pass_destroy(struct rg_pass *pass);

// What the driver's compiler has made of passes so far, as the API hands it out: equal code has
// equal hashes, for passes that are added in the same order. Zeroed: none.
struct rg_pass_code {
    uint64_t hash;
    int64_t bytes; // 0: the API hands none out
};
// Adds a pass, with what packs its items.
void rg_pass_code(struct rg_pass *pass, struct rg_pass_code *code);

// Checks a run, counts it and hands it to the backend. False and one logged line where a check or
// the driver refuses it.
bool rg_pass_run(struct rg_pass *pass, const struct rg_run *run);

#endif
