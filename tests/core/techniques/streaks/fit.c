// The search for the smallest culling radius and local height of streaks: fit DEVICE.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/image/compare/compare.h"
#include "core/techniques/stages/frame.h"
#include "core/techniques/streaks/instance.h"
#include "tests/tools/expect.h"

enum { WIDTH = 128, HEIGHT = 72 };

// A small rain in a corner of the small city, with every particle culled by itself, so that all
// radii differ.
#define SMALL                                                                                      \
    "atlas=small city=small depth_map_px=256 shadow_map_px=64 rain_width_m=60 rain_depth_m=60 "    \
    "rain_height_m=40 camera=free eye_y_m=3 drops_m2_s=40 streak_gain=60 view_angle_deg=70 "       \
    "cull=exact far_layers=0 spectrum=off "

static struct rg_device *device;

static struct streaks *open_rain(struct rg_device *on, const char *settings)
{
    const struct rg_technique *technique = rg_technique_find("streaks");
    void *defaults = rg_settings_create(technique), *small, *all;
    assert_non_null(defaults);
    assert_non_null(small = rg_settings_copy(technique, defaults, SMALL));
    assert_non_null(all = rg_settings_copy(technique, small, settings));
    struct rg_instance *instance = rg_instance_open(technique, on, all, WIDTH, HEIGHT);
    assert_non_null(instance);
    free(defaults);
    free(small);
    free(all);
    return (struct streaks *)instance;
}

static void close_rain(struct streaks *s)
{
    rg_instance_close(&s->base);
}

static struct rg_picture read_picture(struct streaks *s)
{
    struct rg_picture picture;
    assert_true(s->base.technique->draw(&s->base));
    assert_true(rg_frame_read_picture(&s->base, &picture));
    return picture;
}

static struct rg_picture draw(const char *settings)
{
    struct streaks *s = open_rain(device, settings);
    struct rg_picture picture = read_picture(s);
    close_rain(s);
    return picture;
}

static bool same(const struct rg_picture *a, const struct rg_picture *b)
{
    return !memcmp(a->texels, b->texels, (size_t)rg_picture_values(a) * sizeof(*a->texels));
}

static double fact(const struct streaks *s, const char *name)
{
    for (int i = 0; i < s->base.fact_count; i++)
        if (!strcmp(s->base.facts[i].name, name))
            return s->base.facts[i].number;
    return NAN;
}

// The error that the search must find, from instances that do not know of it.
static double error_of(double radius_m, double height_m)
{
    char settings[128];
    struct rg_comparison c;
    snprintf(settings, sizeof(settings), "culling_radius_m=%.17g local_height_m=%.17g", radius_m,
             height_m);
    struct rg_picture picture = draw(settings);
    snprintf(settings, sizeof(settings), "limits=off local_height_m=%.17g", height_m);
    struct rg_picture truth = draw(settings);
    struct rg_picture dry = draw("drops=off splashes=off");
    assert_true(
        rg_compare(&truth, "truth", &picture, "rain", &dry, &(struct rg_compare_options){0}, &c));
    const double error = c.flip.mask_mean;
    assert_above(c.tiers.mask_pixels, 100);
    rg_comparison_destroy(&c);
    rg_picture_destroy(&picture);
    rg_picture_destroy(&truth);
    rg_picture_destroy(&dry);
    return error;
}

static void test_smallest_without_error(void **state)
{
    (void)state;
    const double allowed = 0.05;
    struct streaks *s = open_rain(device, "fit=on fit_error=0.05");
    const double radius_m = fact(s, "culling_radius_m"), height_m = fact(s, "local_height_m");
    const double told = fact(s, "flip_mask_mean");
    assert_equals(radius_m, s->settings.culling_radius_m);
    assert_equals(height_m, s->settings.local_height_m);
    close_rain(s);
    // Neither the smallest nor the largest value that the search tries.
    assert_above(radius_m, 2);
    assert_below(radius_m, 60);
    assert_above(height_m, 2);
    assert_below(height_m, 40);
    const double error = error_of(radius_m, height_m);
    assert_at_most(error, allowed);
    assert_below(fabs(error - told), 1e-6);
    assert_above(error_of(radius_m / 2, height_m), allowed);
    assert_above(error_of(radius_m, height_m / 2), allowed);
}

