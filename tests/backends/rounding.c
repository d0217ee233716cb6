// When a device's programs round quotients and roots themselves, tested on `cpu`. It pretends that
// its API allows inexact ones, and its results are off if a test says so.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "kernels/probe/rough_params.h"
#include "tests/backends/pretending.h"

enum operation { QUOTIENT, ROOT, NEITHER };

static enum operation inexact, asked;
static bool is_lost;

static bool pass_run(struct rg_pass *pass, const struct rg_run *run)
{
    asked = ((const struct probe_rough_params *)run->params)->roots ? ROOT : QUOTIENT;
    pretended_runs++;
    return is_lost ? rg_error("device 'cpu': lost") : rg_backend_cpu.pass_run(pass, run);
}

// One result is off by an ulp.
static bool buf_read(struct rg_buf *buf, size_t offset, void *data, size_t size)
{
    if (!rg_backend_cpu.buf_read(buf, offset, data, size))
        return false;
    ((uint32_t *)data)[size / 8] += asked == inexact;
    return true;
}

static struct rg_device *open_pretending(bool rough, enum rg_tier its_tier,
                                         enum operation its_inexact)
{
    pretend(its_tier);
    pretending.pass_run = pass_run;
    pretending.buf_read = buf_read;
    pretending.rough = rough;
    inexact = its_inexact;
    return rg_device_open("cpu");
}

static void check(struct rg_device *device, bool rounds, int runs)
{
    check_asked(device, device && device->rounds, rounds, "rounding", runs);
}

static void inexact_devices_round_themselves(void **state)
{
    (void)state;
    check(open_pretending(true, RG_T1, QUOTIENT), true, 1);
    check(open_pretending(true, RG_T1, ROOT), true, 2);
}

static void exact_devices_do_not(void **state)
{
    (void)state;
    check(open_pretending(true, RG_T1, NEITHER), false, 2);
}

// Devices are not checked that compute as C does, or whose API promises exact results.
static void others_are_not_asked(void **state)
{
    (void)state;
    check(open_pretending(true, RG_T0, QUOTIENT), false, 0);
    check(open_pretending(false, RG_T1, QUOTIENT), false, 0);
}

static void the_variable_decides(void **state)
{
    (void)state;
    setenv("RG_ROUNDING", "own", 1);
    check(open_pretending(true, RG_T0, NEITHER), true, 0);
    check(open_pretending(false, RG_T0, NEITHER), false, 0);
    setenv("RG_ROUNDING", "driver", 1);
    check(open_pretending(true, RG_T1, QUOTIENT), false, 0);
    setenv("RG_ROUNDING", "", 1);
    check(open_pretending(true, RG_T1, QUOTIENT), true, 1);
    unsetenv("RG_ROUNDING");
}

static void what_cannot_be_is_refused(void **state)
{
    (void)state;
    listen_to_lines(true);
    setenv("RG_ROUNDING", "up", 1);
    assert_null(open_pretending(true, RG_T1, NEITHER));
    unsetenv("RG_ROUNDING");
    assert_string_equal(heard_line, "RG_ROUNDING=up: give own or driver, or unset it");
    assert_int_equal(heard_lines, 1);
    is_lost = true;
    assert_null(open_pretending(true, RG_T1, NEITHER));
    is_lost = false;
    assert_string_equal(heard_line, "device 'cpu': lost");
    assert_int_equal(heard_lines, 2);
    listen_to_lines(false);
}

// Programs that round have their own modules, and a text that says so after its version.
static void their_code_is_another(void **state)
{
    (void)state;
    static const enum rg_code_kind modules[][2] = {
        {RG_CODE_SPIRV, RG_CODE_ROUNDED_SPIRV},
        {RG_CODE_VERTEX_SPIRV, RG_CODE_ROUNDED_VERTEX_SPIRV},
        {RG_CODE_FRAGMENT_SPIRV, RG_CODE_ROUNDED_FRAGMENT_SPIRV}};
    struct rg_kernel_code blended;
    assert_true(rg_kernel_code(rg_kernel_find("test_quads"), RG_CODE_FRAGMENT_GLSL,
                               RG_CODE_ROUNDS | RG_CODE_BLENDS, &blended));
    if (blended.size)
        assert_memory_equal(blended.bytes,
                            "#version 450 core\n#define RG_ROUNDED\n#define RG_BLENDS\n", 55);
    free(blended.bytes);
    static const enum rg_code_kind texts[] = {RG_CODE_GLSL, RG_CODE_VERTEX_GLSL,
                                              RG_CODE_FRAGMENT_GLSL};
    static const char begins[] = "#version 450 core\n#define RG_ROUNDED\n";
    const size_t first = strlen("#version 450 core\n"), length = sizeof(begins) - 1;
    for (int i = 0; i < 3; i++) {
        const struct rg_kernel *kernel = rg_kernel_find(i ? "test_quads" : "probe_ops");
        struct rg_kernel_code plain, code;
        if (!kernel->code[texts[i]].size)
            skip(); // a build without drivers
        assert_true(rg_kernel_code(kernel, modules[i][0], true, &code));
        assert_true(rg_kernel_code(kernel, modules[i][1], false, &plain));
        assert_int_equal(code.size, plain.size);
        assert_memory_equal(code.bytes, plain.bytes, plain.size);
        free(code.bytes);
        free(plain.bytes);
        assert_true(rg_kernel_code(kernel, texts[i], false, &plain));
        assert_true(rg_kernel_code(kernel, texts[i], true, &code));
        assert_int_equal(code.size, plain.size + length - first);
        assert_memory_equal(code.bytes, begins, length);
        assert_memory_equal(code.bytes + length, plain.bytes + first, plain.size - first);
        free(code.bytes);
        free(plain.bytes);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inexact_devices_round_themselves),
        cmocka_unit_test(exact_devices_do_not),
        cmocka_unit_test(others_are_not_asked),
        cmocka_unit_test(the_variable_decides),
        cmocka_unit_test(their_code_is_another),
        cmocka_unit_test(what_cannot_be_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
