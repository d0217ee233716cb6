#include "harness/record/passport/passport.h"

#include <stdlib.h>
#include <string.h>

#include "backends/kernel.h"
#include "harness/record/passport/build_info.h"
#include "harness/record/passport/machine.h"
#include "harness/record/named.h"
#include "harness/record/passport/program.h"

// The variables that change what runs, where, or on how many threads. Only these are recorded.
static const char *const variables[] = {
    // threads
    "GOMP_CPU_AFFINITY", "GOMP_SPINCOUNT", "LP_NUM_THREADS", "OMP_DYNAMIC", "OMP_NUM_THREADS",
    "OMP_PLACES", "OMP_PROC_BIND", "OMP_THREAD_LIMIT", "OMP_WAIT_POLICY", "POCL_AFFINITY",
    "POCL_CPU_MAX_CU_COUNT", "POCL_MAX_PTHREAD_COUNT",
    // which driver
    "EGL_PLATFORM", "GALLIUM_DRIVER", "LIBGL_ALWAYS_SOFTWARE", "LIBGL_DRIVERS_PATH",
    "MESA_GL_VERSION_OVERRIDE", "MESA_LOADER_DRIVER_OVERRIDE", "MESA_VK_DEVICE_SELECT",
    "OCL_ICD_FILENAMES", "OCL_ICD_VENDORS", "POCL_DEVICES", "RUSTICL_ENABLE", "VK_ADD_DRIVER_FILES",
    "VK_DRIVER_FILES", "VK_ICD_FILENAMES", "__EGL_VENDOR_LIBRARY_DIRS",
    "__EGL_VENDOR_LIBRARY_FILENAMES", "__GLX_VENDOR_LIBRARY_NAME",
    // what code it makes, and what stands between
    "GALLIVM_DEBUG", "GALLIVM_PERF", "LD_LIBRARY_PATH", "LD_PRELOAD", "LP_NATIVE_VECTOR_WIDTH",
    "LP_PERF", "MESA_SHADER_CACHE_DISABLE", "POCL_KERNEL_CACHE", "VK_INSTANCE_LAYERS",
    // ours
    "RG_CPU_LEVEL", "RG_ENVIRONMENT_DIR", "RG_KERNEL_DIR", "RG_VK_VALIDATION", NULL};

static json_t *environment(void)
{
    json_t *set = json_object();
    for (int i = 0; variables[i]; i++) {
        const char *value = getenv(variables[i]);
        if (value)
            json_object_set_new(set, variables[i], rg_json_text(value));
    }
    return set;
}

static json_t *words(const char *text)
{
    json_t *array = json_array();
    while (*text) {
        size_t length = 0;
        while (text[length] && text[length] != ' ')
            length++;
        json_array_append_new(array, json_stringn(text, length));
        text += length + (text[length] == ' ');
    }
    return array;
}

static json_t *machine(void)
{
    struct rg_machine m;
    rg_machine_read(&m, "");
    return json_pack("{sososisisssosssosI}", "cpu", rg_json_text(m.cpu), "features",
                     words(m.features), "cores_online", m.cores_online, "cores_allowed",
                     m.cores_allowed, "cores_list", m.cores_list, "quota_cpus",
                     m.quota_cpus > 0 ? json_real(rg_number_kept(m.quota_cpus)) : json_null(),
                     "kernel", m.kernel, "distribution", rg_json_text(m.distribution),
                     "memory_bytes", (json_int_t)m.memory_bytes);
}

static json_t *build(void)
{
    const char *folder = rg_kernel_override();
    char id[RG_PROGRAM_ID_SIZE];
    rg_program_id(id);
    return json_pack("{ssssssssssso}", "version", rg_build_version, "commit", rg_build_commit,
                     "compiler", rg_build_compiler, "type", rg_build_type, "program", id,
                     "kernel_dir", folder ? rg_json_text(folder) : json_null());
}

json_t *rg_passport_device(const struct rg_device_info *info)
{
    return json_pack("{sssosososb}", "name", info->name, "api", rg_json_text(info->api), "device",
                     rg_json_text(info->device), "driver", rg_json_text(info->driver), "software",
                     info->software);
}

json_t *rg_passport_json(const struct rg_device_info *infos, int count)
{
    json_t *devices = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(devices, rg_passport_device(&infos[i]));
    return json_pack("{sosososo}", "raingauge", build(), "machine", machine(), "environment",
                     environment(), "devices", devices);
}
