#include "core/device/packing.h"

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/device/grid.h"
#include "core/device/objects.h"
#include "core/device/scan.h"
#include "kernels/dialect/draw/clip.h"
#include "kernels/packing/params.h"

// The most that a batch's primitives take, whatever the device would allow.
#define MAX_PACKED_BYTES ((int64_t)128 << 20)

enum { MAX_BATCH_CHUNKS = RG_MAX_QUERIES, ARGS = 5 };

// A device's scratch buffers for packing.
struct rg_packing {
    struct rg_buf *prims, *counts, *fates, *before, *args;
    struct rg_scan *scan;
    // Only for draws with queries; NULL before the first.
    struct rg_pass *ranges;
    struct rg_buf *query_args;
};

// --- the packing passes and their buffers ---

bool rg_packer_create(struct rg_pass *pass)
{
    struct rg_packer *packer = rg_alloc(1, sizeof(*packer), pass->kernel->name);
    if (!packer)
        return false;
    pass->packer = packer;
    packer->count = rg_grid_create(pass->device, pass->kernel->draw->count);
    packer->emit = rg_grid_create(pass->device, pass->kernel->draw->emit);
    return packer->count && packer->emit;
}

void rg_packer_destroy(struct rg_pass *pass)
{
    if (!pass->packer)
        return;
    rg_grid_destroy(pass->packer->count);
    rg_grid_destroy(pass->packer->emit);
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
    rg_grid_destroy(packing->ranges);
    rg_buf_destroy(packing->query_args);
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

static bool prepare_queries(struct rg_device *device, struct rg_packing *packing)
{
    const int64_t bytes = MAX_BATCH_CHUNKS * 4 * sizeof(uint32_t);
    return (packing->ranges || (packing->ranges = rg_grid_create(device, "packing_ranges"))) &&
           (packing->query_args ||
            (packing->query_args = rg_buf_create(device, bytes, "query arguments")));
}

int rg_packing_prepare(struct rg_pass *pass, int items, int whole, int *capacity)
{
    struct rg_device *device = pass->device;
    struct rg_packing *packing = packing_of(device);
    if (!packing || (whole && !prepare_queries(device, packing)))
        return 0;
    const struct rg_draw_info *draw = pass->kernel->draw;
    const int64_t an_item = (int64_t)RG_MOST_PRIMS(draw->corners) * draw->prim_size;
    const int64_t most = smaller(MAX_PACKED_BYTES, device->info.limits.max_buffer_bytes);
    int64_t batch = smaller(smaller(items, most / an_item), MAX_BATCH_CHUNKS * RG_DRAW_CHUNK);
    if (whole && batch < items)
        batch = batch / whole * whole;
    const int64_t wanted = batch * an_item;
    if (!batch)
        return rg_unsupported("kernel '%s': %d items a query are more than are drawn at once",
                              pass->kernel->name, whole);
    if (!packing->prims || (int64_t)packing->prims->size < wanted) {
        rg_buf_destroy(packing->prims);
        packing->prims = rg_buf_create(device, wanted, "packed primitives");
    }
    if (!packing->prims)
        return 0;
    *capacity = (int)(packing->prims->size / (size_t)draw->prim_size);
    return (int)batch;
}

// --- running ---

// Finds the beginning of each query's primitives, as arguments of its draw.
static bool find_ranges(const struct rg_packing *packing, int chunks, int corners,
                        int chunks_a_query, int queries)
{
    const packing_params params = {chunks, chunks_a_query, corners == 3 ? 3 : 6};
    return rg_dispatch(packing->ranges,
                       &(struct rg_run){
                           .params = &params,
                           .slots = {[1].buf = packing->before, [2].buf = packing->query_args},
                           .extent = {queries, 1, 1},
                       });
}

// Draws the packed primitives.
static bool draw_packed(struct rg_pass *pass, const struct rg_run *run, const rg_draw_state *state,
                        int chunks)
{
    const struct rg_packing *packing = pass->device->packing;
    const struct rg_packed args = {packing->prims, packing->args, state->capacity,
                                   run->queries ? packing->query_args : NULL};
    if (run->queries && !find_ranges(packing, chunks, pass->kernel->draw->corners,
                                     run->draw->items_a_query / RG_DRAW_CHUNK, run->queries))
        return false;
    struct rg_run packed = *run;
    packed.packed = &args;
    packed.origin.width = state->item_begin;
    packed.extent.width = state->item_end - state->item_begin;
    return rg_dispatch(pass, &packed);
}

// These runs skip the checks, which the caller has done. The checks would refuse the primitives'
// buffer: programs with primitives of different sizes share it, so that its size is not a multiple
// of each. A batch has fewer chunks than any device has work groups.
bool rg_packing_run(struct rg_pass *pass, const struct rg_run *run, const rg_draw_state *state)
{
    struct rg_device *device = pass->device;
    struct rg_packing *packing = device->packing;
    const int batch = state->item_end - state->item_begin;
    const int chunks = (batch + RG_DRAW_CHUNK - 1) / RG_DRAW_CHUNK;
    struct rg_run pack = *run;
    pack.draw = NULL;
    pack.origin = (struct rg_extent){0};
    pack.extent = (struct rg_extent){chunks, 1, 1};
    pack.slots[RG_SLOT_COUNTS].buf = packing->counts;
    pack.slots[RG_SLOT_FATES].buf = packing->fates;
    if (!rg_dispatch(pass->packer->count, &pack) ||
        !rg_scan_sum(packing->scan, packing->counts, packing->before, chunks))
        return false;
    pack.slots[RG_SLOT_COUNTS].buf = packing->before;
    pack.slots[RG_SLOT_PRIMS].buf = packing->prims;
    pack.slots[RG_SLOT_ARGS].buf = packing->args;
    return rg_dispatch(pass->packer->emit, &pack) && draw_packed(pass, run, state, chunks);
}
