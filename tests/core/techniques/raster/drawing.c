// DRAW passes against the tests' own rasteriser, and in closed cases: drawing DEVICE.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/dialect/rng.h"
#include "tests/core/techniques/rigs/scene.h"
#include "tests/oracle/raster.h"
#include "tests/tools/expect.h"

// --- chance ---

static struct {
    uint32_t item, step;
} chance;

static void seed(uint32_t item)
{
    chance.item = item;
    chance.step = 0;
}

static double uniform(void)
{
    return (double)rg_uniform(rg_random(11, chance.item, chance.step++, 9).x);
}

static double between(double low, double high)
{
    return low + (high - low) * uniform();
}

static int whole(int64_t low, int64_t high)
{
    return (int)(low + (int64_t)(uniform() * (double)(high - low + 1)));
}

// --- faces of corners on the grid ---

// Clip space (x, y, w - 1/16, w) for a position (x, y, w).
static const raster_mesh_params by_w = {
    .to_clip = {.xx = 1, .yy = 1, .zz = 1, .zw = -0.0625f, .wz = 1}, .ambient = 1};

// If w is a power of two, corners keep their place on the grid exactly.
static void put_corner(struct faces *faces, int vertex, struct oracle_point at, double w, int width,
                       int height)
{
    float *p = faces->positions + 3 * (size_t)vertex;
    p[0] = (float)(((double)at.x / 128 / width - 1) * w);
    p[1] = (float)(((double)at.y / 128 / height - 1) * w);
    p[2] = (float)w;
}

static double power_of_two(void)
{
    return ldexp(1, whole(-2, 3));
}

static void put_face(struct faces *faces, int face, int a, int b, int c)
{
    const uint32_t corners[3] = {(uint32_t)a, (uint32_t)b, (uint32_t)c};
    memcpy(faces->indices + 3 * (size_t)face, corners, sizeof(corners));
}

// Puts a face in either turn, from any corner on.
static void put_face_anyhow(struct faces *faces, int face, int a, int b, int c)
{
    const int corners[3] = {a, b, c}, first = whole(0, 2), step = whole(1, 2);
    put_face(faces, face, corners[first], corners[(first + step) % 3],
             corners[(first + 2 * step) % 3]);
}

static void expect_layers(const int *layers, const int *due, int width, int height,
                          const char *what)
{
    int wrong = 0, first = -1;
    for (int i = 0; i < width * height; i++) {
        if (layers[i] == due[i])
            continue;
        first = first < 0 ? i : first;
        wrong++;
    }
    if (wrong)
        fail_msg("%s: %d of %d pixels, the first at x %d, y %d: covered %d times, not %d", what,
                 wrong, width * height, first % width, first / width, layers[first], due[first]);
}

static void a_screen_of_two_faces_covers_each_pixel_once(void **state)
{
    static const int sizes[][2] = {{1, 1}, {16, 16}, {333, 217}, {1280, 720}};
    for (int s = 0; s < 4; s++) {
        const int width = sizes[s][0], height = sizes[s][1];
        struct faces faces = faces_make(4, 2);
        for (int k = 0; k < 4; k++)
            put_corner(&faces, k,
                       (struct oracle_point){k == 1 || k == 2 ? width * 256 : 0,
                                             k >= 2 ? height * 256 : 0},
                       power_of_two(), width, height);
        put_face_anyhow(&faces, 0, 0, 1, 2);
        put_face_anyhow(&faces, 1, 0, 2, 3);
        struct faces_on on;
        faces_upload(*state, &faces, &on);
        int *layers = faces_layers(&on, &by_w, width, height, RG_CULL_NONE);
        int *due = malloc((size_t)width * (size_t)height * sizeof(*due));
        for (int i = 0; i < width * height; i++)
            due[i] = 1;
        expect_layers(layers, due, width, height, "the screen");
        free(layers);
        free(due);
        faces_close(&on);
        faces_free(&faces);
    }
}

