// How core/device splits a run into parts, and what it counts, on a device that notes its calls.
#include <stddef.h>
#include <stdint.h>

#include "core/base/log.h"
#include "core/device/device.h"
#include "core/device/limits.h"
#include "kernels/probe/copy_params.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

enum { WIDTH = 21, HEIGHT = 5, DEPTH = 3 };

static const struct rg_backend *honest;
static int seen[DEPTH][HEIGHT][WIDTH], runs;

static bool note_run(struct rg_pass *pass, const struct rg_run *run)
{
    (void)pass;
    runs++;
    for (int z = 0; z < run->extent.depth; z++)
        for (int y = 0; y < run->extent.height; y++)
            for (int x = 0; x < run->extent.width; x++) {
                const struct rg_extent at = {run->origin.width + x, run->origin.height + y,
                                             run->origin.depth + z};
                assert_between(at.width, 100, 100 + WIDTH - 1);
                assert_between(at.height, 200, 200 + HEIGHT - 1);
                assert_between(at.depth, 300, 300 + DEPTH - 1);
                seen[at.depth - 300][at.height - 200][at.width - 100]++;
            }
    return true;
}

// Every item runs once, in parts of 8 x 2 x 2 at most.
static void test_parts(void **state)
{
    (void)state;
    struct rg_device *device = rg_device_open("cpu");
    assert_non_null(device);
    struct rg_backend noting = *device->backend;
    const struct probe_copy_params params = {1, 1, 0};
    struct rg_buf *a = rg_buf_create(device, 4, "a"), *b = rg_buf_create(device, 4, "b");
    struct rg_pass *pass = rg_pass_create(device, "probe_copy");
    assert_true(a && b && pass);
    honest = device->backend;
    noting.pass_run = note_run;
    device->backend = &noting;
    device->info.limits.max_groups[0] = device->info.limits.max_groups[1] =
        device->info.limits.max_groups[2] = 2;
    device->info.limits.group_items = 4;
    assert_true(rg_pass_run(pass, &(struct rg_run){.params = &params,
                                                   .slots = {[1].buf = a, [2].buf = b},
                                                   .origin = {100, 200, 300},
                                                   .extent = {WIDTH, HEIGHT, DEPTH}}));
    for (int i = 0; i < WIDTH * HEIGHT * DEPTH; i++)
        assert_int_equal((&seen[0][0][0])[i], 1);
    assert_int_equal(runs, 3 * 3 * 2);
    assert_int_equal(rg_device_work(device)->dispatches, 3 * 3 * 2);
    assert_int_equal(rg_device_work(device)->runs, 1);
    assert_int_equal(rg_device_work(device)->items, WIDTH * HEIGHT * DEPTH);
    device->backend = honest;
    rg_pass_destroy(pass);
    rg_buf_destroy(b);
    rg_buf_destroy(a);
    assert_true(rg_device_close(device));
}

// Bytes of live objects and of transfers, level by level.
static void test_bytes(void **state)
{
    (void)state;
    uint32_t texels[8 * 4] = {0};
    struct rg_device *device = rg_device_open("cpu");
    assert_non_null(device);
    const struct rg_work *work = rg_device_work(device);
    struct rg_image *image =
        rg_image_create(device, &(struct rg_image_desc){RG_RGBA8, 8, 4, 1, 3}, "image");
    assert_non_null(image);
    const int64_t bytes[] = {8 * 4 * 4, 4 * 2 * 4, 2 * 1 * 4};
    assert_int_equal(work->live_bytes, bytes[0] + bytes[1] + bytes[2]);
    for (int level = 0; level < 3; level++) {
        const int64_t read = work->bytes_read, written = work->bytes_written;
        assert_true(rg_image_write(image, 0, level, texels));
        assert_true(rg_image_read(image, 0, level, texels));
        assert_int_equal(work->bytes_written - written, bytes[level]);
        assert_int_equal(work->bytes_read - read, bytes[level]);
    }
    rg_image_destroy(image);
    assert_int_equal(work->live_bytes, 0);
    assert_int_equal(work->live_images, 0);
    assert_true(rg_device_close(device));
}

