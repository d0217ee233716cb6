// The view from outside: outside DEVICE. Marks are at the particles of the state and have the
// colour of their height. Maps lie over the places that they show. Frusta have their lights'
// colours. All in double precision, with a camera that this test finds itself.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/core/techniques/streaks/rig.h"
#include "tests/tools/expect.h"

// The rig's small rain.
static const double half_m = 30, height_m = 40, radius_m = 12, local_m = 20, eye_m = 3;

// --- a camera that sees a box whole ---

struct view {
    double eye[3], right[3], up[3], ahead[3];
    double focal_px;
    double away; // from the eye to the box's middle
};

struct box {
    double low[3], high[3]; // in the world
};

static const struct box whole = {{-30, 0, -30}, {30, 40, 30}};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Pixels right of the picture's middle and below it; false behind the eye.
static bool project(const struct view *v, const double at[3], double px[2])
{
    double from[3];
    for (int i = 0; i < 3; i++)
        from[i] = at[i] - v->eye[i];
    const double ahead = dot(from, v->ahead);
    px[0] = v->focal_px * dot(from, v->right) / ahead;
    px[1] = -v->focal_px * dot(from, v->up) / ahead;
    return ahead > 0;
}

// The largest distance of the box's corners from the picture's middle, as a share of half the
// picture.
static double filled(const struct view *v, const struct box *box)
{
    double most = 0;
    for (int k = 0; k < 8; k++) {
        double at[3], px[2];
        for (int i = 0; i < 3; i++)
            at[i] = (k >> i & 1 ? box->high : box->low)[i];
        if (!project(v, at, px))
            return INFINITY;
        most =
            fmax(most, fmax(fabs(px[0]) / (RAIN_WIDTH / 2.0), fabs(px[1]) / (RAIN_HEIGHT / 2.0)));
    }
    return most;
}

// From a direction, with an angle of view of 30 degrees; the box fills 94 % of the picture.
static struct view look_at(const struct box *box, double turn_deg, double rise_deg)
{
    const double turn = turn_deg / 180 * M_PI, rise = rise_deg / 180 * M_PI;
    struct view v = {.ahead = {-cos(rise) * cos(turn), -sin(rise), -cos(rise) * sin(turn)},
                     .right = {sin(turn), 0, -cos(turn)},
                     .up = {-sin(rise) * cos(turn), cos(rise), -sin(rise) * sin(turn)},
                     .focal_px = RAIN_HEIGHT / 2.0 / tan(15 / 180.0 * M_PI)};
    double near = 1, far = 10000;
    for (int step = 0; step < 100; step++) {
        v.away = (near + far) / 2;
        for (int i = 0; i < 3; i++)
            v.eye[i] = (box->low[i] + box->high[i]) / 2 - v.ahead[i] * v.away;
        if (filled(&v, box) > 0.94)
            near = v.away;
        else
            far = v.away;
    }
    return v;
}

// --- marks ---

struct mark {
    double x[2], y[2]; // in pixels from the picture's corner
    double fallen;     // 0 at the top, 1 on the ground
};

// The mark of a particle of the state; false if there is none.
static bool mark_of(const struct view *v, const float *place, struct mark *mark)
{
    const int state = (int)place[5];
    const double long_m = fmax(8.16 / 60, 6 * v->away / v->focal_px);
    const double s = (double)place[state == STREAKS_SPLASH ? 3 : 2];
    const double up = state == STREAKS_SPLASH ? long_m / 2 : long_m;
    for (int end = 0; end < 2; end++) {
        const double at[3] = {(double)place[0], height_m - s + end * up, (double)place[1]};
        double px[2];
        assert_true(project(v, at, px));
        mark->x[end] = px[0] + RAIN_WIDTH / 2.0;
        mark->y[end] = px[1] + RAIN_HEIGHT / 2.0;
    }
    mark->fallen = s / height_m;
    return state != STREAKS_NOTHING;
}

static double ramp(double v)
{
    return fmin(fmax(v, 0), 1);
}

// The share of a pixel that a mark covers: a line of 1.5 pixels with smooth sides and square ends.
static double covered(const struct mark *m, double x, double y)
{
    const double dx = m->x[1] - m->x[0], dy = m->y[1] - m->y[0], length = hypot(dx, dy);
    const double along = ((x - m->x[0]) * dx + (y - m->y[0]) * dy) / length;
    const double off = fabs((y - m->y[0]) * dx - (x - m->x[0]) * dy) / length;
    return ramp(1.25 - off) * ramp(1.25 - fmax(-along, along - length));
}

// How many marks touch each pixel, and the last of them.
struct touched {
    int count[RAIN_TEXELS];
    double share[RAIN_TEXELS], fallen[RAIN_TEXELS];
};

