// The records that shards of a command leave, a file each, from which the whole is put together.
//
// A record has a field `shard`: its number, how many there are, and `of`, which says what is
// divided. It is equal in all shards of a whole, and no others are put together.
#ifndef RG_HARNESS_RECORD_DISK_PARTS_H
#define RG_HARNESS_RECORD_DISK_PARTS_H

#include <jansson.h>

#include "harness/record/shard.h"

// Writes a shard's document into a folder, as KIND-I-of-N.json: sealed, and by a temporary file
// that is synced and renamed. Takes over both references. False, with one logged line, on failure.
bool rg_part_write(const char *kind, struct rg_shard shard, json_t *document, json_t *of,
                   const char *folder);

// Zeroed: none. The owner calls rg_parts_free.
struct rg_parts {
    int count;          // of the shards of the whole; 0: no record was found
    json_t **documents; // by number, the first at 0; NULL: missing; owned
    const json_t *of;   // of the first that was found
    int missing;        // shards without a record
};

// Reads the records of a kind from a folder and the folders in it, or one from a file. Tells of
// damaged ones, which count as missing. False, with one logged line that names the file, if a
// record is of another format or of another whole, or cannot be read, or memory runs out.
bool rg_parts_read(struct rg_parts *parts, const char *kind, const char *path);
// The numbers of the shards without a record, "2,5-7", which the caller frees. NULL, with one
// logged line, when memory runs out.
char *rg_parts_lacking(const struct rg_parts *parts);
// The texts that records have under a name, each once, or their lines, each once. The caller frees
// it. NULL, with one logged line, when memory runs out.
char *rg_parts_texts(const struct rg_parts *parts, const char *name, bool by_lines);
void rg_parts_free(struct rg_parts *parts);

#endif
