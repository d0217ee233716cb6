// A drawing is compared with that of cpu:reference, pixel by pixel: by a device that draws what cpu
// does, but for pixels that the test changes.
#include "harness/devices/measure/drawing.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "core/device/device.h"
#include "tests/tools/expect.h"

static const struct rg_backend *honest;

// Added to values of the first pixels that are black, and the number of those pixels.
static struct {
    int codes;    // of 255, in RGBA8's green
    float light;  // in RGBA32F's blue
    float depths; // in each depth
    int pixels;
} change;

static bool read_changed(struct rg_image *image, int layer, int level, void *texels)
{
    uint8_t *bytes = texels;
    float *floats = texels;
    const bool ok = honest->image_read(image, layer, level, texels);
    int left = change.pixels;
    for (int i = 0; ok && i < RG_DRAWING_PIXELS && left > 0; i++) {
        const enum rg_format format = image->desc.format;
        if (format == RG_RGBA8 && !bytes[4 * i + 1]) {
            bytes[4 * i + 1] = (uint8_t)change.codes;
            left--;
        } else if (format == RG_RGBA32F && floats[4 * i + 2] == 0) {
            floats[4 * i + 2] = change.light;
            left--;
        } else if (format == RG_D32F) {
            floats[i] -= change.depths;
            left--;
        }
    }
    return ok;
}

// The differing pixels of each format on a device of this tier.
static void check(enum rg_tier tier, int rgba8, int rgba16f, int rgba32f)
{
    static const enum rg_format formats[] = {RG_RGBA8, RG_RGBA16F, RG_RGBA32F};
    const int due[] = {rgba8, rgba16f, rgba32f};
    struct rg_drawing drawing;
    struct rg_device *device = rg_device_open("cpu");
    assert_non_null(device);
    honest = device->backend;
    struct rg_backend changed = *honest;
    changed.image_read = read_changed;
    device->backend = &changed;
    device->info.tier = tier;
    assert_true(rg_drawing_check(device, &drawing));
    assert_int_equal(drawing.count, 3);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(drawing.formats[i].format, formats[i]);
        assert_int_equal(drawing.formats[i].differing, due[i]);
    }
    assert_above(drawing.ms, 0);
    device->backend = honest;
    assert_true(rg_device_close(device));
}

static int begin(void **state)
{
    (void)state;
    memset(&change, 0, sizeof(change));
    change.pixels = 7;
    return 0;
}

static void cpu_draws_what_the_reference_does(void **state)
{
    (void)state;
    check(RG_T0, 0, 0, 0);
}

static void every_bit_counts_where_it_must(void **state)
{
    (void)state;
    change.codes = 1;
    change.light = 1e-7f;
    check(RG_T0, 7, 0, 7);
}

// Two codes of 255 are allowed, of light likewise.
static void other_devices_may_round(void **state)
{
    (void)state;
    change.codes = 2;
    change.light = 1.99f / 255;
    check(RG_T1, 0, 0, 0);
    change.codes = 3;
    change.light = 2.01f / 255;
    check(RG_T1, 7, 0, 7);
    check(RG_T2, 7, 0, 7);
}

static void depths_count_as_well(void **state)
{
    (void)state;
    change.depths = 0x1p-20f; // 1e-6
    check(RG_T0, 7, 7, 7);
    check(RG_T1, 0, 0, 0);
    change.depths = 0x1p-16f; // 1.5e-5
    check(RG_T1, 7, 7, 7);
}

static void what_cannot_be_drawn_to_is_left_out(void **state)
{
    (void)state;
    struct rg_drawing drawing = {.count = 7};
    struct rg_device *device = rg_device_open("cpu");
    assert_non_null(device);
    device->info.limits.formats[RG_RGBA16F].uses &= ~(unsigned)RG_USE_DRAW;
    assert_true(rg_drawing_check(device, &drawing));
    assert_int_equal(drawing.count, 2);
    assert_int_equal(drawing.formats[0].format, RG_RGBA8);
    assert_int_equal(drawing.formats[1].format, RG_RGBA32F);
    strcpy(device->info.limits.no_draws, "has no queue that draws");
    assert_true(rg_drawing_check(device, &drawing));
    assert_int_equal(drawing.count, 0);
    assert_true(rg_device_close(device));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(cpu_draws_what_the_reference_does, begin),
        cmocka_unit_test_setup(every_bit_counts_where_it_must, begin),
        cmocka_unit_test_setup(other_devices_may_round, begin),
        cmocka_unit_test_setup(depths_count_as_well, begin),
        cmocka_unit_test_setup(what_cannot_be_drawn_to_is_left_out, begin),
    };
    return cmocka_run_group_tests_name("drawings", tests, NULL, NULL);
}
