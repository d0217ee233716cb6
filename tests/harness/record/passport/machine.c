// The machine is read from Linux' files, here from copies in the test's own folder.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>

#include "harness/record/passport/machine.h"
#include "tests/core/root.h"
#include "tests/tools/expect.h"

static struct rg_machine read_machine(void)
{
    struct rg_machine machine;
    rg_machine_read(&machine, root);
    return machine;
}

static void a_machine_is_read(void **state)
{
    (void)state;
    put("/proc/cpuinfo", "processor\t: 0\nmodel name\t: Toy CPU @ 1.00GHz\ncpu MHz\t\t: 999.9\n"
                         "flags\t\t: fpu sse4_2 avx2 avx512f_not fma\n");
    put("/proc/meminfo", "MemFree: 1 kB\nMemTotal:       2048 kB\n");
    put("/proc/self/status", "Name:\tx\nCpus_allowed:\tff\nCpus_allowed_list:\t0-2,5\n");
    put("/sys/devices/system/cpu/online", "0-7\n");
    put("/etc/os-release", "NAME=\"Toy\"\nPRETTY_NAME=\"Toy Linux 3\"\n");
    put("/dev/dri/renderD128", "");
    struct rg_machine machine = read_machine();
    assert_string_equal(machine.cpu, "Toy CPU @ 1.00GHz");
    assert_string_equal(machine.features, "sse4_2 fma avx2");
    assert_int_equal(machine.memory_bytes, 2048 * 1024);
    assert_int_equal(machine.cores_allowed, 4);
    assert_string_equal(machine.cores_list, "0-2,5");
    assert_int_equal(machine.cores_online, 8);
    assert_string_equal(machine.distribution, "Toy Linux 3");
    assert_int_equal(machine.gpu_nodes, 1);
    assert_equals(machine.quota_cpus, 0);
}

// arm64 has no model name, but numbers of implementer and part for each core.
static void a_core_of_arm64_is_named(void **state)
{
    (void)state;
    put("/proc/cpuinfo", "processor\t: 0\nFeatures\t: fp asimd sve\nCPU implementer\t: 0x41\n"
                         "CPU architecture: 8\nCPU part\t: 0xd0b\n\n"
                         "processor\t: 1\nCPU implementer\t: 0x41\nCPU part\t: 0xd05\n\n"
                         "processor\t: 2\nCPU implementer\t: 0x41\nCPU part\t: 0xd05\n");
    assert_string_equal(read_machine().cpu, "Cortex-A76, Cortex-A55");
    assert_string_equal(read_machine().features, "asimd sve");
    put("/proc/cpuinfo", "CPU implementer\t: 0x99\nCPU part\t: 0xd0b\n");
    assert_string_equal(read_machine().cpu, "implementer 0x99, part 0xd0b");
}

static void an_empty_root_is_all_unknown(void **state)
{
    (void)state;
    struct rg_machine machine = read_machine();
    assert_string_equal(machine.cpu, "");
    assert_int_equal(machine.cores_allowed, 0);
    assert_int_equal(machine.cores_online, 0);
    assert_int_equal(machine.memory_bytes, 0);
    assert_equals(machine.quota_cpus, 0);
}

// The tightest quota of the group and of those around it counts.
static void version_2_quotas_are_found(void **state)
{
    (void)state;
    put("/proc/self/cgroup", "0::/outer/inner\n");
    put("/sys/fs/cgroup/outer/inner/cpu.max", "max 100000\n");
    assert_equals(read_machine().quota_cpus, 0);
    put("/sys/fs/cgroup/outer/cpu.max", "150000 100000\n");
    assert_equals(read_machine().quota_cpus, 1.5);
    put("/sys/fs/cgroup/outer/inner/cpu.max", "50000 100000\n");
    assert_equals(read_machine().quota_cpus, 0.5);
    put("/sys/fs/cgroup/outer/cpu.max", "25000 100000\n");
    assert_equals(read_machine().quota_cpus, 0.25);
}

static void version_1_quotas_are_found(void **state)
{
    (void)state;
    put("/proc/self/cgroup", "9:cpuset:/elsewhere\n4:cpu,cpuacct:/docker/abc\n");
    put("/sys/fs/cgroup/cpu/docker/abc/cpu.cfs_quota_us", "-1\n");
    put("/sys/fs/cgroup/cpu/docker/abc/cpu.cfs_period_us", "100000\n");
    assert_equals(read_machine().quota_cpus, 0);
    put("/sys/fs/cgroup/cpu/docker/abc/cpu.cfs_quota_us", "250000\n");
    assert_equals(read_machine().quota_cpus, 2.5);
    put("/sys/fs/cgroup/cpu/docker/abc/cpu.cfs_period_us", "none\n");
    assert_equals(read_machine().quota_cpus, 0);
}

// In a container the path is the host's, but the group is mounted at the top.
static void a_containers_quota_is_found(void **state)
{
    (void)state;
    put("/proc/self/cgroup", "4:cpu:/docker/abc\n");
    put("/sys/fs/cgroup/cpu/cpu.cfs_quota_us", "100000\n");
    put("/sys/fs/cgroup/cpu/cpu.cfs_period_us", "50000\n");
    assert_equals(read_machine().quota_cpus, 2);
}

