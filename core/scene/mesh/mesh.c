#include "core/scene/mesh/mesh.h"

#include <float.h>
#include <math.h>
#include <meshoptimizer.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "kernels/dialect/mesh/normal.h"

// A position and a normal, as joining compares them.
struct vertex {
    float position[3], normal[3];
};

// --- memory ---

void rg_mesh_destroy(struct rg_mesh *mesh)
{
    if (!mesh)
        return;
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->indices);
    free(mesh);
}

static struct rg_mesh *allocate(const char *name, int vertex_count, int face_count)
{
    struct rg_mesh *mesh = rg_alloc(1, sizeof(*mesh), name);
    if (!mesh)
        return NULL;
    snprintf(mesh->name, sizeof(mesh->name), "%s", name);
    mesh->vertex_count = vertex_count;
    mesh->face_count = face_count;
    mesh->positions = rg_alloc((size_t)vertex_count, 3 * sizeof(float), name);
    mesh->normals =
        mesh->positions ? rg_alloc((size_t)vertex_count, 3 * sizeof(float), name) : NULL;
    mesh->indices = mesh->normals ? rg_alloc((size_t)face_count, 3 * sizeof(uint32_t), name) : NULL;
    if (mesh->indices)
        return mesh;
    rg_mesh_destroy(mesh);
    return NULL;
}

uint32_t *rg_mesh_pack_normals(const struct rg_mesh *mesh)
{
    uint32_t *packed = rg_alloc((size_t)mesh->vertex_count, sizeof(*packed), mesh->name);
    for (int i = 0; packed && i < mesh->vertex_count; i++) {
        const float *n = mesh->normals + 3 * (size_t)i;
        packed[i] = mesh_normal_pack(v3_make(n[0], n[1], n[2]));
    }
    return packed;
}

// --- limits ---

static bool check_counts(const char *name, int vertex_count, int face_count)
{
    if (face_count < 1 || vertex_count < 1)
        return rg_error("%s: no faces; a mesh needs at least one triangle (points and lines are "
                        "left out)",
                        name);
    // Before joining there may be three vertices a face.
    if (face_count > RG_MESH_MAX_FACES || vertex_count > 3 * RG_MESH_MAX_FACES)
        return rg_error("%s: %d faces and %d vertices would take %.0f MB; at most %d faces are "
                        "taken: decimate it first",
                        name, face_count, vertex_count, face_count * 12e-6 + vertex_count * 24e-6,
                        RG_MESH_MAX_FACES);
    return true;
}

static bool check_values(const char *name, int vertex_count, int face_count, const float *positions,
                         const uint32_t *indices)
{
    for (int i = 0; i < vertex_count; i++) {
        const float *p = positions + 3 * (size_t)i;
        for (int c = 0; c < 3; c++)
            if (!(fabsf(p[c]) <= RG_MESH_FARTHEST)) // also catches NaN
                return rg_error("%s: vertex %d lies at (%g, %g, %g); coordinates must be numbers "
                                "up to %g: repair the file",
                                name, i, (double)p[0], (double)p[1], (double)p[2],
                                (double)RG_MESH_FARTHEST);
    }
    for (size_t i = 0; i < 3 * (size_t)face_count; i++)
        if (indices[i] >= (uint32_t)vertex_count)
            return rg_error("%s: face %zu names vertex %u, but there are %d; repair the file", name,
                            i / 3, indices[i], vertex_count);
    return true;
}

// --- bounds, normals, hash ---

// Turns subnormal numbers into 0, as some devices do, and -0 too, so that equal places have equal
// bits.
static float plain(double value)
{
    return fabs(value) < (double)FLT_MIN ? 0.0f : (float)value;
}

static bool find_bounds(struct rg_mesh *mesh)
{
    for (int c = 0; c < 3; c++)
        mesh->low[c] = mesh->high[c] = mesh->positions[c];
    for (int i = 1; i < mesh->vertex_count; i++) {
        for (int c = 0; c < 3; c++) {
            const float value = mesh->positions[3 * (size_t)i + (size_t)c];
            mesh->low[c] = value < mesh->low[c] ? value : mesh->low[c];
            mesh->high[c] = value > mesh->high[c] ? value : mesh->high[c];
        }
    }
    if (memcmp(mesh->low, mesh->high, sizeof(mesh->low)))
        return true;
    return rg_error("%s: all vertices lie at (%g, %g, %g), so there is nothing to see; repair the "
                    "file",
                    mesh->name, (double)mesh->low[0], (double)mesh->low[1], (double)mesh->low[2]);
}

// Twice the area of a face times its normal.
static void face_vector(const struct rg_mesh *mesh, int face, double vector[3])
{
    const uint32_t *corner = mesh->indices + 3 * (size_t)face;
    const float *a = mesh->positions + 3 * (size_t)corner[0];
    const float *b = mesh->positions + 3 * (size_t)corner[1];
    const float *c = mesh->positions + 3 * (size_t)corner[2];
    double u[3], v[3];
    for (int i = 0; i < 3; i++) {
        u[i] = (double)b[i] - (double)a[i];
        v[i] = (double)c[i] - (double)a[i];
    }
    for (int i = 0; i < 3; i++)
        vector[i] = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
}

