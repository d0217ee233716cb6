// Checks that two devices to be compared run different drivers.
#ifndef RG_HARNESS_DEVICES_DRIVERS_APART_H
#define RG_HARNESS_DEVICES_DRIVERS_APART_H

#include <stdbool.h>

#include "backends/backend.h"

// Whether two opened devices may be compared. If their names choose different drivers but one file
// runs on both, that is an error; the same build in two files is a warning. `settings` are the
// variables in their names.
bool rg_drivers_are_apart(const struct rg_device_info *a, const char *settings_a,
                          const struct rg_device_info *b, const char *settings_b);

#endif
