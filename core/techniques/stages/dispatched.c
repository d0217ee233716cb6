#include "core/techniques/stages/dispatched.h"

#include <stdlib.h>
#include <string.h>

#include "core/device/device.h"
#include "kernels/dialect/draw/state.h"

// --- slots ---

int rg_dispatched_slots(const struct rg_dispatched *d, struct rg_slot_info slots[RG_MAX_SLOTS])
{
    const rg_draw_state *state = (const rg_draw_state *)(const void *)d->params;
    int count = d->kernel->slot_count;
    memcpy(slots, d->kernel->slots, (size_t)count * sizeof(*slots));
    if (d->kernel->draw && d->has_depth)
        slots[count++] = (struct rg_slot_info){
            .name = "depth",
            .slot = RG_SLOT_DEPTH,
            .kind = state->depth_mode == RG_DEPTH_WRITE ? RG_SLOT_OUT_IMAGE : RG_SLOT_IMAGE,
            .format = RG_D32F};
    if (d->kernel->draw && d->has_colour)
        slots[count++] = (struct rg_slot_info){.name = "colour",
                                               .slot = RG_SLOT_COLOUR,
                                               .kind = RG_SLOT_OUT_IMAGE,
                                               .format = RG_RGBA8};
    return count;
}

// --- taking ---

static struct rg_binding bound_to(const struct rg_run *run, int slot)
{
    if (run->draw && slot == RG_SLOT_COLOUR)
        return (struct rg_binding){.image = run->draw->colour};
    if (run->draw && slot == RG_SLOT_DEPTH)
        return (struct rg_binding){.image = run->draw->depth};
    return run->slots[slot];
}

// A buffer that kernels share may end within an element, which no kernel reads.
static bool read_slot(const struct rg_slot_info *slot, const struct rg_run *run,
                      struct rg_contents *contents)
{
    const struct rg_binding bound = bound_to(run, slot->slot);
    const struct rg_asset asset = {.buf = bound.buf, .image = bound.image};
    const bool ok = rg_contents_read(&asset, contents);
    if (bound.buf)
        contents->size -= contents->size % (size_t)slot->element_size;
    return ok;
}

// Whether a run can be made again from its slots: of draws those whose items the driver sets up.
static bool can_be_kept(const struct rg_pass *pass, const struct rg_run *run)
{
    return !pass->kernel->draw ||
           (pass->device->info.native && !run->packed && !run->draw->samples);
}

static void keep_draw(const struct rg_draw *draw, struct rg_dispatched *d)
{
    d->has_colour = draw->colour;
    d->has_depth = draw->depth && draw->depth_mode != RG_DEPTH_OFF;
    d->layer = draw->layer;
    d->level = draw->level;
}

bool rg_dispatched_before(const struct rg_pass *pass, const struct rg_run *run,
                          struct rg_dispatched *d)
{
    const struct rg_kernel *kernel = pass->kernel;
    struct rg_slot_info slots[RG_MAX_SLOTS];
    bool ok = true;
    *d = (struct rg_dispatched){.kernel = kernel,
                                .was_kept = can_be_kept(pass, run),
                                .origin = run->origin,
                                .extent = run->extent};
    if (!d->was_kept)
        return true;
    memcpy(d->params, run->params,
           (size_t)(kernel->draw ? kernel->draw->call_size : kernel->params_size));
    if (run->draw)
        keep_draw(run->draw, d);
    const int count = rg_dispatched_slots(d, slots);
    for (int i = 0; ok && i < count; i++)
        ok = read_slot(&slots[i], run, &d->before[slots[i].slot]);
    return ok;
}

bool rg_dispatched_after(const struct rg_run *run, struct rg_dispatched *d)
{
    struct rg_slot_info slots[RG_MAX_SLOTS];
    const int count = d->was_kept ? rg_dispatched_slots(d, slots) : 0;
    bool ok = true;
    for (int i = 0; ok && i < count; i++)
        if (rg_slot_is_written(slots[i].kind))
            ok = read_slot(&slots[i], run, &d->after[slots[i].slot]);
    return ok;
}

// --- running again ---

static bool make_slot(struct rg_device *device, const struct rg_slot_info *slot,
                      const struct rg_contents *before, struct rg_binding *bound)
{
    if (!before->desc.levels)
        return (bound->buf = rg_buf_create_with(device, before->bytes, (int64_t)before->size,
                                                slot->name)) != NULL;
    return (bound->image = rg_image_create(device, &before->desc, slot->name)) &&
           rg_contents_write(before, bound->image);
}

static void free_contents(struct rg_contents contents[RG_MAX_SLOTS])
{
    for (int i = 0; i < RG_MAX_SLOTS; i++)
        rg_contents_free(&contents[i]);
}

static struct rg_draw draw_of(const struct rg_dispatched *d, const struct rg_binding *bound)
{
    const rg_draw_state *state = (const rg_draw_state *)(const void *)d->params;
    return (struct rg_draw){
        .colour = d->has_colour ? bound[RG_SLOT_COLOUR].image : NULL,
        .depth = d->has_depth ? bound[RG_SLOT_DEPTH].image : NULL,
        .layer = d->layer,
        .level = d->level,
        .blend = (enum rg_blend)state->blend,
        .depth_mode = (enum rg_depth_mode)state->depth_mode,
        .cull = (enum rg_cull)state->cull,
        .x0 = state->x0,
        .y0 = state->y0,
        .x1 = state->x1,
        .y1 = state->y1,
    };
}

bool rg_dispatched_run(struct rg_dispatched *d, struct rg_device *device)
{
    struct rg_run run = {.params = d->params, .origin = d->origin, .extent = d->extent};
    struct rg_binding bound[RG_MAX_SLOTS] = {{0}};
    struct rg_slot_info slots[RG_MAX_SLOTS];
    const int count = rg_dispatched_slots(d, slots);
    struct rg_pass *pass = rg_pass_create(device, d->kernel->name);
    bool ok = pass != NULL;
    for (int i = 0; ok && i < count; i++) {
        const int slot = slots[i].slot;
        ok = make_slot(device, &slots[i], &d->before[slot], &bound[slot]);
        if (i < d->kernel->slot_count)
            run.slots[slot] = bound[slot];
    }
    const struct rg_draw draw = draw_of(d, bound);
    if (d->kernel->draw) {
        run.params = d->params + sizeof(rg_draw_state);
        run.draw = &draw;
    }
    ok = ok && rg_pass_run(pass, &run) && rg_dispatched_after(&run, d);
    rg_pass_destroy(pass);
    for (int i = 0; i < RG_MAX_SLOTS; i++) {
        rg_buf_destroy(bound[i].buf);
        rg_image_destroy(bound[i].image);
    }
    return ok;
}

void rg_dispatched_free(struct rg_dispatched *d)
{
    free_contents(d->before);
    free_contents(d->after);
    *d = (struct rg_dispatched){0};
}

void rg_dispatches_free(struct rg_dispatches *dispatches)
{
    for (int i = 0; i < dispatches->count; i++)
        rg_dispatched_free(&dispatches->rows[i]);
    free(dispatches->rows);
    *dispatches = (struct rg_dispatches){0};
}
