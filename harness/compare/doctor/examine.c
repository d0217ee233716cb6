// Examines devices, each in a worker.
#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/doctor/doctor.h"
#include "harness/devices/devices.h"
#include "harness/devices/measure/serving/messages.h"
#include "harness/devices/workers/device.h"

int rg_examination_failures(const struct rg_examination *examination)
{
    int failures = 0;
    for (int i = 0; i < RG_PROBE_COUNT; i++)
        failures += !examination->probe[i].builtin && examination->probe[i].different > 0;
    return failures;
}

// Ends the examination with the failure that was just met.
static void fail(struct rg_examination *examination)
{
    const struct rg_failure failure = rg_failure_take();
    examination->status = failure.outcome;
    examination->is_unknown = !examination->opened && failure.fault == RG_FAULT_INPUT;
    snprintf(examination->why, sizeof(examination->why), "%.500s", failure.line);
}

static struct rg_device *open_device(struct rg_examination *examination)
{
    struct rg_device *device = rg_devices_open_one(examination->info.name);
    if (!device) {
        fail(examination);
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

// Each step begins only if the earlier ones succeeded.
static bool examine(struct rg_examination *e, struct rg_worker *worker)
{
    rg_probe_name(e->probe);
    e->probed = rg_worker_fetch(worker, RG_CALL_PROBE, NULL, rg_probe_fields, e->probe);
    e->drawn =
        e->probed && rg_worker_fetch(worker, RG_CALL_DRAWING, NULL, rg_drawing_fields, &e->drawing);
    e->audited = e->drawn && audit(worker, &e->timer);
    e->measured = e->audited &&
                  rg_worker_fetch(worker, RG_CALL_CEILINGS, NULL, rg_ceilings_fields, &e->ceilings);
    return e->measured;
}

// Judges the device's computations and drawings.
static void judge(struct rg_examination *e)
{
    const int failures = e->probed ? rg_examination_failures(e) : 0;
    if (failures)
        snprintf(e->why, sizeof(e->why),
                 "%d of %d operations that kernels use give other bits than C", failures,
                 RG_PROBE_OP_COUNT);
    for (int i = 0; !*e->why && i < e->drawing.count; i++)
        if (!rg_drawn_is_well(&e->drawing.formats[i], e->info.tier))
            snprintf(e->why, sizeof(e->why),
                     "%d of %d pixels drawn into %s, with depth and blending, are not what "
                     "cpu:reference draws",
                     e->drawing.formats[i].differing, RG_DRAWING_PIXELS,
                     rg_format_name(e->drawing.formats[i].format));
    e->status = *e->why ? RG_FAIL : RG_OK;
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
    if (examination->status == RG_OK)
        judge(examination);
}
