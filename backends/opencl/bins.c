#include "backends/opencl/opencl.h"

#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "kernels/dialect/draw/state.h"

extern const struct rg_embedded_code rg_code_bins[RG_CODE_COUNT];

// Enough lanes to keep several cores busy, and few enough to scan. Places take at most MAX_PLACES
// words.
enum { MAX_LANES = 64, ITEMS_A_LANE = 64, MAX_PLACES = 4 << 20 };

// The list's sizes: the first one, which doubles up to the second. On a processor a draw that needs
// more takes several rounds. A GPU's list has the second size from the start, and tiles look for
// primitives themselves if a draw needs more, so that the host never waits for their number.
enum { MIN_LIST_BYTES = 256 << 10, MAX_LIST_BYTES = 64 << 20 };

enum { BLOCK_PX_CPU = RG_TILE_PX, BLOCK_PX_GPU = 2 };

int opencl_block_px(const struct opencl_device *device)
{
    return device->pub.info.software ? BLOCK_PX_CPU : BLOCK_PX_GPU;
}

// The largest list that the device allows.
static size_t most_bytes(const struct opencl_bins *bins)
{
    const int64_t allowed = bins->device->pub.info.limits.max_buffer_bytes;
    return allowed < MAX_LIST_BYTES ? (size_t)allowed : MAX_LIST_BYTES;
}

static bool make_kernel(struct opencl_bins *bins, cl_kernel *kernel, const char *name)
{
    cl_int code;
    *kernel = clCreateKernel(bins->program, name, &code);
    return opencl_check(code, "clCreateKernel", "kernel", name);
}

static bool grow(struct opencl_memory *memory, size_t *bytes, size_t wanted)
{
    if (*bytes >= wanted)
        return true;
    if (memory->mem)
        clReleaseMemObject(memory->mem); // queued commands keep it until they have ended
    memory->mem = NULL;
    *bytes = 0;
    if (!opencl_memory_create(memory, wanted))
        return false;
    *bytes = wanted;
    return true;
}

struct opencl_bins *opencl_bins_of(struct opencl_device *device)
{
    if (device->bins)
        return device->bins;
    struct opencl_bins *bins = device->bins = rg_alloc(1, sizeof(*bins), "bins");
    if (!bins)
        return NULL;
    bins->device = device;
    bins->places = (struct opencl_memory){NULL, device, "buffer", "bins"};
    bins->list = (struct opencl_memory){NULL, device, "buffer", "binned primitives"};
    bins->round = (struct opencl_memory){NULL, device, "buffer", "round of bins"};
    struct rg_kernel_code text;
    if (rg_embedded_code(&rg_code_bins[RG_CODE_OPENCL], "bins", &text))
        bins->program = opencl_build(device, &text, "", "bins");
    free(text.bytes);
    if (bins->program && make_kernel(bins, &bins->walk, "rg_bins_walk") &&
        make_kernel(bins, &bins->scan, "rg_bins_scan") &&
        opencl_memory_create(&bins->round, RG_ROUND_WORDS * sizeof(cl_uint)) &&
        grow(&bins->list, &bins->list_bytes, MIN_LIST_BYTES))
        return bins;
    opencl_bins_destroy(device);
    return NULL;
}

void opencl_bins_destroy(struct opencl_device *device)
{
    struct opencl_bins *bins = device->bins;
    if (!bins)
        return;
    if (bins->walk)
        clReleaseKernel(bins->walk);
    if (bins->scan)
        clReleaseKernel(bins->scan);
    if (bins->program)
        clReleaseProgram(bins->program);
    const struct opencl_memory *all[] = {&bins->places, &bins->list, &bins->round};
    for (int i = 0; i < 3; i++)
        if (all[i]->mem)
            clReleaseMemObject(all[i]->mem);
    free(bins);
    device->bins = NULL;
}

static int at_most(int a, int b)
{
    return a < b ? a : b;
}

static const rg_draw_state *state_of(const struct rg_run *run)
{
    return run->params; // rg_draw_call begins with it
}

bool opencl_bins_begin(struct opencl_bins *bins, const struct rg_kernel *kernel,
                       const struct rg_run *run)
{
    const rg_draw_state *draw = state_of(run);
    const int tiles_x = (draw->x1 - draw->x0 + RG_TILE_PX - 1) / RG_TILE_PX;
    const int tiles = tiles_x * ((draw->y1 - draw->y0 + RG_TILE_PX - 1) / RG_TILE_PX);
    int lanes = at_most(run->extent.width / ITEMS_A_LANE, at_most(MAX_LANES, MAX_PLACES / tiles));
    lanes = lanes < 1 ? 1 : lanes;
    bins->tried_prims = run->packed->capacity;
    bins->shape = (rg_bins){
        .tiles_x = tiles_x,
        .tiles = tiles,
        .lanes = lanes,
        .prim_words = kernel->draw->prim_size / 4,
        .corners = kernel->draw->corners,
    };
    if (!bins->device->pub.info.software && !grow(&bins->list, &bins->list_bytes, most_bytes(bins)))
        return false;
    return grow(&bins->places, &bins->places_bytes,
                (size_t)tiles * (size_t)lanes * sizeof(cl_uint));
}

// --- one round ---

