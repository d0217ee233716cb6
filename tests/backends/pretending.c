#include "tests/backends/pretending.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "core/device/work.h"

struct rg_backend pretending;
const struct rg_backend *const rg_backends[] = {&pretending, NULL};
int pretended_runs;

static enum rg_tier pretended;

static int list(struct rg_device_info *infos, int max, char *why, size_t why_size)
{
    const int count = rg_backend_cpu.list(infos, max < 1 ? max : 1, why, why_size);
    infos[0].tier = pretended;
    return count;
}

static struct rg_device *create(int index)
{
    struct rg_device *device = rg_backend_cpu.create(index);
    if (device)
        device->info.tier = pretended;
    return device;
}

static bool pass_run(struct rg_pass *pass, const struct rg_run *run)
{
    pretended_runs++;
    return rg_backend_cpu.pass_run(pass, run);
}

void pretend(enum rg_tier tier)
{
    pretending = rg_backend_cpu;
    pretending.list = list;
    pretending.create = create;
    pretending.pass_run = pass_run;
    pretended = tier;
    pretended_runs = 0;
}

void check_asked(struct rg_device *device, bool flag, bool is_own, const char *what, int runs)
{
    const struct rg_work none = {0};
    char note[64];
    assert_non_null(device);
    snprintf(note, sizeof(note), ", own %s", what);
    assert_int_equal(flag, is_own);
    assert_int_equal(strstr(device->info.api, note) != NULL, is_own);
    assert_int_equal(pretended_runs, runs);
    assert_memory_equal(rg_device_work(device), &none, sizeof(none));
    assert_true(rg_device_close(device));
}

// --- lines ---

char heard_line[200];
int heard_lines;

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)level, (void)user;
    snprintf(heard_line, sizeof(heard_line), "%s", line);
    heard_lines++;
}

void listen_to_lines(bool on)
{
    heard_lines = 0;
    rg_log_listen(on ? hear : NULL, NULL);
}
