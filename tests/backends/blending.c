// When a device's programs blend by themselves, tested on `cpu`. It pretends to be a device whose
// driver blends, inexactly in the format that a test names.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/device/device.h"
#include "core/device/work.h"

static struct rg_backend pretending;
const struct rg_backend *const rg_backends[] = {&pretending, NULL};
extern const struct rg_backend rg_backend_cpu;

static enum rg_tier tier;
static bool is_able;
static enum rg_format inexact; // RG_FORMAT_NONE: no format
static int runs;

static int list(struct rg_device_info *infos, int max, char *why, size_t why_size)
{
    const int count = rg_backend_cpu.list(infos, max, why, why_size);
    infos[0].tier = tier;
    return count;
}

static struct rg_device *create(int index)
{
    struct rg_device *device = rg_backend_cpu.create(index);
    if (device)
        device->info.tier = tier;
    return device;
}

static bool can_blend(const struct rg_device *device, const char **word)
{
    (void)device;
    *word = "GL_EXT_of_tests";
    return is_able;
}

static bool pass_run(struct rg_pass *pass, const struct rg_run *run)
{
    runs++;
    return rg_backend_cpu.pass_run(pass, run);
}

// One number's last bit is off.
static bool image_read(struct rg_image *image, int layer, int level, void *texels)
{
    const bool ok = rg_backend_cpu.image_read(image, layer, level, texels);
    if (image->desc.format == inexact)
        *((uint32_t *)texels + 16 * 64) ^= 1;
    return ok;
}

static struct rg_device *open_pretending(enum rg_tier its_tier, bool able, enum rg_format off)
{
    pretending = rg_backend_cpu;
    pretending.list = list;
    pretending.create = create;
    pretending.can_blend = can_blend;
    pretending.pass_run = pass_run;
    pretending.image_read = image_read;
    tier = its_tier;
    is_able = able;
    inexact = off;
    runs = 0;
    return rg_device_open("cpu");
}

// The check of the driver must leave no trace on the device.
static void check(struct rg_device *device, bool blends, int its_runs)
{
    assert_non_null(device);
    assert_int_equal(device->blends, blends);
    assert_int_equal(strstr(device->info.api, ", own blending") != NULL, blends);
    assert_int_equal(runs, its_runs);
    const struct rg_work none = {0};
    assert_memory_equal(rg_device_work(device), &none, sizeof(none));
    assert_true(rg_device_close(device));
}

static void inexact_drivers_do_not_blend(void **state)
{
    (void)state;
    check(open_pretending(RG_T1, true, RG_RGBA8), true, 1);
    check(open_pretending(RG_T1, true, RG_RGBA16F), true, 3);
    check(open_pretending(RG_T1, true, RG_RGBA32F), true, 5);
}

static void exact_drivers_do(void **state)
{
    (void)state;
    check(open_pretending(RG_T1, true, RG_FORMAT_NONE), false, 6);
}

// Drivers are not checked that draw as cpu:reference does, or that do not let programs blend.
static void others_are_not_asked(void **state)
{
    (void)state;
    check(open_pretending(RG_T0, true, RG_RGBA32F), false, 0);
    check(open_pretending(RG_T1, false, RG_RGBA32F), false, 0);
}

static void the_variable_decides(void **state)
{
    (void)state;
    setenv("RG_BLENDING", "driver", 1);
    check(open_pretending(RG_T1, true, RG_RGBA32F), false, 0);
    setenv("RG_BLENDING", "program", 1);
    check(open_pretending(RG_T0, true, RG_FORMAT_NONE), true, 0);
    unsetenv("RG_BLENDING");
}

static char heard[200];
static int lines;

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)level, (void)user;
    snprintf(heard, sizeof(heard), "%s", line);
    lines++;
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    rg_log_listen(hear, NULL);
    lines = 0;
    setenv("RG_BLENDING", "program", 1);
    assert_null(open_pretending(RG_T1, false, RG_FORMAT_NONE));
    assert_string_equal(heard, "device 'cpu': RG_BLENDING=program, and its driver has no "
                               "GL_EXT_of_tests; unset RG_BLENDING");
    setenv("RG_BLENDING", "both", 1);
    assert_null(open_pretending(RG_T1, true, RG_FORMAT_NONE));
    assert_string_equal(heard, "RG_BLENDING=both: give driver or program, or unset it");
    unsetenv("RG_BLENDING");
    assert_int_equal(lines, 2);
    rg_log_listen(NULL, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inexact_drivers_do_not_blend), cmocka_unit_test(exact_drivers_do),
        cmocka_unit_test(others_are_not_asked),         cmocka_unit_test(the_variable_decides),
        cmocka_unit_test(what_cannot_be_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
