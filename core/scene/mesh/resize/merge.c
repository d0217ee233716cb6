// Where edges cannot collapse, the vertices of a grid's cell become one.
#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/scene/mesh/resize/resize.h"

enum { MOST_CELLS = 1 << 20 }; // along a side

struct place {
    uint64_t cell;
    uint32_t vertex;
};

static int compare(const void *a, const void *b)
{
    const struct place *x = a, *y = b;
    if (x->cell != y->cell)
        return x->cell < y->cell ? -1 : 1;
    return x->vertex < y->vertex ? -1 : x->vertex > y->vertex;
}

// The longest side of the mesh's bounds. A mesh without extent lies in one cell, whatever the
// length.
static double longest_of(const struct rg_mesh *mesh)
{
    double longest = 0;
    for (int c = 0; c < 3; c++)
        longest = fmax(longest, (double)mesh->high[c] - (double)mesh->low[c]);
    return longest > 0 ? longest : 1;
}

static uint64_t cell_of(const struct rg_mesh *mesh, double longest, uint32_t vertex, int cells)
{
    uint64_t cell = 0;
    for (int c = 0; c < 3; c++) {
        const double at = (double)mesh->positions[3 * (size_t)vertex + (size_t)c];
        const int along = (int)((at - (double)mesh->low[c]) / longest * cells);
        cell = cell << 21 | (uint64_t)(along < cells ? along : cells - 1);
    }
    return cell;
}

// By vertex, the one that stands for its cell: the first of it.
static void find_stand_ins(const struct rg_mesh *mesh, int cells, struct place *places,
                           uint32_t *stand_ins)
{
    const size_t count = (size_t)mesh->vertex_count;
    const double longest = longest_of(mesh);
    for (size_t i = 0; i < count; i++)
        places[i] = (struct place){cell_of(mesh, longest, (uint32_t)i, cells), (uint32_t)i};
    qsort(places, count, sizeof(*places), compare);
    uint32_t first = 0;
    for (size_t i = 0; i < count; i++) {
        first = i && places[i].cell == places[i - 1].cell ? first : places[i].vertex;
        stand_ins[places[i].vertex] = first;
    }
}

// The faces whose corners lie in three cells; `indices` may be NULL.
static int faces_left(const struct rg_mesh *mesh, const uint32_t *stand_ins, uint32_t *indices)
{
    int left = 0;
    for (int face = 0; face < mesh->face_count; face++) {
        const uint32_t *corner = mesh->indices + 3 * (size_t)face;
        const uint32_t a = stand_ins[corner[0]], b = stand_ins[corner[1]], c = stand_ins[corner[2]];
        if (a == b || b == c || c == a)
            continue;
        if (indices) {
            indices[3 * (size_t)left] = a;
            indices[3 * (size_t)left + 1] = b;
            indices[3 * (size_t)left + 2] = c;
        }
        left++;
    }
    return left;
}

int rg_resize_merge(const struct rg_mesh *mesh, int wanted, uint32_t *indices)
{
    struct place *places = rg_alloc((size_t)mesh->vertex_count, sizeof(*places), mesh->name);
    uint32_t *stand_ins =
        places ? rg_alloc((size_t)mesh->vertex_count, sizeof(*stand_ins), mesh->name) : NULL;
    int reached = -1;
    if (stand_ins) {
        int few = 1, many = MOST_CELLS; // cells that will do, and those that will not
        while (many - few > 1) {
            const int cells = few + (many - few) / 2;
            find_stand_ins(mesh, cells, places, stand_ins);
            if (faces_left(mesh, stand_ins, NULL) <= wanted)
                few = cells;
            else
                many = cells;
        }
        find_stand_ins(mesh, few, places, stand_ins);
        reached = faces_left(mesh, stand_ins, indices);
    }
    free(places);
    free(stand_ins);
    return reached;
}
