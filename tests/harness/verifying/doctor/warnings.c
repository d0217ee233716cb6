#define _GNU_SOURCE // sched_setaffinity, RTLD_NEXT
// The warnings of `raingauge doctor`: each trap is told where it is, and nowhere else.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <dlfcn.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "harness/compare/doctor/doctor.h"
#include "harness/record/passport/machine.h"
#include "tests/tools/expect.h"

static struct rg_device_list list;
static int cores; // that this process may run on

// What a machine has in place of this one's; below 0: as it is.
static double quota_cpus = -1;
static int gpu_nodes = -1, cores_allowed = -1;

void rg_machine_read(struct rg_machine *machine, const char *root)
{
    ((__typeof__(&rg_machine_read))dlsym(RTLD_NEXT, "rg_machine_read"))(machine, root);
    if (cores_allowed >= 0)
        machine->cores_allowed = machine->cores_online = cores_allowed;
    machine->quota_cpus = quota_cpus >= 0 ? quota_cpus : machine->quota_cpus;
    machine->gpu_nodes = gpu_nodes >= 0 ? gpu_nodes : machine->gpu_nodes;
}

static const struct rg_backend cpu = {.name = "cpu"}, gl = {.name = "gl"},
                               vulkan = {.name = "vulkan"}, opencl = {.name = "opencl"};

static void add(const struct rg_backend *backend, const char *name, const char *device,
                bool software)
{
    struct rg_device_info *info = &list.infos[list.count];
    list.backends[list.count++] = backend;
    *info = (struct rg_device_info){.software = software};
    snprintf(info->name, sizeof(info->name), "%s", name);
    snprintf(info->device, sizeof(info->device), "%s", device);
}

static const char *const variables[] = {
    "OMP_NUM_THREADS", "OMP_THREAD_LIMIT",       "LP_NUM_THREADS", "POCL_CPU_MAX_CU_COUNT",
    "RG_KERNEL_DIR",   "POCL_MAX_PTHREAD_COUNT", "RG_CPU_LEVEL",   "RG_ROUNDING",
    "RG_BLENDING",     "RG_VK_VALIDATION",       "GALLIVM_PERF",   "VK_INSTANCE_LAYERS"};

static int begin(void **state)
{
    struct rg_machine machine;
    (void)state;
    for (size_t i = 0; i < sizeof(variables) / sizeof(variables[0]); i++)
        unsetenv(variables[i]);
    list.count = 0;
    rg_machine_read(&machine, "");
    cores = machine.cores_allowed;
    return cores < 1;
}

static void set_number(const char *variable, int number)
{
    char text[20];
    snprintf(text, sizeof(text), "%d", number);
    setenv(variable, text, 1);
}

// The only warning with this text in it; "": none has it.
static const char *warning_of(const char *says)
{
    static char found[600];
    size_t i;
    const json_t *line;
    int count = 0;
    json_t *warnings = rg_doctor_warnings(&list);
    *found = 0;
    json_array_foreach(warnings, i, line) if (strstr(json_string_value(line), says))
    {
        snprintf(found, sizeof(found), "%s", json_string_value(line));
        count++;
    }
    json_decref(warnings);
    assert_at_most(count, 1);
    return found;
}

static void expect(const char *says, const char *due)
{
    assert_string_equal(warning_of(says), due);
}

// --- threads ---

static void each_driver_has_its_threads(void **state)
{
    (void)state;
    char due[300];
    add(&cpu, "cpu", "this CPU", true);
    add(&gl, "gl", "llvmpipe", true);
    add(&opencl, "opencl", "pocl", true);
    expect("software devices run on", ""); // all have as many as there are cores
    set_number("OMP_THREAD_LIMIT", cores + 1);
    set_number("POCL_MAX_PTHREAD_COUNT", cores + 2);
    snprintf(due, sizeof(due),
             "software devices run on different numbers of threads: cpu on %d (OMP_THREAD_LIMIT), "
             "gl and vulkan on %d (LP_NUM_THREADS is not set), opencl on %d "
             "(POCL_MAX_PTHREAD_COUNT); set them alike to compare",
             cores + 1, cores, cores + 2);
    expect("software devices run on", due);
    // The first variable of a driver counts, but not if it is empty; 0 means one thread.
    set_number("OMP_NUM_THREADS", cores + 3);
    setenv("POCL_CPU_MAX_CU_COUNT", "", 1);
    set_number("LP_NUM_THREADS", 0);
    snprintf(due, sizeof(due),
             "software devices run on different numbers of threads: cpu on %d (OMP_NUM_THREADS), "
             "gl and vulkan on 1 (LP_NUM_THREADS), opencl on %d (POCL_MAX_PTHREAD_COUNT); set them "
             "alike to compare",
             cores + 3, cores + 2);
    expect("software devices run on", due);
}

static void all_alike_may_be_other_than_the_cores(void **state)
{
    (void)state;
    char due[300];
    add(&cpu, "cpu", "this CPU", true);
    add(&gl, "gl", "a GPU", false); // has no threads here
    add(&vulkan, "vulkan", "llvmpipe", true);
    set_number("OMP_NUM_THREADS", cores + 1);
    set_number("LP_NUM_THREADS", cores + 1);
    snprintf(due, sizeof(due),
             "software devices run on other threads than the %d cores allowed: cpu on %d "
             "(OMP_NUM_THREADS), gl and vulkan on %d (LP_NUM_THREADS)",
             cores, cores + 1, cores + 1);
    expect("software devices run on", due);
    list.count = 2;
    set_number("LP_NUM_THREADS", cores + 5);
    snprintf(due, sizeof(due),
             "software devices run on other threads than the %d cores allowed: cpu on %d "
             "(OMP_NUM_THREADS)",
             cores, cores + 1);
    expect("software devices run on", due);
    list.count = 0;
    expect("software devices run on", "");
}

