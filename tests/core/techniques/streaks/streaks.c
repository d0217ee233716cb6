// streaks as a whole, and its laws: streaks DEVICE.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "kernels/dialect/image/format.h"
#include "tests/core/techniques/streaks/rig.h"
#include "tests/tools/expect.h"

// --- pictures ---

static bool same(const struct rain_texels *a, const struct rain_texels *b)
{
    return !memcmp(a->halves, b->halves, sizeof(a->halves));
}

// How many texels differ.
static int differing(const struct rain_texels *a, const struct rain_texels *b)
{
    int count = 0;
    for (int i = 0; i < RAIN_TEXELS; i++)
        count += memcmp(a->halves + 4 * i, b->halves + 4 * i, 8) != 0;
    return count;
}

// The sum of a colour over the picture.
static double light_of(const struct rain_texels *picture, int colour)
{
    double sum = 0;
    for (int y = 0; y < RAIN_HEIGHT; y++)
        for (int x = 0; x < RAIN_WIDTH; x++)
            sum += rain_texel(picture, x, y, colour);
    return sum;
}

// --- packets ---

static void test_packets_do_not_show(void **state)
{
    (void)state;
    static const char *const ways[] = {
        "packets=kd packet_size=300", "packets=kd packet_size=7000", "packets=quad packet_size=300",
        "packets=quad packet_size=7000", "packets=quad packet_size=300 select=hull"};
    struct rain_texels *world = rain_draw_at("cull=exact order=id packets=world", 3);
    struct rain_texels *dry = rain_draw_at("drops=off splashes=off", 3);
    assert_above(differing(world, dry), 100);
    for (size_t i = 0; i < sizeof(ways) / sizeof(ways[0]); i++) {
        char settings[256];
        snprintf(settings, sizeof(settings), "cull=exact order=id %s", ways[i]);
        struct rain_texels *packets = rain_draw_at(settings, 3);
        assert_true(same(packets, world));
        free(packets);
    }
    free(world);
    free(dry);
}

// Instances with the same particles and packets share them, whatever their other settings.
static void test_rain_is_shared_by_what_it_holds(void **state)
{
    (void)state;
    static const char *const alike[] = {"", "culling_radius_m=7 sparse=4", "geometry=off lights=0"};
    static const char *const others[] = {"seed=2",           "packet_size=300", "packets=quad",
                                         "local_height_m=9", "order=id",        "drops_m2_s=90",
                                         "fall_speed_m_s=5", "rain_width_m=91", "memory_mb=100"};
    struct streaks *first = rain_open(alike[0]);
    for (size_t i = 1; i < sizeof(alike) / sizeof(alike[0]); i++) {
        struct streaks *s = rain_open(alike[i]);
        assert_ptr_equal(s->rain, first->rain);
        rain_close(s);
    }
    for (size_t i = 0; i < sizeof(others) / sizeof(others[0]); i++) {
        struct streaks *s = rain_open(others[i]);
        assert_ptr_not_equal(s->rain, first->rain);
        rain_close(s);
    }
    rain_close(first);
}

// A sparse rain draws one particle in so many, and reports them all.
static void test_sparse_rain_is_less_of_it(void **state)
{
    (void)state;
    struct streaks *whole = rain_open("blocks=all"), *sparse = rain_open("blocks=all sparse=4");
    for (int i = 0; i < 2; i++)
        free(rain_read(i ? sparse : whole));
    const struct rg_counter *of_whole = whole->base.counters, *of_sparse = sparse->base.counters;
    assert_above(of_whole[STREAKS_PARTICLES].value, 1000);
    assert_int_equal(of_sparse[STREAKS_PARTICLES].value, of_whole[STREAKS_PARTICLES].value);
    const double share =
        (double)of_whole[STREAKS_ITEMS].value / (double)of_sparse[STREAKS_ITEMS].value;
    assert_above(share, 3.6);
    assert_below(share, 4.4);
    rain_close(whole);
    rain_close(sparse);
}

