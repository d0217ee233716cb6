// The sky over the scene: overcast, brighter towards the zenith (Moon & Spencer, 1942), with haze
// along the horizon and clouds that stand still.
#ifndef RG_KERNELS_SCENERY_SKY_H
#define RG_KERNELS_SCENERY_SKY_H

#include "kernels/dialect/vec.h"

RG_STRUCT(scenery_sky)
{
    float zenith_r, zenith_g, zenith_b; // light from above
    float horizon_r, horizon_g, horizon_b;
    float clouds; // variation of their light, 0 to 1
    float haze_per_m;
};
RG_STRUCT_SIZE(scenery_sky, 8)

RG_FN float scenery_sky_grain(int x, int y)
{
    uint h = rg_to_uint(x) * 0x9e3779b1u ^ rg_to_uint(y) * 0x85ebca77u;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    return rg_to_float((h ^ (h >> 13)) & 0xffffu) * (1.0f / 65535.0f);
}

// Smooth noise, 0 to 1; x and y not negative.
RG_FN float scenery_sky_noise(float x, float y)
{
    float left = rg_floor(x);
    float top = rg_floor(y);
    int ix = rg_to_int(left);
    int iy = rg_to_int(top);
    float fx = x - left;
    float fy = y - top;
    float wx = fx * fx * (3.0f - 2.0f * fx);
    float wy = fy * fy * (3.0f - 2.0f * fy);
    float a = scenery_sky_grain(ix, iy);
    float b = scenery_sky_grain(ix + 1, iy);
    float c = scenery_sky_grain(ix, iy + 1);
    float d = scenery_sky_grain(ix + 1, iy + 1);
    float above = a + (b - a) * wx;
    float below = c + (d - c) * wx;
    return above + (below - above) * wy;
}

// The light from a direction of unit length.
RG_FN v3 scenery_sky_light(scenery_sky s, v3 d)
{
    float up = rg_max(d.y, 0.0f);
    float share = up * (2.0f - up);
    // Clouds lie on a plane overhead, and fade into the haze.
    float to_plane = 1.0f / (up + 0.08f);
    float x = d.x * to_plane + 32.0f;
    float y = d.z * to_plane + 32.0f;
    float cloud = scenery_sky_noise(x * 1.5f, y * 2.5f);
    float lit = 1.0f + s.clouds * rg_min(up * 4.0f, 1.0f) * (cloud - 0.5f);
    return v3_make((s.horizon_r + (s.zenith_r - s.horizon_r) * share) * lit,
                   (s.horizon_g + (s.zenith_g - s.horizon_g) * share) * lit,
                   (s.horizon_b + (s.zenith_b - s.horizon_b) * share) * lit);
}

#endif
