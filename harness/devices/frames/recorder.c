// Records digests of a run in this process.
#include "harness/devices/frames/recorder.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/array.h"
#include "core/base/log.h"
#include "core/techniques/stages/stages.h"
#include "harness/console/interrupt.h"

// State of a recorded run.
struct recorder {
    struct rg_instance *instance;
    struct rg_digests *digests;
    uint64_t last[RG_MAX_ASSETS]; // by asset
    bool seen[RG_MAX_ASSETS];
    int stages_run;
    int64_t weight; // as in struct rg_digest
    bool ok;
    // If a row's contents are wanted: the row, and their destination.
    int wanted; // -1: none
    struct rg_contents *contents;
    struct rg_state *state;
    // If a stage's dispatches are wanted: the stage, and their destination.
    int watched; // its number from 1 on; 0: none
    struct rg_dispatches *dispatches;
};

static bool add(struct rg_digests *digests, const struct rg_digest *digest)
{
    if (!rg_array_fit(&digests->rows, &digests->room, digests->count + 1, sizeof(*digests->rows),
                      "digests"))
        return false;
    digests->rows[digests->count++] = *digest;
    return true;
}

// Whether an asset has a digest: it exists, has been written, and is not another name of an earlier
// asset.
static bool is_own(const struct rg_instance *instance, int asset)
{
    const struct rg_asset *a = &instance->assets[asset];
    for (int i = 0; i < asset; i++)
        if (instance->assets[i].buf == a->buf && instance->assets[i].image == a->image)
            return false;
    return a->is_defined && (a->buf || a->image);
}

static void keep_state(struct recorder *r, const struct rg_opened_stage *stage,
                       const struct rg_asset *asset)
{
    for (int i = 0; i < r->instance->state_count; i++)
        if (r->instance->state[i].asset == asset)
            *r->state = r->instance->state[i];
    r->state->words = rg_asset_words(r->instance, stage, asset);
}

// Records an asset. A lent one that no stage writes is read only once, because it cannot change.
static void record(struct recorder *r, const struct rg_opened_stage *stage, int at)
{
    const struct rg_asset *asset = &r->instance->assets[at];
    const bool wrote = stage && rg_stage_wrote(stage, asset);
    struct rg_contents now = {0};
    if (!is_own(r->instance, at) || (!wrote && r->seen[at] && !asset->is_owned))
        return;
    r->ok = r->ok && rg_contents_read(asset, &now);
    const uint64_t hash = r->ok ? rg_contents_hash(&now) : 0;
    r->weight += r->seen[at] ? 0 : (int64_t)now.size / 4;
    if (r->ok && (wrote || !r->seen[at] || hash != r->last[at])) {
        struct rg_digest digest = {.frame = r->instance->frame,
                                   .stages_run = r->stages_run,
                                   .hash = hash,
                                   .weight = r->weight};
        strncat(digest.stage, stage ? stage->row.kernel : "", RG_ASSET_NAME - 1);
        strncat(digest.asset, asset->name, RG_ASSET_NAME - 1);
        if (r->digests->count == r->wanted) {
            *r->contents = now;
            now = (struct rg_contents){0};
            keep_state(r, wrote ? stage : NULL, asset);
        }
        r->ok = add(r->digests, &digest);
    }
    r->seen[at] = true;
    r->last[at] = hash;
    rg_contents_free(&now);
}

static void after_stage(const struct rg_opened_stage *stage, void *user)
{
    struct recorder *r = user;
    r->stages_run++;
    r->weight += (int64_t)stage->ran.width * stage->ran.height * stage->ran.depth;
    if (r->watched)
        return;
    for (int i = 0; r->ok && i < r->instance->asset_count; i++)
        record(r, stage, i);
}

static bool run_recorded(const struct rg_digest_run *run, struct rg_device *device,
                         struct recorder *r)
{
    const struct rg_subject *subject = &run->subject;
    const struct rg_technique *technique = subject->technique;
    r->instance =
        rg_instance_open(technique, device, subject->settings, subject->width, subject->height);
    r->ok = r->instance != NULL;
    for (int i = 0; r->ok && !r->watched && i < r->instance->asset_count; i++)
        record(r, NULL, i); // contents from opening
    if (r->instance) {
        r->instance->after_stage = after_stage;
        r->instance->user = r;
    }
    // An interruption ends a run of digests, but not a search for one row or stage.
    const bool may_end = r->wanted < 0 && !r->watched;
    for (int i = 0; r->ok && i < run->frames && !(may_end && rg_interrupted()); i++)
        r->ok = technique->step(r->instance) && technique->draw(r->instance) && r->ok;
    rg_instance_close(r->instance);
    return r->ok;
}

bool rg_recorder_take(const struct rg_digest_run *run, struct rg_device *device,
                      struct rg_digests *digests)
{
    struct recorder r = {.digests = digests, .wanted = -1};
    return run_recorded(run, device, &r);
}

bool rg_recorder_contents(const struct rg_digest_run *run, struct rg_device *device, int row,
                          struct rg_contents *contents, struct rg_state *state)
{
    struct rg_digests digests = {0};
    struct recorder r = {.digests = &digests, .wanted = row, .contents = contents, .state = state};
    const bool ok = run_recorded(run, device, &r);
    rg_digests_free(&digests);
    return ok && (contents->bytes ||
                  rg_error("%s: a second run on %s has not come as far as the first; run again",
                           run->subject.technique->name, device->info.name));
}

// --- dispatches ---

static bool is_watched(const struct recorder *r)
{
    return r->ok && r->stages_run == r->watched - 1;
}

static void before_dispatch(const struct rg_pass *pass, const struct rg_run *run, void *user)
{
    struct recorder *r = user;
    struct rg_dispatches *all = r->dispatches;
    if (!is_watched(r))
        return;
    r->ok = rg_array_fit(&all->rows, &all->room, all->count + 1, sizeof(*all->rows), "dispatches");
    if (r->ok)
        r->ok = rg_dispatched_before(pass, run, &all->rows[all->count++]);
}

static void after_dispatch(const struct rg_pass *pass, const struct rg_run *run, void *user)
{
    struct recorder *r = user;
    (void)pass;
    if (is_watched(r))
        r->ok = rg_dispatched_after(run, &r->dispatches->rows[r->dispatches->count - 1]);
}

bool rg_recorder_dispatches(const struct rg_digest_run *run, struct rg_device *device,
                            int stages_run, struct rg_dispatches *dispatches)
{
    struct rg_digests digests = {0};
    struct recorder r = {
        .digests = &digests, .wanted = -1, .watched = stages_run, .dispatches = dispatches};
    const struct rg_watch watch = {before_dispatch, after_dispatch, &r};
    rg_device_watch(device, &watch);
    const bool ok = run_recorded(run, device, &r);
    rg_device_watch(device, NULL);
    rg_digests_free(&digests);
    return ok;
}

void *rg_recorder_code(struct rg_device *device, const struct rg_kernel *kernel,
                       enum rg_code_kind kind, size_t *size)
{
    struct rg_kernel_code code;
    if (!rg_kernel_code(kernel, kind, rg_device_ways(device, kernel), &code))
        return NULL;
    if (!code.size)
        return rg_unsupported_null("kernel '%s': this build has no code of it for drivers; build "
                                   "raingauge with -Ddrivers=true",
                                   kernel->name);
    *size = code.size;
    return code.bytes;
}

void rg_digests_free(struct rg_digests *digests)
{
    free(digests->rows);
    *digests = (struct rg_digests){0};
}
