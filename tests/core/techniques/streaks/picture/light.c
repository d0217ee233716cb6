// The share of their light that rain's layers show at the default gains, and in small pictures:
// light DEVICE. Rain adds its gain times a constant to a picture. The light at a gain of 1 is thus
// due a hundredth of the light at a gain of 100. tests/core/techniques/streaks/picture/cover.c and
// oracle.c check the latter against optics.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/core/techniques/streaks/rig.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/sanitized.h"

// Light that is lost is lost in a small picture, too, which takes sanitizers a sixteenth of the
// time.
enum { GAIN = 100, SMALLER = IS_SANITIZED ? 4 : 1 };

static struct streaks *open_sized(const char *settings, int width, int height)
{
    const struct rg_technique *technique = rg_technique_find("streaks");
    char all[512];
    void *defaults = rg_settings_create(technique);
    snprintf(all, sizeof(all),
             "atlas=small city=small depth_map_px=1024 shadow_map_px=256 geometry=off %s",
             settings);
    void *copy = rg_settings_copy(technique, defaults, all);
    assert_non_null(copy);
    struct rg_instance *instance = rg_instance_open(technique, rain_device, copy, width, height);
    assert_non_null(instance);
    free(copy);
    free(defaults);
    return (struct streaks *)instance;
}

// The sum of a picture's green, with this gain of drops and splashes.
static double light_with(struct streaks *s, float gain)
{
    struct rg_picture picture = {0};
    double sum = 0;
    s->params.gain = s->params.splash_gain = gain;
    assert_true(s->base.technique->draw(&s->base));
    assert_true(rg_frame_read_picture(&s->base, &picture));
    for (int i = 0; i < picture.width * picture.height; i++)
        sum += (double)picture.texels[4 * i + 1];
    rg_picture_destroy(&picture);
    return sum;
}

static void expect_light(const char *about, const char *settings, int width, int height)
{
    width /= SMALLER;
    height /= SMALLER;
    struct streaks *s = open_sized(settings, width, height);
    rain_step(s, 30);
    const double none = light_with(s, 0), shown = light_with(s, 1) - none,
                 due = (light_with(s, GAIN) - none) / GAIN;
    print_message("%s: shown over due %.4f, due %.4f of the picture\n", about, shown / due,
                  due / (width * height));
    assert_above(due, 0);
    if (!(fabs(shown / due - 1) < 0.005))
        fail_msg("%s: %.4f of the light is shown that is due", about, shown / due);
    rain_close(s);
}

// Part of the rain: all drops of all of it would take half of this test's time.
#define PART "rain_width_m=150 rain_depth_m=150"

static void test_day(void **state)
{
    (void)state;
    expect_light("by day, 512 x 512", "", 512, 512);
    expect_light("by day, 720p", "", 1280, 720);
    expect_light("drops of one size", "spectrum=off", 640, 360);
    expect_light("1/15 s", "exposure_s=0.0666667", 640, 360);
    expect_light("every drop, at 20 mm/h", "rain_mm_h=20 kept_share=1 " PART, 640, 360);
    expect_light("every drop, at 5 mm/h", "rain_mm_h=5 kept_share=1 " PART, 640, 360);
}

static void test_night(void **state)
{
    (void)state;
    expect_light("by night, eight lights", "time=night lights=8", 640, 360);
}

// A picture's light, in the mean of its pixels, at a gain of 100.
static double mean_light(const char *settings, int width, int height)
{
    struct streaks *s = open_sized(settings, width, height);
    rain_step(s, 30);
    const double light = light_with(s, GAIN) - light_with(s, 0);
    rain_close(s);
    return light / (width * height);
}

#define FEW "lights=0 far_layers=0"

// However small the picture, and however thin what is seen in it: most drops and splashes are
// thinner than a pixel of the smaller one. Wide ones depend on where pixels' middles lie.
static void test_small_pictures(void **state)
{
    (void)state;
    static const char *const rains[] = {"drops=off splash_opacity=0 " FEW,
                                        "splashes=off streak_opacity=0 " FEW};
    for (int i = 0; i < 2; i++) {
        const double small = mean_light(rains[i], 160, 90), large = mean_light(rains[i], 640, 360);
        print_message("%s: a 16th of the pixels, %.4f of the light\n", rains[i], small / large);
        assert_above(large, 0);
        assert_below(fabs(small / large - 1), 0.005); // 0.3 %
    }
}

int main(int argc, char **argv)
{
    struct CMUnitTest tests[] = {cmocka_unit_test(test_day), cmocka_unit_test(test_night),
                                 cmocka_unit_test(test_small_pictures)};
    return rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
