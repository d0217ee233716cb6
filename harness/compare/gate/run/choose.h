// Chooses the cases of a gate. Only files of this folder include it.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_CHOOSE_H
#define RG_HARNESS_COMPARE_GATE_RUN_CHOOSE_H

#include "harness/compare/gate/run/timing.h"

// Adds the cases that the filter selects and that the shard has, whose sides are those of all
// pairs. Shards divide cases by the time that they are expected to take: that of the baseline, or
// of the request's times. False, and one logged line, without memory.
bool rg_gate_choose(struct rg_running_gate *run);

#endif
