#include "tests/harness/verifying/rig.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "tests/tools/instance.h"
#include "tests/tools/process/logged.h"

const struct rg_pose rig_poses[] = {{.set = ""}, {.set = NULL}};
const struct rg_law rig_no_laws[] = {{NULL, NULL}};
static const struct rg_proof proof = {
    .poses = rig_poses, .dry = "drops=0 rain_drops_s=0 pane_rain_mm_h=0", .laws = rig_no_laws};
struct rg_technique rig_flow;
enum rg_verify_length rig_length;
int rig_steps;
void (*rig_part)(struct rg_verify *verify);

int rig_setup(void **state)
{
    (void)state;
    rig_flow = *rg_technique_find("flow");
    rig_flow.proof = &proof;
    rig_length = RG_VERIFY_USUAL;
    rig_steps = 2;
    rig_part = rg_verify_devices;
    return 0;
}

void rig_verify(const char *assignments, enum rg_tier tier, int width, int height,
                struct rg_checks *checks)
{
    void *settings = settings_of("flow", "", assignments);
    struct rg_devices devices = {.count = 1, .devices = {rg_device_open("cpu")}};
    struct rg_device *reference = rg_device_open("cpu:reference");
    devices.devices[0]->info.tier = tier;
    struct rg_progress progress;
    struct rg_verify v = {.technique = &rig_flow,
                          .settings = settings,
                          .width = width,
                          .height = height,
                          .length = rig_length,
                          .steps = rig_steps,
                          .reference = reference,
                          .devices = &devices,
                          .checks = checks,
                          .progress = &progress};
    *checks = (struct rg_checks){0};
    rg_checks_add(checks, "another", "state", "cpu", RG_OK, "well");
    rg_log_listen(log_last, NULL);
    rg_progress_start(&progress, rg_verify_device_work(&v));
    rig_part(&v);
    rg_progress_end(&progress);
    rg_log_listen(NULL, NULL);
    assert_true(rg_device_close(reference));
    assert_true(rg_device_close(devices.devices[0]));
    free(settings);
}

const struct rg_check *rig_check(const struct rg_checks *checks, const char *check,
                                 const char *device)
{
    for (int i = 1; i < checks->count; i++)
        if (!strcmp(checks->rows[i].check, check) && !strcmp(checks->rows[i].device, device))
            return &checks->rows[i];
    fail_msg("no check %s on %s", check, device);
    return NULL;
}

enum rg_outcome rig_outcome(const struct rg_checks *checks, const char *check, const char *device)
{
    return rig_check(checks, check, device)->status;
}