// --- pairs that share an edge, each in a tile of its own ---

enum { TILE = 16, TILES = 64, PAIRS = TILES * TILES, PAIR_ROUNDS = 25 };

struct pair {
    struct oracle_point a, b, c, d; // the edge a b is shared; c and d are on either side
};

// A point of the tile; with `on_centres`, on pixel centres or halfway between, where the fill rule
// decides.
static struct oracle_point tile_point(int tile, bool on_centres)
{
    const int x = tile % TILES * TILE * 256, y = tile / TILES * TILE * 256;
    if (on_centres)
        return (struct oracle_point){x + 128 * whole(0, 2 * TILE), y + 128 * whole(0, 2 * TILE)};
    return (struct oracle_point){x + whole(0, 256 * TILE), y + whole(0, 256 * TILE)};
}

static int side_of(struct oracle_point a, struct oracle_point b, struct oracle_point c)
{
    const int64_t turn = oracle_turn((struct oracle_point[3]){a, b, c});
    return turn > 0 ? 1 : turn < 0 ? -1 : 0;
}

static struct pair make_pair(int tile, bool on_centres)
{
    struct pair p;
    do {
        p.a = tile_point(tile, on_centres);
        p.b = tile_point(tile, on_centres);
        p.c = tile_point(tile, on_centres);
        p.d = tile_point(tile, on_centres);
    } while (side_of(p.a, p.b, p.c) * side_of(p.a, p.b, p.d) >= 0);
    return p;
}

static void count_pair(const struct pair *p, int tile, int *due)
{
    const struct oracle_point outline[4] = {p->a, p->d, p->b, p->c};
    const int x = tile % TILES * TILE, y = tile / TILES * TILE;
    for (int py = y; py < y + TILE; py++)
        for (int px = x; px < x + TILE; px++)
            due[py * TILES * TILE + px] = oracle_covers(outline, 4, px, py);
}

static void neighbours_cover_each_pixel_once(void **state)
{
    const int size = TILES * TILE;
    int *due = malloc((size_t)(size * size) * sizeof(*due));
    for (int round = 0; round < PAIR_ROUNDS; round++) {
        struct faces faces = faces_make(4 * PAIRS, 2 * PAIRS);
        for (int i = 0; i < PAIRS; i++) {
            seed((uint32_t)(round * PAIRS + i));
            const struct pair p = make_pair(i, i % 3 == 0);
            const struct oracle_point corners[4] = {p.a, p.b, p.c, p.d};
            for (int k = 0; k < 4; k++)
                put_corner(&faces, 4 * i + k, corners[k], power_of_two(), size, size);
            put_face_anyhow(&faces, 2 * i, 4 * i, 4 * i + 1, 4 * i + 2);
            put_face_anyhow(&faces, 2 * i + 1, 4 * i, 4 * i + 1, 4 * i + 3);
            count_pair(&p, i, due);
        }
        struct faces_on on;
        faces_upload(*state, &faces, &on);
        int *layers = faces_layers(&on, &by_w, size, size, RG_CULL_NONE);
        expect_layers(layers, due, size, size, "pairs of faces");
        free(layers);
        faces_close(&on);
        faces_free(&faces);
    }
    free(due);
}

// --- culling ---

