// flow in one pose, small, without laws and mutants: what tests of `verify` change to see it
// noticed.
#ifndef RG_TESTS_HARNESS_VERIFYING_RIG_H
#define RG_TESTS_HARNESS_VERIFYING_RIG_H

#include "harness/compare/verify/verify.h"

#define RIG_CHEAP                                                                                  \
    "view=pane panes=mirror environment=sky environment_px=16 reflection_px=16 resolution_px=64"

extern const struct rg_pose rig_poses[];
extern const struct rg_law rig_no_laws[];
extern struct rg_technique rig_flow;

// How long poses are run.
extern enum rg_verify_length rig_length;
extern int rig_steps;
// The part of `verify` that is run: rg_verify_devices, or another.
extern void (*rig_part)(struct rg_verify *verify);

// Before each test: all as it was.
int rig_setup(void **state);

// Verifies `cpu`, which is held to a tier, at this size and with these settings, beside a check
// that is ok and is the first of `checks`, which the caller frees.
void rig_verify(const char *assignments, enum rg_tier tier, int width, int height,
                struct rg_checks *checks);

// A check of a device, which is there.
const struct rg_check *rig_check(const struct rg_checks *checks, const char *check,
                                 const char *device);
enum rg_outcome rig_outcome(const struct rg_checks *checks, const char *check, const char *device);

#endif
