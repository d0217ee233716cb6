// flow's pictures with a known outcome: the camera, the intermediate steps, glow, shadows of drops,
// the model, turning boxes. view DEVICE runs on it.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/techniques/flow/instance.h"
#include "tests/core/techniques/flow/rig.h"
#include "tests/oracle/flow/picture.h"
#include "tests/tools/expect.h"

static const char *device = "cpu:reference";

enum { SIZE = 32, UNIT = 65536 };

static const char *const still = "resolution_px=32 drops=0 rain_drops_s=0 pane_rain_mm_h=0 ";

static void open_still(struct rig *rig, const char *assignments, int width, int height)
{
    char text[512];
    snprintf(text, sizeof(text), "%s%s", still, assignments);
    rig_open_sized(rig, device, text, width, height);
}

static uint32_t noise(uint32_t i)
{
    i = (i ^ i >> 16) * 0x7feb352du;
    i = (i ^ i >> 15) * 0x846ca68bu;
    return i ^ i >> 16;
}

static int64_t *water_of(const struct rig *rig, int64_t most)
{
    const int texels = rig->panes * rig->size * rig->size;
    int64_t *water = malloc((size_t)texels * sizeof(*water));
    for (int i = 0; i < texels; i++)
        water[i] = (int64_t)(noise((uint32_t)i) % (uint64_t)most);
    return water;
}

static float *draw_of(const char *assignments, int width, int height)
{
    struct rig rig;
    open_still(&rig, assignments, width, height);
    float *light = rig_draw(&rig);
    rig_close(&rig);
    return light;
}

// --- the camera ---

static void times(const float rows[16], const double v[4], double product[4])
{
    for (int i = 0; i < 4; i++) {
        product[i] = 0;
        for (int k = 0; k < 4; k++)
            product[i] += (double)rows[4 * i + k] * v[k];
    }
}

// A point on the ray through a pixel's centre is seen at that centre, at its distance ahead. Both
// matrices are floats, exact to 2^-24 of the eye's distance and of a few thousand pixels.
static void check_rays(const struct flow_settings *s, int width, int height)
{
    flow_view_params p;
    assert_true(flow_view_params_at(s, 0, width, height, &p));
    float rays[16], to_clip[16];
    memcpy(rays, &p.rays, sizeof(rays));
    memcpy(to_clip, &p.to_clip, sizeof(to_clip));
    for (int i = 0; i < 300; i++) {
        const int x = (int)(noise((uint32_t)i) % (uint32_t)width);
        const int y = (int)(noise(~(uint32_t)i) % (uint32_t)height);
        const double way = 0.3 + 0.05 * i;
        const double pixel[4] = {x * way, y * way, way, 1};
        double point[4], clip[4];
        times(rays, pixel, point);
        point[3] = 1;
        times(to_clip, point, clip);
        const double px = (clip[0] / clip[3] + 1) / 2 * width;
        const double py = (clip[1] / clip[3] + 1) / 2 * height;
        if (fabs(px - x - 0.5) > 0.004 || fabs(py - y - 0.5) > 0.004 ||
            fabs(clip[3] / way - 1) > 1e-5)
            fail_msg("pixel (%d, %d) of %dx%d, %g ahead: seen at (%.5f, %.5f), %g ahead", x, y,
                     width, height, way, px, py, clip[3]);
    }
}

static void test_rays_meet_their_pixels(void **state)
{
    (void)state;
    struct flow_settings s;
    rg_params_reset(&flow_param_table, &s);
    static const int sizes[][2] = {{640, 640}, {1920, 1080}, {90, 333}, {7, 2}};
    for (int i = 0; i < 40; i++) {
        s.camera_azimuth_deg = 47 * i - 360;
        s.camera_elevation_deg = 11 * i % 179 - 89;
        s.distance_mm = 80 + 31 * i;
        s.view_angle_deg = 5 + 3 * i;
        check_rays(&s, sizes[i % 4][0], sizes[i % 4][1]);
    }
}

