// Meshes in memory and by name: joining, normals, other numbers of faces, and models of packages.
#include "tests/core/scene/mesh/rig.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/scene/mesh/edges.h"
#include "core/scene/mesh/models.h"
#include "tests/tools/expect.h"

// --- in memory ---

static void test_equal_vertices_are_joined(void **state)
{
    (void)state;
    // Two triangles with corners of their own; -0 counts as 0, and 1e-40 is too small to keep.
    static const float positions[18] = {0,     0, 0, 1, 0,      0, 0, 1, 0,
                                        -0.0f, 1, 0, 1, 1e-40f, 0, 1, 1, 0};
    static const uint32_t indices[6] = {0, 1, 2, 3, 4, 5};
    static const uint32_t joined[6] = {0, 1, 2, 2, 1, 3};
    struct rg_mesh *mesh = rg_mesh_create("two", 6, 2, positions, NULL, indices);
    check_mesh(mesh);
    assert_int_equal(mesh->vertex_count, 4);
    assert_memory_equal(mesh->indices, joined, sizeof(joined));
    rg_mesh_destroy(mesh);
    // Vertices with different normals stay apart until the mesh is made smooth.
    static const float normals[18] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 1, 0, 0};
    mesh = rg_mesh_create("two", 6, 2, positions, normals, indices);
    check_mesh(mesh);
    assert_int_equal(mesh->vertex_count, 6);
    struct rg_mesh *smooth = rg_mesh_smooth(mesh);
    check_mesh(smooth);
    assert_int_equal(smooth->vertex_count, 4);
    rg_mesh_destroy(mesh);
    rg_mesh_destroy(smooth);
}

// A corner of three faces along the axes, with areas of 1, 2 and 3 halves.
static void test_normals_weigh_areas(void **state)
{
    (void)state;
    static const float positions[12] = {0, 0, 0, 1, 0, 0, 0, 3, 0, 0, 0, 2};
    static const uint32_t indices[9] = {0, 1, 2, 0, 2, 3, 0, 3, 1};
    struct rg_mesh *mesh = rg_mesh_create("corner", 4, 3, positions, NULL, indices);
    check_mesh(mesh);
    const double areas[3] = {6, 2, 3}, length = 7; // twice: 3 * 2, 2 * 1, 1 * 3
    for (int c = 0; c < 3; c++)
        assert_below(fabs((double)mesh->normals[c] - areas[c] / length), 1e-7);
    rg_mesh_destroy(mesh);
}

static void expect_no_mesh(int vertices, int faces, const float *positions, const uint32_t *indices,
                           const char *why)
{
    listen_now();
    assert_null(rg_mesh_create("the arrays", vertices, faces, positions, NULL, indices));
    rg_log_listen(NULL, NULL);
    if (lines.count != 1 || !strstr(lines.last, why))
        fail_msg("%d lines, the last: %s", lines.count, lines.last);
}

static void test_arrays_that_are_refused(void **state)
{
    (void)state;
    const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, no_number[9] = {0, 0, 0, 0, 1, NAN};
    const uint32_t indices[3] = {0, 1, 2}, wrong[3] = {0, 1, 3};
    expect_no_mesh(3, 0, positions, indices, "no faces");
    expect_no_mesh(0, 1, positions, indices, "no faces");
    expect_no_mesh(-1, -1, positions, indices, "no faces");
    expect_no_mesh(3, RG_MESH_MAX_FACES + 1, positions, indices, "10000001 faces");
    expect_no_mesh(3, 1, no_number, indices, "vertex 1 lies at (0, 1, nan)");
    expect_no_mesh(3, 1, positions, wrong, "face 0 names vertex 3, but there are 3");
}

// --- computed models ---

