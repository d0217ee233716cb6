// The record that a shard leaves of a group: the result of its rows, in the schema of all results,
// with a field `group` that says of which plan it is. One file a group, written whole.
#ifndef RG_HARNESS_TABLES_FARM_RECORD_H
#define RG_HARNESS_TABLES_FARM_RECORD_H

#include "harness/record/output.h"
#include "harness/tables/farm/plan.h"

// The name of a group's file in a shard's folder.
enum { RG_FARM_FILE = RG_OUTPUT_PART + 8 };
void rg_farm_file(const struct rg_farm_group *group, char name[RG_FARM_FILE]);

// The document of a group's result, which was measured in `seconds`; the caller releases it. NULL,
// with one logged line, when memory runs out.
json_t *rg_farm_record_json(const struct rg_farm_plan *plan, const struct rg_farm_group *group,
                            const struct rg_result *result, double seconds);
// Writes it into a folder by a temporary file that is synced and renamed, so that readers on a
// shared folder see all of it or nothing. False, with one logged line, on failure.
bool rg_farm_record_write(const struct rg_farm_plan *plan, const struct rg_farm_group *group,
                          const struct rg_result *result, double seconds, const char *folder);

enum rg_farm_found {
    RG_FARM_WHOLE,
    RG_FARM_ABSENT,
    RG_FARM_DAMAGED, // cut or changed, or it lacks a cell of the group
    RG_FARM_FOREIGN, // whole, and of another plan, commit or format
};
// Reads a group's file into a zeroed result, which is zeroed unless it is whole; the caller frees
// it. `why` gets one line that names the file and the mend. `is_checked`: it was read before, and
// its checksums need not be computed again.
enum rg_farm_found rg_farm_record_read(const struct rg_farm_plan *plan,
                                       const struct rg_farm_group *group, const char *path,
                                       bool is_checked, struct rg_result *result,
                                       char why[RG_WHY_SIZE]);

#endif
