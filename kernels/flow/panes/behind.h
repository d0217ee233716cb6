// The picture that water shows: all that does not refract, from the slot behind of the program that
// includes this file (section 4.3; GPU Gems 2, chapter 19).
#ifndef RG_KERNELS_FLOW_PANES_BEHIND_H
#define RG_KERNELS_FLOW_PANES_BEHIND_H

// The picture at the place to which the water's slope displaces the view.
RG_FN rgba seen_through(rg_ctx rg, flow_view_params p, v3 bend, int px, int py)
{
    v3 right = v3_make(p.rays.xx, p.rays.yx, p.rays.zx);
    v3 down = v3_make(p.rays.xy, p.rays.yy, p.rays.zy);
    float x = rg_to_float(px) + 0.5f - v3_dot(bend, right) * p.refraction_px;
    float y = rg_to_float(py) + 0.5f - v3_dot(bend, down) * p.refraction_px;
    return behind_between(rg, x, y, 0, 0);
}

#endif
