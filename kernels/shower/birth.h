// A new particle: its place of birth and its first motion (section II.B).
#ifndef RG_KERNELS_SHOWER_BIRTH_H
#define RG_KERNELS_SHOWER_BIRTH_H

#include "kernels/dialect/math.h"
#include "kernels/dialect/rng.h"
#include "kernels/shower/particle.h"

// Eqs. 6 to 8; if p.is_even, the same body with as many particles in each cubic metre.
RG_FN v3 shower_direction(shower_params p, float r2, float r3)
{
    float phi = p.phi_rad + p.phi_span_rad * r2;
    float lowest = rg_cos(p.phi_rad + p.phi_span_rad);
    float even = lowest + (rg_cos(p.phi_rad) - lowest) * (1.0f - r2);
    float up = p.is_even != 0 ? even : rg_cos(phi);
    float level = p.is_even != 0 ? rg_sqrt(1.0f - even * even) : rg_sin(phi);
    float theta = p.theta_rad + p.theta_span_rad * r3;
    return v3_make(level * rg_sin(theta), up, level * rg_cos(theta));
}

RG_FN float shower_distance(shower_params p, float r1)
{
    float least = p.near_m * p.near_m * p.near_m;
    float most = p.far_m * p.far_m * p.far_m;
    return p.is_even != 0 ? rg_cbrt(least + (most - least) * r1)
                          : p.near_m + (p.far_m - p.near_m) * r1;
}

// Eqs. 3 to 5 and 9 to 13.
RG_FN shower_particle shower_born(shower_params p, int slot)
{
    rg_uint4 words = rg_random(p.seed, rg_to_uint(slot), p.step, SHOWER_PLACE);
    float r = shower_distance(p, rg_uniform(words.x));
    v3 way = v3_scale(shower_direction(p, rg_uniform(words.y), rg_uniform(words.z)), r);
    shower_particle q;
    q.at = v3_make(p.eye_x + way.x, p.eye_y + way.y, p.eye_z + way.z);
    q.fall_m_s = p.fall_m_s * shower_share(p, shower_ahead(p, q.at.x, q.at.z));
    q.vx = p.wind_x;
    q.vz = p.wind_z;
    q.acceleration = v3_make(0.0f, -p.gravity_m_s2, 0.0f);
    q.age = 0.0f;
    return q;
}

#endif
