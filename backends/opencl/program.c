// Programs, built by the driver's compiler and kept with the device.
#include "backends/opencl/opencl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"

// Options that change no value. FP contraction is switched off by a pragma in
// kernels/dialect/lang.h.
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

// Logs a compiler's messages in one line: the first error, else the first line.
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
    rg_driver_error("kernel '%s': clBuildProgram failed with %s on %s: %.*s", name,
                    opencl_error_name(code), device->pub.info.name, (int)strcspn(line, "\r\n"),
                    line);
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
    if (!rg_kernel_code(kernel, RG_CODE_OPENCL, false, &text))
        return NULL;
    cl_program program = opencl_build(device, &text, defines, kernel->name);
    free(text.bytes);
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