// Only bounds of the clocks are kept, whichever file names them.
static void clocks_are_told(void **state)
{
    (void)state;
    assert_string_equal(read_machine().clocks, "");
    put("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "performance\n");
    assert_string_equal(read_machine().clocks, "performance");
    put("/sys/devices/system/cpu/cpu0/cpufreq/scaling_max_freq", "3590123\n");
    put("/sys/devices/system/cpu/cpu0/cpufreq/scaling_cur_freq", "1200000\n");
    assert_string_equal(read_machine().clocks, "performance, at most 3.6 GHz");
    put("/sys/devices/system/cpu/intel_pstate/no_turbo", "1\n");
    assert_string_equal(read_machine().clocks, "performance, at most 3.6 GHz, boost off");
    put("/sys/devices/system/cpu/cpufreq/boost", "1\n");
    assert_string_equal(read_machine().clocks, "performance, at most 3.6 GHz, boost on");
}

// A file of the boost outweighs that of the turbo, whose sense is the other one.
static void boost_has_two_files(void **state)
{
    (void)state;
    static const struct {
        const char *boost, *no_turbo, *clocks;
    } rows[] = {{"0\n", "0\n", "boost off"},
                {"1\n", "1\n", "boost on"},
                {"", "0\n", "boost on"},
                {"", "1\n", "boost off"}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        put("/sys/devices/system/cpu/cpufreq/boost", rows[i].boost);
        put("/sys/devices/system/cpu/intel_pstate/no_turbo", rows[i].no_turbo);
        assert_string_equal(read_machine().clocks, rows[i].clocks);
    }
    put("/sys/devices/system/cpu/cpu0/cpufreq/scaling_max_freq", "2100000\n");
    assert_string_equal(read_machine().clocks, "at most 2.1 GHz, boost off");
}

// Render nodes and NVIDIA's numbered devices count, and nothing else beside them.
static void nodes_of_gpus_are_counted(void **state)
{
    (void)state;
    static const char *const nodes[] = {
        "/dev/dri/renderD128", "/dev/dri/renderD129", "/dev/dri/card0",  "/dev/nvidia0",
        "/dev/nvidia12",       "/dev/nvidiactl",      "/dev/nvidia-uvm", "/dev/null"};
    for (size_t i = 0; i < sizeof(nodes) / sizeof(nodes[0]); i++)
        put(nodes[i], "");
    assert_int_equal(read_machine().gpu_nodes, 4);
}

// Values stand behind any blanks, colons and equals signs; the first line that fits counts.
static void values_are_read(void **state)
{
    (void)state;
    put("/proc/cpuinfo", "flags\t\t: avx512vl avx f16c sse4_2 bmi2 avx512bw avx512cd avx512dq "
                         "avx512f avx2 fma\nflags\t\t: sve\n");
    put("/proc/meminfo", "MemTotal:16777216 kB\nMemTotal: 1 kB\n");
    put("/etc/os-release", "PRETTY_NAME=Toy\nNAME=\"Other\"\n");
    put("/sys/devices/system/cpu/online", "0-2,5-5,7");
    const struct rg_machine machine = read_machine();
    assert_string_equal(machine.features, "sse4_2 avx f16c fma avx2 bmi2 avx512f avx512bw avx512cd "
                                          "avx512dq avx512vl");
    assert_true(machine.memory_bytes == (int64_t)16 << 30);
    assert_string_equal(machine.distribution, "Toy");
    assert_int_equal(machine.cores_online, 5);
    struct utsname name;
    char kernel[sizeof(machine.kernel)];
    assert_int_equal(uname(&name), 0);
    snprintf(kernel, sizeof(kernel), "%.40s %.80s %.30s", name.sysname, name.release, name.machine);
    assert_string_equal(machine.kernel, kernel);
}

static void lists_are_counted(void **state)
{
    (void)state;
    assert_int_equal(rg_cpu_list_count("0"), 1);
    assert_int_equal(rg_cpu_list_count("0-3,6"), 5);
    assert_int_equal(rg_cpu_list_count(""), 0);
    assert_int_equal(rg_cpu_list_count("x"), 0);
    assert_int_equal(rg_cpu_list_count("3-1"), 0);
    assert_int_equal(rg_cpu_list_count("1;2"), 0);
    assert_int_equal(rg_cpu_list_count("2-2"), 1);
    assert_int_equal(rg_cpu_list_count("0-127,130,132-133"), 131);
    assert_int_equal(rg_cpu_list_count("1-"), 0);
    assert_int_equal(rg_cpu_list_count("1-x"), 0);
    assert_int_equal(rg_cpu_list_count("1,,2"), 0);
}

#define IN_A_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_root, remove_root)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_A_FOLDER(a_machine_is_read),
        IN_A_FOLDER(a_core_of_arm64_is_named),
        IN_A_FOLDER(an_empty_root_is_all_unknown),
        IN_A_FOLDER(version_2_quotas_are_found),
        IN_A_FOLDER(version_1_quotas_are_found),
        IN_A_FOLDER(a_containers_quota_is_found),
        IN_A_FOLDER(clocks_are_told),
        IN_A_FOLDER(boost_has_two_files),
        IN_A_FOLDER(nodes_of_gpus_are_counted),
        IN_A_FOLDER(values_are_read),
        cmocka_unit_test(lists_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
