// A driver that misbehaves, for each API: one function of it aborts, faults, ends the process,
// hangs, takes memory without end, or reports that the device is lost or has no room for work.
//
// RG_MISBEHAVE=FUNCTION:HOW:CALLS names the function, the way (one of ways.h, lost or none), and
// the number of good calls before. All other calls go to the real driver. For Vulkan this library
// is a driver in front of lavapipe, which the loader finds by a manifest (VK_DRIVER_FILES). It may
// also change a constant of a shader, or be another build of lavapipe. For EGL, OpenGL and OpenCL
// it is loaded before others (LD_PRELOAD). faults.c makes any function fail, but is no driver of
// its own.
#define _GNU_SOURCE // for hooks.h
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <EGL/egl.h>
#include <GL/gl.h>
#include <GL/glext.h>

#include "tests/cli/drivers/hooks.h"
#include "tests/cli/drivers/ways.h"

// --- misbehaving ---

// Whether this call has to report a lost device; does not return if the process ends or hangs.
static bool misbehaves(const char *function)
{
    static int calls;
    const char *asked = getenv("RG_MISBEHAVE");
    char name[64] = "", how[16] = "";
    int after = 0;
    if (!asked || sscanf(asked, "%63[^:]:%15[^:]:%d", name, how, &after) != 3 ||
        strcmp(name, function) != 0 || calls++ < after)
        return false;
    end_as(how);
    return true;
}

// Whether RG_VANISH=FILE:PROCESSES makes the driver list no device: that many processes have asked
// before. The file has a byte for each.
static bool has_vanished(void)
{
    static int is_gone = -1;
    const char *asked = getenv("RG_VANISH");
    char path[256] = "";
    long processes = 0;
    if (is_gone < 0 && asked && sscanf(asked, "%255[^:]:%ld", path, &processes) == 2) {
        FILE *file = fopen(path, "a");
        is_gone = file && ftell(file) >= processes;
        if (file) {
            fputc('.', file);
            fclose(file);
        }
    }
    return is_gone > 0;
}

// RG_DRIVER_AS=NAME=VALUE: the real driver is as one that is built with this setting.
__attribute__((constructor)) static void build(void)
{
    char *setting = getenv("RG_DRIVER_AS");
    if (setting)
        putenv(setting);
}

// --- functions that are looked up by name ---

static PFN_vkEnumeratePhysicalDevices real_vkEnumeratePhysicalDevices;
static PFN_vkGetPhysicalDeviceProperties2 real_vkGetPhysicalDeviceProperties2;
static PFN_vkCreateDevice real_vkCreateDevice;
static PFN_vkDestroyDevice real_vkDestroyDevice;
static PFN_vkCreateComputePipelines real_vkCreateComputePipelines;
static PFN_vkCreateGraphicsPipelines real_vkCreateGraphicsPipelines;
static PFN_vkCreateShaderModule real_vkCreateShaderModule;
static PFN_vkQueueSubmit real_vkQueueSubmit;
static PFN_vkWaitForFences real_vkWaitForFences;
static PFN_vkGetDeviceProcAddr real_vkGetDeviceProcAddr;
static EGLBoolean (*real_eglInitialize)(EGLDisplay, EGLint *, EGLint *);
static any_function (*real_eglGetProcAddress)(const char *);
static void (*real_glLinkProgram)(GLuint);
static void (*real_glDispatchCompute)(GLuint, GLuint, GLuint);
static void (*real_glBlendFunc)(GLenum, GLenum);
static void (*real_glFinish)(void);
static GLenum (*real_glGetError)(void);

static VkResult hooked_vkEnumeratePhysicalDevices(VkInstance i, uint32_t *n, VkPhysicalDevice *d)
{
    if (has_vanished()) {
        *n = 0;
        return VK_SUCCESS;
    }
    return misbehaves("vkEnumeratePhysicalDevices") ? VK_ERROR_INITIALIZATION_FAILED
                                                    : real_vkEnumeratePhysicalDevices(i, n, d);
}

