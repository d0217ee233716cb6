// A driver that cannot compile or run one kernel, for each API.
//
// RG_KERNEL=FILE names the kernel by its code: SPIR-V, GLSL or OpenCL C. RG_FAILS=WHEN:HOW says
// when the driver fails and how. WHEN is compile, run (its first run), or wait: somebody waits for
// the run, as with drivers that compile in a thread of their own. HOW is abort, fault, exit, hang,
// or report an error. All other calls go to the real driver. For Vulkan this library is a driver in
// front of lavapipe; for OpenGL and OpenCL it is loaded before others (LD_PRELOAD).
#define _GNU_SOURCE // for hooks.h, memmem
#include <pthread.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <GL/gl.h>
#include <GL/glext.h>

#include "tests/cli/drivers/hooks.h"

// --- failing ---

static bool is_kernel(const void *code, size_t size)
{
    static char own[1 << 22];
    static size_t own_size;
    const char *path = getenv("RG_KERNEL");
    FILE *file = own_size || !path ? NULL : fopen(path, "rb");
    if (file) {
        own_size = fread(own, 1, sizeof(own), file);
        fclose(file);
    }
    return own_size && size >= own_size && !memcmp(code, own, own_size);
}

static void *end(void *how)
{
    volatile int *volatile nowhere = NULL;
    if (!strcmp(how, "abort"))
        abort();
    if (!strcmp(how, "fault"))
        *nowhere = 1;
    if (!strcmp(how, "exit"))
        _exit(0);
    return how;
}

// Whether to report an error now; does not return if the process ends or hangs.
static bool fails(const char *when)
{
    static char how[16];
    char asked[16] = "";
    const char *fails = getenv("RG_FAILS");
    if (!fails || sscanf(fails, "%15[^:]:%15s", asked, how) != 2 || strcmp(asked, when) != 0)
        return false;
    pthread_t thread;
    if (!strcmp(when, "wait") && !pthread_create(&thread, NULL, end, how))
        pthread_join(thread, NULL);
    end(how);
    while (!strcmp(how, "hang"))
        pause();
    return true;
}

// The kernel's handles in the API, 0 until they are known; whether it is bound, and whether it has
// run without a wait since.
static uint64_t modules, pipelines, programs;
static bool is_bound, is_pending;

static bool runs(bool is_it)
{
    is_pending = is_pending || is_it;
    return is_it && fails("run");
}

static bool waits(void)
{
    const bool was_pending = is_pending;
    is_pending = false;
    return was_pending && fails("wait");
}

// --- Vulkan and OpenGL: functions that are looked up by name ---

static PFN_vkCreateShaderModule real_vkCreateShaderModule;
static PFN_vkCreateComputePipelines real_vkCreateComputePipelines;
static PFN_vkCmdBindPipeline real_vkCmdBindPipeline;
static PFN_vkQueueSubmit real_vkQueueSubmit;
static PFN_vkWaitForFences real_vkWaitForFences;
static PFN_vkGetDeviceProcAddr real_vkGetDeviceProcAddr;
static any_function (*real_eglGetProcAddress)(const char *);
static PFNGLSHADERSOURCEPROC real_glShaderSource;
static PFNGLATTACHSHADERPROC real_glAttachShader;
static PFNGLLINKPROGRAMPROC real_glLinkProgram;
static PFNGLUSEPROGRAMPROC real_glUseProgram;
static PFNGLDISPATCHCOMPUTEPROC real_glDispatchCompute;
static PFNGLGETNAMEDBUFFERSUBDATAPROC real_glGetNamedBufferSubData;
static PFNGLGETTEXTURESUBIMAGEPROC real_glGetTextureSubImage;
static void (*real_glFinish)(void);

static VkResult hooked_vkCreateShaderModule(VkDevice d, const VkShaderModuleCreateInfo *info,
                                            const VkAllocationCallbacks *a, VkShaderModule *m)
{
    const VkResult result = real_vkCreateShaderModule(d, info, a, m);
    if (result == VK_SUCCESS && is_kernel(info->pCode, info->codeSize))
        modules = (uint64_t)*m;
    else if (result == VK_SUCCESS && modules == (uint64_t)*m)
        modules = 0; // its number was reused
    return result;
}

static VkResult hooked_vkCreateComputePipelines(VkDevice d, VkPipelineCache c, uint32_t n,
                                                const VkComputePipelineCreateInfo *infos,
                                                const VkAllocationCallbacks *a, VkPipeline *p)
{
    const bool is_it = modules && (uint64_t)infos->stage.module == modules;
    if (is_it && fails("compile"))
        return VK_ERROR_UNKNOWN;
    const VkResult result = real_vkCreateComputePipelines(d, c, n, infos, a, p);
    if (result == VK_SUCCESS && (is_it || pipelines == (uint64_t)*p))
        pipelines = is_it ? (uint64_t)*p : 0;
    return result;
}

static void hooked_vkCmdBindPipeline(VkCommandBuffer b, VkPipelineBindPoint point, VkPipeline p)
{
    is_bound = is_bound || (pipelines && (uint64_t)p == pipelines);
    real_vkCmdBindPipeline(b, point, p);
}

