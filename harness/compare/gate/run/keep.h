// What a gate keeps of its times in the folder that it writes into, and what it leaves there.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_KEEP_H
#define RG_HARNESS_COMPARE_GATE_RUN_KEEP_H

#include "harness/compare/gate/run/cases.h"
#include "harness/compare/gate/run/kept.h"

#define RG_GATE_LAUNCHES "launches.csv"

// Opens what the folder of a request keeps; `kept` is NULL where it has none, or nothing is timed.
// `key` as in rg_kept_times_open. False, and one logged line, without memory.
bool rg_keep_open(const struct rg_gate_request *asked, json_t *key, struct rg_kept_times **kept);
// Says which code runs a case that is timed; `kept` may be NULL.
void rg_keep_expect(struct rg_kept_times *kept, const struct rg_gate_case *of);
// Lets it go; where the gate `is_done`, what every launch told is left beside the pictures. False,
// and one logged line, where that cannot be written.
bool rg_keep_close(const struct rg_gate_request *asked, struct rg_kept_times *kept, bool is_done);

#endif