// A device that says it has no room for a work group, or for an item in one, would be asked for
// ever.
static void test_no_room_for_work(void **state)
{
    (void)state;
    struct rg_device *device = rg_device_open("cpu");
    assert_non_null(device);
    struct rg_device_info info = device->info;
    int *const numbers[] = {&info.limits.max_groups[0], &info.limits.max_groups[1],
                            &info.limits.max_groups[2], &info.limits.group_items};
    assert_true(rg_limits_are_sound(&info));
    rg_log_listen(log_last, NULL);
    for (int i = 0; i < 4; i++) {
        const int right = *numbers[i];
        for (*numbers[i] = 0; *numbers[i] > -2; --*numbers[i])
            assert_false(rg_limits_are_sound(&info));
        assert_int_equal(rg_failure_take().fault, RG_FAULT_DRIVER);
        *numbers[i] = right;
    }
    rg_log_listen(NULL, NULL);
    assert_true(rg_device_close(device));
}

// Devices of a backend count from 0, and an index after the last names none.
static void test_names(void **state)
{
    (void)state;
    static const char *const absent[] = {"cpu:2", "cpu:-1", "cpu:nonsense",
                                         "cpu:",  "cp",     "nonsense"};
    struct rg_device *device = rg_device_open("cpu:1");
    assert_non_null(device);
    assert_string_equal(device->info.name, "cpu:reference");
    assert_true(rg_device_close(device));
    rg_log_listen(log_last, NULL);
    for (size_t i = 0; i < sizeof(absent) / sizeof(absent[0]); i++)
        if (rg_device_open(absent[i]))
            fail_msg("%s is opened", absent[i]);
    rg_log_listen(NULL, NULL);
}

// Two devices owe the looser of their tiers, in either order.
static void test_tiers(void **state)
{
    (void)state;
    for (int a = RG_T0; a < RG_TIER_COUNT; a++)
        for (int b = RG_T0; b < RG_TIER_COUNT; b++) {
            const struct rg_device_info one = {.tier = (enum rg_tier)a},
                                        two = {.tier = (enum rg_tier)b};
            assert_int_equal(rg_tier_owed(&one, &two), a > b ? a : b);
        }
}

// Counted objects have a size and read as zeroes, and runs with them do nothing. The room is the
// most that lived together.
static void test_room(void **state)
{
    (void)state;
    bool is_taken;
    uint32_t words[4] = {1, 2, 3, 4};
    struct rg_device *device = rg_device_open("cpu");
    struct rg_buf *kept = rg_buf_create_with(device, words, 16, "kept");
    rg_room_begin(device, RG_ROOM_COUNTED);
    struct rg_buf *large = rg_buf_create(device, 4000, "large");
    rg_buf_destroy(large);
    struct rg_buf *small = rg_buf_create(device, 400, "small");
    struct rg_pass *pass = rg_pass_create(device, "probe_copy");
    const struct probe_copy_params params = {4, 1, 0};
    assert_true(rg_pass_run(pass, &(struct rg_run){.params = &params,
                                                   .slots = {[1].buf = small, [2].buf = kept},
                                                   .extent = {4, 1, 1}}));
    assert_true(rg_buf_read(small, 0, words, 16));
    assert_int_equal(words[0] + words[1] + words[2] + words[3], 0);
    rg_buf_destroy(small);
    rg_pass_destroy(pass);
    assert_int_equal(rg_room_end(device, &is_taken), 4000);
    assert_false(is_taken);
    assert_true(rg_buf_read(kept, 0, words, 16));
    assert_int_equal(words[3], 4); // nothing ran
    rg_room_begin(device, RG_ROOM_WATCHED);
    rg_buf_destroy(rg_buf_create(device, 800, "made"));
    assert_int_equal(rg_room_end(device, &is_taken), 800);
    assert_true(is_taken);
    rg_buf_destroy(kept);
    assert_true(rg_device_close(device));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_parts), cmocka_unit_test(test_bytes),
        cmocka_unit_test(test_names), cmocka_unit_test(test_tiers),
        cmocka_unit_test(test_room),  cmocka_unit_test(test_no_room_for_work),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