static void hooked_vkGetPhysicalDeviceProperties2(VkPhysicalDevice p,
                                                  VkPhysicalDeviceProperties2 *all)
{
    real_vkGetPhysicalDeviceProperties2(p, all);
    for (int i = 0; i < 3 && misbehaves("vkGetPhysicalDeviceProperties2"); i++)
        all->properties.limits.maxComputeWorkGroupCount[i] = 0;
}

static VkResult hooked_vkCreateDevice(VkPhysicalDevice p, const VkDeviceCreateInfo *info,
                                      const VkAllocationCallbacks *a, VkDevice *d)
{
    return misbehaves("vkCreateDevice") ? VK_ERROR_DEVICE_LOST : real_vkCreateDevice(p, info, a, d);
}

static void hooked_vkDestroyDevice(VkDevice d, const VkAllocationCallbacks *a)
{
    if (!misbehaves("vkDestroyDevice"))
        real_vkDestroyDevice(d, a);
}

static VkResult hooked_vkCreateComputePipelines(VkDevice d, VkPipelineCache c, uint32_t n,
                                                const VkComputePipelineCreateInfo *infos,
                                                const VkAllocationCallbacks *a, VkPipeline *p)
{
    return misbehaves("vkCreateComputePipelines")
               ? VK_ERROR_DEVICE_LOST
               : real_vkCreateComputePipelines(d, c, n, infos, a, p);
}

// Reports a lost device, or with "none" makes a pipeline that does not blend.
static VkResult hooked_vkCreateGraphicsPipelines(VkDevice d, VkPipelineCache c, uint32_t n,
                                                 const VkGraphicsPipelineCreateInfo *infos,
                                                 const VkAllocationCallbacks *a, VkPipeline *p)
{
    if (!misbehaves("vkCreateGraphicsPipelines"))
        return real_vkCreateGraphicsPipelines(d, c, n, infos, a, p);
    if (!strstr(getenv("RG_MISBEHAVE"), ":none:") || n != 1)
        return VK_ERROR_DEVICE_LOST;
    VkGraphicsPipelineCreateInfo changed = *infos;
    VkPipelineColorBlendStateCreateInfo blend = *infos->pColorBlendState;
    VkPipelineColorBlendAttachmentState opaque = *blend.pAttachments;
    opaque.blendEnable = VK_FALSE;
    blend.pAttachments = &opaque;
    changed.pColorBlendState = &blend;
    return real_vkCreateGraphicsPipelines(d, c, 1, &changed, a, p);
}

static VkResult hooked_vkQueueSubmit(VkQueue q, uint32_t n, const VkSubmitInfo *infos, VkFence f)
{
    return misbehaves("vkQueueSubmit") ? VK_ERROR_DEVICE_LOST : real_vkQueueSubmit(q, n, infos, f);
}

static VkResult hooked_vkWaitForFences(VkDevice d, uint32_t n, const VkFence *f, VkBool32 all,
                                       uint64_t ns)
{
    return misbehaves("vkWaitForFences") ? VK_ERROR_DEVICE_LOST
                                         : real_vkWaitForFences(d, n, f, all, ns);
}

// RG_MISCOMPILE=BYTES:WORD:VALUE, the last two in hexadecimal: in the shader of this many bytes,
// four-byte constants equal to WORD become VALUE.
static VkResult hooked_vkCreateShaderModule(VkDevice d, const VkShaderModuleCreateInfo *info,
                                            const VkAllocationCallbacks *a, VkShaderModule *m)
{
    enum { OP_CONSTANT = 43, CONSTANT_WORDS = 4, HEADER_WORDS = 5 };
    const char *asked = getenv("RG_MISCOMPILE");
    size_t bytes;
    uint32_t from, to;
    if (!asked || sscanf(asked, "%zu:%x:%x", &bytes, &from, &to) != 3 || bytes != info->codeSize)
        return real_vkCreateShaderModule(d, info, a, m);
    uint32_t *code = malloc(bytes);
    if (!code)
        return VK_ERROR_OUT_OF_HOST_MEMORY;
    memcpy(code, info->pCode, bytes);
    for (size_t i = HEADER_WORDS; i < bytes / 4 && code[i] >> 16; i += code[i] >> 16)
        if (code[i] == (CONSTANT_WORDS << 16 | OP_CONSTANT) && code[i + 3] == from)
            code[i + 3] = to;
    VkShaderModuleCreateInfo changed = *info;
    changed.pCode = code;
    const VkResult result = real_vkCreateShaderModule(d, &changed, a, m);
    free(code);
    return result;
}