// The one pane fills the view, for any turn and any shape of the target.
static void test_one_pane_fills_the_view(void **state)
{
    (void)state;
    static const int sizes[][2] = {{50, 50}, {64, 20}, {13, 70}};
    static const char *const turns[] = {"", "pane_pitch_deg=70 pane_roll_deg=33",
                                        "pane_yaw_deg=-120 pane_pitch_deg=-95"};
    for (int i = 0; i < 3; i++) {
        char text[160];
        snprintf(text, sizeof(text), "stage=height %s", turns[i]);
        struct rig rig;
        open_still(&rig, text, sizes[i][0], sizes[i][1]);
        int64_t *water = malloc(SIZE * SIZE * sizeof(*water));
        for (int k = 0; k < SIZE * SIZE; k++)
            water[k] = UNIT;
        rig_put(&rig, water);
        float *light = rig_draw(&rig);
        for (int k = 0; k < sizes[i][0] * sizes[i][1] * 4; k++)
            assert_equals(light[k], 1.0f);
        free(water);
        free(light);
        rig_close(&rig);
    }
}

// --- the steps of figure 17 ---

// Halves are rounded down, by one part in 2^10.
static void expect_light(const char *what, int x, int y, float light, double due)
{
    if (fabs((double)light - due) > due / 1024 + 1e-6)
        fail_msg("%s, pixel (%d, %d): %.7f, not %.7f", what, x, y, (double)light, due);
}

// A target with a pixel for each texel shows the maps as they are.
static void test_stages_show_the_maps(void **state)
{
    (void)state;
    static const char *const stages[] = {"stage=height", "stage=blurred", "stage=normals",
                                         "stage=blurred blur=off", "stage=normals blur=off"};
    for (int k = 0; k < 5; k++) {
        const int stage = k < 3 ? k : k - 2;
        struct rig rig;
        open_still(&rig, stages[k], SIZE, SIZE);
        const struct flow_settings *s = &rig.settings;
        int64_t *water = water_of(&rig, 3 * UNIT / 2);
        const struct light_surface surface = {water,     SIZE,          s->pane_mm,
                                              s->relief, s->wet_height, k >= 3};
        rig_put(&rig, water);
        float *light = rig_draw(&rig);
        for (int i = 0; i < SIZE * SIZE; i++) {
            const int x = i % SIZE, y = i / SIZE;
            double normal[3];
            light_normal(&surface, (x + 0.5) / SIZE, (y + 0.5) / SIZE, normal);
            const double z = sqrt(fmax(1 - normal[0] * normal[0] - normal[1] * normal[1], 0));
            const double height = fmin((double)water[i] / UNIT, 1),
                         blurred = fmin(light_blurred(&surface, x, y), 1);
            const double due[3][3] = {
                {height, height, height},
                {blurred, blurred, blurred},
                {0.5 + normal[0] / 2, 0.5 + normal[1] / 2, 0.5 + z / 2},
            };
            for (int c = 0; c < 3; c++)
                expect_light(stages[k], x, y, light[4 * i + c], due[stage][c]);
        }
        free(water);
        free(light);
        rig_close(&rig);
    }
}

// For a box the steps show the panes that face the viewer, on black.
static void test_stages_show_the_near_panes(void **state)
{
    (void)state;
    for (int pane = 0; pane < BOX_PANES; pane++) {
        struct rig rig;
        open_still(&rig, "view=box stage=height camera_azimuth_deg=0 camera_elevation_deg=0", 40,
                   40);
        int64_t *water = calloc((size_t)(rig.panes * SIZE * SIZE), sizeof(*water));
        for (int i = 0; i < SIZE * SIZE; i++)
            water[pane * SIZE * SIZE + i] = UNIT;
        rig_put(&rig, water);
        float *light = rig_draw(&rig);
        assert_equals(light[0], 0.0f);
        assert_equals(light[3], 1.0f);
        for (int y = 15; y < 25; y++)
            assert_equals(light[4 * (40 * y + 20)], (pane == BOX_FRONT ? 1.0f : 0.0f));
        free(water);
        free(light);
        rig_close(&rig);
    }
}

// --- glow ---

enum { GLOW_HEIGHT = 64 };

struct light_sum {
    double sum, centre_x, peak, outside; // outside: from 20 pixels beside the middle on
};

static struct light_sum sum_of(const float *light, int width)
{
    struct light_sum s = {0};
    for (int i = 0; i < width * GLOW_HEIGHT; i++) {
        const double red = (double)light[4 * i], x = i % width + 0.5;
        s.sum += red;
        s.centre_x += red * x;
        s.peak = fmax(s.peak, red);
        s.outside += fabs(x - width / 2.0) > 20 ? red : 0;
    }
    s.centre_x /= s.sum;
    return s;
}

