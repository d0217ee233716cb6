// Meshes drawn with depth, against rays: rays DEVICE. Each pixel shows the first face on the ray
// through its centre, at that depth and place of the face. Closed surfaces have no crack and no
// pixel twice.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "kernels/dialect/rng.h"
#include "tests/core/techniques/rigs/scene.h"
#include "tests/oracle/raster.h"
#include "tests/tools/expect.h"

enum { WIDTH = 480, HEIGHT = 270 };

// Corners are snapped to 1/256 pixel, and thus a face's rim moves by no more.
static const double snap_px = 1.0 / 256;

// Errors of single precision in a face's depth and its corners' weights: 32 roundings, and corners
// off by a sixteenth of the grid. The latter matters for thin faces.
static const double rounding = 8.0 / 16777216, place_px = 1.0 / 4096;

// A scene as drawn and as rays see it.
struct view {
    const char *name;
    const struct faces *faces;
    raster_mesh_params params;
    enum rg_cull cull;
};

// A ray's first meeting among the faces that it surely hits.
struct ray {
    double depth;
    double allowed; // the allowed error of the face's depth
    int face;       // -1: none
};

static struct oracle_face face_of(const struct view *view, int index)
{
    return oracle_face_at((const float *)&view->params.to_clip, view->faces->positions,
                          view->faces->indices + 3 * (size_t)index, WIDTH, HEIGHT);
}

// The range of depth over a face's corners; 1 if one is behind the eye.
static double range_of(const struct oracle_face *face)
{
    double low = 1, high = 0;
    for (int k = 0; k < 3; k++) {
        const double *c = face->corners[k];
        if (c[2] < 0 || c[3] <= 0)
            return 1;
        low = fmin(low, c[2] / c[3]);
        high = fmax(high, c[2] / c[3]);
    }
    return high - low;
}

// The allowed error of weights: a distance over the face's thickness, which is its area over its
// longest side.
static double weights_allowed(const struct oracle_outline *o)
{
    double longest = 0;
    for (int i = 0; i < o->count; i++) {
        const int j = (i + 1) % o->count;
        longest = fmax(longest, hypot(o->x[i] - o->x[j], o->y[i] - o->y[j]));
    }
    return rounding + fmin(1, place_px * longest / fabs(o->turn));
}

static double depth_allowed(const struct oracle_face *face, const struct oracle_outline *o)
{
    return rounding + range_of(face) * weights_allowed(o);
}

static bool is_culled(const struct oracle_outline *outline, enum rg_cull cull)
{
    return (cull == RG_CULL_BACK && outline->turn > 0) ||
           (cull == RG_CULL_FRONT && outline->turn < 0);
}

static int clamped(double v, int high)
{
    return v < 0 ? 0 : v > high ? high : (int)v;
}

// The pixels that an outline may cover.
struct box {
    int x0, y0, x1, y1;
};

static struct box box_of(const struct oracle_outline *o)
{
    double low_x = INFINITY, low_y = INFINITY, high_x = -INFINITY, high_y = -INFINITY;
    for (int i = 0; i < o->count; i++) {
        low_x = fmin(low_x, o->x[i]);
        high_x = fmax(high_x, o->x[i]);
        low_y = fmin(low_y, o->y[i]);
        high_y = fmax(high_y, o->y[i]);
    }
    return (struct box){clamped(low_x - 1, WIDTH), clamped(low_y - 1, HEIGHT),
                        clamped(high_x + 1, WIDTH), clamped(high_y + 1, HEIGHT)};
}

static void cast_at(const struct view *view, int index, struct ray *rays)
{
    const struct oracle_face face = face_of(view, index);
    const struct oracle_outline o = oracle_outline_of(&face);
    if (!o.count || is_culled(&o, view->cull))
        return;
    const struct box box = box_of(&o);
    for (int py = box.y0; py < box.y1; py++) {
        for (int px = box.x0; px < box.x1; px++) {
            struct ray *ray = &rays[py * WIDTH + px];
            struct oracle_hit hit;
            if (oracle_margin(&o, px, py) > snap_px && oracle_hit(&face, px, py, &hit) &&
                hit.depth < ray->depth)
                *ray = (struct ray){hit.depth, depth_allowed(&face, &o), index};
        }
    }
}

// The largest errors of the drawing, as parts of the allowed errors, and the pixels that show a
// face.
struct errors {
    double outside, weights, depth, behind;
    int pixels, missing;
};