// Each side of a face has one neighbour, which runs along it in the other direction: no holes, no
// seams.
static void expect_closed(const struct rg_mesh *mesh, int euler)
{
    assert_int_equal(mesh->vertex_count - mesh->face_count / 2, euler);
    uint64_t sum = 0, back = 0;
    for (size_t i = 0; i < 3 * (size_t)mesh->face_count; i++) {
        const uint64_t a = mesh->indices[i], b = mesh->indices[i % 3 == 2 ? i - 2 : i + 1];
        sum += (a << 32 | b) * UINT64_C(0x9e3779b97f4a7c15) ^ a * b; // multisets, compared
        back += (b << 32 | a) * UINT64_C(0x9e3779b97f4a7c15) ^ a * b;
    }
    assert_equals(sum, back);
}

static double volume(const struct rg_mesh *mesh)
{
    double sum = 0;
    for (int i = 0; i < mesh->face_count; i++) {
        const float *p[3];
        for (int k = 0; k < 3; k++)
            p[k] = mesh->positions + 3 * mesh->indices[3 * i + k];
        for (int c = 0; c < 3; c++)
            sum += (double)p[0][c] * ((double)p[1][(c + 1) % 3] * (double)p[2][(c + 2) % 3] -
                                      (double)p[1][(c + 2) % 3] * (double)p[2][(c + 1) % 3]);
    }
    return sum / 6;
}

static void test_computed_models(void **state)
{
    (void)state;
    const double pi = acos(-1);
    struct rg_mesh *sphere = rg_mesh_load("sphere"), *torus = rg_mesh_load("torus");
    check_mesh(sphere);
    check_mesh(torus);
    expect_closed(sphere, 2);
    expect_closed(torus, 0);
    assert_int_equal(sphere->face_count, 27648);
    assert_int_equal(torus->face_count, 32768);
    // The faces look outwards and lie just inside the curved surface.
    assert_below(volume(sphere), 4 * pi / 3);
    assert_above(volume(sphere), 0.999 * 4 * pi / 3);
    assert_below(volume(torus), 2 * pi * pi * 0.7 * 0.09);
    assert_above(volume(torus), 0.998 * 2 * pi * pi * 0.7 * 0.09);
    for (int i = 0; i < 3 * sphere->vertex_count; i++)
        assert_below(fabsf(sphere->normals[i] - sphere->positions[i]), 1e-6f);
    rg_mesh_destroy(sphere);
    rg_mesh_destroy(torus);
}

// --- other numbers of faces ---

static void test_decimation(void **state)
{
    (void)state;
    static const int wanted[] = {20000, 5000, 501, 100};
    struct rg_mesh *sphere = rg_mesh_load("sphere");
    const double whole = volume(sphere);
    for (size_t i = 0; i < COUNT_OF(wanted); i++) {
        char name[64];
        struct rg_mesh *coarse = rg_mesh_decimate(sphere, wanted[i]);
        struct rg_mesh *again = rg_mesh_decimate(sphere, wanted[i]);
        check_mesh(coarse);
        assert_int_equal(coarse->face_count, wanted[i] / 2 * 2); // even, being closed
        // Regular subdivision of an icosahedron loses 10 divided by the number of faces.
        assert_below(fabs(volume(coarse) / whole - 1), 20.0 / wanted[i]);
        assert_equals(coarse->hash, again->hash);
        snprintf(name, sizeof(name), "sphere, decimated to %d faces", wanted[i] / 2 * 2);
        assert_string_equal(coarse->name, name);
        rg_mesh_destroy(coarse);
        rg_mesh_destroy(again);
    }
    struct rg_mesh *same = rg_mesh_decimate(sphere, sphere->face_count);
    assert_equals(same->hash, sphere->hash);
    rg_mesh_destroy(same);
    rg_mesh_destroy(sphere);
}

