#include "core/device/draw.h"

#include <assert.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/require.h"
#include "core/device/device.h"
#include "core/device/scan.h"
#include "kernels/dialect/draw/blend.h"
#include "kernels/dialect/draw/clip.h"

static_assert((int)RG_RGBA8_FORMAT == (int)RG_RGBA8 && (int)RG_RGBA16F_FORMAT == (int)RG_RGBA16F &&
                  (int)RG_RGBA32F_FORMAT == (int)RG_RGBA32F,
              "kernels/dialect/draw/state.h and core/device/kernel.h number formats alike");
static_assert((int)RG_DEPTH_IS_OFF == (int)RG_DEPTH_OFF &&
                  (int)RG_DEPTH_IS_TEST == (int)RG_DEPTH_TEST &&
                  (int)RG_DEPTH_IS_WRITE == (int)RG_DEPTH_WRITE,
              "kernels/dialect/draw/state.h and backends/backend.h number depth modes alike");
static_assert((int)RG_BLEND_IS_OFF == (int)RG_BLEND_OFF &&
                  (int)RG_BLEND_IS_OVER == (int)RG_BLEND_OVER &&
                  (int)RG_BLEND_IS_ADD == (int)RG_BLEND_ADD,
              "kernels/dialect/draw/blend.h and backends/backend.h number blends alike");

// Primitives of a batch take no more than this, whatever a device would allow.
#define MAX_PACKED_BYTES ((int64_t)128 << 20)

enum { MAX_BATCH_CHUNKS = 32768, ARGS = 5 };

// Scratch of a device's packing.
struct rg_packing {
    struct rg_buf *prims, *counts, *fates, *before, *args;
    struct rg_scan *scan;
};

// --- checks ---

static bool check_target(const struct rg_pass *pass, const struct rg_draw *draw,
                         const struct rg_image *image)
{
    const char *kernel = pass->kernel->name;
    require(image->device == pass->device, "kernel '%s': target '%s' belongs to another device",
            kernel, image->name);
    require(draw->layer >= 0 && draw->layer < image->desc.layers && draw->level >= 0 &&
                draw->level < image->desc.levels,
            "kernel '%s': target '%s' has no layer %d, level %d", kernel, image->name, draw->layer,
            draw->level);
    require(image->desc.width <= RG_VIEWPORT_PX && image->desc.height <= RG_VIEWPORT_PX,
            "kernel '%s': target '%s' is %dx%d; at most %d px a side can be drawn to", kernel,
            image->name, image->desc.width, image->desc.height, RG_VIEWPORT_PX);
    return true;
}

static bool check_targets(const struct rg_pass *pass, const struct rg_draw *draw)
{
    const char *kernel = pass->kernel->name;
    require(draw->colour || draw->depth, "kernel '%s': no target given", kernel);
    if ((draw->colour && !check_target(pass, draw, draw->colour)) ||
        (draw->depth && !check_target(pass, draw, draw->depth)))
        return false;
    if (draw->colour) {
        enum rg_format format = draw->colour->desc.format;
        require(format == RG_RGBA8 || format == RG_RGBA16F || format == RG_RGBA32F,
                "kernel '%s': '%s' is %s; colours go to RGBA8, RGBA16F or RGBA32F", kernel,
                draw->colour->name, rg_format_name(format));
    }
    require(!draw->depth || draw->depth->desc.format == RG_D32F,
            "kernel '%s': '%s' is %s; depth goes to D32F", kernel, draw->depth->name,
            rg_format_name(draw->depth->desc.format));
    require(!draw->colour || !draw->depth ||
                (draw->colour->desc.width == draw->depth->desc.width &&
                 draw->colour->desc.height == draw->depth->desc.height),
            "kernel '%s': targets '%s' and '%s' differ in size", kernel, draw->colour->name,
            draw->depth->name);
    require(draw->depth_mode == RG_DEPTH_OFF || draw->depth,
            "kernel '%s': depth is tested, and no depth target given", kernel);
    return true;
}

static bool check_samples(const struct rg_pass *pass, const struct rg_run *run)
{
    const struct rg_buf *samples = run->draw->samples;
    const char *kernel = pass->kernel->name;
    if (!samples)
        return true;
    require(samples->device == pass->device, "kernel '%s': buffer '%s' belongs to another device",
            kernel, samples->name);
    require((int64_t)(samples->size / 4) >= (int64_t)run->origin.width + run->extent.width,
            "kernel '%s': buffer '%s' has %zu counters for %lld items", kernel, samples->name,
            samples->size / 4, (long long)run->origin.width + run->extent.width);
    // A count against a depth that changes meanwhile would depend on the order of the pixels.
    require(run->draw->depth_mode != RG_DEPTH_WRITE,
            "kernel '%s': visible samples are counted against depth that is not written; use "
            "RG_DEPTH_TEST",
            kernel);
    return true;
}

