// Every device must pass these tests: device_suite DEVICE [PART] runs the same ones on any device.
// Native devices pass the part 'native': what their samplers and queries do.
#include "core/base/log.h"
#include "tests/core/device/suite.h"

#include <stdlib.h>
#include <string.h>

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

// 77 means that this machine has no such device.
static int device_is_missing(void)
{
    struct rg_device *device = rg_device_open(suite_device);
    if (device)
        return rg_device_close(device) ? 0 : 1;
    return rg_failure_take().outcome == RG_UNSUPPORTED ? EXIT_UNSUPPORTED : 1;
}

// The parts of the suite, which may run side by side.
static const struct part {
    const char *name;
    const struct suite_tests *files[8];
} parts[] = {
    {"kernels",
     {&buffer_tests, &kernel_tests, &refusal_tests, &lifetime_tests, &scan_tests, &probe_tests,
      &lack_tests}},
    {"images",
     {&image_tests, &texel_tests, &filter_tests, &large_tests, &sampled_tests, &around_tests,
      &pass_tests}},
    {"native",
     {&sampled_tests, &around_tests, &native_filter_tests, &query_tests, &range_tests, &place_tests,
      &pass_tests}},
    {"draws", {&draw_tests, &tally_tests, &query_tests, &range_tests, &place_tests}},
    {"ranges", {&range_tests}}, // alone, for faults of their kernel
    {"targets", {&target_tests, &light_tests, &layer_tests}},
};

// Appends a part's tests to an array of this many, which may move.
static void add_part(const struct part *part, struct CMUnitTest **tests, size_t *count)
{
    for (int f = 0; part->files[f]; f++) {
        const size_t more = (size_t)part->files[f]->count;
        *tests = realloc(*tests, (*count + more) * sizeof(**tests));
        memcpy(*tests + *count, part->files[f]->tests, more * sizeof(**tests));
        *count += more;
    }
}

int main(int argc, char **argv)
{
    if (argc > 1)
        suite_device = argv[1];
    int missing = device_is_missing();
    if (missing)
        return missing;
    struct CMUnitTest *tests = NULL;
    size_t count = 0;
    for (int i = 0; i < COUNT_OF(parts); i++)
        if (argc < 3 || !strcmp(argv[2], parts[i].name))
            add_part(&parts[i], &tests, &count);
    const int failed =
        count ? _cmocka_run_group_tests(suite_device, tests, count, open_device, close_device) : 1;
    free(tests);
    return failed;
}
