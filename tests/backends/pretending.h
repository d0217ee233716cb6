// `cpu`, pretending to be a device of another tier, in the place of the product's backends. A test
// replaces more of its functions.
#ifndef RG_TESTS_BACKENDS_PRETENDING_H
#define RG_TESTS_BACKENDS_PRETENDING_H

#include "core/device/device.h"

extern struct rg_backend pretending;
extern const struct rg_backend rg_backend_cpu;

// Makes `pretending` the backend of cpu with devices of this tier, and counts runs from 0.
void pretend(enum rg_tier tier);
// How many passes ran since then.
extern int pretended_runs;

// Whether an opened device's programs do something themselves (`is_own`), as `flag` must say and
// ", own WHAT" in its API's name, after so many runs. These must leave no trace on the device,
// which is closed.
void check_asked(struct rg_device *device, bool flag, bool is_own, const char *what, int runs);

// Hears what is logged until a call with false: the last line, and how many there were.
void listen_to_lines(bool on);
extern char heard_line[200];
extern int heard_lines;

#endif
