// Particles that the rain reports as unseen (kernels/streaks/taps/unseen.h). In views of all kinds
// none of them has a corner to draw, and they include most particles out of sight. The others have
// the view's depths.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "backends/cpu/kernels/notes.h"
#include "kernels/streaks/taps/rain_2.h"
#include "kernels/dialect/rng.h"

enum { VIEWS = 1500, BLOCKS = 32, PARTICLES = BLOCKS * STREAKS_BLOCK, SIZES = 4, SIDE = 8 };
enum { FIRST_BLOCK = SIZES * STREAKS_SIZE_WORDS, SURFACES = 20 };

// After its header an image has one level of SIDE x SIDE texels.
struct scene {
    float particles[3 * PARTICLES];
    uint blocks[FIRST_BLOCK + BLOCKS * STREAKS_BLOCK_WORDS];
    uint depths[RG_MAX_LEVELS + SIDE * SIDE], numbers[RG_MAX_LEVELS + SIDE * SIDE];
    uint surfaces[SURFACES * SCENERY_SURFACE_WORDS];
};

static const double NEAR = 0.1, FAR = 200; // planes of a view

static uint seed, drawn;

static float within(float low, float high)
{
    return low + (high - low) * rg_uniform(rg_random(seed, drawn++, 0, 0).x);
}

static int one_of(int count)
{
    return (int)within(0, (float)count - 0.01f);
}

static void fill(struct scene *s)
{
    const float classes[SIZES][STREAKS_SIZE_WORDS] = {{1, 1, 1, 1, 0},
                                                      {0.5f, 0.7f, 3, 3, 0.4f},
                                                      {2.5f, 1.2f, 0.5f, 1, 0.9f},
                                                      {0.2f, 0.5f, 8, 9, 0}};
    for (int i = 0; i < FIRST_BLOCK; i++)
        s->blocks[i] = rg_float_bits(classes[i / STREAKS_SIZE_WORDS][i % STREAKS_SIZE_WORDS]);
    for (int i = 0; i < PARTICLES; i++) {
        s->particles[3 * i] = within(-1, 1);
        s->particles[3 * i + 1] = within(-1, 1);
        s->particles[3 * i + 2] = (float)one_of(10) + within(0, 0.99f);
    }
    for (int b = 0; b < BLOCKS; b++) {
        uint *block = s->blocks + FIRST_BLOCK + b * STREAKS_BLOCK_WORDS;
        block[0] = (uint)(b * STREAKS_BLOCK);
        block[1] = b % 4 ? 0xffffffffu : rg_random(seed, drawn++, 0, 0).x;
        block[2] = rg_float_bits(within(-0.2f, 0.2f));
        block[3] = rg_float_bits(within(-0.2f, 0.2f));
        block[4] = rg_float_bits(within(0, 1));
    }
    s->depths[0] = s->numbers[0] = RG_MAX_LEVELS;
    for (int i = 0; i < SIDE * SIDE; i++) {
        s->depths[RG_MAX_LEVELS + i] = rg_float_bits(i % 6 ? within(0.2f, 0.9f) : 1);
        s->numbers[RG_MAX_LEVELS + i] = i % 5 ? (uint)one_of(SURFACES) : SCENERY_NO_SURFACE;
    }
    for (int i = 0; i < SURFACES * SCENERY_SURFACE_WORDS; i++)
        s->surfaces[i] = rg_random(seed, drawn++, 0, 0).x;
}

// A perspective view from a place in the rain space, along `turn` about s, then tilted.
static m4 view_of(float x, float y, float s)
{
    const double turn = (double)within(0, 6.2831853f), tilt = (double)within(-1.5f, 1.5f);
    const double across[3] = {-sin(turn), cos(turn), 0};
    const double ahead[3] = {cos(turn) * cos(tilt), sin(turn) * cos(tilt), sin(tilt)};
    const double down[3] = {-cos(turn) * sin(tilt), -sin(turn) * sin(tilt), cos(tilt)};
    const double wide = 1 / (double)within(0.1f, 2), range = FAR / (FAR - NEAR);
    const double tall = wide * (double)within(1, 2);
    double rows[4][4];
    for (int k = 0; k < 3; k++) {
        rows[0][k] = across[k] * wide;
        rows[1][k] = down[k] * tall;
        rows[2][k] = ahead[k] * range;
        rows[3][k] = ahead[k];
    }
    for (int row = 0; row < 4; row++)
        rows[row][3] =
            -(rows[row][0] * (double)x + rows[row][1] * (double)y + rows[row][2] * (double)s);
    rows[2][3] -= NEAR * range;
    m4 m;
    float *to = &m.xx;
    for (int i = 0; i < 16; i++)
        to[i] = (float)rows[i / 4][i % 4];
    return m;
}

