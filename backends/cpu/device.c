#include "backends/cpu/cpu.h"

#include <fenv.h>
#include <limits.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#ifdef __aarch64__
#include <sys/auxv.h>
#define LEVELS "plain or sve"
#else
#define LEVELS "plain, v2, v3 or v4"
#endif

#include "backends/cpu/draw/bins.h"
#include "core/base/alloc.h"
#include "core/base/files/processor.h"
#include "core/base/log.h"

enum { INDEX_CPU, INDEX_REFERENCE, CPU_DEVICES };

static bool level_runs_here(const char *level)
{
#ifdef __x86_64__
    __builtin_cpu_init();
    if (!strcmp(level, "v2"))
        return __builtin_cpu_supports("sse4.2");
    if (!strcmp(level, "v3"))
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2") &&
               __builtin_cpu_supports("fma");
    if (!strcmp(level, "v4"))
        return level_runs_here("v3") && __builtin_cpu_supports("avx512f") &&
               __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
               __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#elif defined(__aarch64__)
    if (!strcmp(level, "sve"))
        return (getauxval(AT_HWCAP) & HWCAP_SVE) != 0;
#endif
    return true;
}

// The best level for this processor, or the one that RG_CPU_LEVEL names.
static const struct cpu_level *choose_level(void)
{
    const char *wanted = getenv("RG_CPU_LEVEL");
    for (int i = cpu_level_count - 1; i > 0; i--)
        if ((!wanted || !strcmp(wanted, cpu_levels[i].name)) && level_runs_here(cpu_levels[i].name))
            return &cpu_levels[i];
    return NULL;
}

static struct rg_limits limits_of_memory(void)
{
    const struct rg_slot_limits any = {RG_MAX_SLOTS, RG_MAX_SLOTS, RG_MAX_SLOTS};
    struct rg_limits limits = {
        .max_objects = INT_MAX,
        .max_buffer_bytes = (int64_t)INT_MAX * 4, // kernels index words by an int
        .max_image_px = RG_PLAIN_MAX_PX,
        .max_image_layers = RG_PLAIN_MAX_LAYERS,
        .max_groups = {INT_MAX, INT_MAX, INT_MAX},
        .group_items = 1,
        .slot_count = any,
        .slot_end = any,
        .no_native = "draws by its own programs",
        .has_clock = true,
    };
    rg_plain_formats(limits.formats, INT64_MAX);
    return limits;
}

static void describe(int index, struct rg_device_info *info)
{
    const struct cpu_level *level = index == INDEX_REFERENCE ? &cpu_levels[0] : choose_level();
    *info = (struct rg_device_info){
        .software = true,
        .tier = RG_T0,
        .limits = limits_of_memory(),
    };
    snprintf(info->name, sizeof(info->name), index == INDEX_REFERENCE ? "cpu:reference" : "cpu");
    rg_processor_name("/proc/cpuinfo", info->device, sizeof(info->device));
    if (!*info->device)
        snprintf(info->device, sizeof(info->device), "unnamed CPU");
#ifdef __clang__ // whose __VERSION__ is "Debian Clang 19.1.7 (3+b1)"
    snprintf(info->driver, sizeof(info->driver), "clang %d.%d.%d", __clang_major__, __clang_minor__,
             __clang_patchlevel__);
#else
    snprintf(info->driver, sizeof(info->driver), "gcc %s", __VERSION__);
#endif
    snprintf(info->api, sizeof(info->api), "C11, %s, %d thread%s", level->name,
             index == INDEX_REFERENCE ? 1 : omp_get_max_threads(),
             index == INDEX_REFERENCE || omp_get_max_threads() == 1 ? "" : "s");
}

static int cpu_list(struct rg_device_info *infos, int max, char *why, size_t why_size)
{
    if (!choose_level()) {
        snprintf(why, why_size, "RG_CPU_LEVEL=%s is no level that this CPU runs; use " LEVELS,
                 getenv("RG_CPU_LEVEL"));
        return 0;
    }
    int count = max < CPU_DEVICES ? max : CPU_DEVICES;
    for (int i = 0; i < count; i++)
        describe(i, &infos[i]);
    return count;
}

// Kernels rely on round-to-nearest and on subnormal numbers.
static bool floating_point_is_standard(void)
{
    volatile float smallest_normal = 1.17549435e-38f;
    volatile float half = smallest_normal * 0.5f;
    return fegetround() == FE_TONEAREST && half != 0.0f;
}

static struct rg_device *cpu_create(int index)
{
    if (!floating_point_is_standard())
        return rg_error_null(
            "device 'cpu': this thread rounds or flushes floats in another way than "
            "IEEE 754's default; start raingauge without such settings");
    struct cpu_device *device = rg_alloc(1, sizeof(*device), "device 'cpu'");
    if (!device)
        return NULL;
    describe(index, &device->pub.info);
    device->reference = index == INDEX_REFERENCE;
    device->level = device->reference ? &cpu_levels[0] : choose_level();
    return &device->pub;
}

static bool cpu_destroy(struct rg_device *device)
{
    cpu_bins_destroy(((struct cpu_device *)device)->bins);
    free(device);
    return true;
}

const struct rg_backend rg_backend_cpu = {
    .name = "cpu",
    .list = cpu_list,
    .create = cpu_create,
    .destroy = cpu_destroy,
    .buf_create = cpu_buf_create,
    .buf_destroy = cpu_buf_destroy,
    .buf_write = cpu_buf_write,
    .buf_read = cpu_buf_read,
    .image_create = cpu_image_create,
    .image_destroy = cpu_image_destroy,
    .image_write = cpu_image_write,
    .image_read = cpu_image_read,
    .image_clear = cpu_image_clear,
    .pass_create = cpu_pass_create,
    .pass_destroy = cpu_pass_destroy,
    .pass_run = cpu_pass_run,
    .sync = cpu_sync,
    .time = cpu_time,
};
