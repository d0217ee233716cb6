// Finds the kernels that a driver can compile. Each is tried separately, so that one that crashes
// the driver does not affect others.
#ifndef RG_HARNESS_COMPARE_DOCTOR_COMPILE_H
#define RG_HARNESS_COMPARE_DOCTOR_COMPILE_H

#include <jansson.h>
#include <stdbool.h>

// Whether all kernels in `names` ("all", or names separated by commas) exist; if not, one line has
// been logged.
bool rg_doctor_knows_kernels(const char *names);

// Compiles kernels on a device, and runs an item of those that need only zeros, because many
// drivers compile at the first run. Prints their number and the failed ones on stdout, or adds them
// to `report`, an array, if not NULL. Returns an enum rg_exit, after one logged line for each
// failure.
int rg_doctor_compile(const char *device, const char *names, json_t *report);

#endif
