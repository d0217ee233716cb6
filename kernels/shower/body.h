// The body that is seen, by its six sides (section III.B), and whether a drop is inside it.
#ifndef RG_KERNELS_SHOWER_BODY_H
#define RG_KERNELS_SHOWER_BODY_H

#include "kernels/shower/particle.h"

RG_FN float shower_inside(shower_plane side, v3 at)
{
    return side.x * at.x + side.y * at.y + side.z * at.z + side.at;
}

// The test of section III.B: 1 if a point is inside all six sides.
RG_FN int shower_holds(shower_params p, v3 at)
{
    float least = rg_min(rg_min(rg_min(shower_inside(p.front, at), shower_inside(p.back, at)),
                                rg_min(shower_inside(p.left, at), shower_inside(p.right, at))),
                         rg_min(shower_inside(p.top, at), shower_inside(p.bottom, at)));
    return least >= 0.0f ? 1 : 0;
}

// The largest distance inside one side among a drop's four corners.
RG_FN float shower_most(shower_plane side, v3 low_left, v3 low_right, v3 upwards)
{
    float up = side.x * upwards.x + side.y * upwards.y + side.z * upwards.z;
    float left = shower_inside(side, low_left);
    float right = shower_inside(side, low_right);
    return rg_max(rg_max(left, left + up), rg_max(right, right + up));
}

// The test before it: 1 unless the drop's quad is wholly outside one side.
RG_FN int shower_holds_body(shower_params p, v3 at, float fall_m_s)
{
    v3 up = shower_upwards(p, at, fall_m_s);
    float beside = 0.5f * p.width_m * shower_share(p, shower_ahead(p, at.x, at.z));
    v3 l = v3_make(at.x + p.ahead_z * beside, at.y, at.z - p.ahead_x * beside);
    v3 r = v3_make(at.x - p.ahead_z * beside, at.y, at.z + p.ahead_x * beside);
    float least =
        rg_min(rg_min(rg_min(shower_most(p.front, l, r, up), shower_most(p.back, l, r, up)),
                      rg_min(shower_most(p.left, l, r, up), shower_most(p.right, l, r, up))),
               rg_min(shower_most(p.top, l, r, up), shower_most(p.bottom, l, r, up)));
    return least >= 0.0f ? 1 : 0;
}

#endif
