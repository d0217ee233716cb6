#include "harness/compare/shrink/culprit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/console/clock.h"

struct pair {
    struct rg_device *device, *truth;
    struct rg_dispatched now; // the device's results; its inputs are borrowed
    struct rg_dispatched *due;
    double end_ms;
    bool falls; // the device fails; this failure is sought, not a difference
    bool has_failed;
};

// Whether two dispatches have the same bytes in each written slot.
static bool leaves_same(const struct rg_dispatched *a, const struct rg_dispatched *b)
{
    struct rg_slot_info slots[RG_MAX_SLOTS];
    const int count = rg_dispatched_slots(a, slots);
    for (int i = 0; i < count; i++) {
        const int slot = slots[i].slot;
        const struct rg_contents *p = &a->after[slot], *q = &b->after[slot];
        if (p->size != q->size || (p->size && memcmp(p->bytes, q->bytes, p->size) != 0))
            return false;
    }
    return true;
}

// Runs the dispatch on both devices. Whether their results differ, or the device fails as sought.
static bool differs(struct pair *p)
{
    memcpy(&p->now, p->due, offsetof(struct rg_dispatched, after));
    p->has_failed = p->has_failed || !rg_digests_dispatch(p->due, p->truth);
    if (p->has_failed || rg_digests_dispatch(&p->now, p->device))
        return !p->has_failed && !p->falls && !leaves_same(&p->now, p->due);
    p->has_failed = !p->falls || rg_fall_now(p->device).outcome == RG_OK;
    return !p->has_failed;
}

static void forget(struct pair *p)
{
    memset(p->now.before, 0, sizeof(p->now.before)); // owned by the other dispatch
    rg_dispatched_free(&p->now);
}

// --- the fewest items ---

// Halves the items along one axis, keeping either half that still differs, as often as possible.
static void halve(struct pair *p, int *origin, int *extent)
{
    bool keeps = true;
    while (keeps && *extent > 1 && !p->has_failed && rg_now_ms() < p->end_ms) {
        const int first = *origin, whole = *extent, half = whole / 2;
        *extent = half;
        keeps = differs(p);
        if (!keeps) {
            *origin = first + half;
            *extent = whole - half;
            keeps = differs(p);
        }
        if (!keeps) {
            *origin = first;
            *extent = whole;
        }
    }
}

static int64_t items_of(const struct rg_dispatched *d)
{
    return (int64_t)d->extent.width * d->extent.height * d->extent.depth;
}

// --- the smallest inputs ---

enum { LEAST_BYTES = 64, LARGEST_BYTES = 1 << 30 }; // size of a part that is zeroed

// Zeroes a part of an input, and restores it if the difference disappears. False if a device fails,
// as zeroes may cause.
static bool zero_part(struct pair *p, unsigned char *bytes, size_t size)
{
    unsigned char *kept = rg_alloc(size, 1, "a kernel's inputs");
    if (!kept)
        return false;
    memcpy(kept, bytes, size);
    memset(bytes, 0, size);
    const bool keeps = differs(p);
    if (!keeps)
        memcpy(bytes, kept, size);
    free(kept);
    return !p->has_failed;
}

static bool is_zero(const unsigned char *bytes, size_t size)
{
    return !size || (!bytes[0] && !memcmp(bytes, bytes + 1, size - 1));
}

// Zeroes the inputs that no item needs: a whole slot, else its halves, and so on. The largest parts
// come first, so that most is done if time runs out.
static void shrink_inputs(struct pair *p)
{
    bool ok = true;
    for (size_t part = LARGEST_BYTES; ok && part >= LEAST_BYTES; part /= 2)
        for (int slot = 0; ok && slot < RG_MAX_SLOTS; slot++) {
            const struct rg_contents *c = &p->due->before[slot];
            unsigned char *bytes = c->bytes;
            size_t end = part / 2 < c->size ? c->size : 0; // the whole slot is tried once
            for (size_t at = 0; ok && at < end && rg_now_ms() < p->end_ms; at += part) {
                const size_t size = end - at < part ? end - at : part;
                ok = is_zero(bytes + at, size) || zero_part(p, bytes + at, size);
            }
        }
    p->has_failed = false; // it failed only on these inputs
}

