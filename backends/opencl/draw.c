#include "backends/opencl/opencl.h"

#include "kernels/draw_state.h"

// Work items a group: of a processor, tiles, few so that all cores get some; of a GPU, a tile.
enum { TILES_A_GROUP_CPU = 4 };

static cl_int set_target(cl_kernel kernel, cl_uint *next, const struct rg_image *image,
                         const struct rg_draw *draw)
{
    const struct opencl_image *target = (const struct opencl_image *)image;
    const cl_int word = image ? opencl_image_word(image, draw->layer, draw->level) : 0;
    cl_int code =
        clSetKernelArg(kernel, (*next)++, sizeof(cl_mem), image ? &target->memory.mem : NULL);
    return code ? code : clSetKernelArg(kernel, (*next)++, sizeof(word), &word);
}

// The arguments of shaders/draw.cl, in its order.
static cl_int set_arguments(const struct opencl_pass *pass, const struct opencl_bins *bins,
                            const struct rg_run *run)
{
    const cl_kernel kernel = pass->kernel;
    const struct rg_kernel *info = pass->pub.kernel;
    const struct opencl_buf *prims = (struct opencl_buf *)run->packed->prims;
    const struct opencl_buf *samples = (struct opencl_buf *)run->draw->samples;
    cl_uint next = 0;
    cl_int code = clSetKernelArg(kernel, next++, (size_t)info->draw->call_size, run->params);
    code = code ? code : clSetKernelArg(kernel, next++, sizeof(bins->shape), &bins->shape);
    code = code ? code : clSetKernelArg(kernel, next++, sizeof(cl_mem), &prims->memory.mem);
    code = code ? code : clSetKernelArg(kernel, next++, sizeof(cl_mem), &bins->places.mem);
    code = code ? code : clSetKernelArg(kernel, next++, sizeof(cl_mem), &bins->list.mem);
    code = code ? code : set_target(kernel, &next, run->draw->colour, run->draw);
    code = code ? code : set_target(kernel, &next, run->draw->depth, run->draw);
    code = code ? code
                : clSetKernelArg(kernel, next++, sizeof(cl_mem),
                                 samples ? &samples->memory.mem : NULL);
    return code ? code : opencl_set_slots(kernel, next, info, run);
}

static bool shade(const struct opencl_pass *pass, const struct opencl_bins *bins,
                  const struct rg_run *run)
{
    const char *name = pass->pub.kernel->name;
    if (!opencl_check(set_arguments(pass, bins, run), "clSetKernelArg", "kernel", name))
        return false;
    const size_t a_side = RG_TILE_PX / (size_t)bins->shape.block_px, blocks = a_side * a_side;
    const size_t local = blocks == 1 ? TILES_A_GROUP_CPU : blocks;
    const size_t items = ((size_t)bins->shape.tiles * blocks + local - 1) / local * local;
    opencl_will_queue(bins->device);
    return opencl_check(clEnqueueNDRangeKernel(bins->device->queue, pass->kernel, 1, NULL, &items,
                                               &local, 0, NULL, NULL),
                        "clEnqueueNDRangeKernel", "kernel", name);
}

bool opencl_draw(struct rg_pass *pass, const struct rg_run *run)
{
    struct opencl_bins *bins = opencl_bins_of((struct opencl_device *)pass->device);
    if (!bins || !opencl_bins_begin(bins, pass->kernel, run))
        return false;
    for (bool more = true; more; bins->shape.first_prim = bins->shape.end_prim) {
        if (!opencl_bins_sort(bins, run, &more))
            return false;
        if (bins->shape.end_prim > bins->shape.first_prim &&
            !shade((struct opencl_pass *)pass, bins, run))
            return false;
    }
    return true;
}
