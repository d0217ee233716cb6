#include "backends/opencl/opencl.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"

enum { MAX_PLATFORMS = 16, MAX_TEXT = 1024 };

// Images lie in buffers: these bound no driver, and are as cpu has them.
enum { MAX_PX = 32768, MAX_LAYERS = 2048 };

// As shaders/grid.cl has it. On PoCL, 64 to 512 along x are equally fast, fewer or squarer slower.
enum { GROUP_ITEMS = 64 };

static const char *device_text(cl_device_id id, cl_device_info what, char text[MAX_TEXT])
{
    if (clGetDeviceInfo(id, what, MAX_TEXT, text, NULL) != CL_SUCCESS)
        strcpy(text, "unnamed");
    return text;
}

static const char *platform_text(cl_platform_id id, cl_platform_info what, char text[MAX_TEXT])
{
    if (clGetPlatformInfo(id, what, MAX_TEXT, text, NULL) != CL_SUCCESS)
        strcpy(text, "unnamed");
    return text;
}

// 0 where the driver does not know the property.
static cl_ulong device_number(cl_device_id id, cl_device_info what, size_t size)
{
    cl_ulong number = 0; // little-endian hosts alone: a narrower number fills its low bytes
    return clGetDeviceInfo(id, what, size, &number, NULL) == CL_SUCCESS ? number : 0;
}

// "OpenCL 3.0 PoCL 3.1" is 30.
static int version_number(const char *version)
{
    int major = 0, minor = 0;
    return sscanf(version, "OpenCL %d.%d", &major, &minor) == 2 ? major * 10 + minor : 0;
}

// Why kernels cannot run there, or NULL.
static const char *missing(cl_device_id id)
{
    char text[MAX_TEXT];
    if (!device_number(id, CL_DEVICE_AVAILABLE, sizeof(cl_bool)))
        return "is not available";
    if (!device_number(id, CL_DEVICE_COMPILER_AVAILABLE, sizeof(cl_bool)))
        return "has no compiler";
    if (version_number(device_text(id, CL_DEVICE_VERSION, text)) < 12)
        return "is older than OpenCL 1.2";
    if (!device_number(id, CL_DEVICE_ENDIAN_LITTLE, sizeof(cl_bool)))
        return "is big-endian";
    cl_ulong floats = device_number(id, CL_DEVICE_SINGLE_FP_CONFIG, sizeof(cl_device_fp_config));
    return floats & CL_FP_ROUND_TO_NEAREST ? NULL : "does not round floats to nearest";
}

// Adds the usable devices of a platform to `ids`; returns how many there are then.
static int find_on_platform(cl_platform_id platform, cl_device_id *ids, int count, int max,
                            char *why, size_t why_size)
{
    cl_device_id all[RG_MAX_DEVICES];
    cl_uint found = 0;
    char name[MAX_TEXT];
    cl_int code = clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, RG_MAX_DEVICES, all, &found);
    if (code != CL_SUCCESS) {
        platform_text(platform, CL_PLATFORM_NAME, name);
        snprintf(why, why_size, "no OpenCL device: %s on %.60s%s", opencl_error_name(code), name,
                 strcmp(name, "Portable Computing Language")
                     ? ""
                     : " (it obeys POCL_DEVICES and has to write to POCL_CACHE_DIR)");
        return count;
    }
    for (int i = 0; i < (int)found && i < RG_MAX_DEVICES && count < max; i++) {
        const char *reason = missing(all[i]);
        if (!reason)
            ids[count++] = all[i];
        else
            snprintf(why, why_size, "no OpenCL device: %.80s %s",
                     device_text(all[i], CL_DEVICE_NAME, name), reason);
    }
    return count;
}

static int find_on_platforms(cl_device_id *ids, int max, char *why, size_t why_size)
{
    cl_platform_id platforms[MAX_PLATFORMS];
    cl_uint found = 0;
    cl_int code = clGetPlatformIDs(MAX_PLATFORMS, platforms, &found);
    if (code != CL_SUCCESS || found == 0) {
        snprintf(why, why_size, "no OpenCL platform: clGetPlatformIDs failed with %s",
                 opencl_error_name(code));
        return 0;
    }
    int count = 0;
    for (int i = 0; i < (int)found && i < MAX_PLATFORMS; i++)
        count = find_on_platform(platforms[i], ids, count, max, why, why_size);
    return count;
}

