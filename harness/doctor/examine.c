// Examining devices, each in a child process.
#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/devices/child.h"
#include "harness/doctor/report.h"

// A probe of a software driver takes seconds; compilers under a sanitizer or a loaded machine more.
enum { EXAMINE_TIMEOUT_S = 180 };

int rg_examination_failures(const struct rg_examination *examination)
{
    int failures = 0;
    for (int i = 0; i < RG_PROBE_COUNT; i++)
        failures += !examination->probe[i].builtin && examination->probe[i].different > 0;
    return failures;
}

// The child writes what it is about to do, so that a crash shows what it happened in.
static void begin(struct rg_examination *examination, const char *step)
{
    snprintf(examination->why, sizeof(examination->why), "%s", step);
}

// Ends it with the last error.
static void fail(struct rg_examination *examination)
{
    examination->status = rg_outcome_of_error();
    snprintf(examination->why, sizeof(examination->why), "%.500s", rg_last_error());
}

static struct rg_device *open_device(struct rg_examination *examination)
{
    begin(examination, "opening the device");
    struct rg_device *device = rg_device_open(examination->info.name);
    if (!device) {
        fail(examination);
        examination->is_unknown = rg_last_error_kind() == RG_ERROR_INPUT;
        return NULL;
    }
    examination->info = device->info;
    examination->opened = true;
    return device;
}

static void examine(void *answer)
{
    struct rg_examination *examination = answer;
    struct rg_device *device = open_device(examination);
    if (!device)
        return;
    begin(examination, "probing its arithmetic");
    examination->probed = rg_probe_run(device, examination->probe);
    if (!examination->probed) {
        fail(examination);
        return;
    }
    const int failures = rg_examination_failures(examination);
    begin(examination, "auditing its timer");
    examination->audited = rg_timer_audit(device, &examination->timer);
    if (examination->audited) {
        begin(examination, "measuring its ceilings");
        examination->measured = rg_ceilings_measure(device, &examination->ceilings);
    }
    if (!examination->measured || !rg_device_close(device)) {
        fail(examination);
        return;
    }
    examination->status = failures ? RG_FAIL : RG_OK;
    examination->why[0] = 0;
    if (failures)
        snprintf(examination->why, sizeof(examination->why),
                 "%d of %d operations that kernels use give other bits than C", failures,
                 RG_PROBE_OP_COUNT);
}

void rg_doctor_examine(struct rg_examination *examination)
{
    char why[256];
    struct rg_examination *answer = rg_child_answer_create(sizeof(*answer));
    if (!answer) {
        fail(examination);
        return;
    }
    *answer = (struct rg_examination){.info = examination->info};
    const enum rg_outcome end = rg_child_run(examine, answer, EXAMINE_TIMEOUT_S, why, sizeof(why));
    *examination = *answer;
    rg_child_answer_destroy(answer, sizeof(*answer));
    if (end == RG_OK)
        return;
    char step[64];
    snprintf(step, sizeof(step), "%.60s", examination->why);
    examination->status = end;
    snprintf(examination->why, sizeof(examination->why), "%s%s%s", step, *step ? ": " : "", why);
}
