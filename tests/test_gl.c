// What is particular to the gl backend: `test_gl` runs on the first gl device, and `test_gl TEXT`
// expects that there is none, for a reason that contains TEXT (tests/meson.build breaks the
// driver).
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/device.h"
#include "core/log.h"
#include "kernels/test_copy_params.h"

static const char *reason; // why there is no device; NULL: there is one
static int errors;         // lines logged as errors
static FILE *noise;        // what anyone wrote to stderr

static void count_line(enum rg_log_level level, const char *line, void *user)
{
    (void)line, (void)user;
    errors += level == RG_LOG_ERROR;
}

static int open_device(void **state)
{
    *state = rg_device_open("gl", NULL);
    errors = 0;
    return *state ? 0 : -1;
}

static int close_device(void **state)
{
    return rg_device_close(*state) ? 0 : -1;
}

// Changes one word `steps` times, from buffer to buffer and back.
static uint32_t walk(struct rg_device *device, int steps, uint32_t salt)
{
    uint32_t word = 0;
    struct rg_buf *a = rg_buf_create(device, 4, "a"), *b = rg_buf_create(device, 4, "b");
    struct rg_pass *pass = rg_pass_create(device, "test_copy");
    assert_true(a && b && pass && rg_buf_write(a, 0, &word, 4));
    for (int i = 0; i < steps; i++) {
        struct test_copy_params params = {1, 1, salt * (uint32_t)i};
        struct rg_run run = {.params = &params,
                             .slots = {[1].buf = i % 2 ? b : a, [2].buf = i % 2 ? a : b},
                             .extent = {1, 1, 1}};
        assert_true(rg_pass_run(pass, &run));
    }
    assert_true(rg_buf_read(steps % 2 ? b : a, 0, &word, 4));
    rg_pass_destroy(pass);
    rg_buf_destroy(a);
    rg_buf_destroy(b);
    return word;
}

static uint32_t expected_walk(int steps, uint32_t salt)
{
    uint32_t word = 0;
    for (int i = 0; i < steps; i++)
        word ^= salt * (uint32_t)i;
    return word;
}

// More runs than the memory for parameters holds at once: none sees another one's.
static void queued_runs_keep_their_parameters(void **state)
{
    assert_int_equal(walk(*state, 9001, 0x9e3779b1u), expected_walk(9001, 0x9e3779b1u));
}

// A display ends with its last user: neither listing nor closing takes it from a living device.
static void devices_and_lists_live_side_by_side(void **state)
{
    static struct rg_device_list list;
    struct rg_device *second = rg_device_open("gl", NULL);
    assert_non_null(second);
    for (uint32_t salt = 1; salt < 4; salt++) {
        assert_int_equal(walk(*state, 5, salt), expected_walk(5, salt));
        assert_int_equal(walk(second, 6, salt), expected_walk(6, salt));
        rg_device_list_all(&list);
    }
    assert_true(rg_device_close(second));
    assert_int_equal(walk(*state, 7, 3), expected_walk(7, 3));
}

static void a_kernel_that_does_not_compile_is_one_line(void **state)
{
    char folder[] = "/tmp/test_gl.XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof(path), "%s/test_copy.glsl", folder);
    FILE *file = fopen(path, "w");
    fputs("#version 450 core\nvoid main() { missing(1);\nmissing(2); }\n", file);
    fclose(file);
    setenv("RG_KERNEL_DIR", folder, 1);
    struct rg_pass *pass = rg_pass_create(*state, "test_copy");
    unsetenv("RG_KERNEL_DIR");
    unlink(path);
    rmdir(folder);
    assert_null(pass);
    assert_int_equal(errors, 1);
    assert_non_null(strstr(rg_last_error(), "kernel 'test_copy': glCompileShader failed on gl: "));
    assert_non_null(strstr(rg_last_error(), "missing"));
}

static void what_the_driver_refuses_is_one_line(void **state)
{
    struct rg_device *device = *state;
    const struct rg_limits *limits = &device->info.limits;
    struct rg_image_desc desc = {RG_RGBA32F, limits->max_image_px, limits->max_image_px,
                                 limits->max_image_layers, 1};
    assert_null(rg_image_create(device, &desc, "all there is"));
    assert_int_equal(errors, 1);
    assert_non_null(
        strstr(rg_last_error(), "image 'all there is': glTextureStorage3D failed on gl with GL_"));
    assert_int_equal(walk(device, 3, 5), expected_walk(3, 5));
}

static void a_missing_driver_has_a_reason(void **state)
{
    (void)state;
    static struct rg_device_list list;
    errors = 0;
    rg_device_list_all(&list);
    assert_int_equal(errors, 0);
    const char *line = "";
    for (int i = 0; list.missing[i][0]; i++)
        if (!strncmp(list.missing[i], "gl: ", 4))
            line = list.missing[i];
    if (!strstr(line, reason))
        fail_msg("'%s' does not say '%s'", line, reason);
    enum rg_open_status status;
    assert_null(rg_device_open("gl", &status));
    assert_int_equal(status, RG_OPEN_UNSUPPORTED);
    assert_int_equal(errors, 1);
    assert_non_null(strstr(rg_last_error(), reason));
}

// Runs last: everything before it was to leave stderr alone.
static void drivers_are_silent(void **state)
{
    (void)state;
    fflush(stderr);
    rewind(noise);
    char line[256];
    if (fgets(line, sizeof(line), noise))
        fail_msg("on stderr: %s", line);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(queued_runs_keep_their_parameters, open_device,
                                        close_device),
        cmocka_unit_test_setup_teardown(devices_and_lists_live_side_by_side, open_device,
                                        close_device),
        cmocka_unit_test_setup_teardown(a_kernel_that_does_not_compile_is_one_line, open_device,
                                        close_device),
        cmocka_unit_test_setup_teardown(what_the_driver_refuses_is_one_line, open_device,
                                        close_device),
        cmocka_unit_test(drivers_are_silent),
    };
    const struct CMUnitTest without_driver[] = {
        cmocka_unit_test(a_missing_driver_has_a_reason),
        cmocka_unit_test(drivers_are_silent),
    };
    reason = argc > 1 ? argv[1] : NULL;
    cmocka_set_message_output(CM_OUTPUT_TAP);
    rg_log_listen(count_line, NULL);
    noise = tmpfile();
    dup2(fileno(noise), STDERR_FILENO);
    return reason ? cmocka_run_group_tests(without_driver, NULL, NULL)
                  : cmocka_run_group_tests(tests, NULL, NULL);
}
