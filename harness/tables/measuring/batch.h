// Rows of a table that are measured together, with the live jobs of their records.
#ifndef RG_HARNESS_TABLES_MEASURING_BATCH_H
#define RG_HARNESS_TABLES_MEASURING_BATCH_H

#include "harness/devices/measure/measure.h"
#include "harness/tables/table.h"

// Zero all but the borrowed pointers. The owner calls rg_batch_close.
struct rg_batch {
    struct rg_result *result;
    const struct rg_table *table;
    struct rg_kept *kept;
    int job_count, job_room;
    struct rg_job *jobs; // owned; one per prepared cell
    int settings_count;
    void **settings; // owned, with what they point to; a variant's devices share one
};

// Makes room for the jobs of so many rows. False, with one logged line, without memory.
bool rg_batch_open(struct rg_batch *batch, int rows);
// Returns the sessions to `kept`, for the command's other tables, and frees the rest.
void rg_batch_close(struct rg_batch *batch);

// The device with this index in the result.
struct rg_device *rg_batch_device(const struct rg_batch *batch, int device);
// Opens, checks and warms up the jobs of a row's variant on all devices; a failure ends the record
// of its job. `at` names the row, the work and the variant.
void rg_batch_prepare(struct rg_batch *batch, struct rg_place at,
                      const struct rg_measure_options *options);
// Records the size of the texture that a row is about, as each device reports it.
void rg_batch_tell_texture(struct rg_batch *batch, struct rg_place at);

// A cell's settings, owned by the batch; NULL, with one logged line, on failure.
const void *rg_batch_settings(struct rg_batch *batch, struct rg_place at);

#endif
