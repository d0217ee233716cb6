// Finds the first stage after which an asset's bits differ from cpu:reference's, where, and by how
// much. Runs a few frames of each pose, since it reads every asset after every stage.
#include <stdio.h>
#include <stdlib.h>

#include "core/base/log.h"
#include "core/device/device.h"
#include "harness/compare/blame/blame.h"
#include "harness/compare/verify/verify.h"
#include "harness/console/exit.h"
#include "harness/devices/frames/digests.h"

int64_t rg_verify_stage_work(const struct rg_verify *v)
{
    return (int64_t)rg_verify_poses(v) * (v->devices->count + 1);
}

static void blame(struct rg_verify *v, const struct rg_digest_run *run, struct rg_device *device,
                  const char *pose, const struct rg_digests *now, const struct rg_digests *expected)
{
    const bool is_exact = rg_tier_owed(&device->info, &v->reference->info) == RG_T0;
    struct rg_blame blame;
    rg_blame_row(run, device, v->reference, now, expected, &blame); // the text reports a failure
    rg_checks_add(v->checks, run->subject.technique->name, "stages", device->info.name,
                  is_exact ? RG_FAIL : RG_OK, "%s%s%s", pose, *pose ? ": " : "", blame.text);
}

static void compare(struct rg_verify *v, const struct rg_digest_run *run, struct rg_device *device,
                    const char *pose, const struct rg_digests *expected)
{
    struct rg_digests now = {0};
    rg_progress_label(v->progress, "%s: stages on %s", run->subject.technique->name,
                      device->info.name);
    const bool ok = rg_digests_take(run, device, &now);
    if (!ok)
        rg_checks_add_error(v->checks, run->subject.technique->name, "stages", device->info.name);
    else if (rg_blame_first(&now, expected) < 0)
        rg_checks_add(v->checks, run->subject.technique->name, "stages", device->info.name, RG_OK,
                      "%s%s%d frames, %d digests of assets after %d stages, as on %s", pose,
                      *pose ? ": " : "", run->frames, now.count,
                      now.count ? now.rows[now.count - 1].stages_run : 0, v->reference->info.name);
    else
        blame(v, run, device, pose, &now, expected);
    rg_digests_free(&now);
    rg_progress_add(v->progress, 1);
}

static void verify_pose(struct rg_verify *v, const struct rg_pose *pose)
{
    void *settings = rg_settings_copy(v->technique, v->settings, pose->set);
    const struct rg_digest_run run = {{v->technique, settings, v->width, v->height},
                                      rg_verify_steps(v, pose)};
    struct rg_digests expected = {0};
    const bool ok = settings && rg_digests_take(&run, v->reference, &expected);
    if (!ok) {
        v->checks->exit = rg_exit_worse(v->checks->exit, rg_exit_of_error());
        rg_checks_add_error(v->checks, v->technique->name, "stages", v->reference->info.name);
    }
    for (int i = 0; ok && i < v->devices->count; i++)
        if (v->devices->devices[i] != v->reference)
            compare(v, &run, v->devices->devices[i], pose->set, &expected);
    rg_progress_add(v->progress, 1);
    rg_digests_free(&expected);
    free(settings);
}

void rg_verify_stages(struct rg_verify *v)
{
    for (const struct rg_pose *pose = v->technique->proof->poses; pose->set; pose++)
        if (rg_verify_steps(v, pose) != RG_POSE_LEFT_OUT)
            verify_pose(v, pose);
}