// The gate's baseline holds pictures of these. Another mesh would be another cell.
static void test_decimation_is_the_same_everywhere(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        int faces;
        uint64_t hash;
    } pinned[] = {
        {"torus", 10000, 0x36616a16df0b07aeu},
        {"torus", 300, 0x3edfc788e6153c01u},
        {"sphere", 100, 0x1db0b324bfa6a926u},
    };
    for (size_t i = 0; i < COUNT_OF(pinned); i++) {
        struct rg_mesh *mesh = rg_mesh_load_faces(pinned[i].name, pinned[i].faces);
        assert_non_null(mesh);
        assert_int_equal(mesh->face_count, pinned[i].faces);
        if (mesh->hash != pinned[i].hash)
            fail_msg("%s: %016llx", mesh->name, (unsigned long long)mesh->hash);
        rg_mesh_destroy(mesh);
    }
}

// Each side of a face is that of one other face, which has it the other way round.
static void check_closed(const struct rg_mesh *mesh)
{
    enum { MOST = 512 };
    static unsigned char sides[MOST][MOST];
    memset(sides, 0, sizeof(sides));
    assert_at_most(mesh->vertex_count, MOST);
    for (int i = 0; i < 3 * mesh->face_count; i++)
        sides[mesh->indices[i]][mesh->indices[i % 3 == 2 ? i - 2 : i + 1]]++;
    for (int a = 0; a < MOST; a++)
        for (int b = 0; b < MOST; b++) {
            assert_at_most(sides[a][b], 1);
            assert_int_equal(sides[a][b], sides[b][a]);
        }
}

// Of a closed surface half as many vertices as faces say how many holes it has: a torus keeps its
// one, and a sphere gets none, however few faces are left.
static void test_decimation_keeps_holes(void **state)
{
    (void)state;
    static const int wanted[] = {1000, 200, 80, 40, 30, 24};
    struct rg_mesh *torus = rg_mesh_load("torus"), *sphere = rg_mesh_load("sphere");
    for (size_t i = 0; i < COUNT_OF(wanted); i++) {
        struct rg_mesh *ring = rg_mesh_decimate(torus, wanted[i]);
        struct rg_mesh *ball = rg_mesh_decimate(sphere, wanted[i]);
        assert_int_equal(ring->face_count, wanted[i]);
        assert_int_equal(ring->vertex_count, wanted[i] / 2);
        assert_int_equal(ball->face_count, wanted[i]);
        assert_int_equal(ball->vertex_count, wanted[i] / 2 + 2);
        check_closed(ring);
        check_closed(ball);
        rg_mesh_destroy(ring);
        rg_mesh_destroy(ball);
    }
    rg_mesh_destroy(torus);
    rg_mesh_destroy(sphere);
}

