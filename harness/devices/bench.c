#include "harness/devices/bench.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "harness/frames/frame.h"

// --- what was opened with what ---

static bool is_same(const struct rg_bench_subject *a, const struct rg_bench_subject *b)
{
    return a->settings && a->technique == b->technique && a->width == b->width &&
           a->height == b->height &&
           !memcmp(a->settings, b->settings, a->technique->params->settings_size);
}

// A subject with settings of its own. False, with one logged line, without memory.
static bool own_subject(struct rg_bench_subject *own, const struct rg_bench_subject *subject)
{
    *own = *subject;
    own->settings = rg_settings_copy(subject->technique, subject->settings, "");
    return own->settings != NULL;
}

static void free_subject(struct rg_bench_subject *own)
{
    free((void *)own->settings);
    *own = (struct rg_bench_subject){0};
}

// --- devices ---

struct rg_device *rg_bench_device(struct rg_bench *bench, const char *name)
{
    for (int i = 0; i < bench->devices->count; i++)
        if (!strcmp(bench->devices->devices[i]->info.name, name))
            return bench->devices->devices[i];
    struct rg_device **own = bench->own;
    while (*own && strcmp((*own)->info.name, name) && own < bench->own + RG_BENCH_OWN_DEVICES - 1)
        own++;
    if (!*own)
        *own = rg_device_open(name, NULL);
    return *own;
}

// --- instances ---

// Where the instance of a device is kept, or will be: there is a place for each.
static struct rg_kept *kept_on(struct rg_bench *bench, const struct rg_device *device)
{
    struct rg_kept *kept = bench->kept;
    while (kept->instance && kept->instance->device != device)
        kept++;
    return kept;
}

static void close_kept(struct rg_kept *kept)
{
    if (kept->instance)
        kept->instance->technique->destroy(kept->instance);
    free_subject(&kept->of);
    kept->instance = NULL;
}

void rg_bench_keep(struct rg_bench *bench, struct rg_instance *instance)
{
    struct rg_kept *kept = kept_on(bench, instance->device);
    close_kept(kept);
    kept->instance = instance;
}

struct rg_instance *rg_bench_open(struct rg_bench *bench, struct rg_device *device,
                                  const struct rg_bench_subject *subject)
{
    struct rg_kept *kept = kept_on(bench, device);
    if (kept->instance && is_same(&kept->of, subject))
        return kept->instance;
    struct rg_instance *instance =
        subject->technique->create(device, subject->settings, subject->width, subject->height);
    if (!instance)
        return NULL;
    rg_bench_keep(bench, instance);
    return own_subject(&kept->of, subject) ? instance : NULL;
}

// --- truths ---

static bool draw_truth(struct rg_bench *bench, const struct rg_bench_subject *subject, int frames,
                       struct rg_picture *picture)
{
    struct rg_device *device = rg_bench_device(bench, "cpu");
    struct rg_instance *instance = device
                                       ? rg_frame_run(subject->technique, subject->settings, device,
                                                      subject->width, subject->height, frames)
                                       : NULL;
    if (!instance)
        return false;
    const bool ok = rg_frame_read_picture(instance, picture);
    rg_bench_keep(bench, instance);
    return ok;
}

const struct rg_picture *rg_bench_truth(struct rg_bench *bench,
                                        const struct rg_bench_subject *subject, int frames)
{
    for (int i = 0; i < RG_BENCH_TRUTHS; i++)
        if (bench->truths[i].frames == frames && is_same(&bench->truths[i].of, subject))
            return &bench->truths[i].picture;
    struct rg_truth *truth = &bench->truths[bench->truth_count % RG_BENCH_TRUTHS];
    rg_picture_destroy(&truth->picture);
    free_subject(&truth->of);
    *truth = (struct rg_truth){.frames = frames};
    if (!draw_truth(bench, subject, frames, &truth->picture) || !own_subject(&truth->of, subject))
        return NULL;
    bench->truth_count++;
    return &truth->picture;
}

bool rg_bench_free(struct rg_bench *bench)
{
    bool clean = true;
    for (int i = 0; i < RG_MAX_DEVICES + RG_BENCH_OWN_DEVICES; i++)
        close_kept(&bench->kept[i]);
    for (int i = 0; i < RG_BENCH_TRUTHS; i++) {
        rg_picture_destroy(&bench->truths[i].picture);
        free_subject(&bench->truths[i].of);
    }
    for (int i = 0; i < RG_BENCH_OWN_DEVICES; i++)
        if (bench->own[i])
            clean = rg_device_close(bench->own[i]) && clean;
    *bench = (struct rg_bench){.devices = bench->devices};
    return clean;
}
