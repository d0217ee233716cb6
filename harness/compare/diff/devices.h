// The comparison of one frame of a technique on several devices: `raingauge diff TECHNIQUE`.
#ifndef RG_HARNESS_COMPARE_DIFF_DEVICES_H
#define RG_HARNESS_COMPARE_DIFF_DEVICES_H

#include "harness/commands/command.h"

// Renders on every device, compares every pair and prints it. Returns an enum rg_exit: pass when
// every pair holds the tier that its devices owe (T0 between software devices, else T1).
int rg_diff_devices(const struct rg_options *options);

#endif
