// Finds conditions that make measurements or comparisons misleading, as far as visible from outside
// the drivers.
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "backends/kernel.h"
#include "harness/compare/doctor/doctor.h"
#include "harness/record/passport/machine.h"
#include "harness/record/named.h"

static void warn(json_t *warnings, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void warn(json_t *warnings, const char *format, ...)
{
    char line[512];
    va_list args;
    va_start(args, format);
    vsnprintf(line, sizeof(line), format, args);
    va_end(args);
    json_array_append_new(warnings, rg_json_text(line));
}

static const char *value_of(const char *variable)
{
    const char *value = getenv(variable);
    return value && *value ? value : NULL;
}

static void check_cores(json_t *warnings, const struct rg_machine *machine)
{
    if (machine->quota_cpus > 0 && machine->quota_cpus < machine->cores_allowed)
        warn(warnings,
             "the cgroup grants %.4g CPUs of time on %d cores: threads are stopped within frames "
             "and times scatter; set the thread variables (docs/environment.md) to %d",
             machine->quota_cpus, machine->cores_allowed,
             machine->quota_cpus > 1 ? (int)machine->quota_cpus : 1);
    if (machine->cores_allowed > 0 && machine->cores_allowed < machine->cores_online)
        warn(warnings,
             "this process may run on %d of %d cores (%s); drivers that count the others start too "
             "many threads",
             machine->cores_allowed, machine->cores_online, machine->cores_list);
}

// --- threads ---

struct pool {
    const char *backends[3];  // backends whose software devices use these threads
    const char *variables[3]; // the first one set counts
    const char *set;          // the variable that is set, or NULL
    int threads;
};

static const struct rg_device_info *software_of(const struct rg_device_list *list,
                                                const struct pool *pool)
{
    for (int i = 0; i < list->count; i++)
        for (int b = 0; pool->backends[b]; b++)
            if (list->infos[i].software && !strcmp(list->backends[i]->name, pool->backends[b]))
                return &list->infos[i];
    return NULL;
}

static void read_pool(struct pool *pool, int cores)
{
    pool->threads = cores;
    for (int i = 0; pool->variables[i] && !pool->set; i++) {
        const char *value = value_of(pool->variables[i]);
        if (!value)
            continue;
        pool->set = pool->variables[i];
        int threads = atoi(value);
        pool->threads = threads > 0 ? threads : 1; // llvmpipe's 0 means no threads of its own
    }
}

// If a variable gives one driver another number of threads than the rest, times are not comparable.
static void check_threads(json_t *warnings, const struct rg_device_list *list,
                          const struct rg_machine *machine)
{
    struct pool pools[] = {
        {.backends = {"cpu"}, .variables = {"OMP_NUM_THREADS", "OMP_THREAD_LIMIT"}},
        {.backends = {"gl", "vulkan"}, .variables = {"LP_NUM_THREADS"}},
        {.backends = {"opencl"}, .variables = {"POCL_CPU_MAX_CU_COUNT", "POCL_MAX_PTHREAD_COUNT"}}};
    char text[300] = "";
    size_t used = 0;
    int least = INT_MAX, most = 0;
    for (size_t i = 0; i < sizeof(pools) / sizeof(pools[0]); i++) {
        struct pool *pool = &pools[i];
        if (!software_of(list, pool))
            continue;
        read_pool(pool, machine->cores_allowed);
        least = pool->threads < least ? pool->threads : least;
        most = pool->threads > most ? pool->threads : most;
        used += (size_t)snprintf(
            text + used, sizeof(text) - used, "%s%s%s%s on %d (%s%s)", used ? ", " : "",
            pool->backends[0], pool->backends[1] ? " and " : "",
            pool->backends[1] ? pool->backends[1] : "", pool->threads,
            pool->set ? pool->set : pool->variables[0], pool->set ? "" : " is not set");
    }
    if (least < most)
        warn(warnings,
             "software devices run on different numbers of threads: %s; set them alike to compare",
             text);
    else if (most && machine->cores_allowed && most != machine->cores_allowed)
        warn(warnings, "software devices run on other threads than the %d cores allowed: %s",
             machine->cores_allowed, text);
}

// --- variables ---

static void check_variables(json_t *warnings)
{
    const char *folder = rg_kernel_override(), *level = value_of("RG_CPU_LEVEL");
    const char *rounding = value_of("RG_ROUNDING");
    const char *validation = value_of("RG_VK_VALIDATION"), *perf = value_of("GALLIVM_PERF");
    if (folder)
        warn(warnings,
             "RG_KERNEL_DIR=%.200s: gl, vulkan and opencl run the kernels of that folder%s", folder,
             access(folder, R_OK | X_OK) ? ", which cannot be read" : "");
    if (level)
        warn(warnings, "RG_CPU_LEVEL=%.40s: cpu runs at that level, which may not be its fastest",
             level);
    if (rounding)
        warn(warnings,
             "RG_ROUNDING=%.40s: decides who rounds quotients and roots on gl and vulkan; "
             "unset it to let each device's own decide",
             rounding);
    if (value_of("RG_BLENDING"))
        warn(warnings,
             "RG_BLENDING=%.40s: decides who blends on gl and vulkan; unset it to let each "
             "device's own decide",
             getenv("RG_BLENDING"));
    if (validation && !strcmp(validation, "1"))
        warn(warnings, "RG_VK_VALIDATION=1: vulkan is validated, and slower for it; unset it to "
                       "measure");
    if (value_of("VK_INSTANCE_LAYERS"))
        warn(warnings, "VK_INSTANCE_LAYERS=%.200s: these layers stand between raingauge and vulkan",
             getenv("VK_INSTANCE_LAYERS"));
    if (perf)
        warn(warnings, "GALLIVM_PERF=%.80s: software gl and vulkan generate other code than users'",
             perf);
    if (value_of("LD_PRELOAD"))
        warn(warnings, "LD_PRELOAD=%.200s: it may replace what is measured", getenv("LD_PRELOAD"));
#ifndef __OPTIMIZE__
    warn(warnings, "this raingauge was built without optimisation: its times mean nothing");
#endif
}

// --- devices ---

static bool is_first(const struct rg_device_list *list, int i)
{
    return i == 0 || list->backends[i - 1] != list->backends[i];
}

// A backend's bare name means its first device; warns if that is software and there is a GPU.
static void check_software(json_t *warnings, const struct rg_device_list *list,
                           const struct rg_machine *machine)
{
    const char *gpu = NULL;
    for (int i = 0; i < list->count && !gpu; i++)
        if (!list->infos[i].software)
            gpu = list->infos[i].name;
    if (!gpu && !machine->gpu_nodes)
        return;
    for (int i = 0; i < list->count; i++) {
        const struct rg_device_info *info = &list->infos[i];
        if (!is_first(list, i) || !info->software || !strncmp(info->name, "cpu", 3))
            continue;
        if (gpu)
            warn(warnings, "'%s' runs in software (%.80s) though '%s' is a GPU", info->name,
                 info->device, gpu);
        else
            warn(warnings,
                 "'%s' runs in software (%.80s) though this machine has a GPU: no driver of that "
                 "API "
                 "opens it",
                 info->name, info->device);
    }
}

json_t *rg_doctor_warnings(const struct rg_device_list *list)
{
    struct rg_machine machine;
    rg_machine_read(&machine, "");
    json_t *warnings = json_array();
    check_cores(warnings, &machine);
    check_threads(warnings, list, &machine);
    check_variables(warnings);
    check_software(warnings, list, &machine);
    return warnings;
}
