// The passport: what a record says of the machine, the drivers and this binary, so that its numbers
// can be understood elsewhere. Documented field by field in docs/records.md.
#ifndef RG_HARNESS_RECORD_PASSPORT_PASSPORT_H
#define RG_HARNESS_RECORD_PASSPORT_PASSPORT_H

#include <jansson.h>

#include "backends/backend.h"

// The passport of this process with these devices, each with its comparison key
// (harness/record/passport/key.h); the caller releases it. Holds nothing that
// changes from run to run on one machine (no clock frequencies, no load, no host name).
json_t *rg_passport_json(const struct rg_device_info *infos, int count);

// The same of one device: name, api, device, driver, software, libraries.
json_t *rg_passport_device(const struct rg_device_info *info);
// An array of them.
json_t *rg_passport_devices(const struct rg_device_info *const infos[], int count);

#endif