static bool walk(struct opencl_bins *bins, const struct rg_run *run, cl_int scatter)
{
    const struct opencl_buf *prims = (struct opencl_buf *)run->packed->prims;
    const struct opencl_buf *args = (struct opencl_buf *)run->packed->args;
    const struct {
        size_t size;
        const void *value;
    } all[] = {
        {sizeof(bins->shape), &bins->shape}, {sizeof(rg_draw_state), run->params},
        {sizeof(scatter), &scatter},         {sizeof(cl_mem), &prims->memory.mem},
        {sizeof(cl_mem), &args->memory.mem}, {sizeof(cl_mem), &bins->places.mem},
        {sizeof(cl_mem), &bins->list.mem},   {sizeof(cl_mem), &bins->round.mem},
    };
    cl_int code = CL_SUCCESS;
    for (cl_uint i = 0; i < sizeof(all) / sizeof(all[0]) && !code; i++)
        code = clSetKernelArg(bins->walk, i, all[i].size, all[i].value);
    if (!opencl_check(code, "clSetKernelArg", "kernel", "rg_bins_walk"))
        return false;
    const size_t lanes = (size_t)bins->shape.lanes, one = 1;
    if (!opencl_will_queue(bins->device))
        return false;
    code = clEnqueueNDRangeKernel(bins->device->queue, bins->walk, 1, NULL, &lanes, &one, 0, NULL,
                                  NULL);
    return opencl_check(code, "clEnqueueNDRangeKernel", "kernel", "rg_bins_walk");
}

static bool clear_places(struct opencl_bins *bins)
{
    const cl_uint zero = 0;
    const size_t words = (size_t)bins->shape.tiles * (size_t)bins->shape.lanes;
    if (!opencl_will_queue(bins->device))
        return false;
    cl_int code = clEnqueueFillBuffer(bins->device->queue, bins->places.mem, &zero, sizeof(zero), 0,
                                      words * sizeof(zero), 0, NULL, NULL);
    return opencl_check(code, "clEnqueueFillBuffer", "buffer", "bins");
}

static bool scan(struct opencl_bins *bins, const struct rg_run *run)
{
    const struct opencl_buf *args = (struct opencl_buf *)run->packed->args;
    cl_int code = clSetKernelArg(bins->scan, 0, sizeof(bins->shape), &bins->shape);
    code = code ? code : clSetKernelArg(bins->scan, 1, sizeof(cl_mem), &args->memory.mem);
    code = code ? code : clSetKernelArg(bins->scan, 2, sizeof(cl_mem), &bins->places.mem);
    code = code ? code : clSetKernelArg(bins->scan, 3, sizeof(cl_mem), &bins->round.mem);
    if (!opencl_check(code, "clSetKernelArg", "kernel", "rg_bins_scan"))
        return false;
    const size_t items = RG_SCAN_ITEMS;
    if (!opencl_will_queue(bins->device))
        return false;
    code = clEnqueueNDRangeKernel(bins->device->queue, bins->scan, 1, NULL, &items, &items, 0, NULL,
                                  NULL);
    return opencl_check(code, "clEnqueueNDRangeKernel", "kernel", "rg_bins_scan");
}

// Makes a list of `pairs` elements; *fits tells whether memory sufficed. False, and one logged
// line, on failure.
static bool grow_list(struct opencl_bins *bins, cl_uint pairs, bool *fits)
{
    const size_t most = most_bytes(bins), wanted = pairs * sizeof(cl_uint);
    *fits = wanted <= most;
    size_t bytes = bins->list_bytes;
    while (*fits && bytes < wanted)
        bytes = 2 * bytes < most ? 2 * bytes : most;
    return grow(&bins->list, &bins->list_bytes, bytes);
}

// Sorts all primitives without waiting for anything.
static bool sort_at_once(struct opencl_bins *bins, const struct rg_run *run)
{
    const size_t most = most_bytes(bins);
    const size_t bytes = bins->list_bytes < most ? bins->list_bytes : most;
    bins->shape.end_prim = run->packed->capacity;
    bins->shape.capacity = (cl_uint)(bytes / sizeof(cl_uint));
    return clear_places(bins) && walk(bins, run, false) && scan(bins, run) && walk(bins, run, true);
}

bool opencl_bins_sort(struct opencl_bins *bins, const struct rg_run *run, bool *more)
{
    rg_bins *shape = &bins->shape;
    *more = false;
    if (!bins->device->pub.info.software)
        return sort_at_once(bins, run);
    for (;;) {
        shape->end_prim = at_most(shape->first_prim + bins->tried_prims, run->packed->capacity);
        cl_uint round[RG_ROUND_WORDS];
        if (!clear_places(bins) || !walk(bins, run, false) || !scan(bins, run) ||
            !opencl_memory_read(&bins->round, 0, round, sizeof(round)))
            return false;
        const int prims = (int)round[RG_ROUND_PRIMS];
        shape->end_prim = at_most(shape->end_prim, prims);
        *more = shape->end_prim < prims;
        bool fits;
        if (!grow_list(bins, round[RG_ROUND_PAIRS], &fits))
            return false;
        if (!fits && shape->end_prim - shape->first_prim == 1)
            return rg_driver_error(
                "device '%s': a primitive meets %u tiles, more than a buffer holds",
                bins->device->pub.info.name, round[RG_ROUND_PAIRS]);
        if (fits) {
            shape->capacity = (cl_uint)(bins->list_bytes / sizeof(cl_uint));
            bins->tried_prims = at_most(2 * bins->tried_prims, run->packed->capacity);
            return !round[RG_ROUND_PAIRS] || walk(bins, run, true);
        }
        bins->tried_prims = (shape->end_prim - shape->first_prim + 1) / 2;
    }
}
