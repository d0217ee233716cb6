// Finds particles out of sight: tests a ball around each against the view's sides, long before the
// billboard's corners are known. The margin for rounding far exceeds the error of floats.
#ifndef RG_KERNELS_STREAKS_TAPS_UNSEEN_H
#define RG_KERNELS_STREAKS_TAPS_UNSEEN_H

#include "kernels/streaks/material.h"

// The values that the particles of a block share; prefetches the particles' words, a cache line at
// a time.
RG_FN streaks_block streaks_block_ahead(rg_ctx rg, streaks_params p, int i)
{
    streaks_block b = streaks_block_at(rg, p, i);
    for (int word = 0; word < 3 * STREAKS_BLOCK; word += 16) {
        RG_FETCH(rg, particles, 3 * rg_to_int(b.first) + word)
    }
    return b;
}

RG_FN float streaks_most(float x, float y, float z, float w)
{
    return rg_max(rg_max(rg_abs(x), rg_abs(y)), rg_max(rg_abs(z), rg_abs(w)));
}

RG_FN float streaks_length(float x, float y, float z)
{
    return rg_sqrt(x * x + y * y + z * z);
}

// Whether a ball around a place lies beyond one of the view's sides. On a side, the sum or
// difference of two of the matrix's rows is 0.
RG_FN int streaks_out_of_view(m4 m, v3 at, float radius)
{
    rg_corner g = m4_project(m, at);
    float most =
        rg_max(rg_max(streaks_most(m.xx, m.xy, m.xz, m.xw), streaks_most(m.yx, m.yy, m.yz, m.yw)),
               rg_max(streaks_most(m.zx, m.zy, m.zz, m.zw), streaks_most(m.wx, m.wy, m.wz, m.ww)));
    float lost = 1e-3f + 2e-5f * most * (1.0f + rg_abs(at.x) + rg_abs(at.y) + rg_abs(at.z));
    float before = radius * streaks_length(m.zx, m.zy, m.zz);
    float left = radius * streaks_length(m.wx + m.xx, m.wy + m.xy, m.wz + m.xz);
    float right = radius * streaks_length(m.wx - m.xx, m.wy - m.xy, m.wz - m.xz);
    float above = radius * streaks_length(m.wx + m.yx, m.wy + m.yy, m.wz + m.yz);
    float below = radius * streaks_length(m.wx - m.yx, m.wy - m.yy, m.wz - m.yz);
    float inside = rg_min(rg_min(g.w + g.x + left, g.w - g.x + right),
                          rg_min(g.w + g.y + above, g.w - g.y + below));
    return rg_min(inside, g.z + before) + lost < 0.0f ? 1 : 0;
}

// An upper bound of streaks_slope, which goes half a texel of the map across and down, times 4 at
// most.
RG_FN float streaks_slope_within(rg_ctx rg, streaks_params p)
{
    float x = 1.0f / (p.map_per_x * rg_to_float(numbers_width(rg, 0)));
    float y = 1.0f / (p.map_per_y * rg_to_float(numbers_height(rg, 0)));
    return rg_to_float(p.follows) * 2.1f * (rg_abs(x) + rg_abs(y));
}

// The ball contains the billboard's corners. A drop's ball is around the middle of its streak,
// which is at least thinnest_px wide; a splash's is around the impact.
RG_FN int streaks_unseen(rg_ctx rg, streaks_params p, streaks_particle t)
{
    float splash = t.state == STREAKS_SPLASH ? 1.0f : 0.0f;
    float half_fall = 0.5f * p.fall * t.speed;
    float along = t.s - half_fall;
    v3 at = v3_make(t.x, t.y, along + (t.hit - along) * splash);
    float w = p.to_clip.wx * at.x + p.to_clip.wy * at.y + p.to_clip.wz * at.z + p.to_clip.ww;
    float thinnest = p.thinnest_px * rg_max(w, 1e-3f) / p.focal_px;
    float drop = half_fall + (p.drop_radius + p.half_width) * t.radius + thinnest;
    float tall = p.splash_height * (1.0f + p.splash_foot) + 0.5f * p.splash_width;
    float crown = 1.2f * tall * t.radius + streaks_slope_within(rg, p);
    float radius = 1.01f * (drop + crown * splash) + 1e-3f;
    return (t.state == STREAKS_NOTHING ? 1 : 0) | streaks_out_of_view(p.to_clip, at, radius);
}

#endif
