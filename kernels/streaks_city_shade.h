// streaks: what each pixel of the scene looks like, from the number of its surface and its depth,
// which streaks_city.h has left; and the sky where there is none. So a pixel's light is reckoned
// once, however many faces lie behind each other.
#include "math.h"
#include "mesh_normal.h"
#include "streaks_city_shade_params.h"
#include "streaks_light.h"
#include "streaks_surface.h"

#define RG_PARAMS streaks_city_shade_params
#define RG_SLOTS                                                                                   \
    IMAGE(1, RGBA8, numbers)                                                                       \
    IMAGE(2, D32F, depths)                                                                         \
    IN(3, uint, surfaces)                                                                          \
    IMAGE(4, RGBA8, textures)                                                                      \
    IN(5, streaks_light, lights) IMAGE(6, D32F, shadows) IN(7, uint, openness)
#define RG_LIGHTS 1
#include "view_quad.h"

#include "streaks_openness.h"
#include "streaks_shadow.h"
#include "streaks_texture.h"

// How much more than its texture's light a wet ground throws back in the mirror's direction.
#define STREAKS_GLEAM 14.0f
// Openness is asked for so far before a surface, lest it be that of the inside of walls.
#define STREAKS_BEFORE_M 3.0f

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
    float w;
    v3 at;
    v3 ray; // from the eye, of unit length
    float distance;
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
    v3 ray = v3_make(s.at.x - p.eye_x, s.at.y - p.eye_y, s.at.z - p.eye_z);
    s.distance = rg_sqrt(rg_max(v3_dot(ray, ray), 1e-12f));
    s.ray = v3_scale(ray, 1.0f / s.distance);
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

// 1 for grounds that water stands on.
RG_FN float streaks_is_ground(uint look)
{
    uint kind = (look >> 8) & 255u;
    // A sum, for of one choice within another gcc makes branches, and no vectors.
    float asphalt = kind == STREAKS_KIND_ASPHALT ? 1.0f : 0.0f;
    float paving = kind == STREAKS_KIND_PAVING ? 0.6f : 0.0f;
    return asphalt + paving;
}

// --- lights ---

// The light that a wet ground mirrors, the rougher the ground the wider: a lobe about the half way
// between light and eye (Blinn, 1977), to the 64th power.
RG_FN float streaks_gleam(v3 n, v3 ray, v3 to_light)
{
    v3 half_way = v3_add(to_light, v3_scale(ray, -1.0f));
    float squared = rg_max(v3_dot(half_way, half_way), 1e-6f);
    float c = rg_max(v3_dot(n, half_way), 0.0f);
    float c2 = c * c / squared;
    float c4 = c2 * c2;
    float c8 = c4 * c4;
    float c16 = c8 * c8;
    float c32 = c16 * c16;
    return c32 * c32;
}

RG_DRAW_LIGHT(streaks_city_shade)
{
    streaks_light l = lights_at(rg, light);
    streaks_seen s = streaks_seen_at(rg, p, px, py);
    v3 n = mesh_normal_unpack(streaks_word(rg, s, STREAKS_NORMAL));
    float wet = p.wet * streaks_is_ground(streaks_word(rg, s, STREAKS_LOOK));
    streaks_reach reach = streaks_light_reach(l, s.at);
    float facing = rg_max(v3_dot(n, reach.to_light), 0.0f);
    float share = reach.share * facing *
                  (1.0f + STREAKS_GLEAM * wet * streaks_gleam(n, s.ray, reach.to_light));
    share = share * streaks_unshadowed_soft(rg, l, streaks_off_surface(l, s.at, n));
    return rg_rgba(l.r * share, l.g * share, l.b * share, 0.0f);
}

// --- what a pixel shows ---

RG_FN float streaks_eighth(uint word)
{
    return rg_to_float(word & 255u) * (1.0f / 255.0f);
}

RG_FN rgba streaks_painted(rg_ctx rg, streaks_city_shade_params p, streaks_seen s, uint look,
                           float facing)
{
    float u = streaks_float(rg, s, STREAKS_AX) * s.at.x +
              streaks_float(rg, s, STREAKS_AZ) * s.at.z + streaks_float(rg, s, STREAKS_A0);
    float v = streaks_float(rg, s, STREAKS_BX) * s.at.x +
              streaks_float(rg, s, STREAKS_BY) * s.at.y +
              streaks_float(rg, s, STREAKS_BZ) * s.at.z + streaks_float(rg, s, STREAKS_B0);
    float texels = s.w * p.pixel_m * streaks_float(rg, s, STREAKS_DENSITY);
    rgba t = streaks_texture(rg, u, v, rg_to_int(look & 255u),
                             texels * texels / rg_max(facing, 0.04f), p.texture_px, p.last_level);
    uint tint = streaks_word(rg, s, STREAKS_TINT);
    return rg_rgba(t.r * streaks_eighth(tint), t.g * streaks_eighth(tint >> 8),
                   t.b * streaks_eighth(tint >> 16), t.a);
}

// What a wet ground mirrors of the sky: the more, the flatter the view (Schlick, 1994).
RG_FN float streaks_mirrored(float wet, float facing)
{
    float slant = 1.0f - facing;
    float slant2 = slant * slant;
    return wet * (0.02f + 0.6f * slant2 * slant2 * slant);
}

RG_DRAW_FRAGMENT(streaks_city_shade)
{
    streaks_seen s = streaks_seen_at(rg, p, px, py);
    uint look = streaks_word(rg, s, STREAKS_LOOK);
    v3 n = mesh_normal_unpack(streaks_word(rg, s, STREAKS_NORMAL));
    float facing = rg_abs(v3_dot(n, s.ray));
    rgba t = streaks_painted(rg, p, s, look, facing);
    float wet = p.wet * streaks_is_ground(look);
    float open = streaks_openness(rg, v3_add(s.at, v3_scale(n, STREAKS_BEFORE_M)));
    float above = p.ambient * open;
    float beside = p.bounced * (1.0f - open);
    float glow = p.glow * t.a + streaks_eighth(look >> 16);
    float mirrored = streaks_mirrored(wet, facing) * open;
    // What a lamp behind lights up shows little of the light before it.
    float own = (1.0f - 0.45f * wet) * (1.0f - 0.7f * t.a);
    float shown = 1.0f - rg_exp(-s.distance * p.sky.haze_per_m);
    v3 seen =
        v3_make(t.r * (own * (above * p.sky.zenith_r + beside * p.sky.horizon_r + lit.r) + glow) +
                    mirrored * p.sky.horizon_r,
                t.g * (own * (above * p.sky.zenith_g + beside * p.sky.horizon_g + lit.g) + glow) +
                    mirrored * p.sky.horizon_g,
                t.b * (own * (above * p.sky.zenith_b + beside * p.sky.horizon_b + lit.b) + glow) +
                    mirrored * p.sky.horizon_b);
    seen = v3_make(seen.x + (p.sky.horizon_r - seen.x) * shown,
                   seen.y + (p.sky.horizon_g - seen.y) * shown,
                   seen.z + (p.sky.horizon_b - seen.z) * shown);
    v3 sky = streaks_sky_light(p.sky, s.ray);
    return rg_fragment_make(rg_rgba(s.nothing != 0 ? sky.x : seen.x,
                                    s.nothing != 0 ? sky.y : seen.y,
                                    s.nothing != 0 ? sky.z : seen.z, 1.0f),
                            1.0f);
}