// Faces of more than a pixel, one in each tile, in either turn. Faces that culling leaves cover the
// pixels of the exact rule; the others cover none.
static void culling_goes_by_the_turn_on_the_screen(void **state)
{
    const int size = TILES * TILE;
    struct faces faces = faces_make(3 * PAIRS, PAIRS);
    int *turning[2] = {calloc((size_t)(size * size), sizeof(int)),
                       calloc((size_t)(size * size), sizeof(int))};
    for (int i = 0; i < PAIRS; i++) {
        struct oracle_point corners[3];
        seed((uint32_t)i);
        do
            for (int k = 0; k < 3; k++)
                corners[k] = tile_point(i, false);
        while (llabs(oracle_turn(corners)) < 2 * 65536);
        for (int k = 0; k < 3; k++)
            put_corner(&faces, 3 * i + k, corners[k], power_of_two(), size, size);
        put_face(&faces, i, 3 * i, 3 * i + 1, 3 * i + 2);
        int *due = turning[oracle_turn(corners) > 0];
        const int x = i % TILES * TILE, y = i / TILES * TILE;
        for (int py = y; py < y + TILE; py++)
            for (int px = x; px < x + TILE; px++)
                due[py * size + px] = oracle_covers(corners, 3, px, py);
    }
    struct faces_on on;
    faces_upload(*state, &faces, &on);
    int *layers = faces_layers(&on, &by_w, size, size, RG_CULL_BACK);
    expect_layers(layers, turning[0], size, size, "what turns counter-clockwise");
    free(layers);
    layers = faces_layers(&on, &by_w, size, size, RG_CULL_FRONT);
    expect_layers(layers, turning[1], size, size, "what turns clockwise");
    free(layers);
    free(turning[0]);
    free(turning[1]);
    faces_close(&on);
    faces_free(&faces);
}

// --- the guard band ---

enum { SMALL = 64, HUGE_PAIRS = 1000 };

// Clipping to the guard band moves an edge at most by the grid to which corners are snapped.
static const double guard_px = 1.0 / 256;

static struct oracle_point anywhere(double reach_px)
{
    const double x = between(-reach_px, reach_px), y = between(-reach_px, reach_px);
    return (struct oracle_point){(int64_t)(x * 256), (int64_t)(y * 256)};
}

// A pair with its shared edge across the screen, and corners up to a million pixels away on either
// side.
static struct pair huge_pair(void)
{
    struct pair p;
    do {
        const double reach_px = pow(10, between(1.5, 6)), other_px = pow(10, between(1.5, 6));
        const double x = between(0, SMALL), y = between(0, SMALL), angle = between(0, 6.2831853);
        p.a = (struct oracle_point){(int64_t)((x + cos(angle) * reach_px) * 256),
                                    (int64_t)((y + sin(angle) * reach_px) * 256)};
        p.b = (struct oracle_point){(int64_t)((x - cos(angle) * other_px) * 256),
                                    (int64_t)((y - sin(angle) * other_px) * 256)};
        p.c = anywhere(pow(10, between(1.5, 6)));
        p.d = anywhere(pow(10, between(1.5, 6)));
    } while (side_of(p.a, p.b, p.c) * side_of(p.a, p.b, p.d) >= 0);
    return p;
}

// A pair off the upper left corner of the screen, with one corner inside.
static struct pair huge_pair_off_the_corner(void)
{
    const double reach_px = pow(10, between(2, 6));
    struct pair p;
    do {
        p.a = (struct oracle_point){whole(0, 256 * SMALL - 1), whole(0, 256 * SMALL - 1)};
        p.b = (struct oracle_point){(int64_t)(between(-1, -0.5) * reach_px * 256),
                                    (int64_t)(between(-1, -0.5) * reach_px * 256)};
        p.c =
            (struct oracle_point){(int64_t)(between(-1, 0) * reach_px * 256), whole(-9999, p.a.y)};
        p.d =
            (struct oracle_point){whole(-9999, p.a.x), (int64_t)(between(-1, 0) * reach_px * 256)};
    } while (side_of(p.a, p.b, p.c) * side_of(p.a, p.b, p.d) >= 0);
    return p;
}

// Moves each corner to where a float of clip space puts it, on the grid.
static void put_huge(struct faces *faces, int vertex, struct oracle_point *at)
{
    put_corner(faces, vertex, *at, 1, SMALL, SMALL);
    const float *p = faces->positions + 3 * (size_t)vertex;
    at->x = (int64_t)floor(((double)p[0] + 1) * 128 * SMALL + 0.5);
    at->y = (int64_t)floor(((double)p[1] + 1) * 128 * SMALL + 0.5);
}

