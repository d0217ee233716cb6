// Which shard of a whole a command does: the option --shard.
#ifndef RG_HARNESS_COMMANDS_CLI_SHARD_H
#define RG_HARNESS_COMMANDS_CLI_SHARD_H

#include "harness/commands/cli/option.h"
#include "harness/record/disk/parts.h"

extern const struct rg_option rg_shard_option[]; // char *: --shard

// Finds the shard in "2/8", or by the variables of Slurm's arrays, of CI_NODE_INDEX or of
// googletest for "auto". `count` is how many shards there are; 0: not settled. False, with one
// logged line, where it is none of them.
bool rg_shard_read(const char *asked, int count, struct rg_shard *shard);

// The enum rg_exit of the records of a kind that were read from `path`, if some are missing, with
// lines that name them: nothing without any record, inconclusive unless `partial`.
int rg_shards_exit(const struct rg_parts *parts, const char *kind, const char *path, bool partial);

#endif
