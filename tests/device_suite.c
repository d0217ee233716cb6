// What every device must do: device_suite DEVICE runs the same tests on any of them.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "core/device.h"
#include "core/log.h"
#include "kernels/test_copy_params.h"

static const char *device_name;

static int open_device(void **state)
{
    *state = rg_device_open(device_name, NULL);
    return *state ? 0 : -1;
}

static int close_device(void **state)
{
    return rg_device_close(*state) ? 0 : -1;
}

static uint32_t noise(uint32_t i)
{
    return i * 2654435761u ^ 0x9e3779b9u;
}

static void buffers_keep_what_was_written(void **state)
{
    static const int words[] = {1, 3, 64, 257, 65537};
    for (size_t s = 0; s < sizeof(words) / sizeof(words[0]); s++) {
        int n = words[s];
        uint32_t *data = malloc((size_t)n * 4), *back = calloc((size_t)n, 4);
        for (int i = 0; i < n; i++)
            data[i] = noise((uint32_t)i);
        struct rg_buf *buf = rg_buf_create(*state, n * 4, "words");
        assert_non_null(buf);
        assert_true(rg_buf_write(buf, 0, data, n * 4));
        assert_true(rg_buf_write(buf, (n - 1) * 4, data, 4));
        data[n - 1] = data[0];
        assert_true(rg_buf_read(buf, 0, back, n * 4));
        assert_memory_equal(back, data, (size_t)n * 4);
        rg_buf_destroy(buf);
        free(data);
        free(back);
    }
}

static void grids_are_folded(void **state)
{
    enum { ITEMS = 70000 * 64 };
    uint32_t *data = malloc(ITEMS * 4), *back = malloc(ITEMS * 4);
    for (int i = 0; i < ITEMS; i++)
        data[i] = noise((uint32_t)i);
    struct rg_buf *source = rg_buf_create(*state, ITEMS * 4, "source");
    struct rg_buf *target = rg_buf_create(*state, ITEMS * 4, "target");
    struct rg_pass *pass = rg_pass_create(*state, "test_copy");
    assert_true(source && target && pass);
    assert_true(rg_buf_write(source, 0, data, ITEMS * 4));
    struct test_copy_params params = {ITEMS, 1, 0x5eed};
    assert_true(rg_pass_run(pass, &(struct rg_run){.params = &params,
                                                   .slots = {[1].buf = source, [2].buf = target},
                                                   .extent = {ITEMS, 1, 1}}));
    assert_true(rg_buf_read(target, 0, back, ITEMS * 4));
    for (int i = 0; i < ITEMS; i++)
        if (back[i] != (data[i] ^ 0x5eed))
            fail_msg("item %d", i);
    rg_pass_destroy(pass);
    rg_buf_destroy(source);
    rg_buf_destroy(target);
    free(data);
    free(back);
}

int main(int argc, char **argv)
{
    device_name = argc > 1 ? argv[1] : "cpu:reference";
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(buffers_keep_what_was_written),
        cmocka_unit_test(grids_are_folded),
    };
    return cmocka_run_group_tests_name(device_name, tests, open_device, close_device);
}
