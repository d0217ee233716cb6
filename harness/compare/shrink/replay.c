// Replays a case on one device, and compares the result with the expected one.
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/shrink/case.h"
#include "harness/console/exit.h"

static const char mend[] = "write one anew with `raingauge shrink`";

// The last of the first `stages_run` stages; NULL: there are fewer.
static const char *stage_behind(const struct rg_digests *digests, int stages_run)
{
    for (int row = 0; row < digests->count; row++)
        if (digests->rows[row].stages_run == stages_run)
            return *digests->rows[row].stage ? digests->rows[row].stage : "-";
    return NULL;
}

static bool knows_asset(const struct rg_digests *digests, const char *asset)
{
    for (int row = 0; row < digests->count; row++)
        if (!strcmp(digests->rows[row].asset, asset))
            return true;
    return false;
}

// Whether this version has the case's stage and asset. They are raingauge's own, so a case of
// another version says nothing about a device.
static bool is_of_this_version(const struct rg_case *c, const char *path,
                               const struct rg_digests *digests)
{
    const char *stage = stage_behind(digests, c->stages_run);
    if (!stage)
        return rg_error("%s: there are fewer than %d stages here; %s", path, c->stages_run, mend);
    if (strcmp(stage, c->stage) != 0)
        return rg_error("%s: stage %d is '%s' here, and not '%s'; %s", path, c->stages_run, stage,
                        c->stage, mend);
    return knows_asset(digests, c->asset) ||
           rg_error("%s: there is no asset '%s' here; %s", path, c->asset, mend);
}

static int tell(const struct rg_case *c, const struct rg_digests *digests, const char *device)
{
    int row = 0;
    while (row < digests->count && (digests->rows[row].stages_run != c->stages_run ||
                                    strcmp(digests->rows[row].asset, c->asset) != 0))
        row++;
    if (row == digests->count) {
        printf("other: %s leaves no %s after stage %d\n", device, c->asset, c->stages_run);
        return RG_EXIT_FAIL;
    }
    const uint64_t hash = digests->rows[row].hash;
    const bool is_same = hash == c->expected;
    printf("%s: %s leaves %016" PRIx64 " in %s after stage %s; expected %016" PRIx64 "%s\n",
           is_same ? "same" : "other", device, hash, c->asset, c->stage, c->expected,
           hash == c->found && !is_same ? ", as was found" : "");
    return is_same ? RG_EXIT_PASS : RG_EXIT_FAIL;
}

// Prints how the device failed; the error's line has been logged already.
static void tell_fall(const struct rg_case *c, struct rg_device *device)
{
    const struct rg_fall fall = rg_fall_now(device);
    if (fall.outcome)
        printf("other: %s: %s %s%s\n", device->info.name, rg_outcome_name(fall.outcome), fall.what,
               rg_fall_is_same(&fall, &c->fall) ? ", as was found" : "");
}

int rg_case_replay(const struct rg_case *c, const char *path, struct rg_device *device)
{
    struct rg_digests digests = {0};
    int exit;
    if (!rg_digests_take(&c->run, device, &digests)) {
        exit = rg_exit_of_error();
        tell_fall(c, device);
    } else if (is_of_this_version(c, path, &digests))
        exit = tell(c, &digests, device->info.name);
    else
        exit = rg_exit_of_error();
    rg_digests_free(&digests);
    return exit;
}