static void check_pixel(const struct view *view, const struct faces_drawn *drawn, int px, int py,
                        const struct ray *ray, struct errors *e)
{
    const int shown = (int)faces_value(drawn, px, py, 0) - 1;
    if (shown < 0) {
        e->missing += ray->face >= 0;
        return;
    }
    const struct oracle_face face = face_of(view, shown);
    const struct oracle_outline o = oracle_outline_of(&face);
    const double margin = oracle_margin(&o, px, py), allowed = depth_allowed(&face, &o);
    const double depth = (double)drawn->depth[py * WIDTH + px];
    struct oracle_hit hit;
    e->pixels++;
    e->outside = fmax(e->outside, -margin / snap_px);
    e->behind = fmax(e->behind, (depth - ray->depth) / (allowed + ray->allowed));
    if (margin < 0 || !oracle_hit(&face, px, py, &hit))
        return; // on the rim the device keeps weights and depth within the face's range
    e->depth = fmax(e->depth, fabs(depth - hit.depth) / allowed);
    for (int k = 1; k < 3; k++)
        e->weights = fmax(e->weights, fabs((double)faces_value(drawn, px, py, k) - hit.weights[k]) /
                                          weights_allowed(&o));
}

static void check_errors(const struct view *view, const struct errors *e)
{
    print_message("%s: %d pixels; of what is allowed, outside %.2f, weights %.2f, depth %.2f, "
                  "behind %.2f\n",
                  view->name, e->pixels, e->outside, e->weights, e->depth, e->behind);
    assert_above(e->pixels, WIDTH * HEIGHT / 20); // otherwise it shows little
    if (e->missing || e->outside > 1 || e->weights > 1 || e->depth > 1 || e->behind > 1)
        fail_msg("%s: %d pixels are missing, or more is off than allowed", view->name, e->missing);
}

static void check_rays(struct rg_device *device, const struct view *view)
{
    struct faces_on on;
    faces_upload(device, view->faces, &on);
    struct faces_drawn drawn =
        faces_draw(&on, on.test, &view->params,
                   &(struct faces_way){WIDTH, HEIGHT, RG_RGBA32F, RG_BLEND_OFF, RG_DEPTH_WRITE,
                                       view->cull, false});
    struct ray *rays = malloc(WIDTH * HEIGHT * sizeof(*rays));
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        rays[i] = (struct ray){INFINITY, 0, -1};
    for (int i = 0; i < view->faces->face_count; i++)
        cast_at(view, i, rays);
    struct errors e = {0};
    for (int py = 0; py < HEIGHT; py++)
        for (int px = 0; px < WIDTH; px++)
            check_pixel(view, &drawn, px, py, &rays[py * WIDTH + px], &e);
    check_errors(view, &e);
    free(rays);
    faces_drawn_free(&drawn);
    faces_close(&on);
}

static void meshes_show_what_rays_meet(void **state)
{
    static const char *const scenes[] = {
        "scene=mesh",
        "scene=mesh view=7 zoom=3",
        "scene=mesh model=torus view=12",
        "scene=mesh model=torus near=3.8",
        "scene=mesh inside=1 view=9 zoom=0.2 near=0.3",
        "scene=mesh model=sphere faces=300 inside=1",
        "scene=triangles triangles=20000 view=5",
        "scene=triangles triangles=1000 inside=1 near=0.5",
    };
    for (size_t i = 0; i < sizeof(scenes) / sizeof(scenes[0]); i++) {
        struct mesh_scene scene = mesh_scene_open(scenes[i]);
        check_rays(*state,
                   &(struct view){scenes[i], &scene.faces, mesh_scene_look(&scene, WIDTH, HEIGHT),
                                  mesh_scene_cull(&scene)});
        mesh_scene_close(&scene);
    }
}

// Faces of all sizes that cut each other, in front of the eye and behind it.
static void faces_through_each_other_show_what_rays_meet(void **state)
{
    enum { FACES = 400 };
    struct faces faces = faces_make(3 * FACES, FACES);
    for (int i = 0; i < 3 * FACES; i++) {
        const rg_uint4 at = rg_random(3, (uint32_t)i / 3, 0, 1),
                       off = rg_random(3, (uint32_t)i, 1, 1);
        const float size = 4 * rg_uniform(at.w) * rg_uniform(at.w);
        float *p = faces.positions + 3 * i;
        p[0] = 8 * rg_uniform(at.x) - 4 + size * (rg_uniform(off.x) - 0.5f);
        p[1] = 6 * rg_uniform(at.y) - 3 + size * (rg_uniform(off.y) - 0.5f);
        p[2] = 6 * rg_uniform(at.z) - 1 + size * (rg_uniform(off.z) - 0.5f);
        faces.indices[i] = (uint32_t)i;
    }
    const raster_mesh_params p = {
        .to_clip = {.xx = 0.5625f, .yy = 1, .zz = 1.02f, .zw = -0.306f, .wz = 1}};
    check_rays(*state, &(struct view){"faces through each other", &faces, p, RG_CULL_NONE});
    faces_free(&faces);
}

