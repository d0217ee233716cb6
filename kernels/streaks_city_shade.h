// streaks: what each pixel of the scene looks like, from the number of its surface and its depth,
// which streaks_city.h has left; and the sky where there is none. So a pixel's light is reckoned
// once, however many faces lie behind each other.
#include "math.h"
#include "mesh_normal.h"
#include "streaks_city_shade_params.h"
#include "streaks_surface.h"

#define RG_PARAMS streaks_city_shade_params
#define RG_SLOTS                                                                                   \
    IMAGE(1, RGBA8, numbers)                                                                       \
    IMAGE(2, D32F, depths) IN(3, uint, surfaces) IMAGE(4, RGBA8, textures)
#include "view_quad.h"

#include "streaks_texture.h"

RG_DRAW_ITEM(streaks_city_shade)
{
    return view_quad();
}

RG_DRAW_RECORD(streaks_city_shade)
{
    return view_quad_record();
}

// What is seen at a pixel.
RG_STRUCT(streaks_seen)
{
    int first_word; // of its surface
    int nothing;    // 1: the sky
    v3 at;
    float w;
};

RG_FN streaks_seen streaks_seen_at(rg_ctx rg, streaks_city_shade_params p, int px, int py)
{
    float depth = depths_texel(rg, px, py, 0, 0).r;
    uint number = numbers_bytes(rg, px, py, 0, 0);
    v3 pixel = v3_make(rg_to_float(px) + 0.5f, rg_to_float(py) + 0.5f, depth);
    rg_corner c = m4_project(p.from_pixel, pixel);
    streaks_seen s;
    s.nothing = depth >= 1.0f ? 1 : 0;
    s.first_word = s.nothing != 0 ? 0 : rg_to_int(number) * STREAKS_SURFACE_WORDS;
    s.w = 1.0f / rg_max(c.w, 1e-9f);
    s.at = v3_make(c.x * s.w, c.y * s.w, c.z * s.w);
    return s;
}

RG_FN uint streaks_word(rg_ctx rg, streaks_seen s, int word)
{
    return surfaces_at(rg, s.first_word + word);
}

RG_FN float streaks_float(rg_ctx rg, streaks_seen s, int word)
{
    return rg_bits_float(streaks_word(rg, s, word));
}

RG_FN float streaks_tint(uint word)
{
    return rg_to_float(word & 255u) * (1.0f / 255.0f);
}

RG_DRAW_FRAGMENT(streaks_city_shade)
{
    streaks_seen s = streaks_seen_at(rg, p, px, py);
    v3 eye = v3_make(p.eye_x, p.eye_y, p.eye_z);
    v3 ray = v3_add(s.at, v3_scale(eye, -1.0f));
    float distance = rg_sqrt(v3_dot(ray, ray));
    ray = v3_scale(ray, 1.0f / rg_max(distance, 1e-6f));
    v3 sky = streaks_sky_light(p.sky, ray);

    v3 n = mesh_normal_unpack(streaks_word(rg, s, STREAKS_NORMAL));
    float facing = rg_max(rg_abs(v3_dot(n, ray)), 0.04f);
    float u = streaks_float(rg, s, STREAKS_AX) * s.at.x +
              streaks_float(rg, s, STREAKS_AZ) * s.at.z + streaks_float(rg, s, STREAKS_A0);
    float v = streaks_float(rg, s, STREAKS_BX) * s.at.x +
              streaks_float(rg, s, STREAKS_BY) * s.at.y +
              streaks_float(rg, s, STREAKS_BZ) * s.at.z + streaks_float(rg, s, STREAKS_B0);
    float texels = s.w * p.pixel_m * streaks_float(rg, s, STREAKS_DENSITY);
    uint look = streaks_word(rg, s, STREAKS_LOOK);
    uint tint = streaks_word(rg, s, STREAKS_TINT);
    rgba t = streaks_texture(rg, u, v, rg_to_int(look & 255u), texels * texels / facing,
                             p.texture_px, p.last_level);
    float sun = p.sun * rg_max(v3_dot(n, v3_make(p.sun_x, p.sun_y, p.sun_z)), 0.0f);
    float around = p.ambient * (0.55f + 0.45f * n.y);
    float glow = p.glow * t.a;
    float shown = 1.0f - rg_exp(-distance * p.sky.haze_per_m);
    v3 light = v3_make(sun + glow + around * p.sky.zenith_r, sun + glow + around * p.sky.zenith_g,
                       sun + glow + around * p.sky.zenith_b);
    v3 seen = v3_make(t.r * streaks_tint(tint) * light.x, t.g * streaks_tint(tint >> 8) * light.y,
                      t.b * streaks_tint(tint >> 16) * light.z);
    seen = v3_make(seen.x + (p.sky.horizon_r - seen.x) * shown,
                   seen.y + (p.sky.horizon_g - seen.y) * shown,
                   seen.z + (p.sky.horizon_b - seen.z) * shown);
    int nothing = s.nothing;
    rgba c = rg_rgba(nothing != 0 ? sky.x : seen.x, nothing != 0 ? sky.y : seen.y,
                     nothing != 0 ? sky.z : seen.z, 1.0f);
    return rg_fragment_make(c, 1.0f);
}
