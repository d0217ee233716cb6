// Meshes drawn with depth: meshes DEVICE. Every byte of colour, depth and winner is
// cpu:reference's.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "tests/core/techniques/rigs/scene.h"

enum { WIDTH = 1280, HEIGHT = 720 };

static void compare(const char *what, const char *of, const void *due, const void *drawn,
                    int words_a_pixel)
{
    const uint32_t *a = due, *b = drawn;
    const int words = WIDTH * HEIGHT * words_a_pixel;
    int differing = 0, first = -1;
    if (!memcmp(due, drawn, (size_t)words * 4))
        return;
    for (int i = 0; i < words; i++) {
        if (a[i] == b[i])
            continue;
        first = first < 0 ? i : first;
        differing++;
    }
    fail_msg("%s: %d words of the %s differ, first at x %d, y %d: %08x, not %08x", what, differing,
             of, first / words_a_pixel % WIDTH, first / words_a_pixel / WIDTH, (unsigned)b[first],
             (unsigned)a[first]);
}

static void compare_program(const char *what, const char *of, const struct faces_on on[2],
                            bool test, const raster_mesh_params *p, const struct faces_way *way)
{
    struct faces_drawn drawn[2];
    for (int d = 0; d < 2; d++)
        drawn[d] = faces_draw(&on[d], test ? on[d].test : on[d].raster, p, way);
    compare(what, of, drawn[0].colour, drawn[1].colour, drawn[0].texel_words);
    compare(what, "depth", drawn[0].depth, drawn[1].depth, 1);
    faces_drawn_free(&drawn[0]);
    faces_drawn_free(&drawn[1]);
}

static void compare_view(const char *what, const struct faces_on on[2],
                         const struct mesh_scene *scene)
{
    const raster_mesh_params p = mesh_scene_look(scene, WIDTH, HEIGHT);
    struct faces_way way = {
        WIDTH, HEIGHT, RG_RGBA16F, RG_BLEND_OFF, RG_DEPTH_WRITE, mesh_scene_cull(scene), false};
    compare_program(what, "colour", on, false, &p, &way);
    way.format = RG_RGBA32F;
    compare_program(what, "winners and their weights", on, true, &p, &way);
}

static void compare_views(struct rg_device *device, const char *mesh, const char *const *views)
{
    struct rg_device *reference = rg_device_open("cpu:reference");
    struct mesh_scene scene = mesh_scene_open(mesh);
    struct faces_on on[2];
    faces_upload(reference, &scene.faces, &on[0]);
    faces_upload(device, &scene.faces, &on[1]);
    for (int i = 0; views[i]; i++) {
        char assignments[256];
        snprintf(assignments, sizeof(assignments), "%s%s%s", mesh, *views[i] ? " " : "", views[i]);
        mesh_scene_set(&scene, assignments);
        compare_view(assignments, on, &scene);
    }
    faces_close(&on[0]);
    faces_close(&on[1]);
    mesh_scene_close(&scene);
    assert_true(rg_device_close(reference));
}

static void the_bunny_from_20_directions(void **state)
{
    char texts[RASTER_VIEWS][16];
    const char *views[RASTER_VIEWS + 1] = {NULL};
    for (int i = 0; i < RASTER_VIEWS; i++) {
        snprintf(texts[i], sizeof(texts[i]), "view=%d", i);
        views[i] = texts[i];
    }
    compare_views(*state, "scene=mesh", views);
}

static void a_million_tiny_triangles(void **state)
{
    compare_views(*state, "scene=triangles", (const char *const[]){"", NULL});
}

// The near plane cuts the mesh, and triangles surround the eye.
static void the_eye_inside_the_mesh(void **state)
{
    compare_views(*state, "scene=mesh",
                  (const char *const[]){"inside=1 view=3", "inside=1 view=9 zoom=0.2 near=0.3",
                                        "near=4.4", "zoom=4.5", NULL});
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_bunny_from_20_directions),
        cmocka_unit_test(a_million_tiny_triangles),
        cmocka_unit_test(the_eye_inside_the_mesh),
    };
    return raster_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
