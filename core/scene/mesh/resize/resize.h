// What decimating and refining share.
#ifndef RG_CORE_SCENE_MESH_RESIZE_RESIZE_H
#define RG_CORE_SCENE_MESH_RESIZE_RESIZE_H

#include "core/scene/mesh/mesh.h"

// False, with one logged line, if no mesh has so many faces.
bool rg_resize_check(const struct rg_mesh *mesh, int faces);
// Renames a mesh after its source and its number of faces: "bunny.obj, refined to 70000 faces".
void rg_resize_rename(struct rg_mesh *mesh, const char *source, const char *done);

// A face's side, from its corner `corner` (3 * face + 0, 1 or 2) to the next.
struct rg_side {
    uint64_t key; // the two vertices, the lower index in the upper half
    uint32_t corner;
};

static inline uint64_t rg_side_key(uint64_t a, uint64_t b)
{
    return a < b ? a << 32 | b : b << 32 | a;
}

// Fills `sides`, which has room for three a face, with those of different ends, sorted by key and
// then by corner, so that those of one edge follow each other. Returns their number. `ends`, by
// vertex, becomes the number of sides whose lower vertex is this one or an earlier one.
size_t rg_resize_sides(const uint32_t *indices, int face_count, size_t vertex_count, uint32_t *ends,
                       struct rg_side *sides);

// Collapses edges of `indices`, three of each face, until there are at most `wanted` faces, or
// until none can collapse without tearing or folding the surface. Every vertex stays where it is.
// Returns the number of faces left in `indices`, or -1, with one logged line, when memory runs out.
int rg_resize_collapse(const struct rg_mesh *mesh, int wanted, uint32_t *indices);

// Fills `indices` with at most `wanted` faces, by merging the vertices of each cell of a grid, as
// fine as will do. Returns their number, 0 if nothing is left, or -1 as above.
int rg_resize_merge(const struct rg_mesh *mesh, int wanted, uint32_t *indices);

#endif
