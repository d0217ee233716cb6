// Every operation of the dialect gives the same bits on every device and instruction set.
#include "backends/asked/blending.h"
#include "core/base/log.h"
#include "core/device/probe.h"
#include "core/device/scan.h"
#include "tests/core/device/suite.h"
#include "tests/tools/expect.h"

// The first rows must be exact. The drivers' own functions come after them and may differ.
static void check_operations(struct rg_device *device)
{
    struct rg_probe_result results[RG_PROBE_COUNT];
    int failed = 0;
    assert_true(rg_probe_run(device, results));
    for (int i = 0; i < RG_PROBE_COUNT; i++) {
        assert_non_null(results[i].name);
        assert_int_equal(results[i].builtin, i >= RG_PROBE_OP_COUNT);
        assert_int_equal(results[i].compared, RG_PROBE_INPUTS);
        if (results[i].builtin || results[i].different == 0)
            continue;
        print_error("%s, %s: %d of %d differ, by up to %u ulp\n", device->info.api, results[i].name,
                    results[i].different, results[i].compared, results[i].largest_ulps);
        failed++;
    }
    assert_int_equal(failed, 0);
}

static void operations_are_exact(void **state)
{
    check_operations(*state);
}

// Programs that round quotients and roots themselves, as on many GPUs, are exact as well. Here the
// driver's results are right already, and must stay so.
static void operations_rounded_by_programs_are_exact(void **state)
{
    if (!((struct rg_device *)*state)->backend->rough)
        skip();
    setenv("RG_ROUNDING", "own", 1);
    struct rg_device *device = rg_device_open(suite_device);
    unsetenv("RG_ROUNDING");
    assert_non_null(device);
    assert_true(device->rounds);
    check_operations(device);
    assert_true(rg_device_close(device));
}

// Runs the check that a GPU gets when it is opened. Software drivers pass it: they blend as C does.
static void drivers_blend_as_c_does(void **state)
{
    (void)state;
    struct rg_device *device = rg_device_open(suite_device);
    assert_non_null(device);
    if (device->backend->can_blend && !device->blends) {
        device->info.tier = RG_T1;
        assert_true(rg_blending_settle(device));
        assert_int_equal(device->blends, !device->info.software);
    }
    assert_true(rg_device_close(device));
}

static void check_scan(struct rg_device *device)
{
    enum { COUNT = 100003 };
    uint32_t *words = noise_words(COUNT, 8), sum = 0;
    struct rg_buf *values = make_buf(device, words, COUNT, "values");
    struct rg_buf *sums = filled_buf(device, 0, COUNT + 1, "sums");
    struct rg_scan *scan = rg_scan_create(device, COUNT);
    assert_non_null(scan);
    assert_true(rg_scan_sum(scan, values, sums, COUNT));
    uint32_t *got = read_words(sums, COUNT + 1);
    for (int i = 0; i < COUNT; sum += words[i++])
        assert_int_equal(got[i], sum);
    free(got);
    free(words);
    rg_scan_destroy(scan);
    rg_buf_destroy(values);
    rg_buf_destroy(sums);
}

// `cpu` holds its kernels once for each instruction set, and RG_CPU_LEVEL picks one.
static void every_cpu_level_gives_the_same(void **state)
{
    (void)state;
    if (strcmp(suite_device, "cpu") != 0)
        skip();
    static const char *const levels[] = {"plain", "v2", "v3", "v4"};
    const char *set = getenv("RG_CPU_LEVEL");
    char *kept = set ? strdup(set) : NULL;
    int run = 0;
    for (int i = 0; i < COUNT_OF(levels); i++) {
        setenv("RG_CPU_LEVEL", levels[i], 1);
        listen();
        struct rg_device *device = rg_device_open("cpu");
        heard();
        assert_true(device || rg_failure_take().outcome == RG_UNSUPPORTED);
        if (!device)
            continue;
        assert_non_null(strstr(device->info.api, levels[i]));
        check_operations(device);
        check_scan(device);
        assert_true(rg_device_close(device));
        run++;
    }
    setenv("RG_CPU_LEVEL", "v99", 1);
    assert_refused(rg_device_open("cpu"), "RG_CPU_LEVEL=v99");
    if (kept)
        setenv("RG_CPU_LEVEL", kept, 1);
    else
        unsetenv("RG_CPU_LEVEL");
    free(kept);
    assert_at_least(run, 1);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(operations_are_exact),
    cmocka_unit_test(operations_rounded_by_programs_are_exact),
    cmocka_unit_test(drivers_blend_as_c_does),
    cmocka_unit_test(every_cpu_level_gives_the_same),
};
const struct suite_tests probe_tests = {tests, COUNT_OF(tests)};
