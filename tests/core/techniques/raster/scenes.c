// The scenes of panes and of billboards on devices, against polygons in double precision: scenes
// DEVICE.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "tests/core/techniques/rigs/scene.h"
#include "tests/oracle/chance.h"
#include "tests/oracle/raster.h"
#include "tests/tools/expect.h"
#include "tests/tools/instance.h"

enum { WIDTH = 224, HEIGHT = 126 };

// Corners lie on a grid of 1/256 pixel, so that centres nearer to an edge may be on either side.
#define ON_AN_EDGE_PX 0.02

static struct rg_instance *open_scene(struct rg_device *device, const char *assignments)
{
    return instance_of(device, "raster", "", assignments, WIDTH, HEIGHT);
}

static void draw_frame(struct rg_instance *instance, int frame)
{
    while (instance->frame < frame)
        assert_true(instance->technique->step(instance));
    assert_true(instance->technique->draw(instance));
}

// --- polygons ---

struct quad {
    struct oracle_place at[4];
};

// How far a pixel's centre is inside a quad.
static double inside_px(const struct quad *q, int px, int py)
{
    return oracle_inside_px(q->at, 4, (struct oracle_place){px + 0.5, py + 0.5});
}

// Expects the samples of an item: all centres that are surely inside, and no more than may be.
static void expect_samples(const char *what, int item, const struct quad *q, uint32_t samples)
{
    uint32_t least = 0, most = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const double by = inside_px(q, i % WIDTH, i / WIDTH);
        least += by > ON_AN_EDGE_PX;
        most += by > -ON_AN_EDGE_PX;
    }
    if (samples < least || samples > most)
        fail_msg("%s %d covers %u samples, not %u to %u", what, item, (unsigned)samples,
                 (unsigned)least, (unsigned)most);
}

// --- panes ---

enum { PANES = 150, FRAME = 40, TURN_DEG = 3 };

// A pane from its words (kernels/raster/quads_params.h): lengths are in the target's heights.
static struct quad pane_of(const float *words, int frame)
{
    const double angle = (double)words[4] + (double)words[5] * frame * TURN_DEG * acos(-1) / 180;
    const double along = (double)words[2] * HEIGHT, across = (double)words[3] * HEIGHT;
    const double signs[4][2] = {{-1, -1}, {-1, 1}, {1, 1}, {1, -1}};
    struct quad q;
    for (int i = 0; i < 4; i++) {
        const double u = signs[i][0] * along, v = signs[i][1] * across;
        q.at[i].x = ((double)words[0] + 1) / 2 * WIDTH + u * cos(angle) - v * sin(angle);
        q.at[i].y = ((double)words[1] + 1) / 2 * HEIGHT + u * sin(angle) + v * cos(angle);
    }
    return q;
}

// Blends all panes over a pixel in their order. False if it is on an edge of one.
static bool blend_panes(const float *words, int px, int py, double colour[4])
{
    static const double background[4] = {0.0625, 0.078125, 0.109375, 1};
    for (int k = 0; k < 4; k++)
        colour[k] = background[k];
    for (int i = 0; i < PANES; i++, words += RASTER_QUAD_WORDS) {
        const struct quad q = pane_of(words, FRAME);
        const double by = inside_px(&q, px, py);
        if (fabs(by) < ON_AN_EDGE_PX)
            return false;
        for (int k = 0; by > 0 && k < 4; k++)
            colour[k] = (double)words[7 + k] + (1 - (double)words[10]) * colour[k];
    }
    return true;
}

static void panes_are_rectangles_that_turn(void **state)
{
    struct rg_instance *instance =
        open_scene(*state, "scene=quads quads=150 turn_deg=3 count=on format=rgba32f");
    draw_frame(instance, FRAME);
    float *panes = asset_words(instance, "quads");
    uint32_t *samples = asset_words(instance, "samples");
    for (int i = 0; i < PANES; i++) {
        const struct quad q = pane_of(panes + (size_t)i * RASTER_QUAD_WORDS, FRAME);
        expect_samples("pane", i, &q, samples[i]);
    }
    float *texels = malloc(sizeof(float) * 4 * WIDTH * HEIGHT);
    assert_non_null(texels);
    assert_true(rg_image_read(rg_asset_find(instance, "drawn")->image, 0, 0, texels));
    int looked_at = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i += 7) {
        double due[4];
        if (!blend_panes(panes, i % WIDTH, i / WIDTH, due))
            continue;
        for (int k = 0; k < 4; k++)
            if (fabs((double)texels[4 * i + k] - due[k]) > 1e-5)
                fail_msg("x %d, y %d, channel %d: %.7f, not %.7f", i % WIDTH, i / WIDTH, k,
                         (double)texels[4 * i + k], due[k]);
        looked_at++;
    }
    assert_above(looked_at, WIDTH * HEIGHT / 14);
    free(texels);
    free(samples);
    free(panes);
    rg_instance_close(instance);
}

// --- billboards ---

enum { DROPS = 400 };

// One coordinate of a drop after so many seconds; the air is a box that it does not leave.
static double drop_at(double start, double low_m, double size_m, double speed_m_s, double seconds)
{
    const double boxes = start + speed_m_s * seconds / size_m;
    return low_m + size_m * (boxes - floor(boxes));
}