// --- closed surfaces ---

// A ray enters a closed surface as often as it leaves it. The fill rule gives a centre on an edge
// to one side, whichever way faces look. Faces thinner than the grid are an exception. Culling goes
// by a face's turn before snapping, and snapping may turn the face over.
static void check_closed(struct rg_device *device, const char *assignments)
{
    struct mesh_scene scene = mesh_scene_open(assignments);
    const raster_mesh_params p = mesh_scene_look(&scene, WIDTH, HEIGHT);
    struct faces_on on;
    faces_upload(device, &scene.faces, &on);
    int *front = faces_layers(&on, &p, WIDTH, HEIGHT, RG_CULL_BACK);
    int *back = faces_layers(&on, &p, WIDTH, HEIGHT, RG_CULL_FRONT);
    int covered = 0, several = 0, unequal = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        covered += front[i] > 0;
        several += front[i] > 1;
        unequal += front[i] != back[i];
    }
    print_message("%s: %d pixels covered, %d by several layers, %d unequal\n", assignments, covered,
                  several, unequal);
    assert_above(several, 0);
    assert_at_most(unequal, covered / 10000);
    free(front);
    free(back);
    faces_close(&on);
    mesh_scene_close(&scene);
}

static void rays_leave_what_they_enter(void **state)
{
    check_closed(*state, "scene=mesh");
    check_closed(*state, "scene=mesh model=torus");
    check_closed(*state, "scene=triangles triangles=100000");
}

// The convex hull of a mesh's corners on the screen.
struct hull {
    int count;
    struct oracle_place *corners;
};

static struct hull hull_of(const struct view *view)
{
    const int count = 3 * view->faces->face_count;
    struct oracle_place *places = malloc((size_t)count * sizeof(*places));
    struct hull hull = {0, malloc(2 * (size_t)count * sizeof(*places))};
    for (int i = 0; i < count; i++) {
        const struct oracle_face face = face_of(view, i / 3);
        const double *c = face.corners[i % 3];
        places[i] =
            (struct oracle_place){(c[0] / c[3] + 1) / 2 * WIDTH, (c[1] / c[3] + 1) / 2 * HEIGHT};
    }
    hull.count = oracle_hull(places, count, hull.corners);
    free(places);
    return hull;
}

// Faces on the rim are seen from the side, and snapping may fold them over.
static void a_ball_covers_its_disc_once(void **state)
{
    struct mesh_scene scene = mesh_scene_open("scene=mesh model=sphere");
    const struct view view = {"ball", &scene.faces, mesh_scene_look(&scene, WIDTH, HEIGHT),
                              RG_CULL_BACK};
    struct hull hull = hull_of(&view);
    struct faces_on on;
    faces_upload(*state, &scene.faces, &on);
    int *layers = faces_layers(&on, &view.params, WIDTH, HEIGHT, RG_CULL_BACK);
    int on_rim = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const double margin =
            oracle_inside_px(hull.corners, hull.count,
                             (struct oracle_place){i % WIDTH + 0.5, (double)(i / WIDTH) + 0.5});
        const int due = margin > 0;
        on_rim += fabs(margin) < 2 * snap_px;
        if (fabs(margin) >= 2 * snap_px && layers[i] != due)
            fail_msg("x %d, y %d, %g px inside, is covered %d times", i % WIDTH, i / WIDTH, margin,
                     layers[i]);
    }
    print_message("a ball: %d pixels on its rim\n", on_rim);
    assert_below(on_rim, 50);
    free(layers);
    free(hull.corners);
    faces_close(&on);
    mesh_scene_close(&scene);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meshes_show_what_rays_meet),
        cmocka_unit_test(faces_through_each_other_show_what_rays_meet),
        cmocka_unit_test(rays_leave_what_they_enter),
        cmocka_unit_test(a_ball_covers_its_disc_once),
    };
    return raster_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