static PFN_vkVoidFunction hooked_vkGetDeviceProcAddr(VkDevice device, const char *name)
{
    return hook_of(name, real_vkGetDeviceProcAddr(device, name));
}

static EGLBoolean hooked_eglInitialize(EGLDisplay d, EGLint *major, EGLint *minor)
{
    return misbehaves("eglInitialize") ? EGL_FALSE : real_eglInitialize(d, major, minor);
}

static any_function hooked_eglGetProcAddress(const char *name)
{
    return hook_of(name, real_eglGetProcAddress(name));
}

static void hooked_glLinkProgram(GLuint program)
{
    if (!misbehaves("glLinkProgram"))
        real_glLinkProgram(program);
}

static void hooked_glDispatchCompute(GLuint x, GLuint y, GLuint z)
{
    if (!misbehaves("glDispatchCompute"))
        real_glDispatchCompute(x, y, z);
}

static void hooked_glBlendFunc(GLenum source, GLenum target)
{
    if (!misbehaves("glBlendFunc"))
        real_glBlendFunc(source, target);
}

static void hooked_glFinish(void)
{
    if (!misbehaves("glFinish"))
        real_glFinish();
}

static GLenum hooked_glGetError(void)
{
    return misbehaves("glGetError") ? GL_CONTEXT_LOST : real_glGetError();
}

static any_function hook_of(const char *name, any_function real)
{
    static const struct hook hooks[] = {
        HOOK(vkEnumeratePhysicalDevices),
        HOOK(vkGetPhysicalDeviceProperties2),
        HOOK(vkCreateDevice),
        HOOK(vkDestroyDevice),
        HOOK(vkCreateComputePipelines),
        HOOK(vkCreateGraphicsPipelines),
        HOOK(vkCreateShaderModule),
        HOOK(vkQueueSubmit),
        HOOK(vkWaitForFences),
        HOOK(vkGetDeviceProcAddr),
        HOOK(eglInitialize),
        HOOK(eglGetProcAddress),
        HOOK(glLinkProgram),
        HOOK(glDispatchCompute),
        HOOK(glBlendFunc),
        HOOK(glFinish),
        HOOK(glGetError),
    };
    return hook_among(hooks, sizeof(hooks) / sizeof(hooks[0]), name, real);
}

// --- OpenCL: linked functions ---

cl_int clGetDeviceIDs(cl_platform_id platform, cl_device_type type, cl_uint room,
                      cl_device_id *devices, cl_uint *count)
{
    return misbehaves("clGetDeviceIDs")
               ? CL_OUT_OF_HOST_MEMORY
               : REAL(clGetDeviceIDs)(platform, type, room, devices, count);
}

cl_int clBuildProgram(cl_program program, cl_uint count, const cl_device_id *devices,
                      const char *options, void(CL_CALLBACK *notify)(cl_program, void *),
                      void *user)
{
    return misbehaves("clBuildProgram")
               ? CL_OUT_OF_RESOURCES
               : REAL(clBuildProgram)(program, count, devices, options, notify, user);
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                              const size_t *offset, const size_t *global, const size_t *local,
                              cl_uint waits, const cl_event *list, cl_event *event)
{
    return misbehaves("clEnqueueNDRangeKernel")
               ? CL_OUT_OF_RESOURCES
               : REAL(clEnqueueNDRangeKernel)(queue, kernel, dimensions, offset, global, local,
                                              waits, list, event);
}

cl_int clFinish(cl_command_queue queue)
{
    return misbehaves("clFinish") ? CL_OUT_OF_RESOURCES : REAL(clFinish)(queue);
}
