// Reads results from disk.
#ifndef RG_HARNESS_RECORD_DISK_STORED_H
#define RG_HARNESS_RECORD_DISK_STORED_H

#include "harness/record/schema/schema.h"

struct rg_stored {
    int count;
    int64_t room;              // capacity of `results`, for rg_array_fit
    struct rg_result *results; // owned, with everything that they own
};

// Reads one or several results from a file, or from all .json and .journal files of a folder and of
// the folders in it that a comparison key names, by name. Zero `stored` before. False, with one
// logged line that names the file, the place and the mend, if a file is no result, or there is
// none. The caller calls rg_stored_free in either case.
bool rg_stored_read(struct rg_stored *stored, const char *path);
void rg_stored_free(struct rg_stored *stored);

// Reads a file with a single result, such as a journal. False, with the reason in one line in
// `why`, if it is none.
bool rg_stored_read_one(const char *path, struct rg_result *result, char why[RG_WHY_SIZE]);

#endif
