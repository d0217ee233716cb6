// The devices that the ICD loader finds, and what they say of themselves.
#include "backends/opencl/opencl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_PLATFORMS = 16 };

const char *opencl_text(cl_device_id id, cl_device_info what, char text[OPENCL_TEXT])
{
    if (clGetDeviceInfo(id, what, OPENCL_TEXT, text, NULL) != CL_SUCCESS)
        strcpy(text, "unnamed");
    return text;
}

const char *opencl_platform_text(cl_platform_id id, cl_platform_info what, char text[OPENCL_TEXT])
{
    if (clGetPlatformInfo(id, what, OPENCL_TEXT, text, NULL) != CL_SUCCESS)
        strcpy(text, "unnamed");
    return text;
}

cl_ulong opencl_number(cl_device_id id, cl_device_info what, size_t size)
{
    cl_ulong number = 0; // little-endian hosts alone: a narrower number fills its low bytes
    return clGetDeviceInfo(id, what, size, &number, NULL) == CL_SUCCESS ? number : 0;
}

int opencl_version(const char *version)
{
    int major = 0, minor = 0;
    return sscanf(version, "OpenCL %d.%d", &major, &minor) == 2 ? major * 10 + minor : 0;
}

// Why kernels cannot run on a device, or NULL.
static const char *missing(cl_device_id id)
{
    char text[OPENCL_TEXT];
    if (!opencl_number(id, CL_DEVICE_AVAILABLE, sizeof(cl_bool)))
        return "is not available";
    if (!opencl_number(id, CL_DEVICE_COMPILER_AVAILABLE, sizeof(cl_bool)))
        return "has no compiler";
    if (opencl_version(opencl_text(id, CL_DEVICE_VERSION, text)) < 12)
        return "is older than OpenCL 1.2";
    if (!opencl_number(id, CL_DEVICE_ENDIAN_LITTLE, sizeof(cl_bool)))
        return "is big-endian";
    cl_ulong floats = opencl_number(id, CL_DEVICE_SINGLE_FP_CONFIG, sizeof(cl_device_fp_config));
    return floats & CL_FP_ROUND_TO_NEAREST ? NULL : "does not round floats to nearest";
}

// Adds the usable devices of a platform to `ids`; returns how many there are then.
static int find_on_platform(cl_platform_id platform, cl_device_id *ids, int count, int max,
                            char *why, size_t why_size)
{
    cl_device_id all[RG_MAX_DEVICES];
    cl_uint found = 0;
    char name[OPENCL_TEXT];
    cl_int code = clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, RG_MAX_DEVICES, all, &found);
    if (code != CL_SUCCESS) {
        opencl_platform_text(platform, CL_PLATFORM_NAME, name);
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
                     opencl_text(all[i], CL_DEVICE_NAME, name), reason);
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

int opencl_find(cl_device_id *ids, int max, char *why, size_t why_size)
{
    const char *cache = getenv("POCL_CACHE_DIR");
    if (cache && !*cache)
        unsetenv("POCL_CACHE_DIR"); // PoCL 3.1 aborts on an empty one
    int kept = opencl_hide_messages();
    int count = find_on_platforms(ids, max, why, why_size);
    opencl_show_messages(kept);
    return count;
}