static streaks_params params_of(void)
{
    streaks_params p = {.half_x = 30,
                        .half_y = 20,
                        .top = within(-10, 30),
                        .local_height = within(5, 40),
                        .radius = 20,
                        .exact = one_of(2),
                        .map_x = -30,
                        .map_y = -20,
                        .map_per_x = 1.0f / 60,
                        .map_per_y = 1.0f / 40,
                        .map_height = 70,
                        .ground = 70,
                        .fall = one_of(2) ? within(0.01f, 0.1f) : within(0.1f, 5),
                        .drop_radius = within(0.0005f, 0.005f),
                        .sizes = SIZES,
                        .fall_speed = 8,
                        .splash_s = within(0.1f, 1.5f),
                        .splash_width = within(0.01f, 4),
                        .splash_foot = 0.3f,
                        .up_s = -1,
                        .follows = one_of(2),
                        .materials = 1,
                        .drops = 1,
                        .splashes = 1,
                        .thinnest_px = (float)one_of(2),
                        .focal_px = within(5, 200),
                        .splash_last = 1,
                        .around = one_of(2)};
    p.eye_x = within(-20, 20);
    p.eye_y = within(-15, 15);
    p.eye_s = p.top + within(0, p.local_height);
    p.to_clip = view_of(p.eye_x, p.eye_y, p.eye_s);
    p.behind = p.fall + p.drop_radius;
    p.half_width = 1.35f * p.drop_radius;
    p.splash_height = 0.7f * p.splash_width;
    return p;
}

// A corner's depth depends on its distance ahead alone.
static void expect_depth(rg_corner c)
{
    const double due = ((double)c.w - NEAR) * FAR / (FAR - NEAR);
    if (fabs((double)c.z - due) > 2e-4)
        fail_msg("view %u: %g ahead the depth is %g, not %g", seed, (double)c.w, (double)c.z, due);
}

// Counts a view's particles that the rain reports as unseen, and those that are not drawn.
static void look(const rg_ctx rg, const streaks_params p, int *unseen, int *dead)
{
    const rg_draw_state draw = {
        .width = 1280, .height = 720, .x1 = 1280, .y1 = 720, .half_width = 640, .half_height = 360};
    for (int i = 0; i < PARTICLES; i++) {
        const streaks_block block = rg_program_group(rg, p, i / RG_GROUP_ITEMS);
        const bool is_unseen = rg_program_unseen(rg, p, block, i);
        const rg_item item = rg_program_item(rg, draw, p, i);
        const bool is_dead = rg_project(draw, item).fate == RG_FATE_DEAD;
        if (is_unseen && !is_dead)
            fail_msg("view %u: particle %d is unseen, and drawn", seed, i);
        if (!is_dead) {
            expect_depth(item.a);
            expect_depth(item.b);
            expect_depth(item.c);
            expect_depth(item.d);
        }
        *dead += is_dead;
        *unseen += is_unseen;
    }
}

static void what_is_unseen_has_no_corners_in_sight(void **state)
{
    (void)state;
    static struct scene scene;
    struct rg_notes notes = {0};
    int dead = 0, unseen = 0;
    for (seed = 1; seed <= VIEWS; seed++) {
        drawn = 0;
        fill(&scene);
        const streaks_params p = params_of();
        const rg_image_shape map = {SIDE, SIDE, 1, 1};
        look((rg_ctx){.particles = scene.particles,
                      .blocks = scene.blocks,
                      .depths = scene.depths,
                      .depths_shape = map,
                      .numbers = scene.numbers,
                      .numbers_shape = map,
                      .surfaces = scene.surfaces,
                      .notes = &notes},
             p, &unseen, &dead);
    }
    assert_true(dead < VIEWS * PARTICLES / 100 * 97);
    if (unseen < dead * 9 / 10)
        fail_msg("%d of %d particles that are not drawn are found", unseen, dead);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_unseen_has_no_corners_in_sight)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
