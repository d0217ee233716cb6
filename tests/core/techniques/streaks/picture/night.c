// The light of rain around a city's lamps: night DEVICE. A column of rain a metre wide stands in
// the light of a street lamp, a headlight or a sign, and then of a sun from the same side. The
// light of each part of a streak in one is due that in the other times the lamp's inverse square
// and cone, in double precision.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "core/scene/matrix.h"
#include "core/scene/vector.h"
#include "core/techniques/scenery/lights/lights.h"
#include "tests/core/techniques/streaks/rig.h"
#include "tests/tools/expect.h"

static const double pi = 3.14159265358979323846;

// The column's middle, the direction from there to the lamp, and one across it, as the world's axes
// go. The eye is 26 m away.
static const double middle[3] = {0, 3, 0}, towards[3] = {-0.6, 0.8, 0}, across[3] = {0.8, 0.6, 0};

static char path[64];

// --- lights ---

// A lamp's light as the city has it by night: at a distance from the column, turned away from it.
static struct rg_light light_of(enum city_lamp_kind kind, double away_m, double turned_deg)
{
    const double c = cos(turned_deg * pi / 180), s = sin(turned_deg * pi / 180);
    struct city_lamp lamp = {.kind = kind, .tint = {1, 1, 1}};
    for (int i = 0; i < 3; i++) {
        lamp.position[i] = (float)(middle[i] + away_m * towards[i]);
        lamp.direction[i] = (float)(s * across[i] - c * towards[i]);
    }
    const struct scenery_lights_settings settings = {
        .count = 1, .time = SCENERY_NIGHT, .lamps = &lamp, .lamp_count = 1};
    struct rg_lights lights;
    if (kind == CITY_STREET_LAMP) {
        assert_true(scenery_lights_choose(&settings, &lights));
        return lights.lights[0];
    }
    // Other kinds come after the moon.
    struct scenery_lights_settings two = settings;
    two.count = 2;
    assert_true(scenery_lights_choose(&two, &lights));
    assert_int_equal(lights.lights[1].kind, SCENERY_SPOT);
    return lights.lights[1];
}

static void write_light(const struct rg_light *l)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    if (l)
        fprintf(file,
                "{\"lights\": [{\"type\": \"spot\", \"position_m\": [%.9g, %.9g, %.9g], "
                "\"direction\": [%.9g, %.9g, %.9g], \"colour\": [%.9g, %.9g, %.9g], "
                "\"inner_deg\": %.9g, \"outer_deg\": %.9g}]}\n",
                (double)l->position_m[0], (double)l->position_m[1], (double)l->position_m[2],
                (double)l->direction[0], (double)l->direction[1], (double)l->direction[2],
                (double)l->colour[0], (double)l->colour[1], (double)l->colour[2],
                (double)l->inner_deg, (double)l->outer_deg);
    else
        fprintf(file,
                "{\"lights\": [{\"type\": \"sun\", \"direction\": [%g, %g, %g], "
                "\"colour\": [1, 1, 1]}]}\n",
                -towards[0], -towards[1], -towards[2]);
    assert_int_equal(fclose(file), 0);
}

// The share of a lamp's light at a place, in closed form: the inverse square, and a cone that fades
// out between two cosines.
static double share_at(const struct rg_light *l, const double place[3])
{
    double squared = 0, along = 0;
    for (int i = 0; i < 3; i++) {
        const double off = place[i] - (double)l->position_m[i];
        squared += off * off;
        along += off * (double)l->direction[i];
    }
    const double in = cos((double)l->inner_deg * pi / 180),
                 out = cos((double)l->outer_deg * pi / 180);
    const double t = fmin(fmax((along / sqrt(squared) - out) / (in - out), 0), 1);
    return t * t * (3 - 2 * t) / squared;
}

// --- pictures ---

static struct streaks *open_column(void)
{
    char settings[700];
    snprintf(settings, sizeof(settings),
             "state=on geometry=off time=night streak_opacity=0 splashes=off streak_gain=1000 "
             "environment_light=off shadows=off limits=off rain_width_m=1 rain_depth_m=1 "
             "rain_height_m=60 local_height_m=50 drops_m2_s=2000 eye_z_m=-26 eye_y_m=3 "
             "target_y_m=3 target_z_m=0 view_angle_deg=2 lights_file=%s",
             path);
    struct streaks *s = rain_open(settings);
    rain_step(s, 2);
    return s;
}

// The light that rain adds to each pixel.
struct added {
    double at[RAIN_HEIGHT][RAIN_WIDTH];
};

static struct added *added_by_rain(struct streaks *s)
{
    const int drops = s->params.drops;
    struct rain_texels *lit = rain_read(s);
    s->params.drops = 0;
    struct rain_texels *dry = rain_read(s);
    s->params.drops = drops;
    struct added *added = malloc(sizeof(*added));
    assert_non_null(added);
    for (int i = 0; i < RAIN_TEXELS; i++)
        (&added->at[0][0])[i] = rain_texel(lit, i % RAIN_WIDTH, i / RAIN_WIDTH, 1) -
                                rain_texel(dry, i % RAIN_WIDTH, i / RAIN_WIDTH, 1);
    free(lit);
    free(dry);
    return added;
}

