#include "tests/core/scene/mesh/fault.h"

#include <math.h>
#include <string.h>

static const char *position_fault(const struct rg_mesh *mesh)
{
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; i++) {
        if (!(fabsf(mesh->positions[i]) <= RG_MESH_FARTHEST))
            return "a coordinate is out of range";
        low[i % 3] = fminf(low[i % 3], mesh->positions[i]);
        high[i % 3] = fmaxf(high[i % 3], mesh->positions[i]);
    }
    if (memcmp(low, mesh->low, sizeof(low)) || memcmp(high, mesh->high, sizeof(high)))
        return "the bounds are not those of the positions";
    return memcmp(low, high, sizeof(low)) ? NULL : "it has no extent";
}

static const char *normal_fault(const struct rg_mesh *mesh)
{
    for (size_t i = 0; i < (size_t)mesh->vertex_count; i++) {
        const float *n = mesh->normals + 3 * i;
        const double length = sqrt((double)n[0] * (double)n[0] + (double)n[1] * (double)n[1] +
                                   (double)n[2] * (double)n[2]);
        if (!(fabs(length - 1) < 1e-6))
            return "a normal is not of length 1";
    }
    return NULL;
}

// Faces number vertices by first use: thus each vertex is used, and no index is out of range.
static const char *index_fault(const struct rg_mesh *mesh)
{
    uint32_t next = 0;
    for (size_t i = 0; i < 3 * (size_t)mesh->face_count; i++) {
        if (mesh->indices[i] > next)
            return "its vertices are not numbered by first use";
        next += mesh->indices[i] == next;
    }
    return next == (uint32_t)mesh->vertex_count ? NULL : "a vertex is in no face";
}

const char *mesh_fault(const struct rg_mesh *mesh)
{
    if (mesh->vertex_count < 1 || mesh->vertex_count > RG_MESH_MAX_VERTICES ||
        mesh->face_count < 1 || mesh->face_count > RG_MESH_MAX_FACES)
        return "a count is out of range";
    const char *fault = position_fault(mesh);
    fault = fault ? fault : normal_fault(mesh);
    return fault ? fault : index_fault(mesh);
}
