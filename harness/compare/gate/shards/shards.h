// A gate in shards: the record that each shard leaves, and the report of all of them together.
#ifndef RG_HARNESS_COMPARE_GATE_SHARDS_SHARDS_H
#define RG_HARNESS_COMPARE_GATE_SHARDS_SHARDS_H

#include "harness/compare/gate/run/gate.h"
#include "harness/record/disk/parts.h"

// Digests of the files that decide what a gate finds; "": there is none.
struct rg_gate_inputs {
    char baseline[RG_DIGEST_SIZE], expectations[RG_DIGEST_SIZE], times[RG_DIGEST_SIZE];
};
// The digest of a file's bytes. False, and one logged line, if it cannot be read.
bool rg_gate_digest_file(const char *path, char digest[RG_DIGEST_SIZE]);
// That of all files of expectations.
void rg_gate_digest_known(const struct rg_known *known, char digest[RG_DIGEST_SIZE]);

// Reads how long cases took from the record of an earlier gate (`gate --json`), as seconds by name,
// which the caller owns. NULL, and one logged line, if it is none.
json_t *rg_gate_times_read(const char *path);

// Writes the record of a shard whose report is complete into a folder. `beyond` is the enum rg_exit
// of what the report does not tell. False, and one logged line, on failure.
bool rg_gate_part_write(const struct rg_gate_request *request, const struct rg_gate_inputs *inputs,
                        const struct rg_gate *gate, int beyond, const char *folder);

// Makes a zeroed gate's report and results of the records of its shards, to which they point, in
// the order of a gate without shards. Its `beyond` is the worst of theirs. False, and one logged
// line, if shards ran other drivers, or without memory.
bool rg_gate_merge(const struct rg_parts *parts, struct rg_gate *gate);

#endif
