// flow in one pose, small, without laws and mutants: tests of `verify` change it and expect the
// change to be noticed.
#ifndef RG_TESTS_HARNESS_VERIFYING_RIG_H
#define RG_TESTS_HARNESS_VERIFYING_RIG_H

#include "harness/compare/verify/verify.h"

#define RIG_CHEAP                                                                                  \
    "view=pane panes=mirror environment=sky environment_px=16 reflection_px=16 resolution_px=64"

extern const struct rg_pose rig_poses[];
extern const struct rg_law rig_no_laws[];
extern struct rg_technique rig_flow;

// How many steps poses take.
extern enum rg_verify_length rig_length;
extern int rig_steps;
// The part of `verify` that runs: rg_verify_devices, or another.
extern void (*rig_part)(struct rg_verify *verify);

// Before each test: resets all of these.
int rig_setup(void **state);

// Verifies `cpu` with this tier, size and settings, and fills `checks`, which the caller frees.
// Their first row is another check, which is ok.
void rig_verify(const char *assignments, enum rg_tier tier, int width, int height,
                struct rg_checks *checks);

// The check of a device; fails the test if there is none.
const struct rg_check *rig_check(const struct rg_checks *checks, const char *check,
                                 const char *device);
enum rg_outcome rig_outcome(const struct rg_checks *checks, const char *check, const char *device);

#endif
