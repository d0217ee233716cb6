// Drivers compile beforehand: one cell of each technique on each device with a driver. Each
// compiles in its own process, as many at a time as there are cores. A script replaces the program.
#define _GNU_SOURCE // sched_setaffinity
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"
#include "harness/devices/workers/worker.h"
#include "harness/record/passport/machine.h"
#include "harness/tables/runs/compile.h"
#include "tests/harness/results/planning/slow.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"

// --- tables and devices that have only names ---

static const struct rg_table levels = {.id = "slow-0", .technique = "slow", .is_of_textures = true},
                             first = {.id = "slow-1", .technique = "slow"},
                             second = {.id = "slow-2", .technique = "slow"},
                             other = {.id = "fast-1", .technique = "fast"};
static const struct rg_table *const tables[] = {&levels, &first, &other, &second};
enum { TABLES = 4 };

static const struct rg_backend without = {.name = "cpu"}, with = {.package = "a-driver"};
static struct rg_device named[] = {{.backend = &without, .info = {.name = "cpu"}},
                                   {.backend = &with, .info = {.name = "gl"}},
                                   {.backend = &with, .info = {.name = "opencl"}}};
static const struct rg_devices devices = {.count = 3, .devices = {&named[0], &named[1], &named[2]}};

// --- a script that replaces the program ---

static char script[64], told[64];

// Writes a script that logs when it begins and ends, and runs `does` in between.
static void write_script(const char *does)
{
    FILE *file = fopen(script, "w");
    assert_non_null(file);
    fprintf(file, "#!/bin/sh\ntold=%s\necho \"begin $*\" >>$told\n%s\necho end >>$told\n", told,
            does);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(chmod(script, 0755), 0);
    remove(told);
}

static const char *read_told(void)
{
    static char text[4096];
    FILE *file = fopen(told, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof(text) - 1, file)] = 0;
    fclose(file);
    return text;
}

// Compiles on this many cores, with this script, and keeps the log.
static int compile(int cores, const char *does)
{
    cpu_set_t before, these;
    int left = cores;
    assert_int_equal(sched_getaffinity(0, sizeof(before), &before), 0);
    CPU_ZERO(&these);
    for (int i = 0; i < CPU_SETSIZE; i++)
        if (CPU_ISSET(i, &before) && left-- > 0)
            CPU_SET(i, &these);
    struct rg_machine machine;
    rg_machine_read(&machine, "");
    if (CPU_COUNT(&before) < cores || (machine.quota_cpus > 0 && machine.quota_cpus <= cores - 1))
        skip();
    assert_int_equal(sched_setaffinity(0, sizeof(these), &these), 0);
    write_script(does);
    *logged = 0;
    rg_workers.program = script;
    rg_workers.timeout_s = 7;
    rg_log_listen(log_all, NULL);
    const int exit = rg_tables_compile(tables, TABLES, &devices);
    rg_log_listen(NULL, NULL);
    rg_workers.program = NULL;
    assert_int_equal(sched_setaffinity(0, sizeof(before), &before), 0);
    return exit;
}

static void a_technique_is_opened_once_on_each_driver(void **state)
{
    (void)state;
    assert_int_equal(compile(1, "sleep 0.02"), RG_EXIT_PASS);
    assert_string_equal(read_told(),
                        "begin table slow-1 --compile --device opencl --timeout 7\nend\n"
                        "begin table fast-1 --compile --device opencl --timeout 7\nend\n"
                        "begin table slow-1 --compile --device gl --timeout 7\nend\n"
                        "begin table fast-1 --compile --device gl --timeout 7\nend\n");
    assert_non_null(strstr(logged, "what 2 techniques draw with is compiled on 2 devices"));
}

// Each of the first two waits for the other to begin.
static void two_cores_compile_side_by_side(void **state)
{
    (void)state;
    assert_int_equal(compile(2, "for i in $(seq 500); do\n"
                                "  test $(grep -c begin $told) -ge 2 && break\n"
                                "  sleep 0.01\n"
                                "done\n"
                                "test $i -lt 500 || exit 1\n"
                                "test $(grep -c begin $told) -le $(($(grep -c end $told) + 2)) || "
                                "exit 1"),
                     RG_EXIT_PASS);
}

// The others go on. A device that does not support its cell has nothing to compile.
static void what_fails_is_told(void **state)
{
    (void)state;
    assert_int_equal(compile(1, "case \"$*\" in\n"
                                "  *slow-1*opencl*) echo 'raingauge: it fell' >&2; exit 1;;\n"
                                "  *fast-1*gl*) exit 77;;\n"
                                "esac"),
                     RG_EXIT_FAIL);
    assert_string_equal(logged, "4 openings for drivers to compile, 1 at a time\n"
                                "opencl: what slow needs is not compiled beforehand: it fell\n");
    assert_int_equal(compile(1, "case \"$*\" in\n"
                                "  *slow-1*opencl*) echo 'out of memory' >&2; exit 71;;\n"
                                "esac"),
                     RG_EXIT_HARNESS);
    assert_string_equal(logged,
                        "4 openings for drivers to compile, 1 at a time\n"
                        "opencl: what slow needs is not compiled beforehand: out of memory\n");
    assert_non_null(
        strstr(read_told(), "begin table slow-1 --compile --device gl --timeout 7\nend\n"));
}

