// Particles that leave come in again (section III.D): at the top of their column, or, if the wind
// or the viewer's walk took them out, at another side.
#ifndef RG_KERNELS_SHOWER_PROMOTION_H
#define RG_KERNELS_SHOWER_PROMOTION_H

#include "kernels/shower/particle.h"

// Two random numbers, 0 to 1, for a particle in a step.
RG_STRUCT(shower_chances)
{
    float whether;
    float where;
};

RG_FN shower_chances shower_chance(shower_params p, int slot)
{
    uint h = rg_to_uint(slot) * 0x9e3779b9u + p.step * 0x85ebca6bu + p.seed;
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    h = h ^ (h >> 16);
    shower_chances c;
    c.whether = rg_to_float(rg_to_int(h >> 16)) * 1.52587890625e-5f;
    c.where = rg_to_float(rg_to_int(h & 0xffffu)) * 1.52587890625e-5f;
    return c;
}

// The place across the view, from -1 at its left side to 1 at its right, of a particle that was at
// `u`. If it has left, it comes in opposite, for as much rain as the wind blows in there, else
// anywhere at its distance. If wind from behind thins out the rain, some particles that have not
// left go to a side.
RG_FN float shower_across(shower_params p, float u, float ahead, shower_chances c)
{
    float anywhere = 2.0f * c.where - 1.0f;
    float from_right = c.whether < p.right_to_left ? u - 2.0f : anywhere;
    float from_left = c.whether < p.left_to_right ? u + 2.0f : anywhere;
    float side = c.where < p.to_left ? -0.999f : 0.999f;
    float inside = c.whether * ahead < p.thinning_m ? side : u;
    return u > 1.0f ? from_right : u < -1.0f ? from_left : inside;
}

// The new place of a particle that left by a side, in front or behind, and comes in again.
RG_STRUCT(shower_return)
{
    v3 at;
    int is_back; // 1: it left and comes in again
    int is_deep; // 1: it left in front or behind
};

// A particle that leaves in front comes in again behind, and the other way round, at the same place
// on the screen.
RG_FN shower_return shower_returned(shower_params p, v3 at, shower_chances c)
{
    float ahead = shower_ahead(p, at.x, at.z);
    float span = p.far_m - p.near_m;
    float deep = ahead < p.near_m ? ahead + span : ahead > p.far_m ? ahead - span : ahead;
    deep = rg_clamp(deep, p.near_m, p.far_m);
    shower_return r;
    r.is_deep = deep != ahead ? 1 : 0;
    float scale = r.is_deep != 0 ? deep / rg_max(ahead, 0.1f * p.near_m) : 1.0f;
    float most = deep * p.across;
    float u = shower_beside(p, at.x, at.z) * scale / most;
    float turned = shower_across(p, u, deep, c);
    r.is_back = r.is_deep | (turned != u ? 1 : 0);
    float beside = turned * most;
    v3 back =
        v3_make(p.eye_x + deep * p.ahead_x - beside * p.ahead_z, p.eye_y + (at.y - p.eye_y) * scale,
                p.eye_z + deep * p.ahead_z + beside * p.ahead_x);
    r.at = v3_make(r.is_back != 0 ? back.x : at.x, r.is_back != 0 ? back.y : at.y,
                   r.is_back != 0 ? back.z : at.z);
    return r;
}

// The highest place of a column that is seen; below, the lowest that is above the ground as well.
RG_FN float shower_top(shower_params p, float x, float z)
{
    return p.eye_y + shower_ahead(p, x, z) * p.above;
}

RG_FN float shower_floor(shower_params p, float x, float z, float ground)
{
    return rg_max(p.eye_y - shower_ahead(p, x, z) * p.above, ground);
}

// 1 if any part of a column is seen above the ground there.
RG_FN int shower_has_top(shower_params p, float x, float z, float ground)
{
    float ahead = shower_ahead(p, x, z);
    int deep = (ahead >= p.near_m ? 1 : 0) & (ahead <= p.far_m ? 1 : 0);
    int wide = rg_abs(shower_beside(p, x, z)) <= ahead * p.across ? 1 : 0;
    return deep & wide & (shower_top(p, x, z) > ground ? 1 : 0);
}

// The height of a particle that left at an end of its column: as far inside the other end as it had
// gone beyond, so that particles do not gather in rows.
RG_FN float shower_promoted(shower_params p, v3 at, float ground)
{
    float top = shower_top(p, at.x, at.z);
    float lowest = shower_floor(p, at.x, at.z, ground);
    float high = top - lowest;
    float raised = at.y < lowest ? at.y + high : at.y > top ? at.y - high : at.y;
    return rg_clamp(raised, lowest, top);
}

#endif
