// For tests: a mesh whose pixels hold the face that they show, and the place on it.
#include "kernels/dialect/mesh/mesh.h"
#include "kernels/raster/mesh_params.h"

#define RG_PARAMS  raster_mesh_params
#define RG_SLOTS   IN(1, float, positions) IN(2, uint, normals) IN(3, uint, indices)
#define RG_CORNERS 3

RG_STRUCT(test_face)
{
    rg_planes planes;
    int item;
};
#define RG_RECORD test_face
#include "kernels/dialect/draw/draw.h"

#include "kernels/dialect/mesh/item.h"

RG_DRAW_ITEM(test_faces)
{
    return mesh_item(rg, p.to_clip, i);
}

RG_DRAW_RECORD(test_faces)
{
    test_face r;
    r.planes = rg_planes_of(draw, mesh_item(rg, p.to_clip, i));
    r.item = i;
    return r;
}

// The face's number plus one, since 0 is none; the weights of its second and third corner.
RG_DRAW_FRAGMENT(test_faces)
{
    rg_weights k = rg_planes_weights(r.planes, px, py);
    return rg_fragment_make(rg_rgba(rg_to_float(r.item + 1), k.b, k.c, 1.0f),
                            rg_planes_depth(r.planes, px, py));
}
