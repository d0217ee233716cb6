// Outlines of known cases: which edges of a cube, a ball and a sheet are drawn, their width, and
// hidden edges.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/scene/matrix.h"
#include "core/scene/mesh/edges.h"
#include "tests/core/techniques/cartoon/rig.h"
#include "tests/core/techniques/cartoon/scene/shapes.h"
#include "tests/tools/expect.h"

enum { SIZE = 240 };
static const double ANGLE_DEG = 40;

// --- drawing ---

struct pen {
    double contour_px, crease_px, crease_deg, full_m;
};

// A mesh's outlines, seen from one place towards another.
struct drawing {
    struct rg_edges edges;
    float *ink;        // of each pixel, 0 to 1
    uint32_t *samples; // of each edge drawn alone
};

static struct rg_camera camera_at(const double eye[3], const double target[3])
{
    struct rg_camera camera = {
        .up = {0, 1, 0}, .angle_deg = (float)ANGLE_DEG, .near_plane = 0.1f, .far_plane = 100};
    for (int i = 0; i < 3; i++) {
        camera.position[i] = (float)eye[i];
        camera.target[i] = (float)target[i];
    }
    return camera;
}

static cartoon_ink_params params_of(const struct rg_camera *camera, const struct pen *pen,
                                    int edges)
{
    const struct rg_camera_axes axes = rg_camera_axes(camera);
    const double px = 2 * tan(ANGLE_DEG / 360 * M_PI) / SIZE;
    float to_clip[16];
    assert_true(rg_camera_matrix(camera, 1, to_clip));
    return (cartoon_ink_params){
        .to_clip = rg_m4_of(to_clip),
        .eye_x = camera->position[0],
        .eye_y = camera->position[1],
        .eye_z = camera->position[2],
        .right_x = (float)(axes.right[0] * px),
        .right_y = (float)(axes.right[1] * px),
        .right_z = (float)(axes.right[2] * px),
        .down_x = (float)(-axes.up[0] * px),
        .down_y = (float)(-axes.up[1] * px),
        .down_z = (float)(-axes.up[2] * px),
        .depth_fall = (float)(0.1 * 100 / (100 - 0.1)),
        .cos_crease = (float)cos(pen->crease_deg / 180 * M_PI),
        .contour_px = (float)pen->contour_px,
        .crease_px = (float)pen->crease_px,
        .full_m = (float)pen->full_m,
        .count = edges,
    };
}

static struct rg_buf *buffer_of(struct rg_device *device, const void *words, int64_t count)
{
    struct rg_buf *buf = rg_buf_create(device, 4 * count, "words");
    assert_non_null(buf);
    if (words)
        assert_true(rg_buf_write(buf, 0, words, 4 * count));
    return buf;
}

static struct rg_image *image_of(struct rg_device *device, enum rg_format format)
{
    const float one = 1;
    const struct rg_image_desc desc = {format, SIZE, SIZE, 1, 1};
    struct rg_image *image = format == RG_D32F ? rg_image_create_with(device, &desc, &one, "depth")
                                               : rg_image_create(device, &desc, "normals");
    assert_non_null(image);
    return image;
}

static void draw_depth(struct rg_device *device, const struct rg_mesh *mesh, m4 to_clip,
                       struct rg_image *depth)
{
    uint32_t *normals = rg_mesh_pack_normals(mesh);
    uint32_t *materials = calloc((size_t)mesh->face_count, sizeof(*materials));
    assert_true(normals && materials);
    struct rg_buf *bufs[4] = {buffer_of(device, mesh->positions, 3 * (int64_t)mesh->vertex_count),
                              buffer_of(device, normals, mesh->vertex_count),
                              buffer_of(device, mesh->indices, 3 * (int64_t)mesh->face_count),
                              buffer_of(device, materials, mesh->face_count)};
    struct rg_image *colour = image_of(device, RG_RGBA16F);
    struct rg_pass *pass = rg_pass_create(device, "cartoon_faces");
    const cartoon_faces_params params = {to_clip, 0};
    const struct rg_draw draw = {.colour = colour, .depth = depth, .depth_mode = RG_DEPTH_WRITE};
    struct rg_run run = {.params = &params, .extent = {mesh->face_count, 1, 1}, .draw = &draw};
    for (int i = 0; i < 4; i++)
        run.slots[1 + i].buf = bufs[i];
    assert_true(pass && rg_pass_run(pass, &run));
    rg_pass_destroy(pass);
    rg_image_destroy(colour);
    for (int i = 0; i < 4; i++)
        rg_buf_destroy(bufs[i]);
    free(normals);
    free(materials);
}

