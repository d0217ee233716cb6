// The water's normal anywhere on a pane, from the slot normals of the program that includes this
// file.
#ifndef RG_KERNELS_FLOW_PANES_SURFACE_H
#define RG_KERNELS_FLOW_PANES_SURFACE_H

RG_FN wet_normal normal_at(rg_ctx rg, int i)
{
    return wet_normal_unpack(normals_at(rg, i));
}

// The normal map at a point of a pane, bilinear; the pane's texel (0, 0) has the index `first`.
RG_FN wet_normal normal_between(rg_ctx rg, int first, int size, flow_point at)
{
    float s = at.u * rg_to_float(size) - 0.5f;
    float t = at.v * rg_to_float(size) - 0.5f;
    int x = rg_to_int(s + 1.0f) - 1;
    int y = rg_to_int(t + 1.0f) - 1;
    int row = size + 2 * FLOW_MARGIN;
    int i = first + y * row + x;
    float fx = s - rg_to_float(x);
    wet_normal top = wet_normal_lerp(normal_at(rg, i), normal_at(rg, i + 1), fx);
    wet_normal bottom = wet_normal_lerp(normal_at(rg, i + row), normal_at(rg, i + row + 1), fx);
    return wet_normal_lerp(top, bottom, t - rg_to_float(y));
}

// Water as the view meets it.
RG_STRUCT(flow_water)
{
    float wetness; // 0 dry to 1
    v3 bend;       // the part of the normal that lies in the pane, in the world
    v3 normal;     // of unit length, towards the viewer; seen from inside the box drops are hollow
};

RG_FN flow_water water_on(rg_ctx rg, flow_pane_record r, int size, flow_point at)
{
    wet_normal w = normal_between(rg, r.first, size, at);
    float x = wet_normal_component(w.x);
    float y = wet_normal_component(w.y);
    float z = rg_sqrt(rg_max(1.0f - (x * x + y * y), 0.0f));
    flow_water f;
    f.wetness = wet_normal_wetness(w);
    f.bend = v3_add(v3_scale(r.t, x), v3_scale(r.b, y));
    f.normal = v3_scale(v3_add(f.bend, v3_scale(r.n, z)), r.facing);
    return f;
}

#endif
