// Whether two devices that are held against each other run two drivers.
#ifndef RG_HARNESS_DEVICES_DRIVERS_APART_H
#define RG_HARNESS_DEVICES_DRIVERS_APART_H

#include <stdbool.h>

#include "backends/backend.h"

// Whether two devices that were opened may be held against each other: where their names choose
// their drivers differently, and one file runs on both, that is an error. One build in two files is
// a warning. Both come with the variables of their names.
bool rg_drivers_are_apart(const struct rg_device_info *a, const char *settings_a,
                          const struct rg_device_info *b, const char *settings_b);

#endif