static VkResult hooked_vkQueueSubmit(VkQueue q, uint32_t n, const VkSubmitInfo *infos, VkFence f)
{
    const bool is_it = is_bound;
    is_bound = false;
    return runs(is_it) ? VK_ERROR_DEVICE_LOST : real_vkQueueSubmit(q, n, infos, f);
}

static VkResult hooked_vkWaitForFences(VkDevice d, uint32_t n, const VkFence *f, VkBool32 all,
                                       uint64_t ns)
{
    return waits() ? VK_ERROR_DEVICE_LOST : real_vkWaitForFences(d, n, f, all, ns);
}

static void hooked_glShaderSource(GLuint shader, GLsizei n, const GLchar *const *texts,
                                  const GLint *lengths)
{
    if (n == 1 && lengths && is_kernel(texts[0], (size_t)lengths[0]))
        modules = shader;
    else if (modules == shader)
        modules = 0;
    real_glShaderSource(shader, n, texts, lengths);
}

static void hooked_glAttachShader(GLuint program, GLuint shader)
{
    if (modules && shader == modules)
        programs = program;
    else if (programs == program)
        programs = 0;
    real_glAttachShader(program, shader);
}

static void hooked_glLinkProgram(GLuint program)
{
    if (!programs || program != programs || !fails("compile"))
        real_glLinkProgram(program);
}

static void hooked_glUseProgram(GLuint program)
{
    is_bound = programs && program == programs;
    real_glUseProgram(program);
}

static void hooked_glDispatchCompute(GLuint x, GLuint y, GLuint z)
{
    if (!runs(is_bound))
        real_glDispatchCompute(x, y, z);
}

static void hooked_glFinish(void)
{
    waits();
    real_glFinish();
}

static void hooked_glGetNamedBufferSubData(GLuint buffer, GLintptr at, GLsizeiptr size, void *data)
{
    waits();
    real_glGetNamedBufferSubData(buffer, at, size, data);
}

static void hooked_glGetTextureSubImage(GLuint texture, GLint level, GLint x, GLint y, GLint z,
                                        GLsizei w, GLsizei h, GLsizei d, GLenum format, GLenum type,
                                        GLsizei size, void *data)
{
    waits();
    real_glGetTextureSubImage(texture, level, x, y, z, w, h, d, format, type, size, data);
}

static PFN_vkVoidFunction hooked_vkGetDeviceProcAddr(VkDevice device, const char *name)
{
    return hook_of(name, real_vkGetDeviceProcAddr(device, name));
}

static any_function hooked_eglGetProcAddress(const char *name)
{
    return hook_of(name, real_eglGetProcAddress(name));
}

static any_function hook_of(const char *name, any_function real)
{
    static const struct hook hooks[] = {
        HOOK(vkCreateShaderModule),
        HOOK(vkCreateComputePipelines),
        HOOK(vkCmdBindPipeline),
        HOOK(vkQueueSubmit),
        HOOK(vkWaitForFences),
        HOOK(vkGetDeviceProcAddr),
        HOOK(eglGetProcAddress),
        HOOK(glShaderSource),
        HOOK(glAttachShader),
        HOOK(glLinkProgram),
        HOOK(glUseProgram),
        HOOK(glDispatchCompute),
        HOOK(glFinish),
        HOOK(glGetNamedBufferSubData),
        HOOK(glGetTextureSubImage),
    };
    return hook_among(hooks, sizeof(hooks) / sizeof(hooks[0]), name, real);
}

// --- OpenCL: linked functions ---

cl_program clCreateProgramWithSource(cl_context context, cl_uint n, const char **texts,
                                     const size_t *lengths, cl_int *code)
{
    cl_program program = REAL(clCreateProgramWithSource)(context, n, texts, lengths, code);
    if (n == 1 && lengths && is_kernel(texts[0], lengths[0]))
        programs = (uint64_t)(uintptr_t)program;
    return program;
}

cl_int clBuildProgram(cl_program program, cl_uint count, const cl_device_id *devices,
                      const char *options, void(CL_CALLBACK *notify)(cl_program, void *),
                      void *user)
{
    if (program && (uint64_t)(uintptr_t)program == programs && fails("compile"))
        return CL_BUILD_PROGRAM_FAILURE;
    return REAL(clBuildProgram)(program, count, devices, options, notify, user);
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                              const size_t *offset, const size_t *global, const size_t *local,
                              cl_uint count, const cl_event *list, cl_event *event)
{
    cl_program program = NULL;
    clGetKernelInfo(kernel, CL_KERNEL_PROGRAM, sizeof(program), &program, NULL);
    if (runs(program && (uint64_t)(uintptr_t)program == programs))
        return CL_OUT_OF_RESOURCES;
    return REAL(clEnqueueNDRangeKernel)(queue, kernel, dimensions, offset, global, local, count,
                                        list, event);
}

cl_int clFinish(cl_command_queue queue)
{
    return waits() ? CL_OUT_OF_RESOURCES : REAL(clFinish)(queue);
}

cl_int clEnqueueReadBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocks, size_t at,
                           size_t size, void *data, cl_uint count, const cl_event *list,
                           cl_event *event)
{
    return waits() ? CL_OUT_OF_RESOURCES
                   : REAL(clEnqueueReadBuffer)(queue, buffer, blocks, at, size, data, count, list,
                                               event);
}
