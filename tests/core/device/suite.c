// What every device must do: device_suite DEVICE runs the same tests on any of them.
#include "tests/core/device/suite.h"

#include <stdio.h>

enum { EXIT_UNSUPPORTED = 77 };

static int open_device(void **state)
{
    *state = rg_device_open(suite_device);
    return *state ? 0 : -1;
}

static int close_device(void **state)
{
    return rg_device_close(*state) ? 0 : -1;
}

// 77: this machine has no such device.
static int device_is_missing(void)
{
    struct rg_device *device = rg_device_open(suite_device);
    if (device)
        return rg_device_close(device) ? 0 : 1;
    return rg_outcome_of_error() == RG_UNSUPPORTED ? EXIT_UNSUPPORTED : 1;
}

int main(int argc, char **argv)
{
    if (argc > 1)
        suite_device = argv[1];
    int missing = device_is_missing();
    if (missing)
        return missing;
    const struct suite_tests *const files[] = {
        &buffer_tests,   &image_tests, &texel_tests, &kernel_tests, &refusal_tests,
        &lifetime_tests, &scan_tests,  &probe_tests, &draw_tests,   &target_tests,
        &filter_tests,   &large_tests, &light_tests, &lack_tests,   &tally_tests,
    };
    size_t total = 0, count = 0;
    for (int f = 0; f < COUNT_OF(files); f++)
        total += (size_t)files[f]->count;
    struct CMUnitTest *tests = calloc(total, sizeof(*tests));
    for (int f = 0; f < COUNT_OF(files); f++)
        for (int t = 0; t < files[f]->count; t++)
            tests[count++] = files[f]->tests[t];
    int failed = _cmocka_run_group_tests(suite_device, tests, count, open_device, close_device);
    free(tests);
    return failed;
}
