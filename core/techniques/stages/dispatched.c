#include "core/techniques/stages/dispatched.h"

#include <stdlib.h>
#include <string.h>

#include "core/device/device.h"

// --- taking ---

// A buffer that kernels share may end within an element, which no kernel reads.
static bool read_slot(const struct rg_slot_info *slot, const struct rg_binding *bound,
                      struct rg_contents *contents)
{
    const struct rg_asset asset = {.buf = bound->buf, .image = bound->image};
    const bool ok = rg_contents_read(&asset, contents);
    if (bound->buf)
        contents->size -= contents->size % (size_t)slot->element_size;
    return ok;
}

bool rg_dispatched_before(const struct rg_pass *pass, const struct rg_run *run,
                          struct rg_dispatched *d)
{
    const struct rg_kernel *kernel = pass->kernel;
    bool ok = true;
    *d = (struct rg_dispatched){
        .kernel = kernel, .was_kept = !kernel->draw, .origin = run->origin, .extent = run->extent};
    if (!d->was_kept)
        return true;
    memcpy(d->params, run->params, (size_t)kernel->params_size);
    for (int i = 0; ok && i < kernel->slot_count; i++) {
        const struct rg_slot_info *slot = &kernel->slots[i];
        ok = read_slot(slot, &run->slots[slot->slot], &d->before[slot->slot]);
    }
    return ok;
}

bool rg_dispatched_after(const struct rg_run *run, struct rg_dispatched *d)
{
    bool ok = true;
    for (int i = 0; ok && d->was_kept && i < d->kernel->slot_count; i++) {
        const struct rg_slot_info *slot = &d->kernel->slots[i];
        if (rg_slot_is_written(slot->kind))
            ok = read_slot(slot, &run->slots[slot->slot], &d->after[slot->slot]);
    }
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

bool rg_dispatched_run(struct rg_dispatched *d, struct rg_device *device)
{
    struct rg_run run = {.params = d->params, .origin = d->origin, .extent = d->extent};
    struct rg_pass *pass = rg_pass_create(device, d->kernel->name);
    bool ok = pass != NULL;
    for (int i = 0; ok && i < d->kernel->slot_count; i++) {
        const struct rg_slot_info *slot = &d->kernel->slots[i];
        ok = make_slot(device, slot, &d->before[slot->slot], &run.slots[slot->slot]);
    }
    ok = ok && rg_pass_run(pass, &run) && rg_dispatched_after(&run, d);
    rg_pass_destroy(pass);
    for (int i = 0; i < RG_MAX_SLOTS; i++) {
        rg_buf_destroy(run.slots[i].buf);
        rg_image_destroy(run.slots[i].image);
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
