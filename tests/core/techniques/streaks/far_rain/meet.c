// Near rain and far rain agree: meet DEVICE. Drops up to a culling radius with layers behind them
// have the mean and variance of drops up to where the layers end.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/image/files/io.h"
#include "core/scene/city/city.h"
#include "tests/core/techniques/streaks/rig.h"
#include "tests/tools/expect.h"

// One file for each process, since tests of several devices run side by side.
static char lights_path[64], map_path[64], mesh_path[64];

// Light of drops alone, and so much that rounding down to halves loses nothing that matters.
#define MEET                                                                                       \
    "geometry=off splashes=off time=night cull=exact packets=world rain_width_m=50 "               \
    "rain_depth_m=50 rain_height_m=14 local_height_m=14 view_angle_deg=20 streak_opacity=0 "       \
    "streak_gain=1000 taps=8 drops_m2_s=200 far_layers=2 culling_radius_m=24 step_s=0.9 "

// Sums of a picture's light and of its squares.
struct moments {
    double sum, squares;
    int count;
};

// Draws this frame with other settings, which change nothing that is open.
static struct rain_texels *draw(struct streaks *s, double radius_m, int layers, int drops)
{
    s->settings.culling_radius_m = radius_m;
    s->settings.far_layers = layers;
    s->settings.drops = drops;
    assert_true(streaks_look(s));
    return rain_read(s);
}

// Adds the light by which one picture exceeds another.
static void add(struct moments *m, const struct rain_texels *more, const struct rain_texels *less,
                const bool *left_out)
{
    for (int y = 0; y < RAIN_HEIGHT; y++)
        for (int x = 0; x < RAIN_WIDTH; x++) {
            const double light = rain_texel(more, x, y, 1) - rain_texel(less, x, y, 1);
            if (left_out && left_out[y * RAIN_WIDTH + x])
                continue;
            m->sum += light;
            m->squares += light * light;
            m->count++;
        }
}

struct figures {
    double mean, variance;
};

// The allowed difference, as a share.
static const double within = 0.03;

static struct figures figures_of(const struct moments *m)
{
    const double mean = m->sum / m->count;
    return (struct figures){mean, m->squares / m->count - mean * mean};
}

enum { SEEDS = 12, FRAMES = 4 };

// The larger radius adds the drops between both radii to a picture of the same drops.
static void expect_meeting(const char *about, const char *settings, const bool *left_out)
{
    struct moments layers = {0, 0, 0}, drops = {0, 0, 0};
    for (int seed = 1; seed <= SEEDS; seed++) {
        char all[900];
        snprintf(all, sizeof(all), MEET "%s seed=%d", settings, seed);
        struct streaks *s = rain_open(all);
        for (int frame = 0; frame < FRAMES; frame++) {
            rain_step(s, 1);
            struct rain_texels *dry = draw(s, 8, 0, 0), *far = draw(s, 8, 2, 0),
                               *near = draw(s, 8, 0, 1), *whole = draw(s, 24, 0, 1);
            add(&layers, far, dry, left_out);
            add(&drops, whole, near, left_out);
            free(dry);
            free(far);
            free(near);
            free(whole);
        }
        rain_close(s);
    }
    const struct figures a = figures_of(&layers), b = figures_of(&drops);
    assert_above(b.mean, 0);
    assert_above(b.variance, 0);
    if (!(fabs(a.mean / b.mean - 1) < within && fabs(a.variance / b.variance - 1) < within))
        fail_msg("%s: mean %.4f, variance %.4f of those of drops", about, a.mean / b.mean,
                 a.variance / b.variance);
}

static void write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static void write_lights(const char *lights, double sky)
{
    char text[900];
    snprintf(text, sizeof(text), "{\"lights\": [%s], \"sky\": {\"colour\": [%g, %g, %g]}}\n",
             lights, sky, sky, sky);
    write_file(lights_path, text);
}

#define SUN                                                                                        \
    "{\"type\": \"sun\", \"direction\": [0.5, -1, 0.4], \"colour\": [9, 9, 9], \"shadows\": "      \
    "false}"
#define LOW_SUN "{\"type\": \"sun\", \"direction\": [-1, -0.2, 0], \"colour\": [9, 9, 9]}"
#define DARK                                                                                       \
    "{\"type\": \"sun\", \"direction\": [0, -1, 0], \"colour\": [0, 0, 0], \"shadows\": false}"
#define LAMP(x, y, z)                                                                              \
    "{\"type\": \"point\", \"position_m\": [" #x ", " #y ", " #z                                   \
    "], \"colour\": [40, 40, 40], \"shadows\": false}"

static void meet(const char *about, const char *view, const char *more)
{
    char settings[600];
    snprintf(settings, sizeof(settings), "lights_file=%s %s %s", lights_path, view, more);
    expect_meeting(about, settings, NULL);
}

// Free cameras: level; turned, moved and looking up; looking down.
static const char *const views[] = {
    "eye_y_m=7 target_y_m=7 target_z_m=40",
    "eye_x_m=0.7 eye_y_m=5 eye_z_m=-0.8 target_x_m=30 target_y_m=7 target_z_m=21",
    "eye_y_m=9 target_x_m=-30 target_y_m=6 target_z_m=4",
};

static void test_by_day(void **state)
{
    (void)state;
    write_lights(DARK, 1);
    meet("under a sky", views[0], "");
    write_lights(SUN, 0.5);
    meet("by day, turned, two textures a light", views[1], "taps=2");
    meet("by day, down", views[2], "exposure_s=0.03");
    write_lights(SUN, 0);
    meet("the sun alone", views[0], "taps=4");
}

