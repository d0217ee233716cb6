// Results that lie on disk.
#ifndef RG_HARNESS_RECORD_DISK_STORED_H
#define RG_HARNESS_RECORD_DISK_STORED_H

#include "harness/record/schema/schema.h"

struct rg_stored {
    int count;
    int64_t room;              // of the results, for rg_array_fit
    struct rg_result *results; // owned, and what they own
};

// Reads a file, which holds a result or several one after the other, or all of a folder's: files
// that end in .json or .journal, by name. Zeroed before. False, with one logged line that names the
// file, the place and the mend, where one of them is no result, or there is none. The caller calls
// rg_stored_free in either case.
bool rg_stored_read(struct rg_stored *stored, const char *path);
void rg_stored_free(struct rg_stored *stored);

// Reads a file with one result, as a journal is. False where it is none: `why` says so in one line.
bool rg_stored_read_one(const char *path, struct rg_result *result, char why[RG_WHY_SIZE]);

#endif
