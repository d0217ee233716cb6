#include "harness/tables/measuring/batch.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"

bool rg_batch_open(struct rg_batch *batch, int rows)
{
    batch->job_room = rows * rg_result_row_cells(batch->result);
    batch->jobs = rg_alloc((size_t)batch->job_room, sizeof(*batch->jobs), batch->table->id);
    batch->settings = rg_alloc((size_t)batch->job_room, sizeof(void *), batch->table->id);
    return batch->jobs && batch->settings;
}

void rg_batch_close(struct rg_batch *batch)
{
    for (int i = 0; i < batch->job_count; i++)
        if (batch->jobs[i].session)
            rg_kept_put(batch->kept, batch->jobs[i].session);
    for (int i = 0; i < batch->settings_count; i++)
        free(batch->settings[i]);
    free(batch->settings);
    free(batch->jobs);
}

struct rg_device *rg_batch_device(const struct rg_batch *batch, int device)
{
    const struct rg_devices *all = batch->kept->devices;
    const char *name = batch->result->devices[device].name;
    if (device < all->count && !strcmp(all->devices[device]->info.name, name))
        return all->devices[device]; // a device may be given twice
    return rg_kept_device(batch->kept, name);
}

const void *rg_batch_settings(struct rg_batch *batch, struct rg_place at)
{
    void *settings = rg_table_settings(batch->result, batch->table, at);
    if (settings)
        batch->settings[batch->settings_count++] = settings;
    return settings;
}
