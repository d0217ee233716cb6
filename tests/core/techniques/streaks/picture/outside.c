// The view from outside: outside DEVICE. Marks are at the particles of the state, or in a frustum
// on their rays, and have the colour of their height. Maps lie over the places that they show.
// Frusta have their lights' colours. All in double precision, with a camera that this test finds
// itself.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/core/techniques/streaks/rig.h"
#include "tests/tools/expect.h"

// The rig's small rain.
static const double half_m = 30, height_m = 40, radius_m = 12, local_m = 20, eye_m = 3;

// --- a camera that sees a box or a frustum whole ---

struct view {
    double eye[3], right[3], up[3], ahead[3];
    double focal_px;
    double away; // from the eye to the box's middle
};

struct box {
    double low[3], high[3]; // in the world
    double narrow;          // its top over its ground, across; 1: a box
};

static const struct box whole = {{-30, 0, -30}, {30, 40, 30}, 1};

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
            at[i] = (k >> i & 1 ? box->high : box->low)[i] * (k & 2 && i != 1 ? box->narrow : 1);
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

static double mark_length(const struct view *v, bool splash)
{
    return fmax(8.16 / 60, 6 * v->away / v->focal_px) * (splash ? 0.5 : 1);
}

// The mark between two places in the world, the first of them the lower end.
static struct mark mark_between(const struct view *v, const double ends[2][3])
{
    struct mark mark = {.fallen = 1 - ends[0][1] / height_m};
    for (int end = 0; end < 2; end++) {
        double px[2];
        assert_true(project(v, ends[end], px));
        mark.x[end] = px[0] + RAIN_WIDTH / 2.0;
        mark.y[end] = px[1] + RAIN_HEIGHT / 2.0;
    }
    return mark;
}

// The mark of a particle of the state; false if there is none.
static bool mark_of(const struct view *v, const float *place, struct mark *mark)
{
    const int state = (int)place[5];
    const double s = (double)place[state == STREAKS_SPLASH ? 3 : 2];
    const double x = (double)place[0], z = (double)place[1], y = height_m - s;
    const double ends[2][3] = {{x, y, z}, {x, y + mark_length(v, state == STREAKS_SPLASH), z}};
    *mark = mark_between(v, ends);
    return state != STREAKS_NOTHING && y >= 0;
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

// Compares each pixel that no mark touches, or one. Returns how many one touches.
static int compare(const char *settings, const struct touched *t, const struct rain_texels *picture)
{
    int alone = 0, none = 0;
    double background[3] = {0}, highest = 1, lowest = 0;
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
    print_message("%s: %d pixels of one mark alone\n", settings, alone);
    assert_above(lowest - highest, 0.2);
    return alone;
}

static struct streaks *open_outside(const char *settings)
{
    char all[512];
    snprintf(all, sizeof(all), "geometry=off lights=0 drops_m2_s=0.15 %s", settings);
    struct streaks *s = rain_open(all);
    rain_step(s, 3);
    return s;
}

static void check_marks(const char *settings, const struct box *box, double turn, double rise)
{
    const struct view v = look_at(box, turn, rise);
    struct streaks *s = open_outside(settings);
    struct rain_texels *picture = rain_read(s);
    const struct rain_places places = rain_read_places(s);
    struct touched *t = calloc(1, sizeof(*t));
    int marks = 0;
    assert_non_null(t);
    for (int64_t i = 0; i < places.count; i++) {
        struct mark m;
        if (!mark_of(&v, places.words + i * STREAKS_STATE_WORDS, &m))
            continue;
        touch(t, &m);
        marks++;
    }
    assert_above(marks, 100);
    assert_above(compare(settings, t, picture), 300);
    free(t);
    free(places.words);
    free(picture);
    rain_close(s);
}

static void test_marks(void **state)
{
    (void)state;
    // The eye is halfway between the local top and ground.
    const struct box volume = {
        {-radius_m, eye_m - local_m / 2, -radius_m}, {radius_m, eye_m + local_m / 2, radius_m}, 1};
    check_marks(
        "state=on outside=space local_height_m=40 eye_y_m=20 target_y_m=20 culling_radius_m=22 "
        "packets=world blocks=all cull=exact",
        &whole, 30, 25);
    check_marks(
        "state=on outside=space local_height_m=40 eye_y_m=20 target_y_m=20 culling_radius_m=29 "
        "packets=world blocks=all outside_turn_deg=200 outside_rise_deg=70",
        &whole, 200, 70);
    check_marks("state=on outside=volume packets=world blocks=all drops_m2_s=1 "
                "outside_turn_deg=-75 outside_rise_deg=5",
                &volume, -75, 5);
}

// --- a frustum ---

// The rain space of a perspective camera, which is 50 m above the middle of the ground.
static const double camera_m = 50;
static const struct box frustum = {{-30, 0, -30}, {30, 40, 30}, 10.0 / 50};

// A roof: the x of its middle, half a side, and its height.
static const double roof_x_m = 9, roof_half_m = 6, roof_y_m = 15;

// Its other faces lie beyond the rain, so that its unit is the metre.
static void write_roof(char path[64])
{
    static const double size[] = {-200, 0, -200, 200, 0, 200, 200, 0, 199};
    snprintf(path, 64, "outside-%d.off", (int)getpid());
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "OFF\n7 3 0\n");
    for (int i = 0; i < 9; i += 3)
        fprintf(file, "%g %g %g\n", size[i], size[i + 1], size[i + 2]);
    for (int k = 0; k < 4; k++)
        fprintf(file, "%g %g %g\n", roof_x_m + (k == 1 || k == 2 ? roof_half_m : -roof_half_m),
                roof_y_m, k < 2 ? roof_half_m : -roof_half_m);
    fprintf(file, "3 0 1 2\n3 3 4 5\n3 3 5 6\n");
    fclose(file);
}