// A mirror that shows the sky's sun, in its middle or some degrees off it.
static struct light_sum sun_of(const char *glow, double off_deg, int width)
{
    char text[256];
    snprintf(text, sizeof(text),
             "environment_px=128 pane_pitch_deg=36.87 pane_yaw_deg=%g view_angle_deg=30 "
             "reflectivity=1 %s",
             36.87 + off_deg, glow);
    float *light = draw_of(text, width, GLOW_HEIGHT);
    const struct light_sum s = sum_of(light, width);
    free(light);
    return s;
}

// Glow takes light from bright places and gives as much to their surroundings, with the spot in the
// middle or at the edge. Each pixel is rounded down to a half three times more, by 2^-11 in the
// mean. If the target's width is no multiple of 4, light in the rest of the last column is lost;
// then the spot is in the middle.
static void test_glow_spreads_light(void **state)
{
    (void)state;
    static const double offs_deg[] = {0, 6, -10};
    const char *glow = "glow=0.8 glow_threshold=2.5";
    for (int i = 0; i < 3; i++) {
        const int width = offs_deg[i] == 0 ? 97 : 96;
        const struct light_sum without = sun_of("", offs_deg[i], width);
        const struct light_sum with = sun_of(glow, offs_deg[i], width);
        if (fabs(with.sum / without.sum - 1) > 0.002)
            fail_msg("%g degrees off the middle: %g of the light", offs_deg[i],
                     with.sum / without.sum);
        assert_below(with.peak, 0.6 * without.peak);
        if (offs_deg[i] != 0)
            continue;
        assert_above(with.outside, 1.1 * without.outside);
        if (fabs(with.centre_x - without.centre_x) > 0.1)
            fail_msg("the light moved by %g pixels", with.centre_x - without.centre_x);
    }
}

static void test_what_is_dark_does_not_glow(void **state)
{
    (void)state;
    float *without = draw_of("", SIZE, SIZE);
    float *with = draw_of("glow=1 glow_threshold=1000", SIZE, SIZE);
    assert_memory_equal(with, without, SIZE * SIZE * 4 * sizeof(float));
    free(without);
    free(with);
}

// --- the model ---

enum { VIEW = 120 };

static const char *const lit_sphere =
    "view=box panes=glass model=sphere camera_azimuth_deg=0 camera_elevation_deg=0 light=2 "
    "light_azimuth_deg=90 light_elevation_deg=0 model_grey=0.5 ";

// The pixel of the sphere's point 45 degrees to the right, at this height.
static int pixel_of(const struct flow_settings *s, double y)
{
    const struct picture_oracle camera = {.distance = 2 * s->distance_mm / s->pane_mm,
                                          .view_angle_deg = s->view_angle_deg};
    const double side = sqrt((s->model_size * s->model_size - y * y) / 2);
    double pixel[2];
    picture_oracle_project(&camera, VIEW, VIEW, (double[3]){side, y, side}, pixel);
    return (int)pixel[1] * VIEW + (int)pixel[0];
}

// The lit sphere with a drop on the right pane, at the height of its middle.
static float *draw_shadow(const char *shadow, bool wet, struct flow_settings *settings)
{
    char text[256];
    snprintf(text, sizeof(text), "%s%s", lit_sphere, shadow);
    struct rig rig;
    open_still(&rig, text, VIEW, VIEW);
    *settings = rig.settings;
    int64_t *water = calloc((size_t)(rig.panes * SIZE * SIZE), sizeof(*water));
    // Right is away from the front there: z = 0.438 is at 0.281 of the pane.
    for (int y = SIZE / 2 - 3; wet && y < SIZE / 2 + 3; y++)
        for (int x = 9 - 3; x < 9 + 3; x++)
            water[rig_texel(&rig, BOX_RIGHT, x, y)] = UNIT;
    rig_put(&rig, water);
    float *light = rig_draw(&rig);
    free(water);
    rig_close(&rig);
    return light;
}

