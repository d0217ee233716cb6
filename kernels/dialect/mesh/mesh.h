// Triangles of a mesh as items of a DRAW program, and the record of their fragments. A program that
// draws meshes has these slots, and includes item.h after dialect/draw/draw.h:
//   IN(1, float, positions)  x, y, z of each vertex
//   IN(2, uint, normals)     a vertex's normal, packed by mesh_normal_pack
//   IN(3, uint, indices)     three vertices of each triangle
#ifndef RG_KERNELS_DIALECT_MESH_MESH_H
#define RG_KERNELS_DIALECT_MESH_MESH_H

#include "kernels/dialect/matrix.h"
#include "kernels/dialect/mesh/normal.h"
#include "kernels/dialect/draw/triangle.h"

RG_STRUCT(mesh_record)
{
    rg_planes planes;
    uint normal_a;
    uint normal_b;
    uint normal_c;
};
RG_STRUCT_SIZE(mesh_record, 19)

// The normal at a pixel, in the mesh's own space, not of unit length.
RG_FN v3 mesh_normal_at(mesh_record r, int px, int py)
{
    rg_weights k = rg_planes_weights(r.planes, px, py);
    return v3_add(v3_add(v3_scale(mesh_normal_unpack(r.normal_a), k.a),
                         v3_scale(mesh_normal_unpack(r.normal_b), k.b)),
                  v3_scale(mesh_normal_unpack(r.normal_c), k.c));
}

#endif
