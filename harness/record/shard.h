// Shards: what a command does of a whole, which several machines or jobs do together.
#ifndef RG_HARNESS_RECORD_SHARD_H
#define RG_HARNESS_RECORD_SHARD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct rg_shard {
    int number, count; // from 1
};

// Divides things into shards of about the same expected time: gives each a shard, the largest
// first, each to the shard with the least so far. The same times are always divided the same way;
// equal ones in turn. `shard_of` has room for all things, and gets numbers from 1. `longest_s` gets
// the longest shard's time; may be NULL. False, with one logged line, when memory runs out.
bool rg_shard_cut(const double *seconds, int64_t count, int shards, int *shard_of,
                  double *longest_s);

// Writes numbers from 1 as `sbatch --array` takes them: "2,5-7"; "" for none. `has` says it of each
// of `count` numbers, the first at 0. RG_SHARD_NUMBER bytes a number are enough.
enum { RG_SHARD_NUMBER = 12 };
void rg_shard_array(const bool *has, int count, char *text, size_t size);

#endif
