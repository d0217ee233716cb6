// The passport: a record's description of the machine, the drivers and this binary, which makes its
// numbers understandable elsewhere. docs/records.schema.json documents each field.
#ifndef RG_HARNESS_RECORD_PASSPORT_PASSPORT_H
#define RG_HARNESS_RECORD_PASSPORT_PASSPORT_H

#include <jansson.h>

#include "backends/backend.h"

// The passport of this process with these devices, each with its comparison key
// (harness/record/passport/key.h); the caller releases it. Nothing in it changes between runs on
// one machine (no clock rates, no load, no host name).
json_t *rg_passport_json(const struct rg_device_info *infos, int count);

// The description of one device: name, api, device, driver, software, libraries.
json_t *rg_passport_device(const struct rg_device_info *info);
// An array of these.
json_t *rg_passport_devices(const struct rg_device_info *const infos[], int count);

#endif
