// A point of the rain as the camera sees it.
#ifndef RG_KERNELS_CARTOON_RAIN_VIEW_H
#define RG_KERNELS_CARTOON_RAIN_VIEW_H

RG_STRUCT(cartoon_spot)
{
    float x_px;
    float y_px;
    float depth;
    float distance_m; // along the view
    int inside;       // 1: it is in the viewing frustum
};

RG_FN cartoon_spot cartoon_spot_of(cartoon_rain_params p, v3 at)
{
    rg_corner c = m4_project(p.to_clip, at);
    float over_w = 1.0f / rg_max(c.w, 1e-6f);
    cartoon_spot s;
    s.x_px = (c.x * over_w * 0.5f + 0.5f) * rg_to_float(p.width);
    s.y_px = (c.y * over_w * 0.5f + 0.5f) * rg_to_float(p.height);
    s.depth = c.z * over_w;
    s.distance_m = c.w;
    s.inside = (rg_abs(c.x) < c.w ? 1 : 0) & (rg_abs(c.y) < c.w ? 1 : 0) & (c.z > 0.0f ? 1 : 0) &
               (c.z < c.w ? 1 : 0);
    return s;
}

// The radius of a drop's bounding sphere. Near the eye it is capped at CARTOON_BOUND_PX, which
// limits the pixels to look at for a drop.
#define CARTOON_BOUND_PX 16.0f

RG_FN float cartoon_bound_m(cartoon_rain_params p, float distance_m)
{
    return rg_min(p.bound_m, CARTOON_BOUND_PX / p.focal_px * distance_m);
}

#endif
