// The item and record of a mesh's triangle, from the slots of the program that includes this file.
#ifndef RG_KERNELS_DIALECT_MESH_ITEM_H
#define RG_KERNELS_DIALECT_MESH_ITEM_H

RG_FN rg_corner mesh_corner(rg_ctx rg, m4 to_clip, int vertex)
{
    return m4_project(to_clip,
                      v3_make(positions_at(rg, 3 * vertex), positions_at(rg, 3 * vertex + 1),
                              positions_at(rg, 3 * vertex + 2)));
}

RG_FN int mesh_vertex(rg_ctx rg, int triangle, int k)
{
    return rg_to_int(indices_at(rg, 3 * triangle + k));
}

RG_FN rg_item mesh_item(rg_ctx rg, m4 to_clip, int triangle)
{
    rg_item t;
    t.alive = 1;
    t.a = mesh_corner(rg, to_clip, mesh_vertex(rg, triangle, 0));
    t.b = mesh_corner(rg, to_clip, mesh_vertex(rg, triangle, 1));
    t.c = mesh_corner(rg, to_clip, mesh_vertex(rg, triangle, 2));
    t.d = t.c;
    return t;
}

RG_FN mesh_record mesh_record_of(rg_ctx rg, rg_draw_state draw, m4 to_clip, int triangle)
{
    mesh_record r;
    r.planes = rg_planes_of(draw, mesh_item(rg, to_clip, triangle));
    r.normal_a = normals_at(rg, mesh_vertex(rg, triangle, 0));
    r.normal_b = normals_at(rg, mesh_vertex(rg, triangle, 1));
    r.normal_c = normals_at(rg, mesh_vertex(rg, triangle, 2));
    return r;
}

#endif