// A flat sheet keeps its border: what is left covers it whole, with both corners of faces up.
static void test_decimation_keeps_borders(void **state)
{
    (void)state;
    enum { SIDE = 20, VERTICES = (SIDE + 1) * (SIDE + 1), FACES = 2 * SIDE * SIDE };
    float positions[3 * VERTICES];
    uint32_t indices[3 * FACES], *index = indices;
    for (int i = 0; i < VERTICES; i++) {
        positions[3 * i] = (float)(i % (SIDE + 1));
        positions[3 * i + 1] = (float)(i / (SIDE + 1));
        positions[3 * i + 2] = 0;
    }
    for (uint32_t y = 0; y < SIDE; y++)
        for (uint32_t x = 0; x < SIDE; x++) {
            const uint32_t a = y * (SIDE + 1) + x, b = a + SIDE + 1;
            const uint32_t cell[6] = {a, a + 1, b + 1, b + 1, b, a};
            memcpy(index, cell, sizeof(cell));
            index += 6;
        }
    struct rg_mesh *sheet = rg_mesh_create("sheet", VERTICES, FACES, positions, NULL, indices);
    struct rg_mesh *coarse = rg_mesh_decimate(sheet, 20);
    check_mesh(coarse);
    assert_between(coarse->face_count, 2, 20);
    double area = 0;
    for (int i = 0; i < coarse->face_count; i++) {
        const uint32_t *c = coarse->indices + 3 * (size_t)i;
        const float *p = coarse->positions + 3 * c[0], *q = coarse->positions + 3 * c[1],
                    *r = coarse->positions + 3 * c[2];
        const double twice =
            (double)((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
        assert_above(twice, 0);
        area += twice / 2;
    }
    assert_equals(area, SIDE * SIDE);
    rg_mesh_destroy(sheet);
    rg_mesh_destroy(coarse);
}

// Books of four pages that share a spine. No edge can collapse without tearing a page, so that the
// sloppy method must do it, which loses whole books. They are spread over a square and grow in
// size, since the smallest are lost first.
static void test_decimation_against_the_topology(void **state)
{
    (void)state;
    enum { BOOKS = 100, PAGES = 4, FACES = BOOKS * PAGES, VERTICES = BOOKS * (PAGES + 2) };
    float positions[3 * VERTICES], *position = positions;
    uint32_t indices[3 * FACES], *index = indices;
    for (int i = 0; i < BOOKS; i++) {
        const float x = (float)(i * 37 % 100), y = (float)(i * 61 % 97), size = 0.1f * (float)i;
        const float corners[3 * (PAGES + 2)] = {
            x, y, 0, x, y, size, x + size, y, 0, x - size, y, 0, x, y + size, 0, x, y - size, 0};
        for (int k = 0; k < PAGES; k++) {
            *index++ = (uint32_t)(i * (PAGES + 2));
            *index++ = (uint32_t)(i * (PAGES + 2) + 1);
            *index++ = (uint32_t)(i * (PAGES + 2) + 2 + k);
        }
        memcpy(position, corners, sizeof(corners));
        position += COUNT_OF(corners);
    }
    struct rg_mesh *books = rg_mesh_create("books", VERTICES, FACES, positions, NULL, indices);
    struct rg_mesh *coarse = rg_mesh_decimate(books, 100), *exact = rg_mesh_resize(books, 101);
    check_mesh(coarse);
    check_mesh(exact);
    assert_between(coarse->face_count, 1, 100);
    assert_int_equal(exact->face_count, 101);
    rg_mesh_destroy(books);
    rg_mesh_destroy(coarse);
    rg_mesh_destroy(exact);
}

static double surface(const struct rg_mesh *mesh)
{
    double sum = 0;
    for (int i = 0; i < mesh->face_count; i++) {
        double u[3], v[3], cross2 = 0;
        for (int c = 0; c < 3; c++) {
            const double a = (double)mesh->positions[3 * mesh->indices[3 * i] + (uint32_t)c];
            u[c] = (double)mesh->positions[3 * mesh->indices[3 * i + 1] + (uint32_t)c] - a;
            v[c] = (double)mesh->positions[3 * mesh->indices[3 * i + 2] + (uint32_t)c] - a;
        }
        for (int c = 0; c < 3; c++) {
            const double cross = u[(c + 1) % 3] * v[(c + 2) % 3] - u[(c + 2) % 3] * v[(c + 1) % 3];
            cross2 += cross * cross;
        }
        sum += sqrt(cross2) / 2;
    }
    return sum;
}

// All faces of a fan meet at one vertex. Work that grew with their number for each of them would
// take minutes here.
static void test_decimation_of_a_fan(void **state)
{
    (void)state;
    enum { FACES = 200000 };
    float *positions = calloc(FACES + 1, 3 * sizeof(*positions));
    uint32_t *indices = calloc(FACES, 3 * sizeof(*indices));
    assert_non_null(positions);
    assert_non_null(indices);
    for (uint32_t i = 0; i < FACES; i++) {
        const uint32_t face[3] = {FACES, i, (i + 1) % FACES};
        memcpy(indices + 3 * (size_t)i, face, sizeof(face));
        positions[3 * (size_t)i] = (float)cos(i * 2 * M_PI / FACES);
        positions[3 * (size_t)i + 1] = (float)sin(i * 2 * M_PI / FACES);
    }
    struct rg_mesh *fan = rg_mesh_create("fan", FACES + 1, FACES, positions, NULL, indices);
    struct rg_mesh *coarse = rg_mesh_decimate(fan, 1000);
    check_mesh(coarse);
    assert_int_equal(coarse->face_count, 1000);
    assert_below(fabs(surface(coarse) - M_PI), 1e-4);
    rg_mesh_destroy(fan);
    rg_mesh_destroy(coarse);
    free(positions);
    free(indices);
}

static double longest_side(const struct rg_mesh *mesh)
{
    double longest = 0;
    for (int i = 0; i < 3 * mesh->face_count; i++) {
        double sum = 0;
        for (int c = 0; c < 3; c++) {
            const uint32_t a = mesh->indices[i], b = mesh->indices[i % 3 == 2 ? i - 2 : i + 1];
            const double d = (double)mesh->positions[3 * a + (uint32_t)c] -
                             (double)mesh->positions[3 * b + (uint32_t)c];
            sum += d * d;
        }
        longest = fmax(longest, sqrt(sum));
    }
    return longest;
}

static void test_refinement(void **state)
{
    (void)state;
    static const int wanted[] = {13, 14, 15, 100, 1001, 5000};
    struct rg_mesh *box =
        rg_mesh_create("box", BOX_VERTICES, BOX_FACES, box_positions, NULL, box_indices);
    for (size_t i = 0; i < COUNT_OF(wanted); i++) {
        struct rg_mesh *fine = rg_mesh_refine(box, wanted[i]);
        check_mesh(fine);
        assert_int_equal(fine->face_count, wanted[i] / 2 * 2);
        expect_closed(fine, 2); // no side ends in the middle of another face's
        // Coordinates are halves of halves, so that nothing is rounded.
        assert_below(fabs(volume(fine) - 198), 1e-9);
        assert_below(fabs(surface(fine) - 234), 1e-9);
        rg_mesh_destroy(fine);
    }
    struct rg_mesh *fine = rg_mesh_refine(box, 5000);
    // At most twice a side of equal halvings: no edge was forgotten.
    assert_below(longest_side(fine), 2 * sqrt(4 * 234.0 / 5000));
    rg_mesh_destroy(fine);
    rg_mesh_destroy(box);
}

// A surface with a border reaches odd numbers as well.
static void test_refinement_of_an_open_surface(void **state)
{
    (void)state;
    struct rg_mesh *open =
        rg_mesh_create("open", BOX_VERTICES, BOX_FACES - 1, box_positions, NULL, box_indices);
    for (int faces = BOX_FACES; faces < 60; faces++) {
        struct rg_mesh *fine = rg_mesh_refine(open, faces);
        check_mesh(fine);
        assert_int_equal(fine->face_count, faces);
        assert_below(fabs(surface(fine) - (234 - 33.0)), 1e-9);
        rg_mesh_destroy(fine);
    }
    rg_mesh_destroy(open);
}

// A face that is a line to and fro has the longest edge, which cannot be halved. It must not hold
// up the others: one edge a round, instead of half of them, would take hours here.
static void test_refinement_beside_a_line(void **state)
{
    (void)state;
    uint32_t indices[3 * (BOX_FACES + 1)] = {0, 7, 0};
    memcpy(indices + 3, box_indices, sizeof(box_indices));
    struct rg_mesh *box =
        rg_mesh_create("box", BOX_VERTICES, BOX_FACES + 1, box_positions, NULL, indices);
    struct rg_mesh *fine = rg_mesh_refine(box, 100001);
    check_mesh(fine);
    assert_int_equal(fine->face_count, 100001);
    rg_mesh_destroy(box);
    rg_mesh_destroy(fine);
}

static void expect_count_refused(const struct rg_mesh *mesh, int faces, const char *why)
{
    listen_now();
    assert_null(rg_mesh_resize(mesh, faces));
    rg_log_listen(NULL, NULL);
    if (lines.count != 1 || !strstr(lines.last, why))
        fail_msg("%d lines, the last: %s", lines.count, lines.last);
}

static void test_numbers_that_are_refused(void **state)
{
    (void)state;
    struct rg_mesh *torus = rg_mesh_load("torus");
    expect_count_refused(torus, 0, "0 faces are out of range; ask for 1 to 10000000");
    expect_count_refused(torus, -5, "-5 faces");
    expect_count_refused(torus, RG_MESH_MAX_FACES + 1, "10000001 faces");
    expect_count_refused(torus, 1, "nothing is left");
    rg_mesh_destroy(torus);
}

// Several allocations exceed the limit; only the first is reported.
static void test_no_memory_is_one_line(void **state)
{
    (void)state;
    struct rg_mesh *torus = rg_mesh_load("torus");
    const struct rg_mesh large = {.face_count = RG_MESH_MAX_FACES}; // its arrays are not read
    struct rg_edges edges;
    rg_memory_allow((int64_t)100 << 20);
    expect_count_refused(torus, RG_MESH_MAX_FACES, "of --memory are left");
    listen_now();
    assert_false(rg_mesh_edges(&large, &edges));
    rg_log_listen(NULL, NULL);
    rg_edges_free(&edges);
    assert_int_equal(lines.count, 1);
    rg_memory_allow((int64_t)64 << 30);
    rg_mesh_destroy(torus);
}

// --- packages ---

static void expect_model(const char *name, const char *label, int vertices, int faces)
{
    struct rg_mesh *mesh = rg_mesh_load(name);
    assert_non_null(mesh);
    check_mesh(mesh);
    assert_string_equal(mesh->name, label);
    assert_int_equal(mesh->face_count, faces);
    if (vertices)
        assert_int_equal(mesh->vertex_count, vertices);
    rg_mesh_destroy(mesh);
}

static void test_packaged_models(void **state)
{
    (void)state;
    expect_model("bunny", "bunny.obj", 34835, 69666);
    expect_model("horse", "horse.3ds", 0, 7172);
    expect_model("elephant", "refined_elephant.off", 44460, 88928);
    expect_model("cow", "cow.off", 0, 5804); // not in the table
}

// The head is taller than deep, and the cat is its file's model turned by 90 degrees.
// Of the processes that this one has waited for.
static long pages_of_children(void)
{
    struct rusage usage;
    assert_int_equal(getrusage(RUSAGE_CHILDREN, &usage), 0);
    return usage.ru_minflt;
}

// No process reads a model again that was the last one, whose copy is the same to the bit.
static void test_the_last_model_is_kept(void **state)
{
    (void)state;
    struct rg_mesh *first = rg_mesh_load("bunny");
    const long pages = pages_of_children();
    struct rg_mesh *again = rg_mesh_load("bunny");
    assert_int_equal(pages_of_children(), pages);
    assert_string_equal(again->name, first->name);
    assert_int_equal(again->hash, first->hash);
    assert_int_equal(again->face_count, first->face_count);
    assert_memory_equal(again->normals, first->normals,
                        3 * sizeof(float) * (size_t)first->vertex_count);
    assert_memory_equal(again->low, first->low, sizeof(first->low));
    rg_mesh_destroy(again);
    again = rg_mesh_load("horse");
    assert_int_not_equal(again->hash, first->hash);
    assert_true(pages_of_children() > pages);
    rg_mesh_destroy(again);
    again = rg_mesh_load("bunny");
    assert_int_equal(again->hash, first->hash);
    rg_mesh_destroy(again);
    rg_mesh_destroy(first);
}

static void test_packaged_models_are_upright(void **state)
{
    (void)state;
    struct rg_mesh *cat = rg_mesh_load("cat"), *head = rg_mesh_load("mannequin");
    struct rg_mesh *as_it_lies = rg_mesh_read("/usr/share/glmark2/models/cat.3ds", NULL);
    check_mesh(cat);
    check_mesh(head);
    assert_above(head->high[1] - head->low[1], 1.1f * (head->high[2] - head->low[2]));
    // Rotated about x by 90 degrees: y became z, z became -y.
    assert_int_equal(cat->vertex_count, as_it_lies->vertex_count);
    for (int i = 0; i < 3 * cat->vertex_count; i += 3) {
        assert_equals(cat->positions[i], as_it_lies->positions[i]);
        assert_equals(cat->positions[i + 1], -as_it_lies->positions[i + 2]);
        assert_equals(cat->positions[i + 2], as_it_lies->positions[i + 1]);
        assert_below(fabsf(cat->normals[i + 1] + as_it_lies->normals[i + 2]), 1e-6f);
    }
    rg_mesh_destroy(cat);
    rg_mesh_destroy(head);
    rg_mesh_destroy(as_it_lies);
}

// The numbers of faces in Stuppacher and Supan's scenes.
static void test_stand_ins_have_the_published_counts(void **state)
{
    (void)state;
    expect_model("dragon",
                 "ChineseDragon-10kv.off, refined to 100000 faces, in place of the dragon", 0,
                 100000);
    expect_model("buddha", "refined_elephant.off, refined to 100000 faces, in place of the buddha",
                 0, 100000);
    expect_model("planck",
                 "mannequin-devil.off, refined to 50801 faces, in place of the bust of Max Planck",
                 0, 50801);
}

static void expect_no_model(const char *name, const char *why)
{
    listen_now();
    assert_null(rg_mesh_load(name));
    rg_log_listen(NULL, NULL);
    if (lines.count != 1 || !strstr(lines.last, why))
        fail_msg("%d lines, the last: %s", lines.count, lines.last);
}

static void test_names(void **state)
{
    (void)state;
    for (int i = 0; rg_model_at(i); i++)
        for (int k = 0; k < i; k++)
            assert_string_not_equal(rg_model_at(i)->name, rg_model_at(k)->name);
    assert_null(rg_model_at(-1));
    expect_no_model("", "no model is named");
    expect_no_model("unicorn", "holds no data/meshes/unicorn.off");
    // The user's own folder comes first.
    char path[256];
    snprintf(path, sizeof(path), "%s", in_folder("dragon.obj"));
    const char *text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    write_file(path, text, strlen(text));
    setenv("RG_MODEL_DIR", folder, 1);
    expect_model("dragon", "dragon.obj, refined to 100000 faces", 0, 100000);
    expect_model("bunny", "bunny.obj", 34835, 69666);
    unsetenv("RG_MODEL_DIR");
    unlink(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_equal_vertices_are_joined),
        cmocka_unit_test(test_normals_weigh_areas),
        cmocka_unit_test(test_arrays_that_are_refused),
        cmocka_unit_test(test_computed_models),
        cmocka_unit_test(test_decimation),
        cmocka_unit_test(test_decimation_is_the_same_everywhere),
        cmocka_unit_test(test_decimation_keeps_borders),
        cmocka_unit_test(test_decimation_keeps_holes),
        cmocka_unit_test(test_decimation_against_the_topology),
        cmocka_unit_test(test_decimation_of_a_fan),
        cmocka_unit_test(test_refinement),
        cmocka_unit_test(test_refinement_of_an_open_surface),
        cmocka_unit_test(test_refinement_beside_a_line),
        cmocka_unit_test(test_numbers_that_are_refused),
        cmocka_unit_test(test_no_memory_is_one_line),
        cmocka_unit_test(test_packaged_models),
        cmocka_unit_test(test_the_last_model_is_kept),
        cmocka_unit_test(test_packaged_models_are_upright),
        cmocka_unit_test(test_stand_ins_have_the_published_counts),
        cmocka_unit_test(test_names),
    };
    return cmocka_run_group_tests_name("meshes by name", tests, make_folder, remove_folder);
}