// Reduces the items and inputs, then writes the truth's results for them to p->due.
static void shrink_items(struct pair *p, struct rg_culprit *culprit)
{
    struct rg_extent *origin = &p->due->origin, *extent = &p->due->extent;
    culprit->of_items = items_of(p->due);
    halve(p, &origin->depth, &extent->depth);
    halve(p, &origin->height, &extent->height);
    halve(p, &origin->width, &extent->width);
    culprit->items = items_of(p->due);
    shrink_inputs(p);
    culprit->found = differs(p);
}

// --- finding ---

// Whether a kernel packs primitives for a DRAW kernel.
static bool is_packer(const struct rg_kernel *kernel)
{
    const struct rg_kernel *const *all;
    const int count = rg_kernel_all(&all);
    bool packs = false;
    for (int i = 0; !packs && i < count; i++)
        packs = all[i]->draw && (!strcmp(all[i]->draw->count, kernel->name) ||
                                 !strcmp(all[i]->draw->emit, kernel->name));
    return packs;
}

// Whether a device has the packing kernels.
static bool has_packers(const struct rg_device *device)
{
    const struct rg_backend *backend = rg_backend_of(device->backend->name);
    return backend && backend->packed && !device->info.native;
}

static void tell_none(const struct pair *p, const struct rg_blame *blame,
                      const struct rg_dispatches *all, bool is_drawn, struct rg_culprit *culprit)
{
    if (is_drawn && all->count > 1 && !has_packers(p->truth))
        snprintf(culprit->why_not, sizeof(culprit->why_not),
                 "%s draws, and %s has none of the kernels that pack it for %s; to try these, hold "
                 "gl, vulkan or opencl for the truth",
                 blame->first.stage, p->truth->info.name, p->device->info.name);
    else if (is_drawn)
        snprintf(culprit->why_not, sizeof(culprit->why_not),
                 "%s draws: %s; what differs is the drawing itself, which needs raingauge",
                 blame->first.stage,
                 all->count > 1 ? "the kernels that pack it leave what is expected"
                                : "no kernel packs it");
    else
        snprintf(culprit->why_not, sizeof(culprit->why_not),
                 p->falls
                     ? "no kernel of stage %s fails alone: what it needs is between kernels, "
                       "such as their order, barriers or memory"
                     : "no kernel of stage %s leaves other bits alone: what differs is between "
                       "kernels, such as their order, barriers or memory",
                 blame->first.stage);
}

static bool find(struct pair *p, const struct rg_blame *blame, struct rg_dispatches *all,
                 struct rg_culprit *culprit)
{
    bool is_drawn = false, is_other = false;
    for (int i = 0; i < all->count && !is_other && !p->has_failed; i++) {
        is_drawn = is_drawn || !all->rows[i].was_kept;
        p->due = &all->rows[i];
        is_other =
            p->due->was_kept && (has_packers(p->truth) || !is_packer(p->due->kernel)) && differs(p);
    }
    if (is_other) {
        shrink_items(p, culprit);
        culprit->due = *p->due;
        *p->due = (struct rg_dispatched){0};
    }
    if (!p->has_failed && !culprit->found)
        tell_none(p, blame, all, is_drawn, culprit);
    return !p->has_failed;
}

bool rg_culprit_find(const struct rg_digest_run *run, const struct rg_blame *blame,
                     const struct rg_fall *fall, struct rg_device *device, struct rg_device *truth,
                     double end_ms, struct rg_culprit *culprit)
{
    struct rg_digest_run until = *run;
    struct rg_dispatches all = {0};
    struct pair p = {
        .device = device, .truth = truth, .end_ms = end_ms, .falls = fall && fall->outcome};
    *culprit = (struct rg_culprit){0};
    if (!*blame->first.stage) {
        snprintf(culprit->why_not, sizeof(culprit->why_not),
                 "%s differs before the first stage runs; what opening does is not kept",
                 blame->first.asset);
        return true;
    }
    if (blame->first.frame + 1 < run->frames)
        until.frames = (int)blame->first.frame + 1;
    rg_log_hold(p.falls); // how it fails is known already
    const bool ok =
        rg_digests_dispatches(&until, p.falls ? truth : device, blame->first.stages_run, &all) &&
        find(&p, blame, &all, culprit);
    rg_log_hold(false);
    const struct rg_failure failure = rg_failure_take();
    if (!ok && p.falls)
        rg_failure_tell(&failure);
    forget(&p);
    rg_dispatches_free(&all);
    return ok;
}

void rg_culprit_free(struct rg_culprit *culprit)
{
    rg_dispatched_free(&culprit->due);
    *culprit = (struct rg_culprit){0};
}