struct expected {
    int sure, unsure; // pixels surely covered, and pixels too near an outline to tell
};

static struct expected expect_covered(const struct oracle_point *outline, int count)
{
    struct expected e = {0, 0};
    for (int py = 0; py < SMALL; py++) {
        for (int px = 0; px < SMALL; px++) {
            const bool near_rim = oracle_outline_px(outline, count, px, py) < 1.5 * guard_px;
            e.unsure += near_rim;
            e.sure += !near_rim && oracle_covers(outline, count, px, py);
        }
    }
    return e;
}

// The shared edge has no crack and no pixel twice, wherever the guard band cuts the faces.
static void huge_neighbours_cover_each_pixel_once(void **state)
{
    struct faces faces = faces_make(4 * HUGE_PAIRS, 2 * HUGE_PAIRS);
    struct expected *due = malloc(HUGE_PAIRS * sizeof(*due));
    for (int i = 0; i < HUGE_PAIRS; i++) {
        seed((uint32_t)i);
        const struct pair p = i % 4 ? huge_pair() : huge_pair_off_the_corner();
        struct oracle_point corners[4] = {p.a, p.b, p.c, p.d};
        for (int k = 0; k < 4; k++)
            put_huge(&faces, 4 * i + k, &corners[k]);
        put_face_anyhow(&faces, 2 * i, 4 * i, 4 * i + 1, 4 * i + 2);
        put_face_anyhow(&faces, 2 * i + 1, 4 * i, 4 * i + 1, 4 * i + 3);
        due[i] = expect_covered(
            (struct oracle_point[4]){corners[0], corners[3], corners[1], corners[2]}, 4);
    }
    struct faces_on on;
    faces_upload(*state, &faces, &on);
    struct faces_drawn drawn =
        faces_draw(&on, on.raster, &by_w,
                   &(struct faces_way){SMALL, SMALL, RG_RGBA32F, RG_BLEND_ADD, RG_DEPTH_OFF,
                                       RG_CULL_NONE, true});
    int exact = 0;
    for (int i = 0; i < HUGE_PAIRS; i++) {
        const int covered = (int)(drawn.samples[2 * i] + drawn.samples[2 * i + 1]);
        exact += due[i].unsure == 0 && due[i].sure > 0;
        if (covered < due[i].sure || covered > due[i].sure + due[i].unsure)
            fail_msg("pair %d covers %d pixels, not %d to %d", i, covered, due[i].sure,
                     due[i].sure + due[i].unsure);
    }
    assert_above(exact, HUGE_PAIRS / 4); // otherwise the test shows little
    faces_drawn_free(&drawn);
    faces_close(&on);
    faces_free(&faces);
    free(due);
}

// --- inside a closed box ---

static void turn_box(double m[3][3])
{
    double q[4], length = 0;
    for (int i = 0; i < 4; i++) {
        q[i] = between(-1, 1);
        length += q[i] * q[i];
    }
    const double s = 2 / length, a = q[0], b = q[1], c = q[2], d = q[3];
    const double turned[3][3] = {
        {1 - s * (c * c + d * d), s * (b * c - d * a), s * (b * d + c * a)},
        {s * (b * c + d * a), 1 - s * (b * b + d * d), s * (c * d - b * a)},
        {s * (b * d - c * a), s * (c * d + b * a), 1 - s * (b * b + c * c)}};
    memcpy(m, turned, sizeof(turned));
}

