#include "backends/opencl/opencl.h"

#include <limits.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"

void opencl_pass_destroy(struct rg_pass *pass)
{
    struct opencl_pass *opencl = (struct opencl_pass *)pass;
    for (int i = 0; i < OPENCL_VARIANTS; i++)
        if (opencl->variants[i])
            clReleaseKernel(opencl->variants[i]);
    free(opencl);
}

struct rg_pass *opencl_pass_create(struct rg_device *device, const struct rg_kernel *kernel)
{
    struct opencl_pass *pass = rg_alloc(1, sizeof(*pass), kernel->name);
    if (!pass)
        return NULL;
    pass->device = (struct opencl_device *)device;
    pass->info = kernel;
    if (kernel->draw || opencl_kernel_of(pass, 0, "rg_grid", ""))
        return &pass->pub;
    opencl_pass_destroy(&pass->pub);
    return NULL;
}

enum { NO_MEMORY = 1 }; // a code of raingauge; OpenCL's are 0 or below

// Appends a kernel's program, built for the context's one device.
static cl_int append_program(cl_kernel kernel, unsigned char **bytes, size_t *size)
{
    cl_program program;
    size_t more = 0;
    cl_int code = clGetKernelInfo(kernel, CL_KERNEL_PROGRAM, sizeof(program), &program, NULL);
    if (!code)
        code = clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof(more), &more, NULL);
    unsigned char *longer = !code && more ? realloc(*bytes, *size + more) : NULL;
    if (!longer)
        return code ? code : more ? NO_MEMORY : CL_SUCCESS;
    *bytes = longer;
    longer += *size;
    *size += more;
    return clGetProgramInfo(program, CL_PROGRAM_BINARIES, sizeof(longer), &longer, NULL);
}

bool opencl_pass_code(struct rg_pass *pass, void **bytes, size_t *size)
{
    const struct opencl_pass *opencl = (const struct opencl_pass *)pass;
    unsigned char *all = NULL;
    cl_int code = CL_SUCCESS;
    *size = 0;
    for (int i = 0; !code && i < OPENCL_VARIANTS; i++)
        if (opencl->variants[i])
            code = append_program(opencl->variants[i], &all, size);
    *bytes = all;
    if (code == NO_MEMORY)
        return rg_harness_error("kernel '%s': no memory for its program", pass->kernel->name);
    return opencl_check(code, "clGetProgramInfo", "kernel", pass->kernel->name);
}

// Sets the arguments of shaders/grid.cl, in its order. Drivers take about 20 ns for each.
static cl_int set_arguments(cl_kernel kernel, const struct rg_kernel *info,
                            const struct rg_run *run)
{
    const cl_int4 origin = {{run->origin.width, run->origin.height, run->origin.depth, 0}};
    const cl_int4 end = {{run->origin.width + run->extent.width,
                          run->origin.height + run->extent.height,
                          run->origin.depth + run->extent.depth, 0}};
    cl_int failed = clSetKernelArg(kernel, 0, sizeof(origin), &origin);
    failed = failed ? failed : clSetKernelArg(kernel, 1, sizeof(end), &end);
    failed = failed ? failed : clSetKernelArg(kernel, 2, (size_t)info->params_size, run->params);
    return failed ? failed : opencl_set_slots(kernel, 3, info, run);
}

// The number of work items for `width` items: whole groups; surplus work items of the last one
// return at once.
static int64_t whole_groups(const struct opencl_device *device, int width)
{
    int64_t group = device->pub.info.limits.group_items;
    return (width + group - 1) / group * group;
}

static bool enqueue(struct opencl_pass *pass, const struct rg_run *run)
{
    struct opencl_device *device = (struct opencl_device *)pass->pub.device;
    const char *name = pass->pub.kernel->name;
    if (!opencl_check(set_arguments(pass->variants[0], pass->pub.kernel, run), "clSetKernelArg",
                      "kernel", name))
        return false;
    const size_t local[3] = {(size_t)device->pub.info.limits.group_items, 1, 1};
    const size_t global[3] = {(size_t)whole_groups(device, run->extent.width),
                              (size_t)run->extent.height, (size_t)run->extent.depth};
    if (!opencl_will_queue(device))
        return false;
    return opencl_check(clEnqueueNDRangeKernel(device->queue, pass->variants[0], 3, NULL, global,
                                               local, 0, NULL, NULL),
                        "clEnqueueNDRangeKernel", "kernel", name);
}

// Drivers may count a run's items in 32 bits, so a larger run is halved.
static bool run_grid(struct rg_pass *pass, const struct rg_run *run)
{
    const struct rg_extent *extent = &run->extent;
    const struct opencl_device *device = (struct opencl_device *)pass->device;
    if (whole_groups(device, extent->width) * extent->height <= INT_MAX / extent->depth)
        return enqueue((struct opencl_pass *)pass, run);
    struct rg_run near = *run, far = *run;
    if (extent->depth > 1) {
        near.extent.depth = extent->depth / 2;
        far.extent.depth -= near.extent.depth;
        far.origin.depth += near.extent.depth;
    } else {
        near.extent.height = extent->height / 2;
        far.extent.height -= near.extent.height;
        far.origin.height += near.extent.height;
    }
    return run_grid(pass, &near) && run_grid(pass, &far);
}

bool opencl_pass_run(struct rg_pass *pass, const struct rg_run *run)
{
    return pass->kernel->draw ? opencl_draw(pass, run) : run_grid(pass, run);
}