// The usable devices in the loader's order (GPUs first); 0: none, and `why` says so.
static int find_devices(cl_device_id *ids, int max, char *why, size_t why_size)
{
    const char *cache = getenv("POCL_CACHE_DIR");
    if (cache && !*cache)
        unsetenv("POCL_CACHE_DIR"); // PoCL 3.1 aborts on an empty one
    int kept = opencl_hide_messages();
    int count = find_on_platforms(ids, max, why, why_size);
    opencl_show_messages(kept);
    return count;
}

static int64_t smaller(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

static struct rg_limits read_limits(cl_device_id id)
{
    const int64_t alloc =
        (int64_t)device_number(id, CL_DEVICE_MAX_MEM_ALLOC_SIZE, sizeof(cl_ulong));
    const struct rg_slot_limits any = {RG_MAX_SLOTS, RG_MAX_SLOTS, RG_MAX_SLOTS};
    struct rg_limits limits = {
        .max_objects = INT_MAX,
        .max_buffer_bytes = smaller(alloc, (int64_t)INT_MAX * 4), // kernels count words in an int
        .max_image_px = MAX_PX,
        .max_image_layers = MAX_LAYERS,
        .max_groups = {INT_MAX / GROUP_ITEMS, 65535, 65535}, // CUDA's, which NVIDIA runs on
        .group_items = GROUP_ITEMS,
        .slot_count = any,
        .slot_end = any,
        .has_clock = device_number(id, CL_DEVICE_PROFILING_TIMER_RESOLUTION, sizeof(size_t)) > 0,
    };
    for (int f = RG_FORMAT_NONE + 1; f < RG_FORMAT_COUNT; f++)
        limits.formats[f] = (struct rg_format_limits){
            RG_USE_ALL, MAX_PX, MAX_LAYERS, RG_MAX_LEVELS,
            smaller(rg_image_most_bytes((enum rg_format)f), limits.max_buffer_bytes)};
    return limits;
}

static void describe(cl_device_id id, int index, struct rg_device_info *info)
{
    char text[MAX_TEXT], version[MAX_TEXT], driver[MAX_TEXT];
    cl_platform_id platform = NULL;
    clGetDeviceInfo(id, CL_DEVICE_PLATFORM, sizeof(platform), &platform, NULL);
    *info = (struct rg_device_info){
        .software = device_number(id, CL_DEVICE_TYPE, sizeof(cl_device_type)) & CL_DEVICE_TYPE_CPU,
        .limits = read_limits(id),
    };
    info->tier = info->software ? RG_T0 : RG_T1;
    snprintf(info->name, sizeof(info->name), index ? "opencl:%d" : "opencl", index);
    snprintf(info->device, sizeof(info->device), "%.120s", device_text(id, CL_DEVICE_NAME, text));
    int api = version_number(device_text(id, CL_DEVICE_VERSION, version));
    snprintf(info->api, sizeof(info->api), "OpenCL %d.%d, used as 1.2, %d compute units", api / 10,
             api % 10, (int)device_number(id, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof(cl_uint)));
    // A platform's version is "OpenCL 3.0 " and what the vendor adds, such as PoCL's LLVM.
    const char *vendor = platform_text(platform, CL_PLATFORM_VERSION, version);
    vendor += strcspn(vendor, " ");
    vendor += strspn(vendor, " ");
    vendor += strcspn(vendor, " ");
    vendor += strspn(vendor, " ");
    snprintf(info->driver, sizeof(info->driver), "%.30s %.24s%s%.100s",
             platform_text(platform, CL_PLATFORM_NAME, text),
             device_text(id, CL_DRIVER_VERSION, driver), *vendor ? ", " : "", vendor);
}

static int opencl_list(struct rg_device_info *infos, int max, char *why, size_t why_size)
{
    cl_device_id ids[RG_MAX_DEVICES];
    int count = find_devices(ids, max < RG_MAX_DEVICES ? max : RG_MAX_DEVICES, why, why_size);
    for (int i = 0; i < count; i++)
        describe(ids[i], i, &infos[i]);
    return count;
}

static int kernel_count(void)
{
    const struct rg_kernel *const *all;
    return rg_kernel_all(&all);
}

static void opencl_destroy(struct rg_device *device)
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
    char why[160] = "";
    if (find_devices(ids, RG_MAX_DEVICES, why, sizeof(why)) <= index)
        return rg_driver_error_null("device 'opencl:%d': it is gone; %s", index, why);
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
    .package = "pocl-opencl-icd",
    .packed = true,
    .list = opencl_list,
    .create = opencl_create,
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
    .pass_run = opencl_pass_run,
    .sync = opencl_sync,
    .time = opencl_time,
};