// Draws the edges twice: to see them, and to count the pixels of each edge.
static void draw_edges(struct rg_device *device, const cartoon_ink_params *params,
                       struct rg_image *depth, struct drawing *d)
{
    const int count = d->edges.count;
    d->ink = malloc(sizeof(float) * SIZE * SIZE);
    d->samples = calloc((size_t)count, sizeof(*d->samples));
    assert_true(d->ink && d->samples);
    struct rg_buf *edges = buffer_of(device, d->edges.words, (int64_t)count * RG_EDGE_WORDS);
    struct rg_buf *samples = buffer_of(device, d->samples, count);
    struct rg_image *ink = image_of(device, RG_D32F);
    struct rg_pass *pass = rg_pass_create(device, "cartoon_ink");
    struct rg_draw draw = {.depth = ink, .depth_mode = RG_DEPTH_TEST, .samples = samples};
    struct rg_run run = {.params = params, .extent = {count, 1, 1}, .draw = &draw};
    run.slots[1].buf = edges;
    run.slots[2].image = depth;
    assert_true(pass && rg_pass_run(pass, &run));
    draw = (struct rg_draw){.depth = ink, .depth_mode = RG_DEPTH_WRITE};
    assert_true(rg_pass_run(pass, &run));
    assert_true(rg_buf_read(samples, 0, d->samples, 4 * (int64_t)count));
    assert_true(rg_image_read(ink, 0, 0, d->ink));
    for (int i = 0; i < SIZE * SIZE; i++)
        d->ink[i] = 1 - d->ink[i];
    rg_pass_destroy(pass);
    rg_image_destroy(ink);
    rg_buf_destroy(edges);
    rg_buf_destroy(samples);
}

static struct drawing outline(struct rg_device *device, const struct shape *shape,
                              const double eye[3], const double target[3], struct pen pen)
{
    struct drawing d;
    struct rg_mesh *mesh = shape_mesh(shape);
    const struct rg_camera camera = camera_at(eye, target);
    assert_true(rg_mesh_edges(mesh, &d.edges));
    const cartoon_ink_params params = params_of(&camera, &pen, d.edges.count);
    struct rg_image *depth = image_of(device, RG_D32F);
    draw_depth(device, mesh, params.to_clip, depth);
    draw_edges(device, &params, depth, &d);
    rg_image_destroy(depth);
    rg_mesh_destroy(mesh);
    return d;
}

static void drawing_free(struct drawing *d)
{
    rg_edges_free(&d->edges);
    free(d->ink);
    free(d->samples);
}

static double word(const struct drawing *d, int edge, int which)
{
    return (double)d->edges.words[which * d->edges.count + edge];
}

// How many edges cover at least this many pixels.
static int count_drawn(const struct drawing *d, uint32_t least)
{
    int drawn = 0;
    for (int i = 0; i < d->edges.count; i++)
        drawn += d->samples[i] >= least;
    return drawn;
}

static double ink_of_rect(const struct drawing *d, int x0, int y0, int x1, int y1)
{
    double sum = 0;
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++)
            sum += (double)d->ink[y * SIZE + x];
    return sum;
}

static struct shape *shape_new(void)
{
    struct shape *s = calloc(1, sizeof(*s));
    assert_non_null(s);
    return s;
}

static const double origin[3] = {0, 0, 0}, half[3] = {0.5, 0.5, 0.5}, minus[3] = {-0.5, -0.5, -0.5};
static const struct pen contours = {2, 0, 40, 1000}, creases = {0, 2, 40, 1000},
                        both = {2, 2, 40, 1000};

// --- edges ---

