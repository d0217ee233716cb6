#include "core/device/grid.h"

#include <limits.h>

#include "core/base/alloc.h"
#include "core/base/doing.h"
#include "core/base/log.h"
#include "core/device/limits.h"
#include "core/device/targets.h"
#include "core/device/work.h"

// --- passes ---

struct rg_pass *rg_grid_create(struct rg_device *device, const char *name)
{
    const struct rg_kernel *kernel = rg_kernel_find(name);
    require_or_null(kernel, "kernel '%s': unknown; kernels/meson.build lists them", name);
    if (!rg_limits_allow_kernel(&device->info, kernel))
        return NULL;
    rg_doing_begin("compiling kernel", name);
    const bool counted = device->work->room == RG_ROOM_COUNTED;
    struct rg_pass *pass =
        counted ? rg_alloc(1, sizeof(*pass), name) : device->backend->pass_create(device, kernel);
    if (!pass)
        return NULL;
    pass->is_counted = counted;
    pass->device = device;
    pass->kernel = kernel;
    device->work->live_passes++;
    return pass;
}

void rg_grid_destroy(struct rg_pass *pass)
{
    if (!pass)
        return;
    rg_work_settle(pass->device);
    pass->device->work->live_passes--;
    if (pass->is_counted)
        free(pass);
    else
        pass->device->backend->pass_destroy(pass);
}

// --- checks ---

static bool is_buffer(enum rg_slot_kind kind)
{
    return kind < RG_SLOT_IMAGE;
}

static bool check_slot(const struct rg_pass *pass, const struct rg_slot_info *slot,
                       const struct rg_binding *bound)
{
    const char *kernel = pass->kernel->name;
    if (is_buffer(slot->kind)) {
        require(bound->buf && !bound->image, "kernel '%s': slot %d, '%s', wants a buffer", kernel,
                slot->slot, slot->name);
        require(bound->buf->device == pass->device,
                "kernel '%s': buffer '%s' belongs to another device", kernel, bound->buf->name);
        require(bound->buf->size % (size_t)slot->element_size == 0,
                "kernel '%s': buffer '%s' of %zu bytes holds no whole number of elements of %d",
                kernel, bound->buf->name, bound->buf->size, slot->element_size);
        return true;
    }
    require(bound->image && !bound->buf, "kernel '%s': slot %d, '%s', wants an image", kernel,
            slot->slot, slot->name);
    require(bound->image->device == pass->device,
            "kernel '%s': image '%s' belongs to another device", kernel, bound->image->name);
    require(bound->image->desc.format == slot->format,
            "kernel '%s': slot %d wants an image of %s, and '%s' is %s", kernel, slot->slot,
            rg_format_name(slot->format), bound->image->name,
            rg_format_name(bound->image->desc.format));
    return true;
}

// A pass may bind an object that it writes only once, so that no item sees another's writes.
static bool check_aliases(const struct rg_kernel *kernel, const struct rg_run *run)
{
    for (int i = 0; i < kernel->slot_count; i++) {
        for (int j = 0; j < kernel->slot_count; j++) {
            const struct rg_binding *a = &run->slots[kernel->slots[i].slot];
            const struct rg_binding *b = &run->slots[kernel->slots[j].slot];
            bool same = (a->buf && a->buf == b->buf) || (a->image && a->image == b->image);
            require(i == j || !same || !rg_slot_is_written(kernel->slots[i].kind),
                    "kernel '%s': slots '%s' and '%s' are one object, and it is written",
                    kernel->name, kernel->slots[i].name, kernel->slots[j].name);
        }
    }
    return true;
}

// Drivers pad the last work group; its items must not overflow an int either.
enum { MAX_ITEMS = INT_MAX - 1024 };

static bool check_span(const struct rg_kernel *kernel, char axis, int64_t origin, int64_t count)
{
    require(count > 0 && origin >= 0 && origin + count <= MAX_ITEMS,
            "kernel '%s': %lld items in %c from %lld; at least 1, and within 2147482623",
            kernel->name, (long long)count, axis, (long long)origin);
    return true;
}

