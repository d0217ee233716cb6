// Techniques "slow" and "other", whose frames take the time of their settings, on fake devices of
// different slowness, by a clock that only they move. They replace the build's own list:
// rg_techniques has no others.
#ifndef RG_TESTS_HARNESS_RESULTS_PLANNING_SLOW_H
#define RG_TESTS_HARNESS_RESULTS_PLANNING_SLOW_H

#include "harness/devices/kept.h"
#include "tests/harness/devices/measuring/fake.h"

extern int slow_opened; // instances, since slow_begin
// The number of the instance that is interrupted, as by Ctrl-C; 0: none.
extern int slow_interrupted;
// gl's driver compiles this long in its next opening, and in each of the two frames after it.
void slow_compiles(double ms);
// cpu's next opening takes this long to make what its instances share.
void slow_shares(double ms);

// cpu, cpu:reference, which is ten times as slow, and gl, which is three times as slow.
struct slow_rig {
    struct fake_device *fakes[3];
    struct rg_devices devices;
    struct rg_kept kept;
};
void slow_begin(struct slow_rig *rig);
// Fails the test on a leak.
void slow_end(struct slow_rig *rig);

#endif
