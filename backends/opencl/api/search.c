// Finds the devices that the ICD loader gives, and their properties.
#define _GNU_SOURCE // ST_NOEXEC
#include "backends/opencl/opencl.h"

#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "core/base/files/user.h"

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
    cl_ulong number = 0; // little-endian hosts only: a narrower number fills the low bytes
    return clGetDeviceInfo(id, what, size, &number, NULL) == CL_SUCCESS ? number : 0;
}

int opencl_version(const char *version)
{
    int major = 0, minor = 0;
    return sscanf(version, "OpenCL %d.%d", &major, &minor) == 2 ? major * 10 + minor : 0;
}

// Why a device cannot run kernels, or NULL.
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

// Notes a driver that is installed, and fails or is broken. This outweighs missing ones; the first
// failure stays.
__attribute__((format(printf, 3, 4))) static void
note(struct opencl_search *search, enum rg_manifest_state state, const char *format, ...)
{
    if (search->state != RG_MANIFEST_NONE)
        return;
    va_list args;
    va_start(args, format);
    vsnprintf(search->why, sizeof(search->why), format, args);
    va_end(args);
    search->state = state;
}

// PoCL has a device on every machine, unless POCL_DEVICES is empty. It silently reports none if it
// cannot write to its cache, or does not know any device in POCL_DEVICES.
static void blame_pocl(struct opencl_search *search)
{
    const char *devices = getenv("POCL_DEVICES"), *cache = getenv("POCL_CACHE_DIR");
    const char *user = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    char folder[PATH_MAX], why[256] = "";
    if (devices && !*devices)
        return;
    if (cache && *cache)
        snprintf(folder, sizeof(folder), "%s/", cache);
    else
        snprintf(folder, sizeof(folder), "%s%s/pocl/kcache/",
                 user && *user ? user
                 : home        ? home
                               : "",
                 user && *user ? "" : "/.cache");
    if (rg_user_make_folders(folder, why) && access(folder, W_OK | X_OK))
        snprintf(why, sizeof(why), "%.200s: %s", folder, strerror(errno));
    if (*why)
        note(search, RG_MANIFEST_BROKEN,
             "no OpenCL device: PoCL cannot write to its cache: %s; set POCL_CACHE_DIR to "
             "a folder that takes files",
             why);
    else if (devices)
        note(search, RG_MANIFEST_BROKEN,
             "no OpenCL device: PoCL has none that POCL_DEVICES=%.60s asks for; unset it", devices);
    else
        note(search, RG_MANIFEST_FAILED,
             "no OpenCL device: PoCL tells of none, though each machine has one");
}

static bool is_pocl(const char *platform)
{
    return !strcmp(platform, "Portable Computing Language");
}

static void blame_platform(struct opencl_search *search, const char *name, cl_int code)
{
    if (code != CL_DEVICE_NOT_FOUND)
        note(search, RG_MANIFEST_FAILED, "no OpenCL device: clGetDeviceIDs failed with %s on %.60s",
             opencl_error_name(code), name);
    else if (is_pocl(name))
        blame_pocl(search);
    if (search->state == RG_MANIFEST_NONE)
        snprintf(search->why, sizeof(search->why), "no OpenCL device: %s on %.60s",
                 opencl_error_name(code), name);
}

// Whether PoCL's cache folder, or its nearest existing parent, forbids execution: PoCL loads
// compiled programs from there, and aborts if it may not.
static bool cache_is_noexec(char folder[PATH_MAX])
{
    const char *own = getenv("POCL_CACHE_DIR"), *user = getenv("XDG_CACHE_HOME");
    const char *home = getenv("HOME");
    struct statvfs disk;
    snprintf(folder, PATH_MAX, "%s%s",
             own    ? own
             : user ? user
             : home ? home
                    : "/tmp",
             own || user || !home ? "" : "/.cache");
    while (statvfs(folder, &disk)) {
        char *slash = strrchr(folder, '/');
        if (!slash || slash == folder)
            return false;
        *slash = 0;
    }
    return disk.f_flag & ST_NOEXEC;
}

