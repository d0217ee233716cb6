#include "backends/opencl/opencl.h"

#include <stdio.h>

#include "kernels/dialect/draw/state.h"

// Tiles in a work group: on a processor few, so that all cores get some; a GPU has one.
enum { TILES_A_GROUP_CPU = 4 };

// The kernel for the draw's state, compiled with the state as constants, so that PoCL vectorises
// pixels of a row.
static cl_kernel variant_of(struct opencl_pass *pass, const struct rg_draw *draw)
{
    static const enum rg_format formats[4] = {RG_FORMAT_NONE, RG_RGBA8, RG_RGBA16F, RG_RGBA32F};
    const enum rg_format format = draw->colour ? draw->colour->desc.format : RG_FORMAT_NONE;
    int place = 0;
    while (formats[place] != format)
        place++;
    const int blend = draw->colour ? (int)draw->blend : (int)RG_BLEND_OFF;
    char defines[112];
    snprintf(defines, sizeof(defines),
             " -DRG_BLOCK_PX=%d -DRG_VARIANT_FORMAT=%d -DRG_VARIANT_BLEND=%d -DRG_VARIANT_DEPTH=%d",
             opencl_block_px(pass->device), (int)format, blend, (int)draw->depth_mode);
    return opencl_kernel_of(pass, (place * 3 + blend) * 3 + (int)draw->depth_mode, "rg_draw",
                            defines);
}

// The arguments of shaders/draw.cl, in its order.
static cl_int set_arguments(cl_kernel kernel, const struct rg_kernel *info,
                            const struct opencl_bins *bins, const struct rg_run *run)
{
    const struct opencl_buf *prims = (struct opencl_buf *)run->packed->prims;
    const struct opencl_buf *samples = (struct opencl_buf *)run->draw->samples;
    cl_uint next = 0;
    cl_int code = clSetKernelArg(kernel, next++, (size_t)info->draw->call_size, run->params);
    code = code ? code : clSetKernelArg(kernel, next++, sizeof(bins->shape), &bins->shape);
    code = code ? code : clSetKernelArg(kernel, next++, sizeof(cl_mem), &prims->memory.mem);
    code = code ? code : clSetKernelArg(kernel, next++, sizeof(cl_mem), &bins->places.mem);
    code = code ? code : clSetKernelArg(kernel, next++, sizeof(cl_mem), &bins->list.mem);
    code = code ? code : clSetKernelArg(kernel, next++, sizeof(cl_mem), &bins->round.mem);
    code = code ? code : opencl_set_target(kernel, &next, run->draw->colour, run->draw);
    code = code ? code : opencl_set_target(kernel, &next, run->draw->depth, run->draw);
    code = code ? code
                : clSetKernelArg(kernel, next++, sizeof(cl_mem),
                                 samples ? &samples->memory.mem : NULL);
    return code ? code : opencl_set_slots(kernel, next, info, run);
}

static bool shade(cl_kernel kernel, const struct rg_kernel *info, const struct opencl_bins *bins,
                  const struct rg_run *run)
{
    if (!opencl_check(set_arguments(kernel, info, bins, run), "clSetKernelArg", "kernel",
                      info->name))
        return false;
    const size_t a_side = RG_TILE_PX / (size_t)opencl_block_px(bins->device),
                 blocks = a_side * a_side;
    const size_t local = blocks == 1 ? TILES_A_GROUP_CPU : blocks;
    const size_t items = ((size_t)bins->shape.tiles * blocks + local - 1) / local * local;
    if (!opencl_will_queue(bins->device))
        return false;
    return opencl_check(
        clEnqueueNDRangeKernel(bins->device->queue, kernel, 1, NULL, &items, &local, 0, NULL, NULL),
        "clEnqueueNDRangeKernel", "kernel", info->name);
}

bool opencl_draw(struct rg_pass *pass, const struct rg_run *run)
{
    struct opencl_bins *bins = opencl_bins_of((struct opencl_device *)pass->device);
    const cl_kernel kernel = bins ? variant_of((struct opencl_pass *)pass, run->draw) : NULL;
    if (!kernel || !opencl_bins_begin(bins, pass->kernel, run))
        return false;
    for (bool more = true; more; bins->shape.first_prim = bins->shape.end_prim) {
        if (!opencl_bins_sort(bins, run, &more))
            return false;
        if (bins->shape.end_prim > bins->shape.first_prim &&
            !shade(kernel, pass->kernel, bins, run))
            return false;
    }
    return true;
}
