// The rows of a table that are measured together: the live jobs behind their records.
#ifndef RG_HARNESS_TABLES_MEASURING_BATCH_H
#define RG_HARNESS_TABLES_MEASURING_BATCH_H

#include "harness/measure/measure.h"
#include "harness/tables/table.h"

// Zeroed but for what is not owned. The owner calls rg_batch_close.
struct rg_batch {
    struct rg_result *result;
    const struct rg_table *table;
    struct rg_kept *kept;
    int job_count, job_room;
    struct rg_job *jobs; // owned; one a cell of what was prepared
    int settings_count;
    void **settings; // owned, and what they point to; one for the devices of a variant
};

// Room for the jobs of so many rows. False, with one logged line, without memory.
bool rg_batch_open(struct rg_batch *batch, int rows);
// Hands the sessions over to what the tables of a command keep, and frees the rest.
void rg_batch_close(struct rg_batch *batch);

// The device of this place among those of the result.
struct rg_device *rg_batch_device(const struct rg_batch *batch, int device);
// Opens, checks and warms up the jobs of a row's variant on all devices, or ends their records.
// `at` names the row, the work and the variant.
void rg_batch_prepare(struct rg_batch *batch, struct rg_place at,
                      const struct rg_measure_options *options);
// What the devices tell of the texture that a row is about.
void rg_batch_tell_texture(struct rg_batch *batch, struct rg_place at);

// The settings of a cell, which the batch owns; NULL, with one logged line, where there are none.
const void *rg_batch_settings(struct rg_batch *batch, struct rg_place at);

#endif