static double total(const struct added *added)
{
    double sum = 0;
    for (int i = 0; i < RAIN_TEXELS; i++)
        sum += (&added->at[0][0])[i];
    return sum;
}

// The mean share of a lamp's light over all parts of streaks, weighted by what a sun shows of them.
static double mean_share(const struct streaks *s, const struct added *sun, const struct rg_light *l)
{
    float to_world[16];
    double sum = 0, weight = 0;
    rg_rain_matrices(&s->space, NULL, to_world);
    const struct rg_matrix back = rg_matrix_of(to_world);
    const struct rain_places places = rain_read_places(s);
    for (int64_t i = 0; i < places.count; i++) {
        const float *place = places.words + i * STREAKS_STATE_WORDS;
        for (int k = 5; k < 95 && (int)place[5] == STREAKS_DROP; k += 5) {
            const double at[3] = {(double)place[0], (double)place[1],
                                  (double)place[2] - k / 100.0 * (double)s->params.fall};
            const rg_corner c =
                m4_project(s->params.to_clip, v3_make((float)at[0], (float)at[1], (float)at[2]));
            const int x = (int)floor((double)(c.x / c.w + 1) / 2 * RAIN_WIDTH),
                      y = (int)floor((double)(c.y / c.w + 1) / 2 * RAIN_HEIGHT);
            if (!(c.w > 0) || x < 0 || x >= RAIN_WIDTH || y < 0 || y >= RAIN_HEIGHT)
                continue;
            double world[3];
            for (int row = 0; row < 3; row++)
                world[row] = rg_dot(back.rows[row], at) + back.rows[row][3];
            weight += sun->at[y][x];
            sum += sun->at[y][x] * share_at(l, world);
        }
    }
    free(places.words);
    assert_above(weight, 0);
    return sum / weight;
}

// --- tests ---

static struct added *under_sun;

// The rain's light under a lamp, over that under a sun of the same colour.
static double expect_light(const char *about, enum city_lamp_kind kind, double away_m,
                           double turned_deg, double room)
{
    const struct rg_light light = light_of(kind, away_m, turned_deg);
    write_light(&light);
    struct streaks *s = open_column();
    struct added *lit = added_by_rain(s);
    const double due = mean_share(s, under_sun, &light),
                 is = total(lit) / total(under_sun) / (double)light.colour[1];
    rain_close(s);
    free(lit);
    print_message("%s, %g m away, turned by %g degrees: %.6f, %.4f of what is due\n", about, away_m,
                  turned_deg, is, due > 0 ? is / due : 0);
    if (!(fabs(is - due) <= room * due))
        fail_msg("%s, %g m away, turned by %g degrees: %g, not %g", about, away_m, turned_deg, is,
                 due);
    return is;
}

static void test_halo(void **state)
{
    (void)state;
    const double near = expect_light("a street lamp", CITY_STREET_LAMP, 3, 0, 0.02);
    expect_light("a street lamp", CITY_STREET_LAMP, 6, 0, 0.02);
    const double away = expect_light("a street lamp", CITY_STREET_LAMP, 12, 0, 0.02);
    assert_below(fabs(near / away / 16 - 1), 0.1); // the column is a metre wide
    expect_light("a street lamp's edge", CITY_STREET_LAMP, 6, 65, 0.02);
    assert_equals(expect_light("behind a street lamp", CITY_STREET_LAMP, 6, 95, 0.02), 0);
}

static void test_beam(void **state)
{
    (void)state;
    expect_light("in a headlight's beam", CITY_HEADLIGHT, 8, 0, 0.02);
    expect_light("in a headlight's beam", CITY_HEADLIGHT, 16, 0, 0.02);
    expect_light("beside the beam's middle", CITY_HEADLIGHT, 16, 8, 0.02);
    expect_light("at the beam's edge", CITY_HEADLIGHT, 16, 12, 0.03);
    assert_equals(expect_light("outside the beam", CITY_HEADLIGHT, 16, 20, 0.02), 0);
}

static void test_sign(void **state)
{
    (void)state;
    expect_light("before a sign", CITY_SIGN, 3, 0, 0.02);
    expect_light("beside a sign", CITY_SIGN, 3, 60, 0.02);
    assert_equals(expect_light("behind a sign", CITY_SIGN, 3, 100, 0.02), 0);
}

static void look_under_sun(void **state)
{
    (void)state;
    write_light(NULL);
    struct streaks *s = open_column();
    under_sun = added_by_rain(s);
    rain_close(s);
    assert_above(total(under_sun), 0);
}

static void forget(void **state)
{
    (void)state;
    free(under_sun);
}

int main(int argc, char **argv)
{
    snprintf(path, sizeof(path), "test_night_%ld.json", (long)getpid());
    struct CMUnitTest tests[] = {
        cmocka_unit_test(look_under_sun), cmocka_unit_test(test_halo), cmocka_unit_test(test_beam),
        cmocka_unit_test(test_sign),      cmocka_unit_test(forget),
    };
    const int status = rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
    remove(path);
    return status;
}
