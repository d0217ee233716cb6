#include "core/scene/mesh/edges.h"

#include <math.h>
#include <meshoptimizer.h>
#include <stdlib.h>

#include "core/base/alloc.h"

// A side of a face, from its lower vertex to its higher one.
struct side {
    uint32_t low, high;
    int face;
    bool goes_down; // the face traverses it from `high` to `low`
};

struct work {
    const struct rg_mesh *mesh;
    uint32_t *places; // by corner: the first vertex at that position
    double *normals;  // three a face; 0 for faces without area
    struct side *sides;
    int side_count;
};

static void find_normal(const struct rg_mesh *mesh, int face, double normal[3])
{
    double p[3][3], u[3], v[3], squared = 0;
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++)
            p[k][c] = (double)mesh->positions[3 * (size_t)mesh->indices[3 * face + k] + (size_t)c];
    for (int c = 0; c < 3; c++) {
        u[c] = p[1][c] - p[0][c];
        v[c] = p[2][c] - p[0][c];
    }
    for (int c = 0; c < 3; c++) {
        normal[c] = u[(c + 1) % 3] * v[(c + 2) % 3] - u[(c + 2) % 3] * v[(c + 1) % 3];
        squared += normal[c] * normal[c];
    }
    for (int c = 0; c < 3; c++)
        normal[c] = squared > 0 ? normal[c] / sqrt(squared) : 0;
}

static bool has_area(const double normal[3])
{
    return normal[0] != 0 || normal[1] != 0 || normal[2] != 0;
}

static void add_sides(struct work *w, int face)
{
    find_normal(w->mesh, face, w->normals + 3 * (size_t)face);
    for (int k = 0; k < 3 && has_area(w->normals + 3 * (size_t)face); k++) {
        const uint32_t *corners = w->places + 3 * (size_t)face;
        const uint32_t from = corners[k], to = corners[(k + 1) % 3];
        w->sides[w->side_count++] =
            from < to ? (struct side){from, to, face, false} : (struct side){to, from, face, true};
    }
}

static int by_places(const void *a, const void *b)
{
    const struct side *p = a, *q = b;
    if (p->low != q->low)
        return p->low < q->low ? -1 : 1;
    if (p->high != q->high)
        return p->high < q->high ? -1 : 1;
    return p->face - q->face;
}

static bool is_same(const struct side *p, const struct side *q)
{
    return p->low == q->low && p->high == q->high;
}

// The index of the side to pair with the first one, among the sides at the same place: preferably
// one of opposite direction. `count` if there is none.
static int partner(const struct side *sides, int count)
{
    for (int i = 1; i < count; i++)
        if (sides[i].goes_down != sides[0].goes_down)
            return i;
    return count > 1 ? 1 : count;
}

// Writes an edge between two sides; `second` may be NULL.
static void put(struct rg_edges *edges, int room, const struct work *w, const struct side *first,
                const struct side *second)
{
    const double *n = w->normals + 3 * (size_t)first->face;
    // Two faces that traverse an edge in the same direction have opposite orientation.
    const double sign = second && second->goes_down == first->goes_down ? -1 : 1;
    for (int c = 0; c < 3; c++) {
        const double other = second ? sign * w->normals[3 * (size_t)second->face + (size_t)c] : 0;
        const float words[4] = {w->mesh->positions[3 * (size_t)first->low + (size_t)c],
                                w->mesh->positions[3 * (size_t)first->high + (size_t)c],
                                (float)n[c], (float)other};
        for (int k = 0; k < 4; k++)
            edges->words[(size_t)(3 * k + c) * (size_t)room + (size_t)edges->count] = words[k];
    }
    edges->count++;
}

// Pairs the sides with equal ends, and writes an edge for each pair.
static void pair_up(struct rg_edges *edges, int room, const struct work *w, struct side *sides,
                    int count)
{
    while (count > 0) {
        const int other = partner(sides, count);
        put(edges, room, w, &sides[0], other < count ? &sides[other] : NULL);
        int left = 0;
        for (int i = 1; i < count; i++)
            if (i != other)
                sides[left++] = sides[i];
        count = left;
    }
}

// Moves the words of `count` edges, `room` apart so far, together.
static void pack(struct rg_edges *edges, int room)
{
    for (int word = 1; word < RG_EDGE_WORDS; word++)
        for (int i = 0; i < edges->count; i++)
            edges->words[(size_t)word * (size_t)edges->count + (size_t)i] =
                edges->words[(size_t)word * (size_t)room + (size_t)i];
}

static void find_edges(struct work *w, struct rg_edges *edges)
{
    const int room = 3 * w->mesh->face_count;
    for (int face = 0; face < w->mesh->face_count; face++)
        add_sides(w, face);
    qsort(w->sides, (size_t)w->side_count, sizeof(*w->sides), by_places);
    for (int i = 0, end; i < w->side_count; i = end) {
        for (end = i + 1; end < w->side_count && is_same(&w->sides[i], &w->sides[end]);)
            end++;
        pair_up(edges, room, w, w->sides + i, end - i);
    }
    pack(edges, room);
}

bool rg_mesh_edges(const struct rg_mesh *mesh, struct rg_edges *edges)
{
    const size_t faces = (size_t)mesh->face_count;
    struct work w = {.mesh = mesh};
    *edges = (struct rg_edges){0};
    const bool ok = (edges->words = rg_alloc(3 * faces, RG_EDGE_WORDS * sizeof(float), "edges")) &&
                    (w.places = rg_alloc(3 * faces, sizeof(*w.places), "edges")) &&
                    (w.normals = rg_alloc(3 * faces, sizeof(*w.normals), "edges")) &&
                    (w.sides = rg_alloc(3 * faces, sizeof(*w.sides), "edges"));
    if (ok) {
        const struct meshopt_Stream positions = {mesh->positions, 12, 12};
        meshopt_generateShadowIndexBufferMulti(w.places, mesh->indices, 3 * faces,
                                               (size_t)mesh->vertex_count, &positions, 1);
        find_edges(&w, edges);
    }
    free(w.places);
    free(w.normals);
    free(w.sides);
    return ok;
}

void rg_edges_free(struct rg_edges *edges)
{
    free(edges->words);
    *edges = (struct rg_edges){0};
}
