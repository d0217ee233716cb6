#include "harness/record/passport/machine.h"

#include <glob.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>

#include "core/base/files/processor.h"
#include "core/base/text/cgroup.h"
#include "core/base/text/words.h"

enum { LINE_SIZE = 8192, MAX_PATH = 1024 };

// --- files of "key: value" or "key=value" lines ---

static FILE *open_under(const char *root, const char *path)
{
    char whole[2 * MAX_PATH];
    int length = snprintf(whole, sizeof(whole), "%s%s", root, path);
    return length < (int)sizeof(whole) ? fopen(whole, "r") : NULL;
}

static void copy(char *target, size_t size, const char *text)
{
    snprintf(target, size, "%.*s", (int)size - 1, text);
}

// The value of the first line that begins with `key`, without separators and quotes.
static bool read_value(const char *root, const char *path, const char *key, char *value,
                       size_t size)
{
    FILE *file = open_under(root, path);
    char line[LINE_SIZE];
    bool found = false;
    while (file && !found && fgets(line, sizeof(line), file)) {
        if (strncmp(line, key, strlen(key)) != 0)
            continue;
        const char *text = line + strlen(key);
        text += strspn(text, " \t:=\"");
        line[strlen(line) - strlen(text) + strcspn(text, "\"\n")] = 0;
        copy(value, size, text);
        found = true;
    }
    if (file)
        fclose(file);
    return found;
}

// --- CPU ---

// The flags, among hundreds, by which raingauge, LLVM and glibc choose code.
static const char *const interesting[] = {
    "sse4_2",   "avx",      "f16c",     "fma",   "avx2",    "bmi2", "avx512f", "avx512bw",
    "avx512cd", "avx512dq", "avx512vl", "asimd", "asimdhp", "sve",  "sve2",    NULL};

static void read_cpu(struct rg_machine *machine, const char *root)
{
    char flags[LINE_SIZE];
    char path[MAX_PATH];
    snprintf(path, sizeof(path), "%s/proc/cpuinfo", root);
    rg_processor_name(path, machine->cpu, sizeof(machine->cpu));
    if (!read_value(root, "/proc/cpuinfo", "flags", flags, sizeof(flags)) &&
        !read_value(root, "/proc/cpuinfo", "Features", flags, sizeof(flags)))
        return;
    size_t used = 0;
    for (int i = 0; interesting[i]; i++)
        if (rg_has_word(flags, interesting[i]))
            used += (size_t)snprintf(machine->features + used, sizeof(machine->features) - used,
                                     "%s%s", used ? " " : "", interesting[i]);
}

int rg_cpu_list_count(const char *list)
{
    int count = 0;
    while (*list) {
        char *end;
        long first = strtol(list, &end, 10), last = first;
        if (end == list)
            return 0;
        if (*end == '-') {
            list = end + 1;
            last = strtol(list, &end, 10);
            if (end == list || last < first)
                return 0;
        }
        count += (int)(last - first) + 1;
        if (*end && *end != ',')
            return 0;
        list = *end ? end + 1 : end;
    }
    return count;
}

// --- the cgroup's share of CPU time ---

// The CPUs granted by a group's file, or pair of files; 0: unlimited.
static double quota_in(const char *folder, bool is_v2)
{
    char path[MAX_PATH + 32];
    long long quota_us = -1, period_us = 0;
    snprintf(path, sizeof(path), "%s/%s", folder, is_v2 ? "cpu.max" : "cpu.cfs_quota_us");
    FILE *file = fopen(path, "r");
    if (!file || fscanf(file, is_v2 ? "%lld %lld" : "%lld", &quota_us, &period_us) < 1)
        quota_us = -1; // "max"
    if (file)
        fclose(file);
    snprintf(path, sizeof(path), "%s/cpu.cfs_period_us", folder);
    if (!is_v2 && (file = fopen(path, "r"))) {
        if (fscanf(file, "%lld", &period_us) != 1)
            period_us = 0;
        fclose(file);
    }
    return quota_us > 0 && period_us > 0 ? (double)quota_us / (double)period_us : 0;
}

// The lowest quota applies.
static void take_quota(const char *folder, bool is_v2, void *user)
{
    struct rg_machine *machine = user;
    const double quota = quota_in(folder, is_v2);
    if (quota > 0 && (machine->quota_cpus == 0 || quota < machine->quota_cpus))
        machine->quota_cpus = quota;
}

// --- clocks ---

// The first line of a file; "" if it does not exist.
static const char *read_line(const char *root, const char *path, char line[64])
{
    *line = 0;
    read_value(root, path, "", line, 64);
    return line;
}

static void add_clock(struct rg_machine *machine, const char *text)
{
    const size_t used = strlen(machine->clocks);
    snprintf(machine->clocks + used, sizeof(machine->clocks) - used, "%s%s", used ? ", " : "",
             text);
}

// The first processor stands for all, and its highest clock is rounded to 0.1 GHz.
static void read_clocks(struct rg_machine *machine, const char *root)
{
    char line[64], text[32];
    if (*read_line(root, "/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", line))
        add_clock(machine, line);
    const double khz =
        atof(read_line(root, "/sys/devices/system/cpu/cpu0/cpufreq/scaling_max_freq", line));
    if (khz > 0) {
        snprintf(text, sizeof(text), "at most %.1f GHz", khz * 1e-6);
        add_clock(machine, text);
    }
    if (*read_line(root, "/sys/devices/system/cpu/cpufreq/boost", line))
        add_clock(machine, *line == '0' ? "boost off" : "boost on");
    else if (*read_line(root, "/sys/devices/system/cpu/intel_pstate/no_turbo", line))
        add_clock(machine, *line == '0' ? "boost on" : "boost off");
}

// --- GPUs and the system ---

static int count_files(const char *root, const char *pattern)
{
    char path[MAX_PATH];
    glob_t found;
    snprintf(path, sizeof(path), "%s%s", root, pattern);
    if (glob(path, GLOB_NOSORT, NULL, &found))
        return 0;
    int count = (int)found.gl_pathc;
    globfree(&found);
    return count;
}

static void read_system(struct rg_machine *machine, const char *root)
{
    struct utsname name;
    if (!uname(&name))
        snprintf(machine->kernel, sizeof(machine->kernel), "%.40s %.80s %.30s", name.sysname,
                 name.release, name.machine);
    read_value(root, "/etc/os-release", "PRETTY_NAME", machine->distribution,
               sizeof(machine->distribution));
    char kib[64];
    if (read_value(root, "/proc/meminfo", "MemTotal", kib, sizeof(kib)))
        machine->memory_bytes = (int64_t)strtoll(kib, NULL, 10) * 1024;
}

void rg_machine_read(struct rg_machine *machine, const char *root)
{
    *machine = (struct rg_machine){0};
    char online[128];
    read_cpu(machine, root);
    read_system(machine, root);
    if (read_value(root, "/sys/devices/system/cpu/online", "", online, sizeof(online)))
        machine->cores_online = rg_cpu_list_count(online);
    read_value(root, "/proc/self/status", "Cpus_allowed_list", machine->cores_list,
               sizeof(machine->cores_list));
    machine->cores_allowed = rg_cpu_list_count(machine->cores_list);
    rg_cgroups_visit(root, "cpu", take_quota, machine);
    read_clocks(machine, root);
    machine->gpu_nodes =
        count_files(root, "/dev/dri/renderD*") + count_files(root, "/dev/nvidia[0-9]*");
}