static void test_drops_shade_the_model(void **state)
{
    (void)state;
    struct flow_settings s;
    float *none = draw_shadow("drop_shadow=0", true, &s);
    float *dry = draw_shadow("drop_shadow=1", false, &s);
    float *half = draw_shadow("drop_shadow=0.5", true, &s);
    float *full = draw_shadow("drop_shadow=1", true, &s);
    const int shaded = 4 * pixel_of(&s, 0), above = 4 * pixel_of(&s, 0.4);
    // The lamp is at 45 degrees to the surface. Only reflections of the glass and of the model's
    // sheen are missing.
    const double lamp = 2 * 0.5 * sqrt(0.5), taken = (double)(none[shaded] - full[shaded]);
    assert_below(taken, lamp);
    assert_above(taken, 0.9 * lamp);
    // Halves are off by one part in 2^10 of either light.
    assert_below(fabs((double)(none[shaded] - half[shaded]) - taken / 2), 0.002);
    assert_equals(dry[shaded], none[shaded]);
    assert_equals(full[above], none[above]);
    assert_above(none[above], 0.5f * none[shaded]);
    free(none);
    free(dry);
    free(half);
    free(full);
}

static int64_t triangles_of(const char *assignments, bool *told)
{
    struct rig rig;
    open_still(&rig, assignments, SIZE, SIZE);
    free(rig_draw(&rig));
    *told = false;
    for (int i = 0; i < rig.instance->fact_count; i++)
        *told = *told || !strcmp(rig.instance->facts[i].name, "model");
    const int64_t triangles = rig.instance->counters[FLOW_TRIANGLES].value;
    rig_close(&rig);
    return triangles;
}

static void test_the_model_stands_in_glass_alone(void **state)
{
    (void)state;
    bool told;
    assert_int_equal(triangles_of("view=box panes=glass model=sphere", &told), 27648);
    assert_true(told);
    assert_int_equal(triangles_of("view=box panes=glass model=sphere model_faces=1000", &told),
                     1000);
    assert_int_equal(triangles_of("view=box panes=glass model=none", &told), 0);
    assert_false(told);
    assert_int_equal(triangles_of("view=box panes=mirror model=sphere", &told), 0);
    assert_int_equal(triangles_of("view=pane panes=glass model=sphere", &told), 0);
    assert_false(told);
}

// The place in the picture of a point of a model with these bounds: right, down and away from its
// middle.
static void see_point(const struct flow_settings *s, const float point[3], double seen[3])
{
    static const float low[3] = {-1, -1, -1}, high[3] = {1, 1, 1};
    flow_view_params p;
    assert_true(flow_view_params_at(s, 0, VIEW, VIEW, &p));
    flow_view_model(s, 0, low, high, &p);
    const rg_corner at = m4_project(p.to_clip, v3_make(point[0], point[1], point[2]));
    const rg_corner middle = m4_project(p.to_clip, v3_make(0, 0, 0));
    seen[0] = (double)(at.x / at.w - middle.x / middle.w);
    seen[1] = (double)(at.y / at.w - middle.y / middle.w);
    seen[2] = (double)(at.w - middle.w);
}

// A model's x, y and z are the front's right, up and outwards, and its normals turn with it.
static void test_the_model_stands_upright(void **state)
{
    (void)state;
    static const float axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const struct {
        double pitch_deg, yaw_deg, roll_deg;
        int way[3], axis[3]; // where each axis is seen: towards or against right, down or away
    } cases[] = {
        {0, 0, 0, {1, -1, -1}, {0, 1, 2}},
        {0, 0, 90, {1, 1, -1}, {1, 0, 2}}, // clockwise: right becomes down
        {90, 0, 0, {1, 1, -1}, {0, 2, 1}}, // the front faces up
        {0, 90, 0, {1, -1, 1}, {2, 1, 0}}, // the front faces right
    };
    struct flow_settings s;
    rg_params_reset(&flow_param_table, &s);
    s.camera_azimuth_deg = s.camera_elevation_deg = 0;
    for (int i = 0; i < 4; i++) {
        s.pitch_deg = cases[i].pitch_deg;
        s.yaw_deg = cases[i].yaw_deg;
        s.roll_deg = cases[i].roll_deg;
        for (int axis = 0; axis < 3; axis++) {
            double seen[3];
            see_point(&s, axes[axis], seen);
            for (int k = 0; k < 3; k++)
                if (k == cases[i].axis[axis] ? seen[k] * cases[i].way[axis] < 0.05
                                             : fabs(seen[k]) > 1e-5)
                    fail_msg("case %d: axis %d is seen at (%g, %g, %g)", i, axis, seen[0], seen[1],
                             seen[2]);
        }
    }
}

// --- what changes with the frame and the distance ---

