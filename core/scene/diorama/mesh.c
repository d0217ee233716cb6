// Makes a diorama of a user's mesh.

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/scene/diorama/build.h"
#include "kernels/dialect/math.h"

enum { GROUND_SIDES = 64 };
#define MESH_SIZE_M   4.0
#define GROUND_SIZE_M 4.5

// Arrays for a mesh and its ground.
struct arrays {
    int vertices, faces;
    float *positions, *normals;
    uint32_t *indices;
};

static bool make_room(struct arrays *a, const struct rg_mesh *mesh)
{
    a->vertices = mesh->vertex_count + GROUND_SIDES + 1;
    a->faces = mesh->face_count + GROUND_SIDES;
    return (a->positions = rg_alloc((size_t)a->vertices, 3 * sizeof(float), mesh->name)) &&
           (a->normals = rg_alloc((size_t)a->vertices, 3 * sizeof(float), mesh->name)) &&
           (a->indices = rg_alloc((size_t)a->faces, 3 * sizeof(uint32_t), mesh->name));
}

static void free_arrays(struct arrays *a)
{
    free(a->positions);
    free(a->normals);
    free(a->indices);
}

static void put_mesh(struct arrays *a, const struct rg_mesh *mesh)
{
    double longest = 0;
    for (int c = 0; c < 3; c++)
        longest = fmax(longest, (double)mesh->high[c] - (double)mesh->low[c]);
    for (int i = 0; i < 3 * mesh->vertex_count; i++) {
        const int c = i % 3;
        const double low = (double)mesh->low[c], high = (double)mesh->high[c];
        const double from = c == 1 ? low : (low + high) / 2;
        a->positions[i] = (float)(((double)mesh->positions[i] - from) * MESH_SIZE_M / longest);
    }
    memcpy(a->normals, mesh->normals, (size_t)mesh->vertex_count * 3 * sizeof(float));
    memcpy(a->indices, mesh->indices, (size_t)mesh->face_count * 3 * sizeof(uint32_t));
}

// Appends the ground's vertices and faces to the mesh's: the middle, then the rim.
static void put_ground(struct arrays *a, const struct rg_mesh *mesh)
{
    const uint32_t middle = (uint32_t)mesh->vertex_count;
    for (int i = 0; i <= GROUND_SIDES; i++) {
        float *p = a->positions + 3 * ((size_t)middle + (size_t)i);
        const float angle = (float)(2 * M_PI * i / GROUND_SIDES);
        p[0] = i ? rg_sin(angle) * (float)GROUND_SIZE_M : 0;
        p[2] = i ? rg_cos(angle) * (float)GROUND_SIZE_M : 0;
        a->normals[3 * ((size_t)middle + (size_t)i) + 1] = 1;
    }
    for (int i = 0; i < GROUND_SIDES; i++) {
        uint32_t *face = a->indices + 3 * ((size_t)mesh->face_count + (size_t)i);
        face[0] = middle;
        face[1] = middle + 1 + (uint32_t)i;
        face[2] = middle + 1 + (uint32_t)(i + 1) % GROUND_SIDES;
    }
}

static const struct diorama mesh_look = {
    .view = {{0, 1.2, 0}, 9.5, 25, 20, 35, 1},
    .sky = {0.70f, 0.80f, 0.88f},
    .low_sky = {0.93f, 0.94f, 0.90f},
};

static struct diorama *on_ground(const struct rg_mesh *mesh)
{
    struct arrays a = {0};
    struct diorama *d = rg_alloc(1, sizeof(*d), mesh->name);
    const bool has_room = d && make_room(&a, mesh);
    if (has_room) {
        *d = mesh_look;
        diorama_paint(d);
        put_mesh(&a, mesh);
        put_ground(&a, mesh);
        d->mesh =
            rg_mesh_create(mesh->name, a.vertices, a.faces, a.positions, a.normals, a.indices);
        d->materials =
            d->mesh ? rg_alloc((size_t)a.faces, sizeof(*d->materials), mesh->name) : NULL;
        for (int i = mesh->face_count; d->materials && i < a.faces; i++)
            d->materials[i] = PAINT_LAWN;
    }
    free_arrays(&a);
    if (has_room && d->materials)
        return d;
    diorama_destroy(d);
    return NULL;
}

struct diorama *diorama_of_mesh(const char *name)
{
    struct rg_mesh *mesh = rg_mesh_load(name);
    struct diorama *d = mesh ? on_ground(mesh) : NULL;
    rg_mesh_destroy(mesh);
    return d;
}
