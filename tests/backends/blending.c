// When a device's programs blend by themselves, tested on `cpu`. It pretends to be a device whose
// driver blends, inexactly in the format that a test names.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>

#include "tests/backends/pretending.h"

static bool is_able;
static enum rg_format inexact; // RG_FORMAT_NONE: no format

static bool can_blend(const struct rg_device *device, const char **word)
{
    (void)device;
    *word = "GL_EXT_of_tests";
    return is_able;
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
    pretend(its_tier);
    pretending.can_blend = can_blend;
    pretending.image_read = image_read;
    is_able = able;
    inexact = off;
    return rg_device_open("cpu");
}

static void check(struct rg_device *device, bool blends, int runs)
{
    check_asked(device, device && device->blends, blends, "blending", runs);
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

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    listen_to_lines(true);
    setenv("RG_BLENDING", "program", 1);
    assert_null(open_pretending(RG_T1, false, RG_FORMAT_NONE));
    assert_string_equal(heard_line, "device 'cpu': RG_BLENDING=program, and its driver has no "
                                    "GL_EXT_of_tests; unset RG_BLENDING");
    setenv("RG_BLENDING", "both", 1);
    assert_null(open_pretending(RG_T1, true, RG_FORMAT_NONE));
    assert_string_equal(heard_line, "RG_BLENDING=both: give driver or program, or unset it");
    unsetenv("RG_BLENDING");
    assert_int_equal(heard_lines, 2);
    listen_to_lines(false);
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