static void edges_of_a_cube(void **state)
{
    (void)state;
    struct shape *s = shape_new();
    struct drawing d = {0};
    shape_box(s, minus, half);
    struct rg_mesh *mesh = shape_mesh(s);
    assert_true(rg_mesh_edges(mesh, &d.edges));
    int flat = 0, right = 0;
    assert_int_equal(d.edges.count, 18); // 12, and a diagonal of each side
    for (int i = 0; i < 18; i++) {
        double dot = 0;
        for (int c = 0; c < 3; c++)
            dot += word(&d, i, 6 + c) * word(&d, i, 9 + c);
        flat += fabs(dot - 1) < 1e-6;
        right += fabs(dot) < 1e-6;
    }
    assert_int_equal(flat, 6);
    assert_int_equal(right, 12);
    rg_mesh_destroy(mesh);
    rg_edges_free(&d.edges);
    free(s);
}

// A third face at an edge has no partner. A face that turns the other way counts as turned over.
static void edges_of_odd_faces(void **state)
{
    (void)state;
    const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0.5f, 0, 1};
    const uint32_t three[] = {0, 1, 2, 1, 0, 3, 0, 1, 4}, turned[] = {0, 1, 2, 0, 1, 3};
    struct drawing d = {0};
    struct rg_mesh *mesh = rg_mesh_create("three", 5, 3, positions, NULL, three);
    assert_true(mesh && rg_mesh_edges(mesh, &d.edges));
    assert_int_equal(d.edges.count, 8);
    rg_edges_free(&d.edges);
    rg_mesh_destroy(mesh);
    mesh = rg_mesh_create("turned", 4, 2, positions, NULL, turned);
    assert_true(mesh && rg_mesh_edges(mesh, &d.edges));
    assert_int_equal(d.edges.count, 5);
    for (int i = 0; i < 5; i++) {
        const double n = word(&d, i, 8), m = word(&d, i, 11);
        assert_true(m == 0 || n * m > 0.99); // flat, not folded
    }
    rg_edges_free(&d.edges);
    rg_mesh_destroy(mesh);
}

// --- what is drawn ---

// From a corner one sees nine edges of a cube; six of them are its contour.
static void a_cube_from_a_corner(void **state)
{
    const double eye[3] = {2.0, 2.4, 2.8};
    struct shape *s = shape_new();
    shape_box(s, minus, half);
    const struct {
        struct pen pen;
        int seen;
    } cases[] = {{contours, 6},          {creases, 3},           {both, 9},
                 {{0, 2, 100, 1000}, 0}, {{2, 2, 100, 1000}, 6}, {{0, 0, 40, 1000}, 0}};
    for (size_t k = 0; k < sizeof(cases) / sizeof(cases[0]); k++) {
        struct drawing d = outline(*state, s, eye, origin, cases[k].pen);
        assert_int_equal(count_drawn(&d, 60), cases[k].seen);
        assert_int_equal(count_drawn(&d, 16), cases[k].seen); // the others not even in part
        drawing_free(&d);
    }
    free(s);
}

// A ball's contour is a circle: the cone from the eye touches it.
static void a_ball_has_a_round_contour(void **state)
{
    const double eye[3] = {0, 0.3, 4}, distance = sqrt(0.09 + 16);
    const double focal = SIZE / 2.0 / tan(ANGLE_DEG / 360 * M_PI);
    const double radius_px = focal / sqrt(distance * distance - 1);
    struct shape *s = shape_new();
    bool met[360] = {false};
    shape_ball(s, 1, 60, 120);
    struct drawing d = outline(*state, s, eye, origin, contours);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const double x = i % SIZE + 0.5 - SIZE / 2.0, y = i / SIZE + 0.5 - SIZE / 2.0;
        const double off = hypot(x, y) - radius_px;
        if (d.ink[i] <= 0)
            continue;
        // A polygon's edges zigzag about the circle by half a face, and lie inside it by their
        // sagitta.
        assert_below(off, 2.1);
        assert_above(off, -4.5);
        if (d.ink[i] > 0.5f)
            met[(int)(atan2(y, x) / M_PI * 180 + 360) % 360] = true;
    }
    for (int i = 0; i < 360; i++)
        assert_true(met[i]);
    drawing_free(&d);
    d = outline(*state, s, eye, origin, creases);
    assert_int_equal(count_drawn(&d, 1), 0);
    drawing_free(&d);
    free(s);
}

