// Drops at rest on level glass, by laws alone: a drop spreads to a cap that stays as it is, loses
// no water, and is the same whatever the texels. caps DEVICE runs on it.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/core/techniques/flow/rig.h"
#include "tests/tools/expect.h"

static const char *device = "cpu";

struct cap {
    double high_mm, radius_mm; // of its wet texels' area
    double rim_mm;             // mean height half a millimetre inside its edge
};

static struct cap cap_of(const struct rig *rig)
{
    const double texel_mm = rig->settings.pane_mm / rig->size;
    const int texels = rig->size * rig->size;
    int64_t *water = rig_water(rig);
    double sum = 0, x = 0, y = 0, area_mm2 = 0, rim_mm = 0;
    int rim = 0;
    struct cap cap = {0};
    for (int i = 0; i < texels; i++) {
        const double mm = rig_mm(rig, water[i]);
        cap.high_mm = fmax(cap.high_mm, mm);
        area_mm2 += mm > 0.03 ? texel_mm * texel_mm : 0;
        sum += mm;
        x += mm * (i % rig->size + 0.5) * texel_mm;
        y += mm * ((double)(i / rig->size) + 0.5) * texel_mm;
    }
    cap.radius_mm = sqrt(area_mm2 / acos(-1));
    for (int i = 0; i < texels; i++) {
        const double off_mm = hypot((i % rig->size + 0.5) * texel_mm - x / sum,
                                    ((double)(i / rig->size) + 0.5) * texel_mm - y / sum);
        if (fabs(cap.radius_mm - 0.5 - off_mm) > 0.25)
            continue;
        rim_mm += rig_mm(rig, water[i]);
        rim++;
    }
    cap.rim_mm = rim_mm / rim;
    free(water);
    return cap;
}

// A half ellipsoid as high as it is wide a side, after half a second and after another.
static struct cap cap_at_rest(int resolution_px, double radius_mm)
{
    char text[192];
    snprintf(text, sizeof(text),
             "move=sliding pane_mm=24 drops=0 pane_rain_mm_h=0 drying_mm2_s=0 pane_pitch_deg=90 "
             "resolution_px=%d",
             resolution_px);
    struct rig rig;
    rig_open(&rig, device, text);
    rig_put_drop(&rig, 12.1, 11.9, radius_mm, radius_mm);
    const int64_t sum = rig_sum(&rig);
    rig_step(&rig, 30);
    const struct cap before = cap_of(&rig);
    rig_step(&rig, 30);
    const struct cap cap = cap_of(&rig);
    print_message("%d texels: %.4f mm high, radius %.4f mm, %.4f mm at the rim\n", resolution_px,
                  cap.high_mm, cap.radius_mm, cap.rim_mm);
    assert_int_equal(rig_sum(&rig), sum);
    assert_int_equal(rig_ledger(&rig, FLOW_LEDGER_DRAINED), 0);
    assert_below(fabs(before.high_mm - cap.high_mm), 2e-3);
    assert_below(fabs(before.radius_mm - cap.radius_mm), 3e-3);
    rig_close(&rig);
    return cap;
}

static void expect_near(const char *what, double found, double due, double share)
{
    if (!(fabs(found / due - 1) <= share))
        fail_msg("%s: %.5g mm, not %.5g", what, found, due);
}

// Measured with texels of 1/4, 1/6 and 1/8 mm: heights differ from the middle by 1.4 % at most,
// radii by 0.6 %, rims by 1.7 %; in the last half second a height changes by 1e-3 mm, a radius
// by 2.6e-3.
static void test_caps_are_the_same_at_any_resolution(void **state)
{
    (void)state;
    static const struct {
        double radius_mm;
        struct cap due;
    } cases[] = {{1.5, {0.932, 1.947, 0.567}}, {2, {1.388, 2.555, 0.676}}};
    for (int i = 0; i < 2; i++)
        for (int px = 96; px <= 192; px += 48) {
            const struct cap cap = cap_at_rest(px, cases[i].radius_mm);
            expect_near("height", cap.high_mm, cases[i].due.high_mm, 0.02);
            expect_near("radius", cap.radius_mm, cases[i].due.radius_mm, 0.01);
            expect_near("rim", cap.rim_mm, cases[i].due.rim_mm, 0.025);
        }
}

int main(int argc, char **argv)
{
    device = argc > 1 ? argv[1] : device;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_caps_are_the_same_at_any_resolution),
    };
    return cmocka_run_group_tests(tests, NULL, rig_close_devices);
}