// Adds a platform's usable devices to `ids`; returns the new number.
static int find_on_platform(struct opencl_search *search, cl_platform_id platform,
                            cl_device_id *ids, int count, int max)
{
    cl_device_id all[RG_MAX_DEVICES];
    cl_uint found = 0;
    char name[OPENCL_TEXT], cache[PATH_MAX];
    cl_int code = clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof(name), name, NULL);
    if (code != CL_SUCCESS) {
        note(search, RG_MANIFEST_FAILED, "no OpenCL device: clGetPlatformInfo failed with %s",
             opencl_error_name(code));
        return count;
    }
    if (is_pocl(name) && cache_is_noexec(cache)) {
        note(search, RG_MANIFEST_FAILED,
             "PoCL cannot load what it compiles from %.50s, which is mounted noexec; set "
             "POCL_CACHE_DIR to another folder",
             cache);
        return count;
    }
    code = clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, RG_MAX_DEVICES, all, &found);
    if (code != CL_SUCCESS)
        blame_platform(search, name, code);
    for (int i = 0; code == CL_SUCCESS && i < (int)found && i < RG_MAX_DEVICES && count < max;
         i++) {
        const cl_int told = clGetDeviceInfo(all[i], CL_DEVICE_NAME, sizeof(name), name, NULL);
        const char *reason = told == CL_SUCCESS ? missing(all[i]) : NULL;
        if (told != CL_SUCCESS)
            note(search, RG_MANIFEST_FAILED, "no OpenCL device: clGetDeviceInfo failed with %s",
                 opencl_error_name(told));
        else if (!reason)
            ids[count++] = all[i];
        else if (search->state == RG_MANIFEST_NONE)
            snprintf(search->why, sizeof(search->why), "no OpenCL device: %.80s %s", name, reason);
    }
    return count;
}

static int find_on_platforms(struct opencl_search *search, cl_device_id *ids, int max)
{
    cl_platform_id platforms[MAX_PLATFORMS];
    cl_uint found = 0;
    int count = 0;
    cl_int code = clGetPlatformIDs(MAX_PLATFORMS, platforms, &found);
    if (code == CL_PLATFORM_NOT_FOUND_KHR || (code == CL_SUCCESS && !found))
        snprintf(search->why, sizeof(search->why), "no OpenCL platform: clGetPlatformIDs gives %s",
                 code ? opencl_error_name(code) : "none");
    else if (code != CL_SUCCESS)
        note(search, RG_MANIFEST_FAILED, "no OpenCL platform: clGetPlatformIDs failed with %s",
             opencl_error_name(code));
    for (int i = 0; code == CL_SUCCESS && i < (int)found && i < MAX_PLATFORMS; i++)
        count = find_on_platform(search, platforms[i], ids, count, max);
    return count;
}

int opencl_find(struct opencl_search *search, cl_device_id *ids, int max)
{
    const char *cache = getenv("POCL_CACHE_DIR");
    if (cache && !*cache)
        unsetenv("POCL_CACHE_DIR"); // PoCL 3.1 aborts on an empty one
    *search = (struct opencl_search){.state = RG_MANIFEST_NONE};
    int kept = opencl_hide_messages();
    int count = find_on_platforms(search, ids, max);
    opencl_show_messages(kept);
    return count;
}

const struct rg_manifest_rules opencl_manifests = {
    .instead = {"OCL_ICD_VENDORS", "OPENCL_VENDOR_PATH"},
    .beside = {"OCL_ICD_FILENAMES"},
    .places = {{NULL, "/etc/OpenCL/vendors"}},
    .below = "",
    .ending = ".icd",
    .names_libraries = true,
    .names_usual = true,
    .is_text = true,
    .functions = {"clGetExtensionFunctionAddress", "clIcdGetPlatformIDsKHR"},
    .package = OPENCL_PACKAGE,
};

int opencl_judge(const struct opencl_search *search, int count, char *why, size_t why_size)
{
    snprintf(why, why_size, "%s", search->why);
    return rg_manifests_judge(&opencl_manifests, count, search->state, why, why_size);
}