// --- variables ---

static void each_variable_has_its_warning(void **state)
{
    (void)state;
    static const struct {
        const char *variable, *value, *due;
    } rows[] = {
        {"RG_KERNEL_DIR", "/none",
         "RG_KERNEL_DIR=/none: gl, vulkan and opencl run the kernels of that folder, which cannot "
         "be read"},
        {"RG_KERNEL_DIR", "/",
         "RG_KERNEL_DIR=/: gl, vulkan and opencl run the kernels of that folder"},
        {"RG_CPU_LEVEL", "plain",
         "RG_CPU_LEVEL=plain: cpu runs at that level, which may not be its fastest"},
        {"RG_ROUNDING", "own",
         "RG_ROUNDING=own: decides who rounds quotients and roots on gl and vulkan; unset it to "
         "let each device's own decide"},
        {"RG_BLENDING", "program",
         "RG_BLENDING=program: decides who blends on gl and vulkan; unset it to let each device's "
         "own decide"},
        {"RG_VK_VALIDATION", "1",
         "RG_VK_VALIDATION=1: vulkan is validated, and slower for it; unset it to measure"},
        {"RG_VK_VALIDATION", "0", ""},
        {"GALLIVM_PERF", "no_rho",
         "GALLIVM_PERF=no_rho: software gl and vulkan generate other code than users'"},
        {"VK_INSTANCE_LAYERS", "VK_LAYER_x",
         "VK_INSTANCE_LAYERS=VK_LAYER_x: these layers stand between raingauge and vulkan"},
        {"RG_CPU_LEVEL", "", ""},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        char begins[100];
        snprintf(begins, sizeof(begins), "%s=", rows[i].variable);
        expect(begins, "");
        setenv(rows[i].variable, rows[i].value, 1);
        expect(begins, rows[i].due);
        unsetenv(rows[i].variable);
    }
}

// --- software instead of a GPU ---

static void software_beside_a_gpu_is_told(void **state)
{
    (void)state;
    add(&cpu, "cpu", "this CPU", true);
    add(&gl, "gl", "llvmpipe", true);
    add(&gl, "gl:1", "softpipe", true);
    add(&vulkan, "vulkan", "Fast GPU", false);
    add(&vulkan, "vulkan:1", "lavapipe", true);
    expect("in software", "'gl' runs in software (llvmpipe) though 'vulkan' is a GPU");
    list.infos[1].software = false; // the bare name means the first device
    expect("in software", "");
    list.infos[3].software = true;
    expect("in software", "'vulkan' runs in software (Fast GPU) though 'gl' is a GPU");
}

// --- cores ---

static void fewer_cores_than_there_are_are_told(void **state)
{
    (void)state;
    struct rg_machine machine;
    cpu_set_t before, one;
    char due[200];
    rg_machine_read(&machine, "");
    if (machine.cores_online < 2)
        skip();
    if (machine.cores_allowed == machine.cores_online)
        expect("this process may run on", "");
    assert_int_equal(sched_getaffinity(0, sizeof(before), &before), 0);
    CPU_ZERO(&one);
    int core = 0;
    while (!CPU_ISSET(core, &before))
        core++;
    CPU_SET(core, &one);
    assert_int_equal(sched_setaffinity(0, sizeof(one), &one), 0);
    snprintf(due, sizeof(due),
             "this process may run on 1 of %d cores (%d); drivers that count the others start too "
             "many threads",
             machine.cores_online, core);
    expect("this process may run on", due);
    assert_int_equal(sched_setaffinity(0, sizeof(before), &before), 0);
}

// A share of a machine's time that is smaller than its cores.
static void a_quota_is_told(void **state)
{
    (void)state;
    static const struct {
        double quota_cpus;
        const char *due; // "": no warning
    } rows[] = {
        {0, ""}, // none
        {4, ""},
        {5, ""},
        {2.5,
         "the cgroup grants 2.5 CPUs of time on 4 cores: threads are stopped within frames and "
         "times scatter; set the thread variables (docs/environment.md) to 2"},
        {0.5,
         "the cgroup grants 0.5 CPUs of time on 4 cores: threads are stopped within frames and "
         "times scatter; set the thread variables (docs/environment.md) to 1"}};
    cores_allowed = 4;
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        quota_cpus = rows[i].quota_cpus;
        expect("the cgroup grants", rows[i].due);
    }
    cores_allowed = -1;
    quota_cpus = -1;
}

// A GPU that no driver of an API opens is told by each API whose first device is software.
static void a_gpu_that_no_driver_opens_is_told(void **state)
{
    (void)state;
    add(&cpu, "cpu", "this CPU", true);
    add(&gl, "gl", "llvmpipe", true);
    add(&gl, "gl:1", "softpipe", true);
    gpu_nodes = 0;
    expect("runs in software", "");
    gpu_nodes = 1;
    expect("runs in software", "'gl' runs in software (llvmpipe) though this machine has a GPU: no "
                               "driver of that API opens it");
    gpu_nodes = -1;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(each_driver_has_its_threads, begin),
        cmocka_unit_test_setup(all_alike_may_be_other_than_the_cores, begin),
        cmocka_unit_test_setup(each_variable_has_its_warning, begin),
        cmocka_unit_test_setup(software_beside_a_gpu_is_told, begin),
        cmocka_unit_test_setup(fewer_cores_than_there_are_are_told, begin),
        cmocka_unit_test_setup(a_quota_is_told, begin),
        cmocka_unit_test_setup(a_gpu_that_no_driver_opens_is_told, begin),
    };
    return cmocka_run_group_tests_name("warnings of doctor", tests, NULL, NULL);
}
