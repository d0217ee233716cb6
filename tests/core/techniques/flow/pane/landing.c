// What lands on panes by the ledger: drops too small for the samples of their texels, and the
// paper's rain. On cpu.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>

#include "core/techniques/flow/inputs/rain.h"
#include "tests/core/techniques/flow/rig.h"
#include "tests/tools/expect.h"
#include "tests/tools/instance.h"

// All samples of a texel may miss a drop: 8 of them along 16 or 125 mm.
static void test_small_drops_land_whole(void **state)
{
    (void)state;
    static const char *const cases[] = {
        "resolution_px=128 pane_mm=2000",
        "resolution_px=16 pane_mm=2000 drop_radius_min_mm=0.1 drop_radius_max_mm=1"};
    for (int i = 0; i < 2; i++) {
        char text[192];
        snprintf(text, sizeof(text), "move=sliding %s", cases[i]);
        struct rig rig;
        rig_open(&rig, "cpu", text);
        const double sourced = rig_sourced_mm3(&rig, 30),
                     landed = fact_of(rig.instance, "landed_mm3");
        print_message("%s: %.9g mm3 of %.9g\n", cases[i], sourced, landed);
        assert_above(landed, 0);
        assert_below(fabs(sourced - landed), rig_droplet_mm3(&rig) + 1e-9 * landed);
        rig_close(&rig);
    }
}

// Half a minute of the paper's rain, on panes whose edges cut off little and much of the drops.
static void test_the_rate_of_paper_is_what_lands(void **state)
{
    (void)state;
    static const char *const cases[] = {"", "drop_radius_min_mm=0.5 drop_radius_max_mm=7",
                                        ("pane_mm=40 drop_radius_min_mm=7 drop_radius_max_mm=9 "
                                         "drop_height_per_mm=0.1 rain_drops_s=100")};
    for (int i = 0; i < 3; i++) {
        char text[256];
        snprintf(text, sizeof(text),
                 "move=paper resolution_px=96 drops=0 rain_drops_s=1000 capacity=64 %s", cases[i]);
        struct rig rig;
        rig_open(&rig, "cpu", text);
        const double mm_h = fact_of(rig.instance, "pane_rain_mm_h"), side = rig.settings.pane_mm;
        const double landed_mm_h = rig_sourced_mm3(&rig, 1800) / (side * side) / 30 * 3600;
        print_message("%s: %g mm/h, and %g landed\n", cases[i], mm_h, landed_mm_h);
        assert_below(fabs(mm_h / landed_mm_h - 1), 0.01); // 30,000 drops leave 0.5 % to chance
        if (i == 0) // by the midpoint rule: radii of 1 + 3 t^2 mm, as high as wide, less the edges
            assert_below(fabs(mm_h / 4375.35 - 1), 1e-4);
        rig_close(&rig);
    }
}

// C libraries differ in the last bits of a double.
static void test_sizes_are_floats(void **state)
{
    (void)state;
    struct flow_settings s;
    rg_params_reset(&flow_param_table, &s);
    const struct flow_rain rain = flow_rain_of(&s);
    for (int i = 0; i < 1000; i++) {
        const double radius_mm = flow_falling_drop(&rain, 0, i).radius_mm;
        assert_equals((float)radius_mm, radius_mm);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_small_drops_land_whole),
        cmocka_unit_test(test_the_rate_of_paper_is_what_lands),
        cmocka_unit_test(test_sizes_are_floats),
    };
    return cmocka_run_group_tests(tests, NULL, rig_close_devices);
}