// What is drawn to is not read in the same run.
static bool check_feedback(const struct rg_pass *pass, const struct rg_run *run)
{
    const struct rg_draw *draw = run->draw;
    for (int i = 0; i < pass->kernel->slot_count; i++) {
        const struct rg_slot_info *slot = &pass->kernel->slots[i];
        const struct rg_binding *bound = &run->slots[slot->slot];
        require(slot->kind == RG_SLOT_IN || slot->kind == RG_SLOT_IMAGE,
                "kernel '%s': slot '%s' is written; DRAW programs write their targets alone",
                pass->kernel->name, slot->name);
        require((!bound->image || (bound->image != draw->colour && bound->image != draw->depth)) &&
                    (!bound->buf || bound->buf != draw->samples),
                "kernel '%s': slot '%s' and a target are one object", pass->kernel->name,
                slot->name);
    }
    return true;
}

static void target_size(const struct rg_draw *draw, int *width, int *height)
{
    const struct rg_image *image = draw->colour ? draw->colour : draw->depth;
    *width = rg_level_size(image->desc.width, draw->level);
    *height = rg_level_size(image->desc.height, draw->level);
}

static bool is_whole(const struct rg_draw *draw)
{
    return !draw->x0 && !draw->y0 && !draw->x1 && !draw->y1;
}

bool rg_draw_check(const struct rg_pass *pass, const struct rg_run *run)
{
    const struct rg_draw *draw = run->draw;
    require(draw, "kernel '%s': a DRAW program, and the run names no target", pass->kernel->name);
    if (!check_targets(pass, draw) || !check_samples(pass, run) || !check_feedback(pass, run))
        return false;
    int width, height;
    target_size(draw, &width, &height);
    require(is_whole(draw) || (draw->x0 >= 0 && draw->y0 >= 0 && draw->x0 < draw->x1 &&
                               draw->y0 < draw->y1 && draw->x1 <= width && draw->y1 <= height),
            "kernel '%s': the scissor %d,%d to %d,%d is empty or leaves the %dx%d target",
            pass->kernel->name, draw->x0, draw->y0, draw->x1, draw->y1, width, height);
    require(run->extent.height == 1 && run->extent.depth == 1 && !run->origin.height &&
                !run->origin.depth,
            "kernel '%s': items of a DRAW program lie along x", pass->kernel->name);
    return true;
}

// --- packing ---

bool rg_packer_create(struct rg_pass *pass)
{
    struct rg_packer *packer = rg_alloc(1, sizeof(*packer), pass->kernel->name);
    if (!packer)
        return false;
    pass->packer = packer;
    packer->count = rg_pass_create(pass->device, pass->kernel->draw->count);
    packer->emit = rg_pass_create(pass->device, pass->kernel->draw->emit);
    return packer->count && packer->emit;
}

void rg_packer_destroy(struct rg_pass *pass)
{
    if (!pass->packer)
        return;
    rg_pass_destroy(pass->packer->count);
    rg_pass_destroy(pass->packer->emit);
    free(pass->packer);
    pass->packer = NULL;
}

void rg_packing_destroy(struct rg_device *device)
{
    struct rg_packing *packing = device->packing;
    if (!packing)
        return;
    rg_scan_destroy(packing->scan);
    rg_buf_destroy(packing->prims);
    rg_buf_destroy(packing->counts);
    rg_buf_destroy(packing->fates);
    rg_buf_destroy(packing->before);
    rg_buf_destroy(packing->args);
    free(packing);
    device->packing = NULL;
}

static struct rg_packing *packing_of(struct rg_device *device)
{
    if (device->packing)
        return device->packing;
    struct rg_packing *packing = device->packing =
        rg_alloc(1, sizeof(*packing), "packed primitives");
    if (packing &&
        (packing->counts = rg_buf_create(device, MAX_BATCH_CHUNKS * 4, "packing counts")) &&
        (packing->fates = rg_buf_create(device, MAX_BATCH_CHUNKS * 8, "packing fates")) &&
        (packing->before = rg_buf_create(device, (MAX_BATCH_CHUNKS + 1) * 4, "packing places")) &&
        (packing->args = rg_buf_create(device, ARGS * 4, "draw arguments")) &&
        (packing->scan = rg_scan_create(device, MAX_BATCH_CHUNKS)))
        return packing;
    rg_packing_destroy(device);
    return NULL;
}

