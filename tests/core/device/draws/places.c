// What fragments know of their place on a triangle: weights of its corners, w and depth, against a
// model in double precision. On native devices the driver interpolates them.
#include <math.h>

#include "tests/core/device/draws/quads.h"
#include "tests/core/device/suite.h"

enum { PX = 64, TRIANGLES = 60, CORNERS = 3, VALUES = 4 };

// Drivers snap corners to this part of a pixel.
static const double STEP = 1.0 / 256;

static double unit(uint32_t i)
{
    return (double)(noise(i) >> 8) * 0x1p-24;
}

// Corners in clip space with w from 1 to 4, around the target's middle: none is behind the eye, and
// some lie beyond its edges.
static void make_triangle(uint32_t seed, float *quad)
{
    memset(quad, 0, TEST_QUAD_WORDS * sizeof(*quad));
    for (uint32_t k = 0; k < CORNERS; k++) {
        const double turn = 2.0944 * (double)k + 1.2 * unit(seed + 8 * k),
                     w = 1 + 3 * unit(seed + 8 * k + 1);
        const double far = 0.5 + unit(seed + 8 * k + 2);
        float *corner = quad + 4 * k;
        corner[0] = (float)(far * cos(turn) * w);
        corner[1] = (float)(far * sin(turn) * w);
        corner[2] = (float)(unit(seed + 8 * k + 3) * w);
        corner[3] = (float)w;
    }
}

// What a place in pixels has: weights of the second and the third corner, w, depth; and the least
// of the three weights, or -1 behind the eye. After Olano and Greer: the place is a sum of the
// corners in x, y and w.
static double values_at(const float *quad, double x, double y, double values[VALUES])
{
    const double at[CORNERS] = {x / PX * 2 - 1, y / PX * 2 - 1, 1};
    double shares[CORNERS], sum = 0, depth = 0, det = 0;
    for (int k = 0; k < CORNERS; k++) {
        const float *p = quad + 4 * ((k + 1) % CORNERS), *q = quad + 4 * ((k + 2) % CORNERS);
        const double across[CORNERS] = {(double)p[1] * (double)q[3] - (double)p[3] * (double)q[1],
                                        (double)p[3] * (double)q[0] - (double)p[0] * (double)q[3],
                                        (double)p[0] * (double)q[1] - (double)p[1] * (double)q[0]};
        const float *own = quad + 4 * k;
        det = (double)own[0] * across[0] + (double)own[1] * across[1] + (double)own[3] * across[2];
        shares[k] = (at[0] * across[0] + at[1] * across[1] + at[2] * across[2]) / det;
        sum += shares[k];
        depth += shares[k] * (double)own[2];
    }
    values[0] = shares[1] / sum;
    values[1] = shares[2] / sum;
    values[2] = 1 / sum;
    values[3] = depth;
    return sum > 0 ? fmin(fmin(shares[0], shares[1]), shares[2]) / sum : -1;
}

static void draw(struct rg_device *device, struct rg_pass *pass, const float *quad,
                 float (*colours)[4], float *depths)
{
    const test_quads_params p = {0};
    const float black[4] = {0}, far = 1;
    struct rg_buf *quads = make_buf(device, quad, TEST_QUAD_WORDS, "quads");
    struct rg_image *colour = rg_image_create_with(
        device, &(struct rg_image_desc){RG_RGBA32F, PX, PX, 1, 1}, black, "colour");
    struct rg_image *depth =
        rg_image_create_with(device, &(struct rg_image_desc){RG_D32F, PX, PX, 1, 1}, &far, "depth");
    assert_true(quads && colour && depth);
    const struct rg_draw to = {.colour = colour, .depth = depth, .depth_mode = RG_DEPTH_WRITE};
    assert_true(rg_pass_run(
        pass, &(struct rg_run){
                  .params = &p, .slots = {[1].buf = quads}, .extent = {1, 1, 1}, .draw = &to}));
    assert_true(rg_image_read(colour, 0, 0, colours) && rg_image_read(depth, 0, 0, depths));
    rg_buf_destroy(quads);
    rg_image_destroy(colour);
    rg_image_destroy(depth);
}

// A corner that moves by a step moves a value by no more than the value changes over a few.
static void check_pixel(const float *quad, int x, int y, const double got[VALUES])
{
    static const char *const names[] = {"second weight", "third weight", "w", "depth"};
    double due[VALUES], across[VALUES], down[VALUES];
    values_at(quad, x + 0.5, y + 0.5, due);
    values_at(quad, x + 0.5 + STEP, y + 0.5, across);
    values_at(quad, x + 0.5, y + 0.5 + STEP, down);
    for (int i = 0; i < VALUES; i++) {
        const double bound = 4 * (fabs(across[i] - due[i]) + fabs(down[i] - due[i])) + 1e-5;
        if (!(fabs(got[i] - due[i]) <= bound))
            fail_msg("pixel %d, %d: %s %.9g, not %.9g within %.3g", x, y, names[i], got[i], due[i],
                     bound);
    }
}

// Pixels inside by more than a few steps are drawn, and those outside are not.
static int check_triangle(const float *quad, float (*colours)[4], const float *depths)
{
    int drawn = 0;
    for (int i = 0; i < PX * PX; i++) {
        const int x = i % PX, y = i / PX;
        const bool is_drawn = colours[i][3] == 1;
        double values[VALUES];
        const double least = values_at(quad, x + 0.5, y + 0.5, values);
        drawn += is_drawn;
        if (is_drawn != (least > 0) && fabs(least) > 0.01)
            fail_msg("pixel %d, %d is %s, with weights from %.3g on, w %.3g and depth %.3g", x, y,
                     is_drawn ? "drawn" : "not drawn", least, values[2], values[3]);
        if (is_drawn && least > 0)
            check_pixel(quad, x, y,
                        (double[VALUES]){(double)colours[i][0], (double)colours[i][1],
                                         (double)colours[i][2], (double)depths[i]});
    }
    return drawn;
}

static void fragments_know_their_place(void **state)
{
    static float colours[PX * PX][4], depths[PX * PX];
    struct rg_pass *pass = rg_pass_create(*state, "test_placed");
    int drawn = 0;
    assert_non_null(pass);
    for (uint32_t i = 0; i < TRIANGLES; i++) {
        float quad[TEST_QUAD_WORDS];
        make_triangle(i << 8, quad);
        draw(*state, pass, quad, colours, depths);
        drawn += check_triangle(quad, colours, depths);
    }
    assert_true(drawn > TRIANGLES * PX * PX / 8);
    rg_pass_destroy(pass);
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(fragments_know_their_place)};
const struct suite_tests place_tests = {tests, COUNT_OF(tests)};