// A particle by where its ray meets the ground, and the share of its way that it has come.
struct falling {
    double x, z, share;
    double cosine; // of the ray's angle with straight down
};

// The place on a particle's ray so far from the top.
static void on_ray(const struct falling *f, double way_m, double at[3])
{
    const double down = way_m * f->cosine, wide = (camera_m - height_m + down) / camera_m;
    at[0] = f->x * wide;
    at[1] = height_m - down;
    at[2] = f->z * wide;
}

// How far inside the roof a particle's ray meets its plane, in metres; negative outside.
static double in_roof(const struct falling *f)
{
    double at[3];
    on_ray(f, (height_m - roof_y_m) / f->cosine, at);
    return roof_half_m - fmax(fabs(at[0] - roof_x_m), fabs(at[2]));
}

// The mark of a particle, if its ray meets the roof or not; false if there is none. The particle
// comes as far as the rain space is high. If it meets something on its way, it is a splash there
// for a time.
static bool mark_on_ray(const struct view *v, const struct falling *f, bool roofed,
                        struct mark *mark)
{
    const double behind_m = 8.16 / 60 + 0.0016, splash_m = 8.16 * 0.126;
    const double hit = (roofed ? height_m - roof_y_m : height_m) / f->cosine;
    const double way = f->share * height_m, past = way - behind_m - hit;
    const bool splash = hit < height_m && (past < 0 ? past + height_m : past) < splash_m;
    double ends[2][3];
    on_ray(f, splash ? hit : way, ends[0]);
    on_ray(f, (splash ? hit : way) - mark_length(v, splash), ends[1]);
    *mark = mark_between(v, ends);
    return splash || past < 0;
}

// The particles of the selection that is in the frame.
static struct falling *read_falling(const struct streaks *s, int *count)
{
    const int64_t bytes = (int64_t)s->rain->particles[0]->size;
    float *particles = malloc((size_t)bytes);
    struct falling *all = calloc((size_t)s->selection.block_count * 32, sizeof(*all));
    assert_true(particles && all && s->rain->buffer_count == 1);
    assert_true(rg_buf_read(s->rain->particles[0], 0, particles, bytes));
    *count = 0;
    for (int64_t i = 0; i < s->selection.block_count * 32; i++) {
        const uint32_t *block = s->selection.blocks + i / 32 * STREAKS_BLOCK_WORDS;
        const float *p = particles + 3 * (block[0] + i % 32);
        float shift[3]; // x, y, turn
        memcpy(shift, block + 2, sizeof(shift));
        const double turned = (double)p[2] + (double)shift[2];
        const double x = half_m * ((double)p[0] + (double)shift[0]),
                     z = half_m * ((double)p[1] + (double)shift[1]);
        if (block[1] >> i % 32 & 1)
            all[(*count)++] = (struct falling){x, z, turned - floor(turned),
                                               camera_m / hypot(camera_m, hypot(x, z))};
    }
    free(particles);
    return all;
}

