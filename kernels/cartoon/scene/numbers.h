// The nearest face in each pixel: one more than its number, lowest byte first, 0 in the sky.
// Collisions look up the face by it, since the depth map is only as fine as its texels.
#include "kernels/cartoon/scene/faces_params.h"
#include "kernels/dialect/mesh/mesh.h"

#define RG_PARAMS  cartoon_faces_params
#define RG_SLOTS   IN(1, float, positions) IN(2, uint, normals) IN(3, uint, indices)
#define RG_CORNERS 3

RG_STRUCT(cartoon_numbered)
{
    mesh_record mesh;
    uint number;
};
#define RG_RECORD cartoon_numbered
#define RG_DEPTH_OF_CORNERS
#include "kernels/dialect/draw/draw.h"

#include "kernels/dialect/mesh/item.h"

RG_DRAW_ITEM(cartoon_numbers)
{
    return mesh_item(rg, p.to_clip, p.first + i);
}

RG_DRAW_RECORD(cartoon_numbers)
{
    cartoon_numbered r;
    r.mesh = mesh_record_of(rg, draw, p.to_clip, p.first + i);
    r.number = rg_to_uint(p.first + i + 1);
    return r;
}

RG_FN float cartoon_byte_of(uint number, int place)
{
    return rg_to_float(rg_to_int(number >> rg_to_uint(place) & 255u)) * (1.0f / 255.0f);
}

RG_DRAW_FRAGMENT(cartoon_numbers)
{
    return rg_fragment_make(rg_rgba(cartoon_byte_of(r.number, 0), cartoon_byte_of(r.number, 8),
                                    cartoon_byte_of(r.number, 16), cartoon_byte_of(r.number, 24)),
                            rg_planes_depth(r.mesh.planes, px, py));
}
