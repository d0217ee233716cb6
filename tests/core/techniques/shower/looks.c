// The paper claims that improved rain looks the same: shower looks. The test measures mean and
// deviation of its light in each region, and over time. One device is asked, since all draw the
// same pictures.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "kernels/dialect/image/format.h"
#include "tests/core/techniques/shower/rig.h"
#include "tests/tools/expect.h"

enum { WIDTH = 160, HEIGHT = 90, ACROSS = 4, DOWN = 3, REGIONS = ACROSS * DOWN, FRAMES = 16 };

// The mean light of drops in each region, and its deviation over the pixels.
struct looks {
    double mean[REGIONS], deviation[REGIONS];
    double all; // the mean of the whole picture
};

// The part of a pixel that drops hide, from its light.
static double hidden(const struct shower *s, const uint16_t *texel)
{
    return ((double)rg_unpack_half(texel[0]) - pour_sky(0)) / (pour_light(s, 0) - pour_sky(0));
}

static int region_of(int pixel)
{
    const int x = pixel % WIDTH, y = pixel / WIDTH;
    return y * DOWN / HEIGHT * ACROSS + x * ACROSS / WIDTH;
}

static struct looks looks_of(const char *settings)
{
    static uint16_t texels[WIDTH * HEIGHT * 4];
    char all[512];
    struct looks l = {0};
    snprintf(all, sizeof(all),
             "particles=20000 variation=0 drop_height_m=0.4 light=8 gravity_m_s2=0 birth=whole "
             "eye_y_m=60 wind_m_s=1 %s",
             settings);
    struct shower *s = pour_open(all, WIDTH, HEIGHT);
    pour_step(s, 120); // by then the first step's rain is out of sight
    for (int frame = 0; frame < FRAMES; frame++) {
        pour_step(s, 11);
        assert_true(s->base.technique->draw(&s->base));
        assert_true(rg_image_read(s->base.target, 0, 0, texels));
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const double share = hidden(s, texels + 4 * i);
            l.mean[region_of(i)] += share;
            l.deviation[region_of(i)] += share * share;
        }
    }
    const double pixels = (double)WIDTH * HEIGHT / REGIONS * FRAMES;
    for (int i = 0; i < REGIONS; i++) {
        l.mean[i] /= pixels;
        l.deviation[i] = sqrt(l.deviation[i] / pixels - l.mean[i] * l.mean[i]);
        l.all += l.mean[i] / REGIONS;
    }
    pour_close(s);
    return l;
}

// The largest difference of a region from the same region of other rain, as a share of the other.
static void compare(const char *what, const struct looks *a, const struct looks *b, double *mean,
                    double *deviation)
{
    *mean = *deviation = 0;
    for (int i = 0; i < REGIONS; i++) {
        *mean = fmax(*mean, fabs(b->mean[i] / a->mean[i] - 1));
        *deviation = fmax(*deviation, fabs(b->deviation[i] / a->deviation[i] - 1));
    }
    print_message(
        "%s: %.5f of the light, not %.5f; regions differ by %.1f %% in mean and %.1f %% in "
        "deviation\n",
        what, b->all, a->all, 100 * *mean, 100 * *deviation);
}

static struct looks traditional_but(const char *difference, const struct looks *before,
                                    double *mean, double *deviation)
{
    char settings[128];
    snprintf(settings, sizeof(settings), "system=traditional %s", difference);
    const struct looks after = looks_of(settings);
    compare(difference, before, &after, mean, deviation);
    return after;
}

// Four improvements leave the rain alike: regions differ no more than between seeds. Compact
// particles make identical pictures, and so does uniform motion without acceleration.
static void four_improvements_leave_the_rain_as_it_is(void **state)
{
    (void)state;
    static const char *const which[] = {"seed=2", "shape=segments", "crop=point", "state=compact",
                                        "motion=uniform"};
    const struct looks before = looks_of("system=traditional");
    for (int i = 0; i < 5; i++) {
        double mean, deviation;
        const struct looks after = traditional_but(which[i], &before, &mean, &deviation);
        const double most = i < 3 ? 0.2 : 0;
        assert_at_most(mean, most);
        assert_at_most(deviation, most);
        pour_expect("light", after.all, before.all, 0.06 * before.all);
    }
}

// Two improvements change the rain. Particles that die at the view's lower end live shortly in
// front, where the view is low. As many promoted particles stay in front as were placed there, so
// that promotion brings near rain, which is brighter. With layers far drops are smaller.
static void promotion_and_layers_change_it(void **state)
{
    (void)state;
    double mean, deviation;
    const struct looks before = looks_of("system=traditional");
    const struct looks promoted = traditional_but("renewal=promotion", &before, &mean, &deviation);
    assert_above(promoted.all, 1.8 * before.all);
    assert_below(promoted.all, 3 * before.all);
    const struct looks layered = traditional_but("layers=on", &before, &mean, &deviation);
    assert_above(layered.all, 0.3 * before.all);
    assert_below(layered.all, 0.6 * before.all);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(four_improvements_leave_the_rain_as_it_is),
        cmocka_unit_test(promotion_and_layers_change_it),
    };
    return pour_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
