#include "backends/opencl/opencl.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"

// As in shaders/grid.cl. On PoCL, 64 to 512 along x are equally fast, fewer or squarer slower.
enum { GROUP_ITEMS = 64 };

static struct rg_limits read_limits(cl_device_id id)
{
    const int64_t countable = (int64_t)INT_MAX * 4; // kernels index words by an int
    const int64_t alloc =
        (int64_t)opencl_number(id, CL_DEVICE_MAX_MEM_ALLOC_SIZE, sizeof(cl_ulong));
    const struct rg_slot_limits any = {RG_MAX_SLOTS, RG_MAX_SLOTS, RG_MAX_SLOTS};
    struct rg_limits limits = {
        .max_objects = INT_MAX,
        .max_buffer_bytes = alloc < countable ? alloc : countable,
        .max_image_px = RG_PLAIN_MAX_PX,
        .max_image_layers = RG_PLAIN_MAX_LAYERS,
        .max_groups = {INT_MAX / GROUP_ITEMS, 65535, 65535}, // CUDA's limits, for NVIDIA
        .group_items = GROUP_ITEMS,
        .slot_count = any,
        .slot_end = any,
        .no_native = "draws by its own programs",
        .has_clock = opencl_number(id, CL_DEVICE_PROFILING_TIMER_RESOLUTION, sizeof(size_t)) > 0,
    };
    rg_plain_formats(limits.formats, limits.max_buffer_bytes);
    return limits;
}

static void describe(cl_device_id id, int index, struct rg_device_info *info)
{
    char text[OPENCL_TEXT], version[OPENCL_TEXT], driver[OPENCL_TEXT];
    cl_platform_id platform = NULL;
    clGetDeviceInfo(id, CL_DEVICE_PLATFORM, sizeof(platform), &platform, NULL);
    *info = (struct rg_device_info){
        .software = opencl_number(id, CL_DEVICE_TYPE, sizeof(cl_device_type)) & CL_DEVICE_TYPE_CPU,
        .limits = read_limits(id),
    };
    info->tier = info->software ? RG_T0 : RG_T1;
    snprintf(info->name, sizeof(info->name), index ? "opencl:%d" : "opencl", index);
    snprintf(info->device, sizeof(info->device), "%.120s", opencl_text(id, CL_DEVICE_NAME, text));
    int api = opencl_version(opencl_text(id, CL_DEVICE_VERSION, version));
    snprintf(info->api, sizeof(info->api), "OpenCL %d.%d, used as 1.2, %d compute units", api / 10,
             api % 10, (int)opencl_number(id, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof(cl_uint)));
    // A platform's version is "OpenCL 3.0 " and the vendor's text, such as PoCL's LLVM.
    const char *vendor = opencl_platform_text(platform, CL_PLATFORM_VERSION, version);
    vendor += strcspn(vendor, " ");
    vendor += strspn(vendor, " ");
    vendor += strcspn(vendor, " ");
    vendor += strspn(vendor, " ");
    snprintf(info->driver, sizeof(info->driver), "%.30s %.24s%s%.100s",
             opencl_platform_text(platform, CL_PLATFORM_NAME, text),
             opencl_text(id, CL_DRIVER_VERSION, driver), *vendor ? ", " : "", vendor);
}

static int opencl_list(struct rg_device_info *infos, int max, char *why, size_t why_size)
{
    cl_device_id ids[RG_MAX_DEVICES];
    struct opencl_search search;
    rg_manifests_begin(&opencl_manifests);
    int count = opencl_find(&search, ids, max < RG_MAX_DEVICES ? max : RG_MAX_DEVICES);
    for (int i = 0; i < count; i++)
        describe(ids[i], i, &infos[i]);
    return opencl_judge(&search, count, why, why_size);
}

static int kernel_count(void)
{
    const struct rg_kernel *const *all;
    return rg_kernel_all(&all);
}

static bool opencl_destroy(struct rg_device *device)
{
    struct opencl_device *opencl = (struct opencl_device *)device;
    opencl_bins_destroy(opencl);
    for (int i = 0; opencl->programs && i < kernel_count() * OPENCL_VARIANTS; i++)
        if (opencl->programs[i])
            clReleaseProgram(opencl->programs[i]);
    free(opencl->programs);
    if (opencl->queue)
        clReleaseCommandQueue(opencl->queue);
    if (opencl->context)
        clReleaseContext(opencl->context);
    free(opencl);
    return true;
}

static bool open_queue(struct opencl_device *device)
{
    const char *name = device->pub.info.name;
    cl_int code;
    device->context = clCreateContext(NULL, 1, &device->id, NULL, NULL, &code);
    if (!opencl_check(code, "clCreateContext", "device", name))
        return false;
    device->queue =
        clCreateCommandQueue(device->context, device->id, CL_QUEUE_PROFILING_ENABLE, &code);
    return opencl_check(code, "clCreateCommandQueue", "device", name);
}

static struct rg_device *opencl_create(int index)
{
    cl_device_id ids[RG_MAX_DEVICES];
    struct opencl_search search;
    if (opencl_find(&search, ids, RG_MAX_DEVICES) <= index)
        return rg_driver_error_null("device 'opencl:%d': it is gone; %s", index, search.why);
    struct opencl_device *device = rg_alloc(1, sizeof(*device), "device 'opencl'");
    if (device)
        device->programs = rg_alloc((size_t)kernel_count() * OPENCL_VARIANTS, sizeof(cl_program),
                                    "device 'opencl'");
    if (!device || !device->programs) {
        free(device);
        return NULL;
    }
    device->id = ids[index];
    describe(device->id, index, &device->pub.info);
    if (open_queue(device))
        return &device->pub;
    opencl_destroy(&device->pub);
    return NULL;
}

const struct rg_backend rg_backend_opencl = {
    .name = "opencl",
    .package = OPENCL_PACKAGE,
    .packed = true,
    .list = opencl_list,
    .create = opencl_create,
    .functions = opencl_functions,
    .destroy = opencl_destroy,
    .buf_create = opencl_buf_create,
    .buf_destroy = opencl_buf_destroy,
    .buf_write = opencl_buf_write,
    .buf_read = opencl_buf_read,
    .image_create = opencl_image_create,
    .image_destroy = opencl_image_destroy,
    .image_write = opencl_image_write,
    .image_read = opencl_image_read,
    .image_clear = opencl_image_clear,
    .pass_create = opencl_pass_create,
    .pass_destroy = opencl_pass_destroy,
    .pass_code = opencl_pass_code,
    .pass_run = opencl_pass_run,
    .sync = opencl_sync,
    .time = opencl_time,
};
