// Techniques, "slow" and "other", whose frames take what their settings say, on fake devices that
// take so many times as long, by a clock that only they move. They are all that rg_techniques has,
// in place of the build's own list.
#ifndef RG_TESTS_HARNESS_RESULTS_PLANNING_SLOW_H
#define RG_TESTS_HARNESS_RESULTS_PLANNING_SLOW_H

#include "harness/devices/kept.h"
#include "tests/harness/measuring/fake.h"

extern int slow_opened; // instances, since the rig was begun
// The one of them that is interrupted, as by Ctrl-C; 0: none.
extern int slow_interrupted;
// Has gl's driver compile for so long in its next opening, and in each of the two frames after it.
void slow_compiles(double ms);
// Has cpu's next opening make what its instances share, which takes so long.
void slow_shares(double ms);

// cpu, cpu:reference, which takes ten times as long, and gl, which takes three times as long.
struct slow_rig {
    struct fake_device *fakes[3];
    struct rg_devices devices;
    struct rg_kept kept;
};
void slow_begin(struct slow_rig *rig);
// Fails the test on a leak.
void slow_end(struct slow_rig *rig);

#endif