// A box that spins looks, at each frame, like one that is turned as far.
static void test_spin(void **state)
{
    (void)state;
    static const char *const spins[][2] = {
        {"spin_roll_deg_s=60", "pane_roll_deg=60"},
        {"spin_pitch_deg_s=-20 pane_pitch_deg=50", "pane_pitch_deg=30"},
        {"spin_yaw_deg_s=35 pane_roll_deg=10", "pane_yaw_deg=35 pane_roll_deg=10"},
    };
    for (int i = 0; i < 3; i++) {
        float *light[2];
        for (int k = 0; k < 2; k++) {
            char text[256];
            snprintf(text, sizeof(text), "view=box model=none stage=height step_s=0.5 %s",
                     spins[i][k]);
            struct rig rig;
            open_still(&rig, text, VIEW, VIEW);
            rig_step(&rig, 2);
            int64_t *water = water_of(&rig, UNIT);
            rig_put(&rig, water);
            light[k] = rig_draw(&rig);
            free(water);
            rig_close(&rig);
        }
        assert_memory_equal(light[0], light[1], VIEW * VIEW * 4 * sizeof(float));
        free(light[0]);
        free(light[1]);
    }
}

// Water runs on the box by its pose at each frame.
static void test_water_follows_the_spin(void **state)
{
    (void)state;
    static const int to[4][2] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}};
    struct rig rig;
    open_still(&rig, "spin_roll_deg_s=90 step_s=1", SIZE, SIZE);
    for (int frame = 0; frame < 8; frame++) {
        rig_put_one(&rig, SIZE / 2, SIZE / 2, UNIT / 2);
        rig_step(&rig, 1);
        int64_t *water = rig_water(&rig);
        const int dx = to[frame % 4][0], dy = to[frame % 4][1];
        assert_above(water[rig_texel(&rig, 0, SIZE / 2 + dx, SIZE / 2 + dy)], UNIT / 8);
        free(water);
    }
    rig_close(&rig);
}

// The resolution is the coarsest of resolution_px, its half, its quarter and so on that gives each
// pixel its texels.
static void test_resolution_follows_the_distance(void **state)
{
    (void)state;
    struct flow_settings s;
    rg_params_reset(&flow_param_table, &s);
    static const int most_px[] = {1024, 512, 300};
    for (int i = 0; i < 3; i++) {
        s.resolution_px = most_px[i];
        s.texels_a_pixel = 0;
        s.distance_mm = 5000;
        assert_int_equal(flow_texels(&s, 0, 600), most_px[i]);
        s.texels_a_pixel = 1.5;
        int kinds = 0, last = 0;
        for (s.distance_mm = 50; s.distance_mm < 20000; s.distance_mm *= 1.07) {
            const double half_view_mm =
                s.distance_mm * tan(s.view_angle_deg / 2 * 0.017453292519943);
            const double due = 1.5 * 600 * s.pane_mm / (2 * half_view_mm);
            const int texels = flow_texels(&s, 0, 600), fold = most_px[i] / texels;
            kinds += texels != last;
            last = texels;
            if (texels < 16 || (fold & (fold - 1)) || most_px[i] / fold != texels ||
                (texels < due && fold > 1) || (texels / 2 >= due && texels / 2 >= 16))
                fail_msg("%g mm: %d texels of %d; %g are due", s.distance_mm, texels, most_px[i],
                         due);
        }
        assert_above(kinds, 3);
    }
    struct rig rig;
    rig_open_sized(&rig, device,
                   "view=box model=none resolution_px=256 texels_a_pixel=1 "
                   "distance_mm=1448",
                   64, 160);
    assert_int_equal(rig.size, 32); // the box's side covers 20 pixels
    rig_step(&rig, 1);
    free(rig_draw(&rig));
    rig_close(&rig);
}

int main(int argc, char **argv)
{
    device = argc > 1 ? argv[1] : device;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rays_meet_their_pixels),
        cmocka_unit_test(test_one_pane_fills_the_view),
        cmocka_unit_test(test_stages_show_the_maps),
        cmocka_unit_test(test_stages_show_the_near_panes),
        cmocka_unit_test(test_glow_spreads_light),
        cmocka_unit_test(test_what_is_dark_does_not_glow),
        cmocka_unit_test(test_drops_shade_the_model),
        cmocka_unit_test(test_the_model_stands_in_glass_alone),
        cmocka_unit_test(test_the_model_stands_upright),
        cmocka_unit_test(test_spin),
        cmocka_unit_test(test_water_follows_the_spin),
        cmocka_unit_test(test_resolution_follows_the_distance),
    };
    return cmocka_run_group_tests(tests, NULL, rig_close_devices);
}