// The same rain with other particles: as much of it, in other places.
static void test_grid_is_like_the_trees(void **state)
{
    (void)state;
    const char *const common = "cull=exact geometry=off splashes=off streak_opacity=0 lights=0 ";
    char settings[256];
    snprintf(settings, sizeof(settings), "%s drops=off", common);
    struct rain_texels *dry = rain_draw_at(settings, 2);
    double rain[2];
    for (int i = 0; i < 2; i++) {
        double of_seeds[4], sum = 0;
        for (int seed = 0; seed < 4; seed++) {
            snprintf(settings, sizeof(settings), "%s packets=%s packet_size=1000 seed=%d", common,
                     i ? "grid" : "kd", seed + 1);
            struct rain_texels *picture = rain_draw_at(settings, 2);
            of_seeds[seed] = light_of(picture, 1) - light_of(dry, 1);
            sum += of_seeds[seed];
            free(picture);
        }
        rain[i] = sum / 4;
        double squares = 0;
        for (int seed = 0; seed < 4; seed++)
            squares += pow(of_seeds[seed] - rain[i], 2);
        assert_above(rain[i], 0);
        assert_below(sqrt(squares / 3), 0.2 * rain[i]);
    }
    free(dry);
    assert_below(fabs(rain[0] - rain[1]), 0.25 * rain[0]);
}

// --- particles ---

// Drops stay in place in the world when the camera and its local space move (height correction).
// Compares two cameras at the same time.
static void test_drops_stay_put(void **state)
{
    (void)state;
    const char *const common = "state=on packets=world order=id local_height_m=15 eye_y_m=%g";
    struct rain_places places[2];
    for (int i = 0; i < 2; i++) {
        char settings[256];
        snprintf(settings, sizeof(settings), common, i ? 14.25 : 12.0);
        struct streaks *s = rain_open(settings);
        rain_step(s, 7);
        places[i] = rain_read_places(s);
        rain_close(s);
    }
    int64_t seen = 0, wrapped = 0;
    assert_int_equal(places[0].count, places[1].count);
    for (int64_t i = 0; i < places[0].count; i++) {
        const float *a = places[0].words + i * STREAKS_STATE_WORDS;
        const float *b = places[1].words + i * STREAKS_STATE_WORDS;
        if ((int)a[5] != STREAKS_DROP || (int)b[5] != STREAKS_DROP)
            continue;
        const double moved = fabs((double)a[2] - (double)b[2]);
        assert_true(moved < 1e-3 || fabs(moved - 15) < 1e-3);
        assert_equals(a[0], b[0]);
        assert_equals(a[1], b[1]);
        seen++;
        wrapped += moved > 1;
    }
    // The camera rose by 2.25 m of 15 m, and so that share of drops entered again at the top.
    assert_above(seen, 1000);
    assert_below(fabs((double)wrapped / (double)seen - 2.25 / 15), 0.1);
    free(places[0].words);
    free(places[1].words);
}

// A particle's history since the first frame.
struct life {
    int state;
    int splash_frames; // of the present splash; -1: it began before the first frame
    int splashes;
    float hit;
};

// A splash begins as a drop, stays at one height, and lasts as long as all others.
static void follow(struct life *life, const float *place, int frame, int lasts)
{
    const int now = (int)place[5];
    if (now == STREAKS_SPLASH && life->state == STREAKS_SPLASH && life->hit == place[3]) {
        life->splash_frames += life->splash_frames >= 0;
    } else if (now == STREAKS_SPLASH) {
        assert_true(!frame || life->state == STREAKS_DROP);
        life->splash_frames = frame ? 1 : -1;
        life->splashes++;
    } else if (life->state == STREAKS_SPLASH && life->splash_frames >= 0) {
        assert_between(life->splash_frames, lasts - 1, lasts + 1);
    }
    life->state = now;
    life->hit = place[3];
}

static void test_one_splash_a_hit(void **state)
{
    (void)state;
    // 15 m at 10 m/s are a life of 90 frames; splashes last for 12.
    const int frames = 200, lasts = 12;
    struct streaks *s = rain_open("state=on packets=world local_height_m=15 fall_speed_m_s=10 "
                                  "splash_s=0.2 drops_m2_s=20");
    struct life *lives = NULL;
    int64_t count = 0, splashes = 0, falling = 0;
    for (int frame = 0; frame < frames; frame++) {
        rain_step(s, 1);
        const struct rain_places places = rain_read_places(s);
        count = places.count;
        if (!lives)
            lives = calloc((size_t)count, sizeof(*lives));
        assert_non_null(lives);
        for (int64_t i = 0; i < count; i++)
            follow(&lives[i], places.words + i * STREAKS_STATE_WORDS, frame, lasts);
        free(places.words);
    }
    for (int64_t i = 0; i < count; i++) {
        splashes += lives[i].splashes;
        falling += lives[i].splashes > 0;
        assert_between(lives[i].splashes, 0, 4); // frames / 90, and the first and last
    }
    assert_above(falling, 500);
    assert_at_least(splashes, 2 * falling);
    free(lives);
    rain_close(s);
}

