// The dioramas: their published numbers; faces that look outwards and enclose solids; normals that
// fit their faces; the same build on every machine.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/scene/diorama/diorama.h"
#include "tests/tools/expect.h"

struct vector {
    double x, y, z;
};

static struct vector minus(struct vector a, struct vector b)
{
    return (struct vector){a.x - b.x, a.y - b.y, a.z - b.z};
}

static struct vector cross(struct vector a, struct vector b)
{
    return (struct vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static double dot(struct vector a, struct vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static struct vector at(const float *array, uint32_t i)
{
    const float *v = array + 3 * (size_t)i;
    return (struct vector){(double)v[0], (double)v[1], (double)v[2]};
}

// Twice the area of a face, along its normal.
static struct vector area_of(const struct rg_mesh *mesh, int face)
{
    const uint32_t *k = mesh->indices + 3 * (size_t)face;
    const struct vector a = at(mesh->positions, k[0]);
    return cross(minus(at(mesh->positions, k[1]), a), minus(at(mesh->positions, k[2]), a));
}

// --- places: vertices at the same point are one place ---

struct places {
    int *of_vertex; // the first vertex at the same place
};

static const float *sorted_positions;

static int by_position(const void *a, const void *b)
{
    const int i = *(const int *)a, j = *(const int *)b;
    const int order = memcmp(sorted_positions + 3 * (size_t)i, sorted_positions + 3 * (size_t)j,
                             3 * sizeof(float));
    return order ? order : i - j;
}

static struct places weld(const struct rg_mesh *mesh)
{
    const size_t count = (size_t)mesh->vertex_count;
    struct places p = {malloc(count * sizeof(int))};
    int *order = malloc(count * sizeof(*order));
    assert_true(p.of_vertex && order);
    for (int i = 0; i < mesh->vertex_count; i++)
        order[i] = i;
    sorted_positions = mesh->positions;
    qsort(order, count, sizeof(*order), by_position);
    for (size_t i = 0; i < count; i++) {
        const bool same = i > 0 && !memcmp(mesh->positions + 3 * (size_t)order[i],
                                           mesh->positions + 3 * (size_t)order[i - 1], 12);
        p.of_vertex[order[i]] = same ? p.of_vertex[order[i - 1]] : order[i];
    }
    free(order);
    return p;
}

// An edge of a face, from one place to another.
struct edge {
    int from, to, face;
};

static int by_ends(const void *a, const void *b)
{
    const struct edge *p = a, *q = b;
    return p->from != q->from ? p->from - q->from : p->to != q->to ? p->to - q->to : 0;
}

static struct edge *edges_of(const struct rg_mesh *mesh, const struct places *places)
{
    const size_t count = 3 * (size_t)mesh->face_count;
    struct edge *edges = malloc(count * sizeof(*edges));
    assert_non_null(edges);
    for (size_t i = 0; i < count; i++) {
        const size_t next = i % 3 == 2 ? i - 2 : i + 1;
        edges[i] = (struct edge){places->of_vertex[mesh->indices[i]],
                                 places->of_vertex[mesh->indices[next]], (int)(i / 3)};
    }
    qsort(edges, count, sizeof(*edges), by_ends);
    return edges;
}

static int find(int *parent, int i)
{
    while (parent[i] != i)
        i = parent[i] = parent[parent[i]];
    return i;
}

// --- tests ---

static void sizes_are_as_published(void **state)
{
    (void)state;
    static const int published[DIORAMAS][2] = {{6387, 9907},   {8726, 14240}, {952, 1187},
                                               {19016, 37372}, {5744, 10308}, {25817, 48154},
                                               {4601, 8180}};
    for (int i = 0; i < DIORAMAS; i++) {
        struct diorama *d = diorama_create((enum diorama_scene)i);
        assert_non_null(d);
        assert_int_equal(d->mesh->vertex_count, published[i][0]);
        assert_int_equal(d->mesh->face_count, published[i][1]);
        assert_int_equal(diorama_sizes[i].vertices, published[i][0]);
        assert_int_equal(diorama_sizes[i].faces, published[i][1]);
        for (int face = 0; face < d->mesh->face_count; face++)
            assert_below(d->materials[face], (uint32_t)d->material_count);
        diorama_destroy(d);
    }
}

static void every_machine_builds_the_same(void **state)
{
    (void)state;
    static const uint64_t hashes[DIORAMAS] = {
        0x172fc8901b085909u, 0x0752ceea78b254e5u, 0x2959fe2b2c0cd25du, 0xcc027b538ba11e6cu,
        0x6897c4320cffe606u, 0x4617ac1acf2f160au, 0x5d8f6dff40fec03cu,
    };
    int others = 0;
    for (int i = 0; i < DIORAMAS; i++) {
        struct diorama *d = diorama_create((enum diorama_scene)i);
        if (d->mesh->hash != hashes[i])
            print_message("%s is %#018llx\n", d->mesh->name, (unsigned long long)d->mesh->hash);
        others += d->mesh->hash != hashes[i];
        diorama_destroy(d);
    }
    assert_int_equal(others, 0);
}

static void no_face_is_degenerate(void **state)
{
    (void)state;
    for (int i = 0; i < DIORAMAS; i++) {
        struct diorama *d = diorama_create((enum diorama_scene)i);
        for (int face = 0; face < d->mesh->face_count; face++) {
            const struct vector area = area_of(d->mesh, face);
            assert_above(sqrt(dot(area, area)), 1e-7); // m2
        }
        diorama_destroy(d);
    }
}

// A normal has unit length, and lies on the outer side of its face. Few, on thin rims, may not.
static void normals_fit_their_faces(void **state)
{
    (void)state;
    for (int i = 0; i < DIORAMAS; i++) {
        struct diorama *d = diorama_create((enum diorama_scene)i);
        int off = 0;
        for (int face = 0; face < d->mesh->face_count; face++) {
            const struct vector area = area_of(d->mesh, face);
            for (int k = 0; k < 3; k++) {
                const struct vector n =
                    at(d->mesh->normals, d->mesh->indices[3 * (size_t)face + (size_t)k]);
                assert_below(fabs(dot(n, n) - 1), 1e-5);
                off += dot(n, area) < 0.05 * sqrt(dot(area, area));
            }
        }
        assert_below(off, 3 * d->mesh->face_count / 50);
        diorama_destroy(d);
    }
}

static int count_like(const struct edge *edges, int count, const struct edge *like)
{
    int found = 0;
    for (int i = 0; i < count; i++)
        found += by_ends(&edges[i], like) == 0;
    return found;
}

// Two faces that share an edge run along it in opposite directions. If two solids touch in an edge,
// four faces do, two in each direction.
static void faces_turn_alike(void **state)
{
    (void)state;
    for (int i = 0; i < DIORAMAS; i++) {
        struct diorama *d = diorama_create((enum diorama_scene)i);
        struct places places = weld(d->mesh);
        struct edge *edges = edges_of(d->mesh, &places);
        const int count = 3 * d->mesh->face_count;
        for (int k = 1; k < count; k++) {
            const struct edge back = {edges[k].to, edges[k].from, 0};
            if (by_ends(&edges[k - 1], &edges[k]) == 0)
                assert_int_equal(count_like(edges, count, &back), 2);
        }
        free(edges);
        free(places.of_vertex);
        diorama_destroy(d);
    }
}

// A closed part has a positive volume, so that its faces look outwards. Most of a scene is closed.
static void solids_look_outwards(void **state)
{
    (void)state;
    for (int i = 0; i < DIORAMAS; i++) {
        struct diorama *d = diorama_create((enum diorama_scene)i);
        const struct rg_mesh *mesh = d->mesh;
        struct places places = weld(mesh);
        struct edge *edges = edges_of(mesh, &places);
        const size_t count = (size_t)mesh->vertex_count;
        int *parent = malloc(count * sizeof(*parent)), closed = 0;
        bool *open = calloc(count, sizeof(*open));
        double *volume = calloc(count, sizeof(*volume));
        assert_true(parent && open && volume);
        for (size_t v = 0; v < count; v++)
            parent[v] = (int)v;
        for (int e = 0; e < 3 * mesh->face_count; e++)
            parent[find(parent, edges[e].from)] = find(parent, edges[e].to);
        for (int e = 0; e < 3 * mesh->face_count; e++) {
            const struct edge back = {edges[e].to, edges[e].from, 0};
            if (!bsearch(&back, edges, 3 * (size_t)mesh->face_count, sizeof(back), by_ends))
                open[find(parent, edges[e].from)] = true;
        }
        for (int face = 0; face < mesh->face_count; face++) {
            const uint32_t first = mesh->indices[3 * (size_t)face];
            const int solid = find(parent, places.of_vertex[first]);
            const struct vector area = area_of(mesh, face);
            volume[solid] += dot(at(mesh->positions, first), area) / 6;
            closed += !open[solid];
        }
        for (size_t v = 0; v < count; v++)
            assert_true(open[v] || volume[v] >= 0);
        assert_above(closed, mesh->face_count / 2);
        free(parent);
        free(open);
        free(volume);
        free(edges);
        free(places.of_vertex);
        diorama_destroy(d);
    }
}

static void scenes_stand_on_their_ground(void **state)
{
    (void)state;
    for (int i = 0; i < DIORAMAS; i++) {
        struct diorama *d = diorama_create((enum diorama_scene)i);
        for (int c = 0; c < 3; c += 2)
            assert_true(d->mesh->low[c] < -1.5f && d->mesh->low[c] > -9 &&
                        d->mesh->high[c] > 1.5f && d->mesh->high[c] < 9);
        assert_above(d->mesh->low[1], -0.25f);
        assert_at_most(d->mesh->low[1], 0);
        assert_above(d->mesh->high[1], 0.8f);
        diorama_destroy(d);
    }
}

static void a_mesh_stands_on_a_ground(void **state)
{
    (void)state;
    struct diorama *d = diorama_of_mesh("torus");
    assert_non_null(d);
    assert_int_equal(d->mesh->face_count, 32832);
    assert_below(fabsf(d->mesh->low[1]), 1e-6f);
    assert_below(fabsf(d->mesh->high[0] - 4.5f), 1e-3f);
    assert_int_not_equal(d->materials[0], d->materials[32831]);
    diorama_destroy(d);
    assert_null(diorama_of_mesh(""));
    assert_null(diorama_of_mesh("no/such.obj"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes_are_as_published),
        cmocka_unit_test(every_machine_builds_the_same),
        cmocka_unit_test(no_face_is_degenerate),
        cmocka_unit_test(normals_fit_their_faces),
        cmocka_unit_test(faces_turn_alike),
        cmocka_unit_test(solids_look_outwards),
        cmocka_unit_test(scenes_stand_on_their_ground),
        cmocka_unit_test(a_mesh_stands_on_a_ground),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