// Touches the pixels of a particle's mark. At the roof's rim the map's texels decide whether the
// roof is met: then two marks make their pixels uncertain. True if it is near the end of its way.
static bool touch_falling(struct touched *t, const struct view *v, const struct falling *f)
{
    const double inside = in_roof(f);
    const bool unsure = fabs(inside) < 0.25;
    struct mark m;
    for (int roofed = 0; roofed < 2; roofed++)
        for (int k = 0; (unsure ? k < 2 : k < 1 && roofed == (inside > 0)); k++)
            if (mark_on_ray(v, f, roofed, &m))
                touch(t, &m);
    return inside < -1 && f->share > 0.9;
}

// What a frustum's frames show.
struct shown {
    int alone;         // pixels that one mark touches
    int middle, aside; // drops near the end of their way
};

static void check_frame(const char *settings, struct streaks *s, const struct view *v,
                        struct shown *shown)
{
    struct rain_texels *picture = rain_read(s);
    struct touched *t = calloc(1, sizeof(*t));
    int count = 0;
    struct falling *falling = read_falling(s, &count);
    assert_non_null(t);
    for (int i = 0; i < count; i++) {
        const bool ends = touch_falling(t, v, &falling[i]);
        shown->middle += ends && falling[i].cosine > 0.98;
        shown->aside += ends && falling[i].cosine < 0.92;
    }
    shown->alone += compare(settings, t, picture);
    free(falling);
    free(t);
    free(picture);
}

static void check_frustum(const char *settings, double turn, double rise)
{
    char box[350], all[400], path[64];
    struct shown shown = {0};
    write_roof(path);
    snprintf(box, sizeof(box),
             "scene=%s limits=off local_height_m=40 eye_y_m=20 target_y_m=20 blocks=all "
             "outside_turn_deg=%g outside_rise_deg=%g %s",
             path, turn, rise, settings);
    snprintf(all, sizeof(all), "outside=frustum %s", box);
    const struct view v = look_at(&frustum, turn, rise);
    struct streaks *beside = open_outside(box); // has a map of its own
    struct streaks *s = open_outside(all);
    for (int frame = 0; frame < 4; frame++) {
        check_frame(settings, s, &v, &shown);
        rain_step(s, 50);
    }
    print_message("at their end %d in the middle, %d aside\n", shown.middle, shown.aside);
    assert_above(shown.alone, 500);
    assert_above(shown.middle, 5);
    assert_above(shown.aside, 5);
    rain_close(s);
    rain_close(beside);
    remove(path);
}

// The overlay's lines are along the frustum's edges.
static void test_frustum_edges(void **state)
{
    (void)state;
    static const char *const settings[] = {
        "geometry=off lights=0 limits=off outside=frustum drops=off splashes=off",
        "geometry=off lights=0 limits=off outside=frustum drops=off splashes=off overlay=on"};
    const struct view v = look_at(&frustum, 30, 25);
    struct rain_texels *pictures[2];
    for (int k = 0; k < 2; k++)
        pictures[k] = rain_draw_at(settings[k], 1);
    for (int i = 0; i < 28; i++) {
        const double up = height_m * (1 + i / 4) / 8.0, wide = half_m * (1 - up / camera_m);
        const double at[3] = {i & 1 ? wide : -wide, up, i & 2 ? wide : -wide};
        double px[2], differs = 0;
        assert_true(project(&v, at, px));
        const int x = (int)floor(px[0] + RAIN_WIDTH / 2.0),
                  y = (int)floor(px[1] + RAIN_HEIGHT / 2.0);
        for (int c = 0; c < 3; c++)
            differs += fabs(rain_texel(pictures[0], x, y, c) - rain_texel(pictures[1], x, y, c));
        if (differs < 0.01)
            fail_msg("%.1f m up, pixel %d, %d: no line", up, x, y);
    }
    free(pictures[0]);
    free(pictures[1]);
}

// A drop of the middle reaches the ground; one aside ends above it, by the cosine of its angle.
static void test_frustum(void **state)
{
    (void)state;
    const struct falling middle = {0, 0, 1, 1}, aside = {30, 0, 1, camera_m / hypot(camera_m, 30)};
    double at[3];
    on_ray(&middle, height_m, at);
    assert_float_equal(at[1], 0, 1e-9);
    on_ray(&aside, height_m, at);
    assert_float_equal(at[1], 5.701, 1e-3);
    check_frustum("packets=world drops_m2_s=0.1", 30, 25);
    check_frustum("packets=grid packet_size=70 drops_m2_s=0.08", -110, 35);
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
        cmocka_unit_test(test_marks),         cmocka_unit_test(test_frustum),
        cmocka_unit_test(test_frustum_edges), cmocka_unit_test(test_density_map),
        cmocka_unit_test(test_depth_map),     cmocka_unit_test(test_frusta_and_lines),
    };
    return rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
