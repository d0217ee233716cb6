#include "harness/record/passport/variables.h"

#include <stddef.h>
#include <string.h>

const struct rg_variable rg_variables[] = {
    // threads
    {"GOMP_CPU_AFFINITY", true},
    {"GOMP_SPINCOUNT", true},
    {"LP_NUM_THREADS", true},
    {"OMP_DYNAMIC", true},
    {"OMP_NUM_THREADS", true},
    {"OMP_PLACES", true},
    {"OMP_PROC_BIND", true},
    {"OMP_THREAD_LIMIT", true},
    {"OMP_WAIT_POLICY", true},
    {"POCL_AFFINITY", true},
    {"POCL_CPU_MAX_CU_COUNT", true},
    {"POCL_MAX_PTHREAD_COUNT", true},
    // choice of the driver
    {"EGL_PLATFORM", false},
    {"GALLIUM_DRIVER", false},
    {"LIBGL_ALWAYS_SOFTWARE", false},
    {"LIBGL_DRIVERS_PATH", false},
    {"MESA_GL_VERSION_OVERRIDE", false},
    {"MESA_LOADER_DRIVER_OVERRIDE", false},
    {"MESA_VK_DEVICE_SELECT", false},
    {"OCL_ICD_FILENAMES", false},
    {"OCL_ICD_VENDORS", false},
    {"POCL_DEVICES", false},
    {"RUSTICL_ENABLE", false},
    {"VK_ADD_DRIVER_FILES", false},
    {"VK_DRIVER_FILES", false},
    {"VK_ICD_FILENAMES", false},
    {"__EGL_VENDOR_LIBRARY_DIRS", false},
    {"__EGL_VENDOR_LIBRARY_FILENAMES", false},
    {"__GLX_VENDOR_LIBRARY_NAME", false},
    // choice of its code, and layers in between
    {"GALLIVM_DEBUG", true},
    {"GALLIVM_PERF", true},
    {"LD_LIBRARY_PATH", false},
    {"LD_PRELOAD", true},
    {"LP_NATIVE_VECTOR_WIDTH", true},
    {"LP_PERF", true},
    {"MESA_SHADER_CACHE_DISABLE", false},
    {"POCL_KERNEL_CACHE", false},
    {"VK_INSTANCE_LAYERS", true},
    // raingauge's own
    {"RG_BLENDING", true},
    {"RG_CPU_LEVEL", true},
    {"RG_ENVIRONMENT_DIR", false},
    {"RG_KERNEL_DIR", false},
    {"RG_LABELS", true},
    {"RG_MODEL_DIR", false},
    {"RG_NATIVE", true},
    {"RG_ROUNDING", true},
    {"RG_VK_VALIDATION", true},
    {NULL, false},
};

bool rg_variable_is_of_speed(const char *name)
{
    for (int i = 0; rg_variables[i].name; i++)
        if (!strcmp(rg_variables[i].name, name))
            return rg_variables[i].is_of_speed;
    return false;
}