static void a_process_that_cannot_start_is_told(void **state)
{
    (void)state;
    assert_int_equal(compile(1, ""), RG_EXIT_PASS);
    *logged = 0;
    rg_workers.program = "/nonexistent/raingauge";
    rg_log_listen(log_all, NULL);
    const struct rg_table *const alone[] = {&first, &other};
    const struct rg_devices gl = {.count = 1, .devices = {&named[1]}};
    assert_int_equal(rg_tables_compile(alone, 2, &gl), RG_EXIT_HARNESS);
    rg_log_listen(NULL, NULL);
    rg_workers.program = NULL;
    static const char *const techniques[] = {"slow", "fast"};
    for (int i = 0; i < 2; i++) {
        char due[256];
        snprintf(due, sizeof(due),
                 "\ngl: what %s needs is not compiled beforehand: no process could be started for "
                 "it: No such file or directory; ",
                 techniques[i]);
        assert_non_null(strstr(logged, due));
    }
}

// Ctrl-C reaches this process alone, which ends the processes that it started.
static void an_interruption_ends_it(void **state)
{
    (void)state;
    assert_int_equal(compile(1, "kill -INT $PPID; sleep 300"), RG_EXIT_SIGNALLED + SIGINT);
    assert_string_equal(read_told(), "begin table slow-1 --compile --device opencl --timeout 7\n");
    assert_string_equal(logged, "4 openings for drivers to compile, 1 at a time\n");
    rg_interrupt_watch();
}

// --- in this process ---

static const struct rg_table_row own_rows[] = {{"fixed_ms=2", {1}, "a"},
                                               {"fixed_ms=4", {2}, "b"},
                                               {"fixed_ms=7", {3}, "c"},
                                               {"fixed_ms=9", {4}, "d"}};
static const struct rg_table own = {.id = "slow-3",
                                    .technique = "slow",
                                    .columns = {"fixed_ms"},
                                    .key_count = 1,
                                    .quick_rows = 2,
                                    .quick = "step_ms=2",
                                    .smaller = {"open_ms=10", "open_ms=20"},
                                    .variants = {{"full", "", NULL}},
                                    .width = 1024,
                                    .height = 512,
                                    .row_count = 4,
                                    .rows = own_rows,
                                    .note = "a note"};

// The last of the rows that quick mode needs, as small as a budget draws it: two frames of 256 x
// 128 pixels, with quick settings and those of small pictures.
static void one_cell_is_opened_here(void **state)
{
    (void)state;
    const struct rg_table *const one[] = {&own};
    struct slow_rig rig;
    slow_begin(&rig);
    struct rg_device *gl = rig.devices.devices[2];
    struct rg_backend backend = *gl->backend;
    const struct rg_devices alone = {.count = 1, .devices = {gl}};
    rg_log_listen(log_all, NULL);
    *logged = 0;
    assert_int_equal(rg_tables_compile(one, 1, &alone), RG_EXIT_NOTHING);
    assert_int_equal(slow_opened, 0);
    assert_non_null(strstr(logged, "nothing is compiled"));
    backend.package = "a-driver";
    gl->backend = &backend;
    *logged = 0;
    const double start_ms = rg_now_ms(), frame_ms = 2 + 4 + 1.25e-4 * 256 * 128;
    assert_int_equal(rg_tables_compile(one, 1, &alone), RG_EXIT_PASS);
    assert_int_equal(slow_opened, 1);
    assert_near(rg_now_ms() - start_ms, 3 * (10 + 2 * frame_ms), 1e-6);
    assert_string_equal(logged,
                        "what 1 technique draws with is compiled on 1 device, in 0.091 s\n");
    rig.fakes[2]->waits_left = 0;
    assert_int_not_equal(rg_tables_compile(one, 1, &alone), RG_EXIT_PASS);
    rig.fakes[2]->waits_left = -1;
    rg_log_listen(NULL, NULL);
    slow_end(&rig);
}

static int set_up(void **state)
{
    if (make_folder(state))
        return -1;
    snprintf(script, sizeof(script), "%s/program", folder);
    snprintf(told, sizeof(told), "%s/told", folder);
    return 0;
}

static int tear_down(void **state)
{
    remove(script);
    remove(told);
    return remove_folder(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_technique_is_opened_once_on_each_driver),
        cmocka_unit_test(two_cores_compile_side_by_side),
        cmocka_unit_test(what_fails_is_told),
        cmocka_unit_test(a_process_that_cannot_start_is_told),
        cmocka_unit_test(an_interruption_ends_it),
        cmocka_unit_test(one_cell_is_opened_here),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