bool rg_run_check(const struct rg_pass *pass, const struct rg_run *run)
{
    const struct rg_kernel *kernel = pass->kernel;
    require(run->params, "kernel '%s': no parameters given", kernel->name);
    if (!check_span(kernel, 'x', run->origin.width, run->extent.width) ||
        !check_span(kernel, 'y', run->origin.height, run->extent.height) ||
        !check_span(kernel, 'z', run->origin.depth, run->extent.depth))
        return false;
    for (int i = 0; i < kernel->slot_count; i++)
        if (!check_slot(pass, &kernel->slots[i], &run->slots[kernel->slots[i].slot]))
            return false;
    return check_aliases(kernel, run);
}

// --- running ---

void rg_run_count(struct rg_pass *pass, const struct rg_run *run)
{
    struct rg_work *work = pass->device->work;
    if (work->room == RG_ROOM_COUNTED)
        return;
    work->runs++;
    work->items += (int64_t)run->extent.width * run->extent.height * run->extent.depth;
}

static bool draws_texels(const struct rg_pass *pass)
{
    return !pass->kernel->draw && rg_is_drawn(pass->device, pass->kernel);
}

// Texels that items have beyond their image are left out, as stores are.
static bool hand_over(struct rg_pass *pass, const struct rg_run *run)
{
    struct rg_tally *tally = pass->device->work->tally;
    struct rg_run given = *run;
    struct rg_draw draw;
    if (draws_texels(pass)) {
        if (!rg_target_of_texels(pass->kernel, run, &draw))
            return true;
        given.draw = &draw;
    }
    return tally ? rg_tally_run(tally, pass, &given)
                 : pass->device->backend->pass_run(pass, &given);
}

bool rg_dispatch(struct rg_pass *pass, const struct rg_run *run)
{
    struct rg_work *work = pass->device->work;
    if (work->room == RG_ROOM_COUNTED)
        return true;
    const struct rg_watch *watch = work->watch;
    work->dispatches++;
    if (watch)
        watch->before(pass, run, watch->user);
    rg_doing_run(pass->kernel->name);
    const bool ok = hand_over(pass, run);
    if (watch)
        watch->after(pass, run, watch->user);
    return ok;
}

static int smaller(int64_t a, int b)
{
    return a < b ? (int)a : b;
}

// Splits a run that exceeds the device's work groups into several dispatches, each with its own
// origin. A draw of texels has one layer.
static bool run_folded(struct rg_pass *pass, const struct rg_run *run)
{
    const struct rg_limits *limits = &pass->device->info.limits;
    const int64_t max_width = (int64_t)limits->max_groups[0] * limits->group_items;
    const int max_depth = draws_texels(pass) ? 1 : limits->max_groups[2];
    struct rg_run part = *run;
    struct rg_extent done = {0, 0, 0};
    for (done.depth = 0; done.depth < run->extent.depth; done.depth += part.extent.depth) {
        part.origin.depth = run->origin.depth + done.depth;
        part.extent.depth = smaller(max_depth, run->extent.depth - done.depth);
        for (done.height = 0; done.height < run->extent.height; done.height += part.extent.height) {
            part.origin.height = run->origin.height + done.height;
            part.extent.height = smaller(limits->max_groups[1], run->extent.height - done.height);
            for (done.width = 0; done.width < run->extent.width; done.width += part.extent.width) {
                part.origin.width = run->origin.width + done.width;
                part.extent.width = smaller(max_width, run->extent.width - done.width);
                if (!rg_dispatch(pass, &part))
                    return false;
            }
        }
    }
    return true;
}

bool rg_grid_run(struct rg_pass *pass, const struct rg_run *run)
{
    if (!rg_run_check(pass, run))
        return false;
    require(!run->draw, "kernel '%s': a GRID kernel, and the run names a target",
            pass->kernel->name);
    if (draws_texels(pass) && !rg_target_takes_texels(pass, run))
        return false;
    rg_run_count(pass, run);
    return run_folded(pass, run);
}
