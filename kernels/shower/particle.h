// A particle by value: its motion and its size. Kernels, in the folders below, and the host's own
// allocation (core/techniques/shower/heap.c) share the files of this folder.
#ifndef RG_KERNELS_SHOWER_PARTICLE_H
#define RG_KERNELS_SHOWER_PARTICLE_H

#include "kernels/shower/params.h"

RG_STRUCT(shower_particle)
{
    v3 at;
    float fall_m_s; // 0: there is none
    // Further attributes of the traditional system.
    float vx, vz;
    v3 acceleration;
    float age; // frames
};

// The distance of a place ahead of the eye; below, to the eye's right.
RG_FN float shower_ahead(shower_params p, float x, float z)
{
    return (x - p.eye_x) * p.ahead_x + (z - p.eye_z) * p.ahead_z;
}

RG_FN float shower_beside(shower_params p, float x, float z)
{
    return (z - p.eye_z) * p.ahead_x - (x - p.eye_x) * p.ahead_z;
}

// The share of the full size and speed that drops at this distance have: 1, 1/2 and 1/3 in three
// layers of equal depth.
RG_FN float shower_share(shower_params p, float ahead)
{
    float depth = (ahead - p.near_m) / (p.far_m - p.near_m);
    float share = depth < 0.33333334f ? 1.0f : depth < 0.6666667f ? 0.5f : 0.33333334f;
    return p.is_layered != 0 ? share : 1.0f;
}

// A step: the place moves by the velocity at the step's beginning, and the velocity by the
// acceleration. The horizontal velocity is the wind of the moment.
RG_FN shower_particle shower_moved(shower_params p, shower_particle q)
{
    shower_particle m = q;
    m.at = v3_make(q.at.x + p.wind_x * p.step_s, q.at.y - q.fall_m_s * p.step_s,
                   q.at.z + p.wind_z * p.step_s);
    float gained = p.accelerates != 0 ? q.acceleration.y * p.step_s : 0.0f;
    m.fall_m_s = q.fall_m_s > 0.0f ? q.fall_m_s - gained : 0.0f;
    m.vx = p.wind_x + q.acceleration.x * p.step_s;
    m.vz = p.wind_z + q.acceleration.z * p.step_s;
    m.age = q.age + 1.0f;
    return m;
}

// The vector from a drop's lower end to its upper one: against its velocity, and as high as the
// drop.
RG_FN v3 shower_upwards(shower_params p, v3 at, float fall_m_s)
{
    float height = p.height_m * shower_share(p, shower_ahead(p, at.x, at.z));
    float back = height / rg_max(fall_m_s, 1e-3f);
    return v3_make(-p.wind_x * back, height, -p.wind_z * back);
}

#endif
