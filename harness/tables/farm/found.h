// The records of a plan's groups that shards left in folders.
#ifndef RG_HARNESS_TABLES_FARM_FOUND_H
#define RG_HARNESS_TABLES_FARM_FOUND_H

#include "harness/record/passport/origins.h"
#include "harness/tables/farm/plan.h"

// A machine, by the comparison keys of the plan's devices on it.
struct rg_farm_machine {
    char key[RG_KEY_SIZE];  // of its only device, or of all together
    char text[RG_KEY_TEXT]; // "Intel Xeon E5, 8 cores"
};

struct rg_farm_record {
    int64_t group; // index
    int machine;   // index
    char *path;    // owned
    int64_t next;  // another machine's record of the group; -1: none
};

// Zeroed; the owner calls rg_farm_found_free.
struct rg_farm_records {
    int64_t count, room;
    struct rg_farm_record *records; // owned; a group's are kept once a machine
    int64_t machine_count, machine_room;
    struct rg_farm_machine *machines; // owned
    int64_t *first_of;                // the first record of each group; -1: none; owned
    int64_t twice, damaged;           // records that are not kept
};

// Finds the records of a plan in folders, by their order. What ends in .json there must be records
// of the plan. Tells of those that are damaged, which count as missing, and of those that are there
// twice. False, with one logged line that names the file, where one is of another plan, commit or
// format, a folder cannot be read, or memory runs out.
bool rg_farm_records_find(struct rg_farm_records *found, const struct rg_farm_plan *plan,
                          const char *const *folders, int count);
// The record of a group on a machine; NULL: there is none.
const struct rg_farm_record *rg_farm_record_of(const struct rg_farm_records *found, int64_t group,
                                               int machine);
// The number of cells without a record. Names the first groups with some in lines of the log.
int64_t rg_farm_missing(const struct rg_farm_records *found, const struct rg_farm_plan *plan);
void rg_farm_found_free(struct rg_farm_records *found);

#endif