static int64_t smaller(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

// Sees to room for the primitives of as many of `items` as go into one batch; returns these.
static int make_room(struct rg_device *device, struct rg_packing *packing,
                     const struct rg_draw_info *draw, int items)
{
    const int64_t an_item = (int64_t)RG_MOST_PRIMS(draw->corners) * draw->prim_size;
    const int64_t most = smaller(MAX_PACKED_BYTES, device->info.limits.max_buffer_bytes);
    const int64_t batch = smaller(smaller(items, most / an_item), MAX_BATCH_CHUNKS * RG_DRAW_CHUNK);
    const int64_t wanted = batch * an_item;
    if (packing->prims && (int64_t)packing->prims->size >= wanted)
        return (int)batch;
    rg_buf_destroy(packing->prims);
    packing->prims = rg_buf_create(device, wanted, "packed primitives");
    return packing->prims ? (int)batch : 0;
}

// --- running ---

static void fill_state(const struct rg_draw *draw, rg_draw_state *state)
{
    *state = (rg_draw_state){
        .x0 = draw->x0,
        .y0 = draw->y0,
        .x1 = draw->x1,
        .y1 = draw->y1,
        .cull = draw->cull,
        .blend = draw->blend,
        .depth_mode = draw->depth_mode,
        .colour_format = draw->colour ? (int)draw->colour->desc.format : 0,
        .counted = draw->samples != NULL,
    };
    target_size(draw, &state->width, &state->height);
    if (is_whole(draw)) {
        state->x1 = state->width;
        state->y1 = state->height;
    }
    state->half_width = 0.5f * (float)state->width;
    state->half_height = 0.5f * (float)state->height;
}

// Past the checks: they have been done, and programs whose primitives differ in size share a buffer
// that is no whole number of each. A batch's chunks are fewer than any device's work groups.
static bool run_stage(struct rg_pass *stage, const struct rg_run *run)
{
    stage->device->work->dispatches++;
    return stage->device->backend->pass_run(stage, run);
}

static bool run_packed(struct rg_pass *pass, const struct rg_run *run, rg_draw_state *state,
                       int batch)
{
    struct rg_device *device = pass->device;
    struct rg_packing *packing = device->packing;
    const int chunks = (batch + RG_DRAW_CHUNK - 1) / RG_DRAW_CHUNK;
    struct rg_run pack = *run;
    pack.draw = NULL;
    pack.origin = (struct rg_extent){0};
    pack.extent = (struct rg_extent){chunks, 1, 1};
    pack.slots[RG_SLOT_COUNTS].buf = packing->counts;
    pack.slots[RG_SLOT_FATES].buf = packing->fates;
    if (!run_stage(pass->packer->count, &pack) ||
        !rg_scan_sum(packing->scan, packing->counts, packing->before, chunks))
        return false;
    pack.slots[RG_SLOT_COUNTS].buf = packing->before;
    pack.slots[RG_SLOT_PRIMS].buf = packing->prims;
    pack.slots[RG_SLOT_ARGS].buf = packing->args;
    if (!run_stage(pass->packer->emit, &pack))
        return false;
    struct rg_run packed = *run;
    packed.packed = &(struct rg_packed){packing->prims, packing->args, state->capacity};
    packed.origin.width = state->item_begin;
    packed.extent.width = batch;
    return run_stage(pass, &packed);
}

bool rg_draw_run(struct rg_pass *pass, const struct rg_run *run)
{
    struct rg_device *device = pass->device;
    const struct rg_draw_info *info = pass->kernel->draw;
    _Alignas(16) unsigned char call[RG_MAX_PARAMS_SIZE];
    rg_draw_state state;
    fill_state(run->draw, &state);
    memcpy(call + sizeof(state), run->params, (size_t)pass->kernel->params_size);
    struct rg_run part = *run;
    part.params = call;
    int batch = run->extent.width;
    if (device->backend->packed) {
        struct rg_packing *packing = packing_of(device);
        batch = packing ? make_room(device, packing, info, batch) : 0;
        if (!batch)
            return false;
        state.capacity = (int)(packing->prims->size / (size_t)info->prim_size);
    }
    for (int64_t done = 0; done < run->extent.width; done += batch) {
        const int items = (int)smaller(batch, run->extent.width - done);
        state.item_begin = run->origin.width + (int)done;
        state.item_end = state.item_begin + items;
        memcpy(call, &state, sizeof(state));
        if (!(device->backend->packed ? run_packed(pass, &part, &state, items)
                                      : device->backend->pass_run(pass, &part)))
            return false;
    }
    return true;
}