// The eye is at the origin and looks along z; y points down.
static void project(const struct raster_settings *s, const double at[3], double *x, double *y)
{
    const double scale = HEIGHT / 2.0 / tan(s->view_angle_deg / 2 * acos(-1) / 180);
    *x = WIDTH / 2.0 + scale * at[0] / at[2];
    *y = HEIGHT / 2.0 + scale * at[1] / at[2];
}

// A streak lies along the drop's way. Its sides are across this way and the line of sight.
static struct quad streak_of(const struct raster_settings *s, const double head[3])
{
    const double speed = hypot(s->wind_m_s, s->fall_m_s), length = s->streak_length_mm / 1000;
    const double way[3] = {s->wind_m_s / speed, s->fall_m_s / speed, 0};
    const double side[3] = {way[1] * head[2], -way[0] * head[2],
                            way[0] * head[1] - way[1] * head[0]};
    const double wide = s->streak_radius_mm / 1000 / hypot(hypot(side[0], side[1]), side[2]);
    static const double corners[4][2] = {{0, 1}, {1, 1}, {1, -1}, {0, -1}};
    struct quad q;
    for (int i = 0; i < 4; i++) {
        double at[3];
        for (int k = 0; k < 3; k++)
            at[k] = head[k] - corners[i][0] * length * way[k] + corners[i][1] * wide * side[k];
        project(s, at, &q.at[i].x, &q.at[i].y);
    }
    return q;
}

static void streaks_trail_their_drops(void **state)
{
#define STREAKS                                                                                    \
    "scene=billboards billboards=400 count=on streak_radius_mm=90 streak_length_mm=1500 "          \
    "wind_m_s=3 fall_m_s=7 air_width_m=30 air_height_m=20 view_angle_deg=60"
    struct rg_instance *instance = open_scene(*state, STREAKS);
    struct mesh_scene scene;
    mesh_scene_set(&scene, STREAKS);
    const struct raster_settings *s = &scene.settings;
    draw_frame(instance, FRAME);
    float *drops = asset_words(instance, "drops");
    uint32_t *samples = asset_words(instance, "samples");
    int64_t seen = 0;
    for (int i = 0; i < DROPS; i++) {
        const double seconds = FRAME * s->step_s;
        const double head[3] = {
            drop_at((double)drops[i], -s->air_width_m / 2, s->air_width_m, s->wind_m_s, seconds),
            drop_at((double)drops[DROPS + i], -s->air_height_m / 2, s->air_height_m, s->fall_m_s,
                    seconds),
            (double)drops[2 * DROPS + i] * s->reach_m};
        if (head[2] < 1)
            continue; // the near plane may cut it
        const struct quad q = streak_of(s, head);
        expect_samples("streak", i, &q, samples[i]);
        seen += samples[i];
    }
    assert_above(seen, 3000);
    free(samples);
    free(drops);
    rg_instance_close(instance);
}

// Drops fill the air evenly, and their coordinates are independent of each other.
static void drops_fill_the_air(void **state)
{
    enum { MANY = 20000 };
    struct rg_instance *instance = open_scene(*state, "scene=billboards billboards=20000");
    float *drops = asset_words(instance, "drops");
    static double of[3][MANY];
    const double *const columns[3] = {of[0], of[1], of[2]};
    for (int k = 0; k < 3; k++) {
        double sum = 0, squares = 0;
        for (int i = 0; i < MANY; i++) {
            of[k][i] = (double)drops[k * MANY + i];
            sum += of[k][i];
            squares += of[k][i] * of[k][i];
        }
        assert_below(fabs(sum / MANY - 0.5), 4 * 0.289 / sqrt(MANY));
        assert_below(fabs(squares / MANY - 1.0 / 3), 4 * 0.298 / sqrt(MANY));
    }
    assert_below(oracle_dependence(columns, 3, MANY), 5);
    free(drops);
    rg_instance_close(instance);
}

// The same seed has the same drops, however many there are, and another seed others.
static void a_seed_sets_the_drops(void **state)
{
    enum { FEW = 100, MORE = 164 };
    static const char *const sets[] = {"scene=billboards billboards=100 seed=7",
                                       "scene=billboards billboards=164 seed=7",
                                       "scene=billboards billboards=100 seed=8"};
    struct rg_instance *instances[3];
    float *drops[3];
    for (int i = 0; i < 3; i++) {
        instances[i] = open_scene(*state, sets[i]);
        drops[i] = asset_words(instances[i], "drops");
    }
    int same = 0;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < FEW; i++) {
            assert_equals(drops[0][k * FEW + i], drops[1][k * MORE + i]);
            same += drops[0][k * FEW + i] == drops[2][k * FEW + i];
        }
    assert_at_most(same, 1);
    for (int i = 0; i < 3; i++) {
        free(drops[i]);
        rg_instance_close(instances[i]);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_seed_sets_the_drops),
        cmocka_unit_test(panes_are_rectangles_that_turn),
        cmocka_unit_test(streaks_trail_their_drops),
        cmocka_unit_test(drops_fill_the_air),
    };
    return raster_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