static void touch(struct touched *t, const struct mark *m)
{
    const int left = (int)fmin(m->x[0], m->x[1]) - 3, right = (int)fmax(m->x[0], m->x[1]) + 3;
    const int top = (int)fmin(m->y[0], m->y[1]) - 3, bottom = (int)fmax(m->y[0], m->y[1]) + 3;
    for (int y = top > 0 ? top : 0; y < bottom && y < RAIN_HEIGHT; y++)
        for (int x = left > 0 ? left : 0; x < right && x < RAIN_WIDTH; x++) {
            const double share = covered(m, x + 0.5, y + 0.5);
            const int i = y * RAIN_WIDTH + x;
            if (share <= 0)
                continue;
            t->count[i]++;
            t->share[i] = share;
            t->fallen[i] = m->fallen;
        }
}

static void check_marks(const char *settings, const struct box *box, double turn, double rise)
{
    char all[512];
    snprintf(all, sizeof(all), "state=on geometry=off lights=0 drops_m2_s=0.15 %s", settings);
    const struct view v = look_at(box, turn, rise);
    struct streaks *s = rain_open(all);
    rain_step(s, 3);
    struct rain_texels *picture = rain_read(s);
    const struct rain_places places = rain_read_places(s);
    struct touched *t = calloc(1, sizeof(*t));
    int marks = 0, alone = 0, none = 0;
    double highest = 1, lowest = 0;
    assert_non_null(t);
    for (int64_t i = 0; i < places.count; i++) {
        struct mark m;
        if (!mark_of(&v, places.words + i * STREAKS_STATE_WORDS, &m))
            continue;
        touch(t, &m);
        marks++;
    }
    double background[3] = {0};
    for (int i = 0; i < RAIN_TEXELS && !none; i++)
        for (int c = 0; c < 3 && !t->count[i]; c++, none = 1)
            background[c] = rain_texel(picture, i % RAIN_WIDTH, i / RAIN_WIDTH, c);
    for (int i = 0; i < RAIN_TEXELS; i++) {
        const double f = t->fallen[i], colour[3] = {f, 1 - fabs(2 * f - 1), 1 - f};
        if (t->count[i] > 1)
            continue;
        for (int c = 0; c < 3; c++) {
            const double due = background[c] + t->share[i] * (colour[c] - background[c]);
            const double is = rain_texel(picture, i % RAIN_WIDTH, i / RAIN_WIDTH, c);
            if (fabs(is - due) > 0.012)
                fail_msg("pixel %d, %d, colour %d: %.4f, not %.4f (covered %.3f)", i % RAIN_WIDTH,
                         i / RAIN_WIDTH, c, is, due, t->share[i]);
        }
        alone += t->count[i];
        if (t->share[i] < 0.9)
            continue;
        highest = fmin(highest, f);
        lowest = fmax(lowest, f);
    }
    print_message("%s: %d marks, %d pixels of one alone\n", settings, marks, alone);
    assert_above(marks, 100);
    assert_above(alone, 300);
    assert_above(lowest - highest, 0.2);
    free(t);
    free(places.words);
    free(picture);
    rain_close(s);
}

static void test_marks(void **state)
{
    (void)state;
    // The eye is halfway between the local top and ground.
    const struct box volume = {{-radius_m, eye_m - local_m / 2, -radius_m},
                               {radius_m, eye_m + local_m / 2, radius_m}};
    check_marks("outside=space local_height_m=40 eye_y_m=20 target_y_m=20 culling_radius_m=29 "
                "packets=world blocks=all cull=exact",
                &whole, 30, 25);
    check_marks("outside=space local_height_m=40 eye_y_m=20 target_y_m=20 culling_radius_m=29 "
                "packets=world blocks=all outside_turn_deg=200 outside_rise_deg=70",
                &whole, 200, 70);
    check_marks("outside=volume packets=world blocks=all drops_m2_s=1 "
                "outside_turn_deg=-75 outside_rise_deg=5",
                &volume, -75, 5);
}

// --- maps ---

// The round gradient over the top plane: 1 in the middle, and 0 from the sides of the rain space
// on.
static void test_density_map(void **state)
{
    (void)state;
    const struct view v = look_at(&whole, 30, 40);
    struct streaks *s = rain_open("outside=space outside_rise_deg=40 outside_map=density "
                                  "geometry=off lights=0 drops_m2_s=0.01");
    struct rain_texels *picture = rain_read(s);
    int seen = 0;
    for (int i = 0; i < RAIN_TEXELS; i++) {
        const double right = i % RAIN_WIDTH + 0.5 - RAIN_WIDTH / 2.0;
        const double down = i / RAIN_WIDTH + 0.5 - RAIN_HEIGHT / 2.0;
        double ray[3];
        for (int c = 0; c < 3; c++)
            ray[c] = v.ahead[c] * v.focal_px + v.right[c] * right - v.up[c] * down;
        const double way = (height_m - v.eye[1]) / ray[1];
        const double x = v.eye[0] + ray[0] * way, z = v.eye[2] + ray[2] * way;
        const double due = 1 - hypot(x, z) / half_m;
        const double is = rain_texel(picture, i % RAIN_WIDTH, i / RAIN_WIDTH, 1);
        if (fmax(fabs(x), fabs(z)) > half_m - 1)
            continue;
        if (fabs(is - fmax(due, 0)) > 0.012)
            fail_msg("at %.1f, %.1f m: %.3f, not %.3f", x, z, is, fmax(due, 0));
        seen += due > 0.1;
    }
    assert_above(seen, 1000);
    free(picture);
    rain_close(s);
}

