// Examining devices, each in a worker.
#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/devices/devices.h"
#include "harness/doctor/report.h"
#include "harness/devices/workers/device.h"
#include "harness/measure/messages.h"

int rg_examination_failures(const struct rg_examination *examination)
{
    int failures = 0;
    for (int i = 0; i < RG_PROBE_COUNT; i++)
        failures += !examination->probe[i].builtin && examination->probe[i].different > 0;
    return failures;
}

// Ends it with the last error.
static void fail(struct rg_examination *examination)
{
    examination->status = rg_outcome_of_error();
    snprintf(examination->why, sizeof(examination->why), "%.500s", rg_last_error());
}

static struct rg_device *open_device(struct rg_examination *examination)
{
    struct rg_device *device = rg_devices_open_one(examination->info.name);
    if (!device) {
        fail(examination);
        examination->is_unknown = rg_last_error_kind() == RG_ERROR_INPUT;
        return NULL;
    }
    examination->info = device->info;
    examination->opened = true;
    return device;
}

static bool audit(struct rg_worker *worker, struct rg_timer_audit *timer)
{
    const bool ok = rg_worker_fetch(worker, RG_CALL_AUDIT, NULL, rg_audit_fields, timer);
    timer->trusted = ok && timer->has_timer && rg_timer_is_trusted(timer->ratio);
    return ok;
}

// Each step begins only where those before it came to their end.
static bool examine(struct rg_examination *e, struct rg_worker *worker)
{
    rg_probe_name(e->probe);
    e->probed = rg_worker_fetch(worker, RG_CALL_PROBE, NULL, rg_probe_fields, e->probe);
    e->audited = e->probed && audit(worker, &e->timer);
    e->measured = e->audited &&
                  rg_worker_fetch(worker, RG_CALL_CEILINGS, NULL, rg_ceilings_fields, &e->ceilings);
    return e->measured;
}

void rg_doctor_examine(struct rg_examination *examination)
{
    struct rg_device *device = open_device(examination);
    if (!device)
        return;
    const bool ok = examine(examination, rg_remote_worker(device));
    if (!ok)
        fail(examination);
    if (!rg_device_close(device) && ok)
        fail(examination);
    const int failures = examination->probed ? rg_examination_failures(examination) : 0;
    if (examination->status != RG_OK || !failures)
        return;
    examination->status = RG_FAIL;
    snprintf(examination->why, sizeof(examination->why),
             "%d of %d operations that kernels use give other bits than C", failures,
             RG_PROBE_OP_COUNT);
}
