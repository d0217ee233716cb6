// The normal map of the scene, and its depth, of the nearest face in each pixel; all styles and the
// rain's collisions read them. A texel holds the normal in the world, of unit length and on the
// side that is seen, and one more than the number of the face's material.
#include "kernels/cartoon/scene/faces_params.h"
#include "kernels/dialect/mesh/mesh.h"

#define RG_PARAMS cartoon_faces_params
#define RG_SLOTS                                                                                   \
    IN(1, float, positions) IN(2, uint, normals) IN(3, uint, indices) IN(4, uint, materials)
#define RG_CORNERS 3

RG_STRUCT(cartoon_face)
{
    mesh_record mesh;
    float side; // -1: it is seen from behind
    float material;
};
#define RG_RECORD cartoon_face
#define RG_DEPTH_OF_CORNERS
#include "kernels/dialect/draw/draw.h"

#include "kernels/dialect/mesh/item.h"

RG_DRAW_ITEM(cartoon_faces)
{
    return mesh_item(rg, p.to_clip, p.first + i);
}

RG_DRAW_RECORD(cartoon_faces)
{
    cartoon_face r;
    r.mesh = mesh_record_of(rg, draw, p.to_clip, p.first + i);
    r.side = rg_turn(mesh_item(rg, p.to_clip, p.first + i)) > 0.0f ? -1.0f : 1.0f;
    r.material = rg_to_float(rg_to_int(materials_at(rg, p.first + i)) + 1);
    return r;
}

RG_DRAW_FRAGMENT(cartoon_faces)
{
    v3 n = mesh_normal_at(r.mesh, px, py);
    float scale = r.side / rg_sqrt(rg_max(v3_dot(n, n), 1e-12f));
    return rg_fragment_make(rg_rgba(n.x * scale, n.y * scale, n.z * scale, r.material),
                            rg_planes_depth(r.mesh.planes, px, py));
}
