// Which kernels a driver can compile, each by itself: one that brings a driver down takes along no
// other.
#ifndef RG_HARNESS_DOCTOR_COMPILE_H
#define RG_HARNESS_DOCTOR_COMPILE_H

#include <jansson.h>
#include <stdbool.h>

// Whether all kernels of `names` ("all", or names with commas between them) are known; else one
// line has been logged.
bool rg_doctor_knows_kernels(const char *names);

// Compiles them on a device, and runs an item of those that need nothing but zeros for it, for many
// drivers compile a kernel only then. Prints how many there were and which failed, on stdout, or
// into `report`, an array, where that is not NULL. Returns an enum rg_exit, after one logged line
// for each failure where it is not RG_EXIT_PASS.
int rg_doctor_compile(const char *device, const char *names, json_t *report);

#endif
