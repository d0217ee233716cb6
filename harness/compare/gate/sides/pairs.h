// What a gate holds against what: devices by two.
#ifndef RG_HARNESS_COMPARE_GATE_SIDES_PAIRS_H
#define RG_HARNESS_COMPARE_GATE_SIDES_PAIRS_H

#include "harness/compare/gate/sides/sides.h"

struct rg_gate_pair {
    char names[RG_SIDES][RG_DEVICE_NAME_SIZE]; // as --device takes one device
};

struct rg_gate_pairs {
    int count;
    struct rg_gate_pair all[RG_MAX_DEVICES];
    int left_out; // an enum rg_exit, of devices whose drivers fell while they were listed
};

// Two devices. False, and one logged line, where a name is none.
bool rg_gate_pair_of(const char *a, const char *b, struct rg_gate_pair *pair);

// Each of the devices that `names` holds, with commas or "all", of another build and of this one:
// `program` is the other's. Returns an enum rg_exit: usage where a name or the program is none, and
// with "all" unsupported or fail where there is no device.
int rg_gate_pairs_of_builds(const char *program, const char *names, struct rg_gate_pairs *pairs);

// Devices that a gate could be of, and is not. Names are not owned.
struct rg_gate_left {
    int count;
    const char *names[RG_MAX_DEVICES];
};
// Of one of two builds, as far as they are known without a look at drivers, which may have been
// left out for that they hang: cpu:reference, and the first device of each backend.
void rg_gate_pairs_left(const struct rg_gate_pairs *pairs, struct rg_gate_left *left);

#endif