// The search leaves no trace: all frames are drawn with the sizes that it found. Maps around the
// observer, far layers and overlays depend on the sizes, too.
static void test_frames_are_as_set(void **state)
{
    (void)state;
    static const char *const more[] = {
        "",
        ("depth_map=dynamic depth_map_period=5 far_layers=2 overlay=on packets=kd "
         "packet_size=200"),
        "spectrum=best least_diameter_mm=1 kept_share=0.1",
        "spectrum=marshall-palmer kept_share=0.002"};
    for (size_t i = 0; i < sizeof(more) / sizeof(more[0]); i++) {
        char settings[256];
        snprintf(settings, sizeof(settings), "%s fit=on", more[i]);
        struct streaks *found = open_rain(device, settings);
        snprintf(settings, sizeof(settings), "%s culling_radius_m=%.17g local_height_m=%.17g",
                 more[i], fact(found, "culling_radius_m"), fact(found, "local_height_m"));
        struct streaks *set = open_rain(device, settings);
        assert_true(isnan(fact(set, "culling_radius_m")));
        for (int frame = 0; frame < 3; frame++) {
            struct rg_picture a = read_picture(found), b = read_picture(set);
            assert_true(same(&a, &b));
            rg_picture_destroy(&a);
            rg_picture_destroy(&b);
            assert_true(found->base.technique->step(&found->base));
            assert_true(set->base.technique->step(&set->base));
        }
        for (int c = 0; c < STREAKS_COUNTERS; c++)
            assert_int_equal(found->base.counters[c].value, set->base.counters[c].value);
        close_rain(found);
        close_rain(set);
    }
}

static void test_looser_is_no_larger(void **state)
{
    (void)state;
    static const double errors[] = {0.005, 0.03, 0.08};
    double before_m = INFINITY, first_m = 0;
    for (int i = 0; i < 3; i++) {
        char settings[64];
        snprintf(settings, sizeof(settings), "fit=on fit_error=%g", errors[i]);
        struct streaks *s = open_rain(device, settings);
        const double radius_m = fact(s, "culling_radius_m");
        assert_at_most(radius_m, before_m);
        assert_at_most(fact(s, "flip_mask_mean"), errors[i]);
        first_m = i ? first_m : radius_m;
        before_m = radius_m;
        close_rain(s);
    }
    assert_below(before_m, first_m / 2);
}

// However large the allowed error, the fastest drop of a spectrum (9.17 m/s) has time to make a
// streak and a splash: 1/60 s and 3 s.
static void test_least_height_of_sizes(void **state)
{
    (void)state;
    struct streaks *s = open_rain(device, "fit=on fit_error=0.2 spectrum=best kept_share=0.02 "
                                          "rain_mm_h=100 splash_s=3 fall_speed_m_s=2");
    const double height_m = fact(s, "local_height_m");
    assert_below(fabs(height_m - 9.17 * (1.0 / 60 + 3)), 0.02);
    close_rain(s);
}

// The result depends neither on the device nor on the sizes that were set, from which the search
// starts.
static void test_nothing_else_decides(void **state)
{
    (void)state;
    if (device->info.tier != RG_T0)
        skip(); // equal by eye, not to the bit
    struct rg_device *cpu = rg_device_open("cpu");
    assert_non_null(cpu);
    struct streaks *a = open_rain(device, "fit=on");
    struct streaks *b = open_rain(cpu, "fit=on culling_radius_m=1000 local_height_m=0.1");
    struct rg_picture picture_a = read_picture(a), picture_b = read_picture(b);
    assert_equals(fact(a, "culling_radius_m"), fact(b, "culling_radius_m"));
    assert_equals(fact(a, "local_height_m"), fact(b, "local_height_m"));
    assert_equals(fact(a, "flip_mask_mean"), fact(b, "flip_mask_mean"));
    assert_true(same(&picture_a, &picture_b));
    rg_picture_destroy(&picture_a);
    rg_picture_destroy(&picture_b);
    close_rain(a);
    close_rain(b);
    assert_true(rg_device_close(cpu));
}

static const char *device_name = "cpu";
static struct streaks *shared;

// One instance stays open beside those of the tests, so that instances share one city and one
// atlas.
static int set_up(void **state)
{
    (void)state;
    device = rg_device_open(device_name);
    if (!device)
        return -1;
    shared = open_rain(device, "");
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    close_rain(shared);
    return rg_device_close(device) ? 0 : -1;
}

int main(int argc, char **argv)
{
    if (argc > 1)
        device_name = argv[1];
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_smallest_without_error), cmocka_unit_test(test_frames_are_as_set),
        cmocka_unit_test(test_looser_is_no_larger),    cmocka_unit_test(test_least_height_of_sizes),
        cmocka_unit_test(test_nothing_else_decides),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
