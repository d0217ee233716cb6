// Draws of fixed functions through the drivers' own pipelines (shaders/fixed/fixed.h), with a
// digest of each. Each is tried separately, so that one that crashes the driver does not affect
// others.
#ifndef RG_HARNESS_COMPARE_DOCTOR_FIXED_H
#define RG_HARNESS_COMPARE_DOCTOR_FIXED_H

#include <jansson.h>

#include "core/device/device.h"

// Draws them on the device of this name, and adds its row to `devices`: "fixed" in
// docs/records.schema.json says what is in it. `info` receives the device's description where it
// opens. Returns an enum rg_exit, after one logged line for each failure.
int rg_doctor_fixed(const char *name, struct rg_device_info *info, json_t *devices);

// The passport of these devices, with the digests in such rows; the caller releases it.
json_t *rg_doctor_fixed_passport(const json_t *devices, const struct rg_device_info *infos,
                                 int count);

// Prints such rows for people.
void rg_doctor_fixed_print(const json_t *devices);

#endif
