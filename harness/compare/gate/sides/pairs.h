// The pairs of devices that a gate compares.
#ifndef RG_HARNESS_COMPARE_GATE_SIDES_PAIRS_H
#define RG_HARNESS_COMPARE_GATE_SIDES_PAIRS_H

#include "harness/compare/gate/sides/sides.h"

struct rg_gate_pair {
    // As an argument of --device for one device. A's is "" if a baseline takes its place.
    char names[RG_SIDES][RG_DEVICE_NAME_SIZE];
};

struct rg_gate_pairs {
    int count;
    struct rg_gate_pair all[RG_MAX_DEVICES];
    int left_out; // an enum rg_exit, for devices whose drivers crashed while they were listed
};

// Makes a pair of two devices. False, and one logged line, if a name is not one.
bool rg_gate_pair_of(const char *a, const char *b, struct rg_gate_pair *pair);

// Pairs each device of another build with the same one of this build. `names` has commas, or is
// "all"; `program` is the other build's program. Returns an enum rg_exit: usage for a bad name or
// program; with "all" and no device, unsupported or fail.
int rg_gate_pairs_of_builds(const char *program, const char *names, struct rg_gate_pairs *pairs);

// Devices that could be gated but are not. Names are not owned.
struct rg_gate_left {
    int count;
    const char *names[RG_MAX_DEVICES];
};
// Fills them in for a comparison of builds: cpu:reference and the first device of each backend.
// Drivers are not asked, because one that hangs may have been left out on purpose.
void rg_gate_pairs_left(const struct rg_gate_pairs *pairs, struct rg_gate_left *left);

#endif
