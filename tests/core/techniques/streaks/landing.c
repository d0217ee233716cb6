// Drops of a spectrum as they land and as they are seen: landing DEVICE. Fast drops land more often
// than slow ones. Thus splashes have the spectrum of the flux, not of the air; the test computes it
// from formulas. Blocks and packets, which are selected by the largest and the fastest drops, must
// not show.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/core/techniques/streaks/rig.h"
#include "tests/tools/expect.h"

static const double pi = 3.14159265358979323846, largest_mm = 6, splash_s = 1;

// --- the formulas ---

enum { PARTS = 2000 };

struct rain {
    bool is_best;
    double rain_mm_h, least_mm;
    bool normalised; // so many drops that those of 0.1 to 6 mm make rain_mm_h
};

// Drops in a cubic metre, for each millimetre of diameter, as their authors give them.
static double density(const struct rain *r, double d)
{
    if (!r->is_best)
        return 8000 * exp(-4.1 * pow(r->rain_mm_h, -0.21) * d);
    const double a = 1.30 * pow(r->rain_mm_h, 0.232), part = pow(d / a, 2.25);
    return 67 * pow(r->rain_mm_h, 0.846) * 2.25 / d * part * exp(-part) / (pi / 6 * d * d * d);
}

// Atlas' fit of the terminal speed.
static double speed(double d)
{
    return fmax(9.65 - 10.3 * exp(-0.6 * d), 0);
}

static double water_mm(double drops_m2, double d)
{
    return drops_m2 * pi / 6 * d * d * d * 1e-6;
}

static double diameter_at(const struct rain *r, double part)
{
    return r->least_mm + (largest_mm - r->least_mm) * part / PARTS;
}

// The drops up to each diameter that land on a square metre in a second, and their whole water in
// millimetres. By the midpoint rule.
struct landing {
    double drops[PARTS + 1], water, squares[PARTS + 1]; // squares: of their weights
};

// By how much the law is multiplied.
static double times_of(const struct rain *r)
{
    const struct rain all = {r->is_best, r->rain_mm_h, 0.1, false};
    double water = 0;
    for (int i = 0; r->normalised && i < PARTS; i++) {
        const double d = diameter_at(&all, i + 0.5);
        water += water_mm(density(r, d) * speed(d) * (largest_mm - 0.1) / PARTS, d);
    }
    return r->normalised ? r->rain_mm_h / 3600 / water : 1;
}

static void reckon(const struct rain *r, struct landing *due)
{
    const double width = (largest_mm - r->least_mm) / PARTS, times = times_of(r);
    *due = (struct landing){0};
    for (int i = 0; i < PARTS; i++) {
        const double d = diameter_at(r, i + 0.5), drops = times * density(r, d) * speed(d) * width;
        due->drops[i + 1] = due->drops[i] + drops;
        due->water += water_mm(drops, d);
    }
}

static double drops_m3(const struct rain *r)
{
    double sum = 0;
    for (int i = 0; i < PARTS; i++)
        sum += density(r, diameter_at(r, i + 0.5)) * (largest_mm - r->least_mm) / PARTS;
    return sum * times_of(r);
}

// --- splashes ---

static struct streaks *open_splashes(const struct rain *r, const char *more)
{
    char settings[700];
    // The local space is as high as the rain space, so that every drop lands in it.
    snprintf(settings, sizeof(settings),
             "state=on geometry=off drops=off terminal_speed=atlas packets=world blocks=all "
             "rain_height_m=40 local_height_m=40 eye_y_m=19.9 target_y_m=19.9 target_z_m=40 "
             "culling_radius_m=30 splash_s=%g spectrum=%s rain_mm_h=%g least_diameter_mm=%g "
             "normalised=off kept_share=%g kept=%s",
             splash_s, r->is_best ? "best" : "marshall-palmer", r->rain_mm_h, r->least_mm,
             1e6 / (144000 * drops_m3(r)), more);
    struct streaks *s = rain_open(settings);
    rain_step(s, 7);
    return s;
}

// Counts splashes by their drops' diameters; each splash lasts splash_s.
static struct landing count_landing(const struct streaks *s, const struct rain *r, int64_t *count)
{
    const struct rain_places places = rain_read_places(s);
    const double share = 1 / (60 * 60 * s->mean_density * splash_s);
    struct landing sum = {0};
    *count = 0;
    for (int64_t i = 0; i < places.count; i++) {
        const float *place = places.words + i * STREAKS_STATE_WORDS;
        if ((int)place[5] != STREAKS_SPLASH)
            continue;
        const double d = 2000 * (double)place[8], drops = share * (double)place[9];
        const int part = (int)ceil((d - r->least_mm) / (largest_mm - r->least_mm) * PARTS);
        assert_between(part, 0, PARTS);
        sum.drops[part] += drops;
        sum.water += water_mm(drops, d);
        sum.squares[part] += drops * drops;
        *count += 1;
    }
    free(places.words);
    for (int i = 0; i < PARTS; i++) {
        sum.drops[i + 1] += sum.drops[i];
        sum.squares[i + 1] += sum.squares[i];
    }
    return sum;
}

