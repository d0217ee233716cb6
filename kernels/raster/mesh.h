// raster: a mesh in matt grey under one distant light.
#include "kernels/dialect/mesh/mesh.h"
#include "kernels/raster/mesh_params.h"

#define RG_PARAMS  raster_mesh_params
#define RG_SLOTS   IN(1, float, positions) IN(2, uint, normals) IN(3, uint, indices)
#define RG_CORNERS 3
#define RG_RECORD  mesh_record
#define RG_DEPTH_OF_CORNERS
#include "kernels/dialect/draw/draw.h"

#include "kernels/dialect/mesh/item.h"

RG_DRAW_ITEM(raster_mesh)
{
    return mesh_item(rg, p.to_clip, i);
}

RG_DRAW_RECORD(raster_mesh)
{
    return mesh_record_of(rg, draw, p.to_clip, i);
}

RG_DRAW_FRAGMENT(raster_mesh)
{
    v3 n = mesh_normal_at(r, px, py);
    float length = rg_sqrt(rg_max(v3_dot(n, n), 1e-12f));
    float lit = v3_dot(n, v3_make(p.light_x, p.light_y, p.light_z)) / length;
    float grey = p.ambient + (1.0f - p.ambient) * rg_max(lit, 0.0f);
    return rg_fragment_make(rg_rgba(grey, grey, grey, 1.0f), rg_planes_depth(r.planes, px, py));
}
