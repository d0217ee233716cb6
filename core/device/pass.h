// Passes with checked arguments: the way to run any kernel.
#ifndef RG_CORE_DEVICE_PASS_H
#define RG_CORE_DEVICE_PASS_H

#include "backends/backend.h"

// Creates a pass of the kernel of this name; NULL and one logged line on failure. Destroying NULL
// is allowed.
struct rg_pass *rg_pass_create(struct rg_device *device, const char *kernel);
void rg_pass_destroy(struct rg_pass *pass);

// Calls `take` with the code that the driver's compiler has made of a pass and its packing passes
// so far, as the API returns it; there may be none. The bytes last as long as the call. False, and
// one logged line, where the driver refuses.
bool rg_pass_code(struct rg_pass *pass, void (*take)(const void *bytes, size_t size, void *user),
                  void *user);

// Checks a run, counts it and hands it to the backend. False and one logged line where a check or
// the driver refuses it.
bool rg_pass_run(struct rg_pass *pass, const struct rg_run *run);

#endif