static void add_sheet(struct shape *s, double x0, double x1, double y0, double y1, double z)
{
    const double corners[4][3] = {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
    shape_quad(s, corners);
}

// The left side of a sheet that falls away, from 3 m ahead to 6 m. It crosses a pixel's row for
// each third of a column, and is as wide as its farther end.
static void a_receding_line_has_its_far_end_s_width(void **state)
{
    const double corners[4][3] = {{-1, -1, 1}, {1, -1, 1}, {1, 1, -2}, {-1, 1, -2}};
    const double eye[3] = {0, 0, 4};
    const struct pen pen = {3, 0, 40, 3};
    struct shape *s = shape_new();
    shape_quad(s, corners);
    struct drawing d = outline(*state, s, eye, origin, pen);
    const double across = ink_of_rect(&d, 0, 100, SIZE / 2, 140) / 40;
    assert_below(fabs(across / sqrt(1 + 1 / 9.0) - 1.5), 0.04);
    drawing_free(&d);
    free(s);
}

// A sheet has its boundary drawn, seen from either side, and not its diagonal. A line has the width
// that was asked for, and less beyond a distance.
static void a_sheet_has_a_boundary(void **state)
{
    struct shape *s = shape_new();
    add_sheet(s, -1, 1, -1, 1, 0);
    for (int side = -1; side <= 1; side += 2) {
        const double eye[3] = {0, 0, 4.0 * side};
        const struct pen pens[] = {{3, 0, 40, 1000}, {3, 0, 40, 2}, {4.5, 1, 170, 4}};
        const double due[] = {3, 1.5, 4.5};
        for (int k = 0; k < 3; k++) {
            struct drawing d = outline(*state, s, eye, origin, pens[k]);
            assert_int_equal(count_drawn(&d, 60), 4);
            const double width = ink_of_rect(&d, 100, 0, 140, SIZE / 2) / 40;
            assert_below(fabs(width - due[k]), 0.04);
            assert_equals(ink_of_rect(&d, 60, 60, 180, 180), 0); // inside the sheet
            drawing_free(&d);
        }
    }
    free(s);
}

// --- what is hidden ---

static void a_wall_hides_what_is_behind(void **state)
{
    const double eye[3] = {0.4, 0.9, 6}, low[3] = {-0.4, -0.4, -0.4}, high[3] = {0.4, 0.4, 0.4};
    struct shape *s = shape_new();
    shape_box(s, low, high);
    add_sheet(s, -1.2, 1.2, -1.2, 1.2, 1.5);
    struct drawing d = outline(*state, s, eye, origin, both);
    assert_int_equal(count_drawn(&d, 1), 4); // the wall's boundary
    drawing_free(&d);
    free(s);
}

// A wall facing the viewer hides lines close behind it, at a quarter of a hundredth of its
// distance.
static void a_wall_hides_what_is_close_behind(void **state)
{
    const double eye[3] = {0, 0, 5};
    struct shape *s = shape_new();
    add_sheet(s, -0.5, 0.5, -0.5, 0.5, -0.012);
    add_sheet(s, -1, 1, -1, 1, 0);
    struct drawing d = outline(*state, s, eye, origin, both);
    assert_int_equal(count_drawn(&d, 1), 4);
    drawing_free(&d);
    free(s);
}

// A line ends within a pixel of where it goes behind a wall.
static void a_line_ends_behind_a_wall(void **state)
{
    const double eye[3] = {0, 0, 5};
    struct shape *s = shape_new();
    add_sheet(s, -1.5, 1.5, -0.5, 0.5, 0);
    add_sheet(s, -1.5, 0, -1, 1, 1); // its rim is in the picture's middle
    struct drawing d = outline(*state, s, eye, origin, (struct pen){2, 0, 40, 1000});
    const double focal = SIZE / 2.0 / tan(ANGLE_DEG / 360 * M_PI);
    const int row = (int)(SIZE / 2.0 - 0.5 * focal / 5);
    assert_below(fabs(ink_of_rect(&d, 125, row - 3, 165, row + 4) - 80), 2);
    assert_equals(ink_of_rect(&d, 75, row - 3, 116, row + 4), 0);
    drawing_free(&d);
    free(s);
}

// In a corner both faces come nearer on either side of the crease. It must be drawn all the same.
static void a_crease_in_a_corner_is_whole(void **state)
{
    const double floor_at[4][3] = {{-2, 0, 2}, {2, 0, 2}, {2, 0, -1}, {-2, 0, -1}};
    struct shape *s = shape_new();
    shape_quad(s, floor_at);
    add_sheet(s, -2, 2, 0, 3, -1);
    for (int k = 0; k < 4; k++) {
        const double eye[3] = {0.3 * k, 0.25 + 0.6 * k, 3.5 - 0.4 * k}, target[3] = {0, 0.1, -1};
        struct drawing d = outline(*state, s, eye, target, creases);
        uint32_t most = 0;
        for (int i = 0; i < d.edges.count; i++)
            most = d.samples[i] > most ? d.samples[i] : most;
        int columns = 0;
        for (int x = 0; x < SIZE; x++)
            columns += ink_of_rect(&d, x, 0, x + 1, SIZE) > 1.6;
        assert_above(most, 2 * SIZE);
        assert_above(columns, SIZE - 4);
        drawing_free(&d);
    }
    free(s);
}

// A thin board's far lower edges are close behind its top.
static void a_thin_board_hides_its_back(void **state)
{
    const double low[3] = {-1, -0.04, -1}, high[3] = {1, 0.04, 1}, eye[3] = {0.3, 1.6, 3.2};
    struct shape *s = shape_new();
    shape_box(s, low, high);
    struct drawing d = outline(*state, s, eye, origin, (struct pen){1, 1, 40, 1000});
    for (int i = 0; i < d.edges.count; i++) {
        const bool is_hidden =
            word(&d, i, 1) < 0 && word(&d, i, 4) < 0 && word(&d, i, 2) < 0 && word(&d, i, 5) < 0;
        if (is_hidden)
            assert_between(d.samples[i], 0, 12);
    }
    assert_int_equal(count_drawn(&d, 60), 5); // four above, one below; upright ones are short
    drawing_free(&d);
    free(s);
}

// A line ends beyond its corner in a quarter of a disc, as wide as the line.
static void ends_are_round(void **state)
{
    const double eye[3] = {0, 0, 4}, focal = SIZE / 2.0 / tan(ANGLE_DEG / 360 * M_PI);
    const double side = 60 * 4 / focal; // 60 pixels in the picture
    struct shape *s = shape_new();
    add_sheet(s, -side, side, -side, side, 0);
    struct drawing d = outline(*state, s, eye, origin, (struct pen){8, 0, 40, 1000});
    const double due = M_PI / 4 * (4 * 4 + 1 / 12.0);
    assert_below(fabs(ink_of_rect(&d, 180, 180, SIZE, SIZE) - due), 0.5);
    drawing_free(&d);
    free(s);
}

// Lines that cross are as dark as one: a pixel never has more ink than its darkest line.
static void crossings_are_no_darker(void **state)
{
    const double eye[3] = {0, 0, 4};
    struct shape *s = shape_new();
    add_sheet(s, -0.8, 0.8, -0.5, 0.5, 0);
    add_sheet(s, -0.5, 0.5, -0.8, 0.8, 0);
    struct drawing d = outline(*state, s, eye, origin, (struct pen){3, 0, 40, 1000});
    for (int i = 0; i < SIZE * SIZE; i++)
        assert_true(d.ink[i] >= 0 && d.ink[i] <= 1);
    const double focal = SIZE / 2.0 / tan(ANGLE_DEG / 360 * M_PI);
    const int at = (int)(SIZE / 2.0 + 0.5 * focal / 4); // where two boundaries cross
    const double crossed = ink_of_rect(&d, at - 6, at - 6, at + 6, at + 6);
    assert_below(fabs(crossed - (2 * 3 * 12 - 9)), 1.2);
    drawing_free(&d);
    free(s);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_of_a_cube),
        cmocka_unit_test(edges_of_odd_faces),
        cmocka_unit_test(a_cube_from_a_corner),
        cmocka_unit_test(a_ball_has_a_round_contour),
        cmocka_unit_test(a_receding_line_has_its_far_end_s_width),
        cmocka_unit_test(a_sheet_has_a_boundary),
        cmocka_unit_test(a_wall_hides_what_is_behind),
        cmocka_unit_test(a_wall_hides_what_is_close_behind),
        cmocka_unit_test(a_line_ends_behind_a_wall),
        cmocka_unit_test(a_crease_in_a_corner_is_whole),
        cmocka_unit_test(a_thin_board_hides_its_back),
        cmocka_unit_test(ends_are_round),
        cmocka_unit_test(crossings_are_no_darker),
    };
    return rig_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