// Twice the standard deviation, where it is largest, of the share of drops up to a diameter: for
// drops of one weight 1 over the root of their number.
static double spread(const struct landing *l)
{
    double most = 0;
    for (int i = 0; i <= PARTS; i++) {
        const double share = l->drops[i] / l->drops[PARTS];
        most = fmax(most, l->squares[i] * pow(1 - share, 2) +
                              (l->squares[PARTS] - l->squares[i]) * pow(share, 2));
    }
    return 2 * sqrt(most) / l->drops[PARTS];
}

static void expect_flux(const struct rain *r, const char *more)
{
    struct streaks *s = open_splashes(r, more);
    struct landing due;
    int64_t count;
    const struct landing is = count_landing(s, r, &count);
    reckon(r, &due);
    const double drops = is.drops[PARTS] / due.drops[PARTS], water = is.water / due.water;
    double most = 0;
    for (int i = 0; i <= PARTS; i++)
        most = fmax(most, fabs(is.drops[i] / is.drops[PARTS] - due.drops[i] / due.drops[PARTS]));
    print_message(
        "%s, %g mm/h: %lld splashes, %.4f of the drops, %.4f of the water, off by %.4f of %.4f\n",
        r->is_best ? "best" : "marshall-palmer", r->rain_mm_h, (long long)count, drops, water, most,
        1.63 * spread(&is) + 0.001);
    assert_above(count, 20000);
    assert_below(fabs(drops - 1), 0.02);
    assert_below(fabs(water - 1), 0.02);
    // Kolmogorov-Smirnov test at 1 % for drops of these weights, and half a class of 512.
    assert_below(most, 1.63 * spread(&is) + 0.001);
    assert_below(spread(&is), 2 / sqrt((double)count)); // or weights are too uneven
    rain_close(s);
}

static void test_drops_land_by_flux(void **state)
{
    (void)state;
    static const double rates[] = {1, 5, 20, 50, 100};
    for (int best = 0; best < 2; best++)
        for (int k = 0; k < 5; k++)
            expect_flux(&(struct rain){best, rates[k], 0.8, false}, "alike");
    expect_flux(&(struct rain){true, 20, 0.8, false}, "section");
    expect_flux(&(struct rain){false, 20, 0.3, true}, "streak normalised=on"); // the default
}

// --- what is seen ---

// Draws a picture by each way to choose blocks. All must be the same, and differ from the picture
// without rain.
static void expect_no_blocks(const char *view, const char *drops)
{
    static const char *const ways[] = {"blocks=all", "blocks=seen select=rect",
                                       "blocks=seen select=hull"};
    struct rain_texels *pictures[3];
    char settings[600];
    snprintf(settings, sizeof(settings), "%s drops=off splashes=off", view);
    struct rain_texels *dry = rain_draw_at(settings, 30);
    for (int way = 0; way < 3; way++) {
        snprintf(settings, sizeof(settings), "%s cull=exact packets=quad packet_size=2000 %s %s",
                 view, drops, ways[way]);
        pictures[way] = rain_draw_at(settings, 30);
        if (memcmp(pictures[way], pictures[0], sizeof(*dry)))
            fail_msg("%s, %s, %s: not as with all blocks", view, drops, ways[way]);
    }
    assert_true(memcmp(pictures[0], dry, sizeof(*dry)));
    for (int way = 0; way < 3; way++)
        free(pictures[way]);
    free(dry);
}

#define SIZES "spectrum=best least_diameter_mm=1 kept_share=0.2 "

// Only blocks and packets that the view cannot see are left out. Views that look up over a low
// local space show streaks and splashes from below it.
static void test_blocks_do_not_show(void **state)
{
    (void)state;
    static const char *const views[] = {
        "view_angle_deg=30 eye_y_m=3 target_y_m=3 target_z_m=40",
        "view_angle_deg=30 local_height_m=6 eye_y_m=6 target_y_m=36 target_z_m=40",
        "view_angle_deg=30 eye_y_m=20 target_y_m=0 target_z_m=12",
    };
    for (size_t i = 0; i < sizeof(views) / sizeof(views[0]); i++) {
        expect_no_blocks(views[i], SIZES "splash_width_mm=2000");
        expect_no_blocks(views[i], SIZES "splashes=off splash_s=0.001 exposure_s=0.25");
    }
    expect_no_blocks(views[1], "spectrum=marshall-palmer kept_share=0.005 splash_width_mm=2000");
}

// Drops of one size, in blocks by how far they have fallen. A splash lasts as long as its drop
// would fall on below the surface: on the ground, further than these views see.
static void test_splashes_outlast_their_blocks(void **state)
{
    (void)state;
    static const char *const views[] = {
        "view_angle_deg=20 eye_y_m=1 target_y_m=1 target_z_m=40",
        "view_angle_deg=20 local_height_m=12 eye_y_m=1.5 target_y_m=1.5 target_z_m=40",
    };
    for (size_t i = 0; i < sizeof(views) / sizeof(views[0]); i++)
        expect_no_blocks(views[i], "drops=off splash_width_mm=400 splash_s=0.8 drops_m2_s=20");
}

int main(int argc, char **argv)
{
    struct CMUnitTest tests[] = {
        cmocka_unit_test(test_drops_land_by_flux),
        cmocka_unit_test(test_blocks_do_not_show),
        cmocka_unit_test(test_splashes_outlast_their_blocks),
    };
    return rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