// A dynamic depth map covers only the culling prism, and shows the scene's height there.
static void test_depth_map(void **state)
{
    (void)state;
    const struct view v = look_at(&whole, 30, 60);
    struct streaks *s = rain_open("outside=space outside_rise_deg=60 outside_map=depth "
                                  "depth_map=dynamic geometry=off lights=0 drops_m2_s=0.01");
    struct rain_texels *picture = rain_read(s);
    const double middle[3] = {0, height_m, 0}, beside[3] = {20, height_m, 0};
    double px[2], over[2] = {0};
    assert_true(project(&v, middle, px) && project(&v, beside, over));
    float *depths = malloc(256 * 256 * sizeof(*depths));
    assert_true(rg_image_read(s->map->depths, 0, 0, depths));
    assert_float_equal(rain_texel(picture, (int)floor(px[0] + RAIN_WIDTH / 2.0),
                                  (int)floor(px[1] + RAIN_HEIGHT / 2.0), 0),
                       1 - depths[128 * 256 + 128], 0.03);
    const double sky = rain_texel(picture, 0, 0, 0);
    assert_float_equal(rain_texel(picture, (int)floor(over[0] + RAIN_WIDTH / 2.0),
                                  (int)floor(over[1] + RAIN_HEIGHT / 2.0), 0),
                       sky, 1e-6);
    free(depths);
    free(picture);
    rain_close(s);
}

// --- frusta ---

static void write_light(char path[64])
{
    snprintf(path, 64, "outside-%d.json", (int)getpid());
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "{\"lights\": [{\"type\": \"spot\", \"position_m\": [0, 12, 20], \"direction\": "
                  "[0, -1, 0], \"colour\": [0.1, 0.9, 0.2], \"outer_deg\": 30}]}");
    fclose(file);
}

// A frustum of green light is green. Only lines are drawn over the picture, so that most of it
// stays as it was.
static void test_frusta_and_lines(void **state)
{
    (void)state;
    char path[64], settings[256];
    write_light(path);
    struct rain_texels *pictures[3];
    static const char *const overlays[] = {"off", "lights", "on"};
    for (int k = 0; k < 3; k++) {
        snprintf(settings, sizeof(settings),
                 "geometry=off drops_m2_s=0.01 packets=world lights_file=%s overlay=%s", path,
                 overlays[k]);
        pictures[k] = rain_draw_at(settings, 1);
    }
    int green = 0, changed = 0;
    for (int i = 0; i < RAIN_TEXELS; i++) {
        double off[3], lit[3], on[3];
        for (int c = 0; c < 3; c++) {
            off[c] = rain_texel(pictures[0], i % RAIN_WIDTH, i / RAIN_WIDTH, c);
            lit[c] = rain_texel(pictures[1], i % RAIN_WIDTH, i / RAIN_WIDTH, c);
            on[c] = rain_texel(pictures[2], i % RAIN_WIDTH, i / RAIN_WIDTH, c);
        }
        const bool is_line = lit[1] > off[1] + 0.05;
        green += is_line && lit[0] < off[0] && lit[2] < off[2];
        if (is_line)
            assert_below(lit[0], off[0]);
        const bool inset = i % RAIN_WIDTH > RAIN_WIDTH * 3 / 4 && i / RAIN_WIDTH < RAIN_HEIGHT / 3;
        changed += !inset && memcmp(off, on, sizeof(on)) != 0;
    }
    print_message("%d pixels of a green frustum, %d of all lines\n", green, changed);
    assert_above(green, 50);
    assert_above(changed, green);
    assert_below(changed, RAIN_TEXELS / 4);
    for (int k = 0; k < 3; k++)
        free(pictures[k]);
    remove(path);
}

int main(int argc, char **argv)
{
    struct CMUnitTest tests[] = {
        cmocka_unit_test(test_marks),
        cmocka_unit_test(test_density_map),
        cmocka_unit_test(test_depth_map),
        cmocka_unit_test(test_frusta_and_lines),
    };
    return rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