// A box about the eye, in any rotation; the eye looks along z, and walls are at 1 from the middle.
static struct faces box_around(const double eye[3])
{
    static const int walls[12][3] = {{0, 1, 3}, {0, 3, 2}, {4, 7, 5}, {4, 6, 7},
                                     {0, 5, 1}, {0, 4, 5}, {2, 3, 7}, {2, 7, 6},
                                     {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
    struct faces box = faces_make(8, 12);
    double m[3][3];
    turn_box(m);
    for (int i = 0; i < 8; i++) {
        const double corner[3] = {i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1};
        for (int row = 0; row < 3; row++)
            for (int c = 0; c < 3; c++)
                box.positions[3 * i + row] += (float)(m[row][c] * (corner[c] - eye[c]));
    }
    for (int i = 0; i < 12; i++)
        put_face(&box, i, walls[i][0], walls[i][1], walls[i][2]);
    return box;
}

static raster_mesh_params look_along_z(double near_plane, double far_plane, int width, int height)
{
    const double depth = far_plane / (far_plane - near_plane);
    return (raster_mesh_params){.to_clip = {.xx = (float)height / (float)width,
                                            .yy = 1,
                                            .zz = (float)depth,
                                            .zw = (float)(-depth * near_plane),
                                            .wz = 1},
                                .ambient = 1};
}

// The error of a pixel's depth, against the wall that the pixel shows, where the ray meets it.
static double depth_error(const raster_mesh_params *p, const struct faces *box,
                          const struct faces_drawn *drawn, int px, int py)
{
    const int wall = (int)faces_value(drawn, px, py, 0) - 1;
    assert_between(wall, 0, box->face_count - 1);
    const struct oracle_face face =
        oracle_face_at((const float *)&p->to_clip, box->positions, box->indices + 3 * (size_t)wall,
                       drawn->width, drawn->height);
    const struct oracle_outline outline = oracle_outline_of(&face);
    struct oracle_hit hit;
    assert_above(oracle_margin(&outline, px, py), -1.0 / 256); // snapping moves it as much
    assert_true(oracle_hit(&face, px, py, &hit));
    return fabs((double)drawn->depth[py * drawn->width + px] - hit.depth);
}

static void a_box_around_the_eye_covers_each_pixel_once(void **state)
{
    enum { WIDTH = 160, HEIGHT = 90, BOXES = 100 };
    int *due = malloc(WIDTH * HEIGHT * sizeof(*due));
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        due[i] = 1;
    double worst = 0;
    for (int i = 0; i < BOXES; i++) {
        seed((uint32_t)i);
        const double eye[3] = {between(-0.7, 0.7), between(-0.7, 0.7), between(-0.7, 0.7)};
        struct faces box = box_around(eye);
        const raster_mesh_params p = look_along_z(between(0.01, 0.1), 5, WIDTH, HEIGHT);
        struct faces_on on;
        faces_upload(*state, &box, &on);
        int *layers = faces_layers(&on, &p, WIDTH, HEIGHT, RG_CULL_NONE);
        expect_layers(layers, due, WIDTH, HEIGHT, "a box around the eye");
        struct faces_drawn drawn =
            faces_draw(&on, on.test, &p,
                       &(struct faces_way){WIDTH, HEIGHT, RG_RGBA32F, RG_BLEND_OFF, RG_DEPTH_WRITE,
                                           RG_CULL_NONE, false});
        for (int py = 0; py < HEIGHT; py += 3)
            for (int px = 0; px < WIDTH; px += 3)
                worst = fmax(worst, depth_error(&p, &box, &drawn, px, py));
        faces_drawn_free(&drawn);
        free(layers);
        faces_close(&on);
        faces_free(&box);
    }
    free(due);
    print_message("depth in %d boxes: at most %.2g off\n", BOXES, worst);
    assert_below(worst, 1e-6);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_screen_of_two_faces_covers_each_pixel_once),
        cmocka_unit_test(neighbours_cover_each_pixel_once),
        cmocka_unit_test(culling_goes_by_the_turn_on_the_screen),
        cmocka_unit_test(huge_neighbours_cover_each_pixel_once),
        cmocka_unit_test(a_box_around_the_eye_covers_each_pixel_once),
    };
    return raster_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
