// Edges of made-up meshes: faces that turn the same way, one turned inside out, three that meet in
// an edge, and one that is halved.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "core/scene/mesh/edges.h"
#include "core/scene/mesh/mesh.h"
#include "tests/tools/expect.h"

// A roof whose ridge runs from (0, 0, 0) to (0, 0, 1); its eaves are at x = -1 and 1, y = -1. A
// third face stands upright on the ridge.
static const float places[] = {0, 0, 0, 0, 0, 1, 1, -1, 0, -1, -1, 0, 0, 1, 0};
static const double outwards = 0.70710678118654752;

// The normals of the two faces beside the ridge.
static void ridge_of(const struct rg_edges *edges, double first[3], double second[3])
{
    int found = 0;
    for (int e = 0; e < edges->count; e++) {
        double word[RG_EDGE_WORDS];
        for (int w = 0; w < RG_EDGE_WORDS; w++)
            word[w] = (double)edges->words[w * edges->count + e];
        const bool is_ridge = word[0] == 0 && word[1] == 0 && word[3] == 0 && word[4] == 0;
        if (!is_ridge || (word[9] == 0 && word[10] == 0 && word[11] == 0))
            continue;
        for (int c = 0; c < 3; c++) {
            first[c] = word[RG_EDGE_NORMALS + c];
            second[c] = word[RG_EDGE_NORMALS + 3 + c];
        }
        found++;
    }
    assert_int_equal(found, 1);
}

static void assert_vector(const double v[3], double x, double y, double z)
{
    if (!(fabs(v[0] - x) < 1e-6 && fabs(v[1] - y) < 1e-6 && fabs(v[2] - z) < 1e-6))
        fail_msg("(%g, %g, %g), not (%g, %g, %g)", v[0], v[1], v[2], x, y, z);
}

// Both normals are on the outer side of the first face, whichever way the second face turns.
static void test_two_faces(void **state)
{
    (void)state;
    static const uint32_t faces[2][6] = {{0, 1, 2, 1, 0, 3}, {0, 1, 2, 0, 1, 3}};
    for (int i = 0; i < 2; i++) {
        struct rg_mesh *mesh = rg_mesh_create("roof", 4, 2, places, NULL, faces[i]);
        struct rg_edges edges;
        double first[3], second[3];
        assert_non_null(mesh);
        assert_true(rg_mesh_edges(mesh, &edges));
        assert_int_equal(edges.count, 5);
        ridge_of(&edges, first, second);
        assert_vector(first, outwards, outwards, 0);
        assert_vector(second, -outwards, outwards, 0);
        rg_edges_free(&edges);
        rg_mesh_destroy(mesh);
    }
}

// With three faces at an edge, the first pairs with the one that turns the other way round.
static void test_three_faces(void **state)
{
    (void)state;
    static const uint32_t faces[] = {0, 1, 2, 0, 1, 4, 1, 0, 3};
    struct rg_mesh *mesh = rg_mesh_create("roof", 5, 3, places, NULL, faces);
    struct rg_edges edges;
    double first[3], second[3];
    assert_non_null(mesh);
    assert_true(rg_mesh_edges(mesh, &edges));
    assert_int_equal(edges.count, 8);
    ridge_of(&edges, first, second);
    assert_vector(first, outwards, outwards, 0);
    assert_vector(second, -outwards, outwards, 0);
    rg_edges_free(&edges);
    rg_mesh_destroy(mesh);
}

// Refining halves the longest edge, from the ridge to an eave. The normal in its middle leans half
// as far.
static void test_a_middle(void **state)
{
    (void)state;
    static const uint32_t faces[] = {0, 1, 2, 1, 0, 3};
    struct rg_mesh *mesh = rg_mesh_create("roof", 4, 2, places, NULL, faces);
    assert_non_null(mesh);
    struct rg_mesh *fine = rg_mesh_refine(mesh, 3);
    assert_non_null(fine);
    assert_int_equal(fine->face_count, 3);
    assert_int_equal(fine->vertex_count, 5);
    int found = 0;
    for (int i = 0; i < fine->vertex_count; i++) {
        const float *p = fine->positions + 3 * i, *n = fine->normals + 3 * i;
        if (fabsf(p[0]) != 0.5f)
            continue;
        assert_equals(p[1], -0.5f);
        assert_equals(p[2], 0.5f);
        const double normal[3] = {fabs((double)n[0]), (double)n[1], (double)n[2]};
        assert_vector(normal, sin(M_PI / 8), cos(M_PI / 8), 0);
        found++;
    }
    assert_int_equal(found, 1);
    rg_mesh_destroy(fine);
    rg_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_two_faces),
        cmocka_unit_test(test_three_faces),
        cmocka_unit_test(test_a_middle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
