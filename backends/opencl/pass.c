#include "backends/opencl/opencl.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"

// Only options that change no value. FP contraction is off by a pragma in kernels/dialect/lang.h.
static void build_options(cl_device_id id, const char *defines, char *options, size_t size)
{
    cl_device_fp_config config = 0;
    clGetDeviceInfo(id, CL_DEVICE_SINGLE_FP_CONFIG, sizeof(config), &config, NULL);
    snprintf(options, size, "-w -cl-std=CL1.2%s%s",
             config & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT
                 ? " -cl-fp32-correctly-rounded-divide-sqrt"
                 : "",
             defines);
}

// Logs what a driver's compiler had to say, in one line: its first error, else its first line.
static void build_failed(const struct opencl_device *device, cl_program program, const char *name,
                         cl_int code)
{
    size_t size = 0;
    clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, 0, NULL, &size);
    char *log = calloc(1, size + 1);
    if (log)
        clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, size, log, NULL);
    const char *line = log ? log + strspn(log, "\r\n\t ") : "";
    const char *error = strstr(line, "error:");
    while (error && error > line && error[-1] != '\n')
        error--;
    line = error ? error : line;
    rg_error("kernel '%s': clBuildProgram failed with %s on %s: %.*s", name,
             opencl_error_name(code), device->pub.info.name, (int)strcspn(line, "\r\n"), line);
    free(log);
}

cl_program opencl_build(struct opencl_device *device, const struct rg_kernel_code *text,
                        const char *defines, const char *name)
{
    char options[256];
    build_options(device->id, defines, options, sizeof(options));
    const char *source = (const char *)text->bytes;
    cl_int code;
    cl_program program = clCreateProgramWithSource(device->context, 1, &source, &text->size, &code);
    if (!opencl_check(code, "clCreateProgramWithSource", "kernel", name))
        return NULL;
    int hidden = opencl_hide_messages();
    code = clBuildProgram(program, 1, &device->id, options, NULL, NULL);
    opencl_show_messages(hidden);
    if (code == CL_SUCCESS)
        return program;
    build_failed(device, program, name, code);
    clReleaseProgram(program);
    return NULL;
}

static cl_program build_kernel(struct opencl_device *device, const struct rg_kernel *kernel,
                               const char *defines)
{
    struct rg_kernel_code text;
    void *owned;
    if (!rg_kernel_code(kernel, RG_CODE_OPENCL, &text, &owned))
        return NULL;
    cl_program program = opencl_build(device, &text, defines, kernel->name);
    free(owned);
    return program;
}

cl_kernel opencl_kernel_of(struct opencl_pass *pass, int variant, const char *entry,
                           const char *defines)
{
    if (pass->variants[variant])
        return pass->variants[variant];
    struct opencl_device *device = pass->device;
    const struct rg_kernel *kernel = pass->info;
    cl_program *program = &device->programs[rg_kernel_index(kernel) * OPENCL_VARIANTS + variant];
    if (!*program && !(*program = build_kernel(device, kernel, defines)))
        return NULL;
    cl_int code;
    pass->variants[variant] = clCreateKernel(*program, entry, &code);
    return opencl_check(code, "clCreateKernel", "kernel", kernel->name) ? pass->variants[variant]
                                                                        : NULL;
}

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
    struct opencl_pass *pass = calloc(1, sizeof(*pass));
    if (!pass)
        return rg_error_null("kernel '%s': no memory left", kernel->name);
    pass->device = (struct opencl_device *)device;
    pass->info = kernel;
    if (kernel->draw || opencl_kernel_of(pass, 0, "rg_grid", ""))
        return &pass->pub;
    opencl_pass_destroy(&pass->pub);
    return NULL;
}

cl_int opencl_set_slots(cl_kernel kernel, cl_uint next, const struct rg_kernel *info,
                        const struct rg_run *run)
{
    cl_int failed = CL_SUCCESS;
#define SET(size, value)                                                                           \
    failed = failed ? failed : clSetKernelArg(kernel, next++, (size_t)(size), value)
    for (int i = 0; i < info->slot_count; i++) {
        const struct rg_slot_info *slot = &info->slots[i];
        const struct opencl_buf *buf = (struct opencl_buf *)run->slots[slot->slot].buf;
        const struct opencl_image *image = (struct opencl_image *)run->slots[slot->slot].image;
        const cl_int count =
            buf ? (cl_int)(buf->pub.size / (size_t)slot->element_size) : image->words;
        SET(sizeof(cl_mem), buf ? &buf->memory.mem : &image->memory.mem);
        SET(sizeof(count), &count);
        if (image)
            SET(sizeof(image->shape), &image->shape);
    }
#undef SET
    return failed;
}

// The arguments of shaders/grid.cl, in its order. Drivers take about 20 ns for each.
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

// The items that run for so many in a row: the last group's surplus ends at once.
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
    opencl_will_queue(device);
    return opencl_check(clEnqueueNDRangeKernel(device->queue, pass->variants[0], 3, NULL, global,
                                               local, 0, NULL, NULL),
                        "clEnqueueNDRangeKernel", "kernel", name);
}

// Drivers may count a run's items in 32 bits: what is larger runs in two halves.
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
