// Fewer faces. All of it is in doubles and in one order, so that every machine gets the same mesh.
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/scene/mesh/resize/resize.h"

struct rg_mesh *rg_mesh_decimate(const struct rg_mesh *mesh, int faces)
{
    if (!rg_resize_check(mesh, faces))
        return NULL;
    // One vertex a position, so that no seam between normals holds an edge; normals are made anew.
    struct rg_mesh *smooth = rg_mesh_smooth(mesh);
    if (!smooth || smooth->face_count <= faces)
        return smooth;
    struct rg_mesh *coarse = NULL;
    const size_t bytes = 3 * (size_t)smooth->face_count * sizeof(uint32_t);
    uint32_t *indices = rg_alloc(1, bytes, mesh->name);
    int reached = -1;
    if (indices) {
        memcpy(indices, smooth->indices, bytes);
        reached = rg_resize_collapse(smooth, faces, indices);
        if (reached > faces)
            reached = rg_resize_merge(smooth, faces, indices);
    }
    if (reached > 0)
        coarse = rg_mesh_create(mesh->name, smooth->vertex_count, reached, smooth->positions, NULL,
                                indices);
    else if (!reached)
        rg_error("%s: nothing is left of it when it is decimated to %d faces; ask for more",
                 mesh->name, faces);
    if (coarse)
        rg_resize_rename(coarse, mesh->name, "decimated");
    free(indices);
    rg_mesh_destroy(smooth);
    return coarse;
}

struct rg_mesh *rg_mesh_resize(const struct rg_mesh *mesh, int faces)
{
    if (mesh->face_count <= faces)
        return rg_mesh_refine(mesh, faces);
    struct rg_mesh *coarse = rg_mesh_decimate(mesh, faces);
    if (!coarse || coarse->face_count == faces)
        return coarse;
    struct rg_mesh *exact = rg_mesh_refine(coarse, faces);
    rg_mesh_destroy(coarse);
    if (exact)
        rg_resize_rename(exact, mesh->name, "decimated");
    return exact;
}