// --- light ---

// Without geometry everything has the horizon's colour, rounded down to halves.
static void test_the_sky_is_even(void **state)
{
    (void)state;
    for (int night = 0; night < 2; night++) {
        const struct scenery_look look = night ? scenery_night() : scenery_day();
        const float due[4] = {look.sky.horizon_r, look.sky.horizon_g, look.sky.horizon_b, 1};
        char settings[128];
        snprintf(settings, sizeof(settings), "geometry=off drops=off splashes=off time=%s",
                 night ? "night" : "day");
        struct rain_texels *picture = rain_draw_at(settings, 1);
        for (int i = 0; i < 4 * RAIN_TEXELS; i++) {
            const float value = rg_unpack_half(picture->halves[i]);
            assert_at_most(value, due[i % 4]);
            assert_at_least(value, due[i % 4] * (1 - 0x1p-10f));
        }
        free(picture);
    }
}

static void write_lights(const char *path, bool first, bool second)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "{\"lights\": [");
    if (first)
        fprintf(file, "{\"type\": \"point\", \"position_m\": [3, 6, 8], \"colour\": [1, 0.5, 0.2], "
                      "\"intensity\": 40, \"shadows\": false}");
    if (second)
        fprintf(file,
                "%s{\"type\": \"sun\", \"direction\": [0.5, -1, 0.3], "
                "\"colour\": [0.2, 0.6, 1], \"intensity\": 3, \"shadows\": true}",
                first ? ", " : "");
    fprintf(file, "]}\n");
    assert_int_equal(fclose(file), 0);
}

static void test_lights_add_up(void **state)
{
    (void)state;
    // One file for each process, since tests of several devices run side by side.
    char path[64], settings[256];
    snprintf(path, sizeof(path), "test_streaks_%ld.json", (long)getpid());
    snprintf(settings, sizeof(settings),
             "geometry=off environment_light=off streak_opacity=0 splash_opacity=0 lights_file=%s",
             path);
    struct rain_texels *dry = rain_draw_at("geometry=off drops=off splashes=off lights=0", 2);
    double added[4][3];
    for (int i = 1; i < 4; i++) {
        write_lights(path, i & 1, i & 2);
        struct rain_texels *picture = rain_draw_at(settings, 2);
        for (int c = 0; c < 3; c++)
            added[i][c] = light_of(picture, c) - light_of(dry, c);
        free(picture);
    }
    for (int c = 0; c < 3; c++) {
        const double sum = added[1][c] + added[2][c];
        assert_above(added[1][c], 0);
        assert_above(added[2][c], 0);
        // Halves round each light's part down.
        assert_below(fabs(added[3][c] - sum), 0.03 * sum);
    }
    free(dry);
    remove(path);
}

// Looks stand for settings, and the first look for the defaults.
static void test_looks(void **state)
{
    (void)state;
    const struct rg_param_table *table = &streaks_param_table;
    struct streaks_settings initial, set;
    memset(&initial, 0, sizeof(initial));
    memset(&set, 0, sizeof(set));
    rg_params_reset(table, &initial);
    rg_params_reset(table, &set);
    assert_true(rg_params_set_all(table, &set, "look=thesis streak_opacity=2"));
    assert_true(set.points);
    assert_above(set.streak_gain, 1);
    assert_equals(set.streak_opacity, 2);
    assert_true(rg_params_set_all(table, &set, "look=photograph"));
    assert_memory_equal(&set, &initial, sizeof(set));
}

int main(int argc, char **argv)
{
    struct CMUnitTest tests[] = {
        cmocka_unit_test(test_packets_do_not_show),
        cmocka_unit_test(test_rain_is_shared_by_what_it_holds),
        cmocka_unit_test(test_sparse_rain_is_less_of_it),
        cmocka_unit_test(test_grid_is_like_the_trees),
        cmocka_unit_test(test_drops_stay_put),
        cmocka_unit_test(test_one_splash_a_hit),
        cmocka_unit_test(test_the_sky_is_even),
        cmocka_unit_test(test_lights_add_up),
        cmocka_unit_test(test_looks),
    };
    return rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
