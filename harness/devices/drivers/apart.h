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

// Whether two names, with their variables, choose different drivers of one API. `cpu` has none.
bool rg_drivers_are_chosen_apart(const char *a, const char *settings_a, const char *b,
                                 const char *settings_b);
// The variables of two names that differ, other than those that choose a driver: "LP_PERF no_blend
// and not unset". "": none does.
void rg_drivers_settings(const char *now, const char *then, char *text, size_t size);

#endif