// Most drops are small, but the few large ones vary the most.
static void test_sizes(void **state)
{
    (void)state;
    write_lights(SUN, 0.5);
    meet("drops of a spectrum", views[0], "spectrum=marshall-palmer rain_mm_h=50");
    meet("drops that stand for many", views[0],
         "spectrum=best rain_mm_h=50 least_diameter_mm=1 kept_share=0.2 kept=section");
}

static void test_under_lamps(void **state)
{
    (void)state;
    write_lights(LAMP(6, 15, 16) ", " LAMP(-7, 1, 12) ", " LAMP(-4, 14, -6), 0.02);
    meet("lamps beside the view", views[0], "");
}

// Leaves out a disk about a lamp, seen by a level camera 7 m high. There a few drops beside the
// lamp outshine all others.
static void leave_out(bool left_out[RAIN_TEXELS], double x_m, double y_m, double z_m,
                      double radius_m)
{
    const double px_m = 2 * tan(10 * acos(-1) / 180) / RAIN_HEIGHT;
    for (int y = 0; y < RAIN_HEIGHT; y++)
        for (int x = 0; x < RAIN_WIDTH; x++) {
            const double right = -x_m, down = 7 - y_m;
            const double px = (x + 0.5 - RAIN_WIDTH / 2.0) * px_m * z_m - right,
                         py = (y + 0.5 - RAIN_HEIGHT / 2.0) * px_m * z_m - down;
            if (hypot(px, py) < radius_m)
                left_out[y * RAIN_WIDTH + x] = true;
        }
}

static void test_lamps_in_view(void **state)
{
    (void)state;
    static bool left_out[RAIN_TEXELS];
    write_lights(LAMP(2, 8, 16) ", " LAMP(-2, 6, 12), 0.02);
    leave_out(left_out, 2, 8, 16, 0.8);
    leave_out(left_out, -2, 6, 12, 0.8);
    char settings[600];
    snprintf(settings, sizeof(settings), "lights_file=%s %s", lights_path, views[0]);
    expect_meeting("lamps in view", settings, left_out);
}

// Denser on one side, so that a map turned over would differ.
static void test_map_with_holes(void **state)
{
    (void)state;
    enum { SIDE = 16 };
    float texels[SIDE * SIDE * 4];
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
            for (int c = 0; c < 4; c++)
                texels[4 * (y * SIDE + x) + c] =
                    c == 3 ? 1
                    : (x * 7 + y * 5 + x * y) % 3 == 0
                        ? 0
                        : (y < SIDE / 2 ? 0.08f : 0.25f) * (float)(1 + (x + 2 * y) % 4);
    const struct rg_picture map = {.width = SIDE, .height = SIDE, .channels = 4, .texels = texels};
    const struct rg_write_options options = {0};
    assert_true(rg_picture_write(map_path, &map, &options));
    char more[128];
    snprintf(more, sizeof(more), "density_map=%s", map_path);
    write_lights(SUN, 0.5);
    meet("holes, turned", views[1], more);
}

// The scene is a rectangle between its first and last corner. A mesh is scaled to the city's width,
// centred over the origin and set on the ground. Specks in the city's corners keep the rectangle in
// its place.
static void write_plate(const double corners[4][3])
{
    const double far = (double)CITY_SIDE_M / 2;
    const double specks[6][2] = {{-far, -far}, {-far, 1 - far}, {1 - far, -far},
                                 {far, far},   {far, far - 1},  {far - 1, far}};
    FILE *file = fopen(mesh_path, "w");
    assert_non_null(file);
    fputs("OFF\n10 3 0\n", file);
    for (int i = 0; i < 4; i++)
        fprintf(file, "%g %g %g\n", corners[i][0], corners[i][1], corners[i][2]);
    for (int i = 0; i < 6; i++)
        fprintf(file, "%g 0 %g\n", specks[i][0], specks[i][1]);
    fputs("4 0 1 2 3\n3 4 5 6\n3 7 8 9\n", file);
    assert_int_equal(fclose(file), 0);
}

#define PLATE "geometry=on depth_map_px=1024 shadow_map_px=1024 "

// A roof keeps the nearer half of the layers dry. A slab tests three places; the roof ends between
// two of them.
static void test_roofs(void **state)
{
    (void)state;
    char more[160];
    snprintf(more, sizeof(more), PLATE "scene=%s", mesh_path);
    write_plate((const double[4][3]){{-24, 9, 0}, {24, 9, 0}, {24, 9, 14.6667}, {-24, 9, 14.6667}});
    write_lights(DARK, 1);
    meet("a roof", views[0], more);
}

// A wall beside the view keeps a low sun from the nearer half of the layers.
static void test_shadows(void **state)
{
    (void)state;
    char more[160];
    snprintf(more, sizeof(more), PLATE "scene=%s", mesh_path);
    write_plate((const double[4][3]){{6, 0, 0}, {6, 0, 15}, {6, 20, 15}, {6, 20, 0}});
    write_lights(LOW_SUN, 0);
    meet("shadows", views[0], more);
}

int main(int argc, char **argv)
{
    snprintf(lights_path, sizeof(lights_path), "test_meet_%ld.json", (long)getpid());
    snprintf(map_path, sizeof(map_path), "test_meet_%ld.exr", (long)getpid());
    snprintf(mesh_path, sizeof(mesh_path), "test_meet_%ld.off", (long)getpid());
    struct CMUnitTest tests[] = {
        cmocka_unit_test(test_by_day),         cmocka_unit_test(test_under_lamps),
        cmocka_unit_test(test_sizes),          cmocka_unit_test(test_lamps_in_view),
        cmocka_unit_test(test_map_with_holes), cmocka_unit_test(test_roofs),
        cmocka_unit_test(test_shadows),
    };
    const int status = rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
    remove(lights_path);
    remove(map_path);
    remove(mesh_path);
    return status;
}
