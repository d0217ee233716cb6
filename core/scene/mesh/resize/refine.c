// More faces: the longest edges are halved.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/scene/mesh/resize/resize.h"

bool rg_resize_check(const struct rg_mesh *mesh, int faces)
{
    if (faces >= 1 && faces <= RG_MESH_MAX_FACES)
        return true;
    return rg_error("%s: %d faces are out of range; ask for 1 to %d", mesh->name, faces,
                    RG_MESH_MAX_FACES);
}

void rg_resize_rename(struct rg_mesh *mesh, const char *source, const char *done)
{
    snprintf(mesh->name, sizeof(mesh->name), "%.100s, %s to %d faces", source, done,
             mesh->face_count);
}

// Sides with the same two vertices: `count` of them from `first` on, in sorted order.
struct edge {
    double length2;
    uint32_t first, count;
};

// Refines in rounds; in one round each face loses at most one edge.
struct refinement {
    int vertex_count, face_count, wanted;
    float *positions, *normals;
    uint32_t *indices;
    struct rg_side *sides;
    uint32_t *ends; // of `sides`, by vertex
    struct edge *edges;
    bool *taken; // by face: one of its edges was halved in this round
};

static int compare_edges(const void *a, const void *b)
{
    const struct edge *x = a, *y = b;
    if (x->length2 != y->length2)
        return x->length2 > y->length2 ? -1 : 1;
    return x->first < y->first ? -1 : x->first > y->first;
}

static double length_squared(const struct refinement *r, uint64_t key)
{
    const float *a = r->positions + 3 * (key >> 32), *b = r->positions + 3 * (key & 0xffffffffu);
    double sum = 0;
    for (int c = 0; c < 3; c++)
        sum += ((double)b[c] - (double)a[c]) * ((double)b[c] - (double)a[c]);
    return sum;
}

// Finds all edges, longest first, and returns their number.
static size_t find_edges(struct refinement *r)
{
    const size_t sides =
        rg_resize_sides(r->indices, r->face_count, (size_t)r->vertex_count, r->ends, r->sides);
    size_t edges = 0;
    for (size_t i = 0; i < sides; i++) {
        if (i > 0 && r->sides[i].key == r->sides[i - 1].key)
            r->edges[edges - 1].count++;
        else
            r->edges[edges++] = (struct edge){length_squared(r, r->sides[i].key), (uint32_t)i, 1};
    }
    qsort(r->edges, edges, sizeof(*r->edges), compare_edges);
    return edges;
}

// Whether all of an edge's faces are different and untouched in this round.
static bool is_free(const struct refinement *r, const struct edge *edge)
{
    const struct rg_side *sides = r->sides + edge->first;
    for (uint32_t i = 0; i < edge->count; i++)
        if (r->taken[sides[i].corner / 3] ||
            (i > 0 && sides[i].corner / 3 == sides[i - 1].corner / 3))
            return false;
    return true;
}

static uint32_t add_middle(struct refinement *r, uint64_t key)
{
    const size_t a = key >> 32, b = key & 0xffffffffu, middle = (size_t)r->vertex_count++;
    for (size_t c = 0; c < 3; c++) {
        r->positions[3 * middle + c] =
            (float)(((double)r->positions[3 * a + c] + (double)r->positions[3 * b + c]) / 2);
        // not normalised; rg_mesh_create does that
        r->normals[3 * middle + c] = r->normals[3 * a + c] + r->normals[3 * b + c];
    }
    return (uint32_t)middle;
}

// Splits each face of the edge in two: one in its place, one at the end.
static void halve(struct refinement *r, const struct edge *edge)
{
    const uint32_t middle = add_middle(r, r->sides[edge->first].key);
    for (uint32_t i = 0; i < edge->count; i++) {
        const uint32_t corner = r->sides[edge->first + i].corner, face = corner / 3;
        uint32_t *old = r->indices + 3 * (size_t)face;
        uint32_t *added = r->indices + 3 * (size_t)r->face_count++;
        const uint32_t from = corner % 3, to = (from + 1) % 3;
        memcpy(added, old, 3 * sizeof(uint32_t));
        old[to] = middle;
        added[from] = middle;
        r->taken[face] = true;
    }
}

// One round: halves edges, from the longest that can be halved down to half its length. False when
// every edge would exceed the wanted number.
static bool run_round(struct refinement *r)
{
    const int before = r->face_count;
    const size_t edges = find_edges(r);
    double limit2 = 0;
    memset(r->taken, 0, (size_t)r->face_count * sizeof(*r->taken));
    for (size_t i = 0; i < edges && r->face_count < r->wanted; i++) {
        const struct edge *edge = &r->edges[i];
        if (edge->length2 < limit2)
            break;
        if (edge->count > (uint32_t)(r->wanted - r->face_count) || !is_free(r, edge))
            continue;
        if (r->face_count == before)
            limit2 = edge->length2 / 4;
        halve(r, edge);
    }
    return r->face_count > before;
}

static bool begin_refinement(struct refinement *r, const struct rg_mesh *mesh, int faces)
{
    const size_t most = (size_t)mesh->vertex_count + (size_t)(faces - mesh->face_count);
    *r = (struct refinement){
        .vertex_count = mesh->vertex_count,
        .face_count = mesh->face_count,
        .wanted = faces,
    };
    if (!(r->positions = rg_alloc(most, 3 * sizeof(float), mesh->name)) ||
        !(r->normals = rg_alloc(most, 3 * sizeof(float), mesh->name)) ||
        !(r->indices = rg_alloc((size_t)faces, 3 * sizeof(uint32_t), mesh->name)) ||
        !(r->sides = rg_alloc((size_t)faces, 3 * sizeof(struct rg_side), mesh->name)) ||
        !(r->ends = rg_alloc(most, sizeof(*r->ends), mesh->name)) ||
        !(r->edges = rg_alloc((size_t)faces, 3 * sizeof(struct edge), mesh->name)) ||
        !(r->taken = rg_alloc((size_t)faces, sizeof(bool), mesh->name)))
        return false;
    memcpy(r->positions, mesh->positions, (size_t)mesh->vertex_count * 3 * sizeof(float));
    memcpy(r->normals, mesh->normals, (size_t)mesh->vertex_count * 3 * sizeof(float));
    memcpy(r->indices, mesh->indices, (size_t)mesh->face_count * 3 * sizeof(uint32_t));
    return true;
}

static void end_refinement(struct refinement *r)
{
    free(r->positions);
    free(r->normals);
    free(r->indices);
    free(r->sides);
    free(r->ends);
    free(r->edges);
    free(r->taken);
}

struct rg_mesh *rg_mesh_refine(const struct rg_mesh *mesh, int faces)
{
    if (!rg_resize_check(mesh, faces))
        return NULL;
    // One vertex a position: otherwise an edge on a seam between normals would be halved on one
    // side only.
    struct rg_mesh *smooth = rg_mesh_smooth(mesh), *fine = NULL;
    if (!smooth || smooth->face_count >= faces)
        return smooth;
    struct refinement r;
    if (begin_refinement(&r, smooth, faces)) {
        while (r.face_count < r.wanted && run_round(&r))
            continue;
        fine = rg_mesh_create(mesh->name, r.vertex_count, r.face_count, r.positions, r.normals,
                              r.indices);
    }
    if (fine)
        rg_resize_rename(fine, mesh->name, "refined");
    end_refinement(&r);
    rg_mesh_destroy(smooth);
    return fine;
}
