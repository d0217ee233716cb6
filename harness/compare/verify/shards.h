// A verification in shards: the checks of a technique on a device, or its mutants, are a unit,
// which stays whole. Each shard leaves a record, and all together make the checks of one run.
#ifndef RG_HARNESS_COMPARE_VERIFY_SHARDS_H
#define RG_HARNESS_COMPARE_VERIFY_SHARDS_H

#include "harness/compare/verify/verify.h"
#include "harness/record/disk/parts.h"

// The unit of a technique's mutants; others have the name of their device.
#define RG_UNIT_MUTANTS "mutants"

struct rg_verify_unit {
    const char *technique, *name; // not owned
    double steps;                 // that it takes
    bool is_here;                 // the shard has it
};

// Zeroed: none. The owner frees `all`.
struct rg_verify_units {
    int count;
    int64_t room;
    struct rg_verify_unit *all;
};

// Adds a unit. False, with one logged line, without memory.
bool rg_units_add(struct rg_verify_units *units, const char *technique, const char *name,
                  int64_t steps);
// Divides units by their steps, whatever the order of a technique's devices. False, with one logged
// line, without memory.
bool rg_units_cut(struct rg_verify_units *units, const struct rg_shard *shard);
bool rg_units_have(const struct rg_verify_units *units, const char *technique, const char *name);
// Whether the shard has a unit at all.
bool rg_units_have_any(const struct rg_verify_units *units);

// What all shards of a verification have in common; the caller owns it. `how` describes its options
// and is taken over.
json_t *rg_units_whole(const struct rg_verify_units *units, json_t *how);

// Adds the checks of all shards, in the order of one run, as far as units have one; the exit status
// is that of the worst. False, and one logged line, if a record has a check that is none.
bool rg_checks_merge(const struct rg_parts *parts, struct rg_checks *checks);
// The devices of all shards, each once; the caller owns them.
json_t *rg_checks_merge_devices(const struct rg_parts *parts);

#endif