// Replaces normals that are 0 by the sum of the adjacent faces' vectors.
static bool make_normals(struct rg_mesh *mesh)
{
    double(*sums)[3] = rg_alloc((size_t)mesh->vertex_count, sizeof(*sums), mesh->name);
    if (!sums)
        return false;
    for (int face = 0; face < mesh->face_count; face++) {
        double vector[3];
        face_vector(mesh, face, vector);
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 3; i++)
                sums[mesh->indices[3 * (size_t)face + (size_t)k]][i] += vector[i];
    }
    for (int i = 0; i < mesh->vertex_count; i++) {
        float *normal = mesh->normals + 3 * (size_t)i;
        if (normal[0] != 0 || normal[1] != 0 || normal[2] != 0)
            continue;
        const double *s = sums[i], length = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
        for (int c = 0; c < 3; c++)
            normal[c] = length > 0 ? plain(s[c] / length) : c == 1 ? 1.0f : 0.0f;
    }
    free(sums);
    return true;
}

static void hash_words(XXH3_state_t *state, const void *words, size_t count)
{
    unsigned char bytes[4096];
    for (size_t done = 0; done < count;) {
        const size_t part = count - done < sizeof(bytes) / 4 ? count - done : sizeof(bytes) / 4;
        for (size_t i = 0; i < part; i++) {
            uint32_t word;
            memcpy(&word, (const char *)words + 4 * (done + i), 4);
            for (int b = 0; b < 4; b++)
                bytes[4 * i + (size_t)b] = (unsigned char)(word >> 8 * b);
        }
        XXH3_64bits_update(state, bytes, 4 * part);
        done += part;
    }
}

static bool find_hash(struct rg_mesh *mesh)
{
    XXH3_state_t *state = XXH3_createState();
    if (!state)
        return rg_harness_error("%s: no memory for its hash", mesh->name);
    XXH3_64bits_reset(state);
    hash_words(state, mesh->positions, 3 * (size_t)mesh->vertex_count);
    hash_words(state, mesh->indices, 3 * (size_t)mesh->face_count);
    mesh->hash = XXH3_64bits_digest(state);
    XXH3_freeState(state);
    return true;
}

// --- joining ---

// A normal without a direction becomes 0.
static void make_vertex(const float *position, const float *normal, struct vertex *vertex)
{
    for (int c = 0; c < 3; c++)
        vertex->position[c] = plain(position[c]);
    double length = 0;
    for (int c = 0; normal && c < 3; c++)
        length += (double)normal[c] * (double)normal[c];
    length = sqrt(length);
    const bool direction = length > 0 && isfinite(length);
    for (int c = 0; c < 3; c++)
        // NOLINTNEXTLINE: without a normal the length is 0
        vertex->normal[c] = direction ? plain((double)normal[c] / length) : 0.0f;
}

// Makes a mesh of the arrays, whose vertices are the distinct ones of `vertices` that faces use.
static struct rg_mesh *join(const char *name, int vertex_count, int face_count,
                            const struct vertex *vertices, const uint32_t *indices, uint32_t *remap)
{
    const size_t corners = 3 * (size_t)face_count;
    const size_t distinct = meshopt_generateVertexRemap(remap, indices, corners, vertices,
                                                        (size_t)vertex_count, sizeof(*vertices));
    if (distinct > RG_MESH_MAX_VERTICES)
        return rg_error_null("%s: %zu vertices would take %.0f MB; at most %d are taken: decimate "
                             "it first",
                             name, distinct, (double)distinct * 24e-6, RG_MESH_MAX_VERTICES);
    struct rg_mesh *mesh = allocate(name, (int)distinct, face_count);
    if (!mesh)
        return NULL;
    for (int i = 0; i < vertex_count; i++) {
        if (remap[i] == ~0u)
            continue; // no face uses it
        memcpy(mesh->positions + 3 * (size_t)remap[i], vertices[i].position, 3 * sizeof(float));
        memcpy(mesh->normals + 3 * (size_t)remap[i], vertices[i].normal, 3 * sizeof(float));
    }
    for (size_t i = 0; i < corners; i++)
        mesh->indices[i] = remap[indices[i]];
    return mesh;
}

struct rg_mesh *rg_mesh_create(const char *name, int vertex_count, int face_count,
                               const float *positions, const float *normals,
                               const uint32_t *indices)
{
    if (!check_counts(name, vertex_count, face_count) ||
        !check_values(name, vertex_count, face_count, positions, indices))
        return NULL;
    struct vertex *vertices = rg_alloc((size_t)vertex_count, sizeof(*vertices), name);
    uint32_t *remap = vertices ? rg_alloc((size_t)vertex_count, sizeof(*remap), name) : NULL;
    struct rg_mesh *mesh = NULL;
    for (int i = 0; remap && i < vertex_count; i++)
        make_vertex(positions + 3 * (size_t)i, normals ? normals + 3 * (size_t)i : NULL,
                    &vertices[i]);
    if (remap)
        mesh = join(name, vertex_count, face_count, vertices, indices, remap);
    free(remap);
    free(vertices);
    if (mesh && find_bounds(mesh) && make_normals(mesh) && find_hash(mesh))
        return mesh;
    rg_mesh_destroy(mesh);
    return NULL;
}

struct rg_mesh *rg_mesh_smooth(const struct rg_mesh *mesh)
{
    return rg_mesh_create(mesh->name, mesh->vertex_count, mesh->face_count, mesh->positions, NULL,
                          mesh->indices);
}
