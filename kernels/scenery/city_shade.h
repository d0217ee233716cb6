// Shades each pixel of the scene, from the surface number and depth that city.h left, or draws the
// sky if there is no surface. So a pixel's light is computed once, however many faces lie behind
// each other.
#include "kernels/dialect/math.h"
#include "kernels/scenery/city_shade_params.h"
#include "kernels/scenery/light.h"
#include "kernels/scenery/surface.h"

#define RG_PARAMS scenery_city_shade_params
#define RG_SLOTS                                                                                   \
    IMAGE(1, RGBA8, numbers)                                                                       \
    IMAGE(2, D32F, depths)                                                                         \
    IN(3, uint, surfaces)                                                                          \
    SAMPLED(4, RGBA8, textures, TILED)                                                             \
    IN(5, scenery_light, lights) SAMPLED(6, D32F, shadows, SHADOW) IN(7, uint, openness)
#define RG_LIGHTS 1
#define RG_GLOSS  1
#include "kernels/dialect/draw/view_quad.h"

#include "kernels/scenery/openness.h"
#include "kernels/scenery/shadow.h"
#include "kernels/scenery/texture.h"

// The roughness of the water on a wet ground, squared as in Walter et al. (2007). docs/city.md
// compares its reflection with that of wet roads as measured.
#define SCENERY_FILM 0.25f
// The same for a sun or moon, whose light comes through rain clouds, from a wide patch of the sky.
#define SCENERY_CLOUDED 0.6f
// Openness is read this far in front of a surface, and not inside the wall.
#define SCENERY_BEFORE_M 3.0f

RG_DRAW_ITEM(streaks_city_shade)
{
    return view_quad();
}

RG_DRAW_RECORD(streaks_city_shade)
{
    return view_quad_record();
}

// The point of the scene that is seen at a pixel.
RG_STRUCT(scenery_seen)
{
    int first_word; // of its surface
    int nothing;    // 1: the sky
    float w;
    v3 at;
    v3 ray; // from the eye, of unit length
    float distance;
};

RG_FN scenery_seen scenery_seen_at(rg_ctx rg, scenery_city_shade_params p, int px, int py)
{
    float depth = depths_texel(rg, px, py, 0, 0).r;
    uint number = numbers_bytes(rg, px, py, 0, 0);
    v3 pixel = v3_make(rg_to_float(px) + 0.5f, rg_to_float(py) + 0.5f, depth);
    rg_corner c = m4_project(p.from_pixel, pixel);
    scenery_seen s;
    s.nothing = depth >= 1.0f ? 1 : 0;
    s.first_word = s.nothing != 0 ? 0 : rg_to_int(number) * SCENERY_SURFACE_WORDS;
    s.w = 1.0f / rg_max(c.w, 1e-9f);
    s.at = v3_make(c.x * s.w, c.y * s.w, c.z * s.w);
    v3 ray = v3_make(s.at.x - p.eye_x, s.at.y - p.eye_y, s.at.z - p.eye_z);
    s.distance = rg_sqrt(rg_max(v3_dot(ray, ray), 1e-12f));
    s.ray = v3_scale(ray, 1.0f / s.distance);
    return s;
}

RG_FN uint scenery_word(rg_ctx rg, scenery_seen s, int word)
{
    return surfaces_at(rg, s.first_word + word);
}

// The wetness that a surface gets, 0 to 1.
RG_FN float scenery_wetness(uint normal)
{
    return rg_to_float(normal >> 30) * (1.0f / 3.0f);
}

// --- textures ---

// The upper 16 bits of a word as a signed number; below, the lower ones.
RG_FN float scenery_upper(uint word)
{
    return rg_to_float(rg_to_int(word >> 16) - ((word >> 31) != 0u ? 65536 : 0));
}

RG_FN float scenery_lower(uint word)
{
    return scenery_upper(word << 16);
}

RG_FN rgba scenery_painted(rg_ctx rg, scenery_city_shade_params p, scenery_seen s, v3 n, uint look,
                           float facing)
{
    uint scales = scenery_word(rg, s, SCENERY_SCALES);
    uint offsets = scenery_word(rg, s, SCENERY_OFFSETS);
    float scale_u = scenery_lower(scales) * (1.0f / SCENERY_SCALE_STEPS);
    float scale_v = scenery_upper(scales) * (1.0f / SCENERY_SCALE_STEPS);
    int level = n.y > SCENERY_LEVEL_Y || n.y < -SCENERY_LEVEL_Y ? 1 : 0;
    int turned = rg_to_int((look >> SCENERY_TURNED_BIT) & 1u);
    float ground_u = turned != 0 ? s.at.z : s.at.x;
    float ground_v = turned != 0 ? s.at.x : s.at.z;
    float along_u = level != 0 ? ground_u : n.z * s.at.x - n.x * s.at.z;
    float along_v = level != 0 ? ground_v : s.at.y;
    float u = scale_u * along_u + scenery_lower(offsets) * (1.0f / 65536.0f);
    float v = scale_v * along_v + scenery_upper(offsets) * (1.0f / 65536.0f);
    // The product of the texels that a pixel is wide and, seen at a slant, long.
    float width = s.w * p.pixel_m * rg_to_float(p.texture_px);
    float texels = width * width * rg_abs(scale_u * scale_v) / rg_max(facing, 0.04f);
    rgba t = scenery_texture(rg, u, v, rg_to_int(look & 255u), texels, p.texture_px, p.last_level);
    uint tint = look >> SCENERY_TINT_BIT;
    return rg_rgba(t.r * (rg_to_float(tint & 31u) * (1.0f / 31.0f)),
                   t.g * (rg_to_float((tint >> 5) & 63u) * (1.0f / 63.0f)),
                   t.b * (rg_to_float(tint >> 11) * (1.0f / 31.0f)), t.a);
}

// --- lights ---

// The share of a lamp's light that a wet ground's water mirrors to the eye, over that which a white
// matt ground that faces the lamp shows: facets as many as GGX has, in each other's shadow (Smith),
// with Fresnel's reflectance by Schlick (1994).
RG_FN float scenery_gleam(int kind, v3 n, v3 ray, v3 to_light, float facing)
{
    float alpha = kind == SCENERY_SUN ? SCENERY_CLOUDED : SCENERY_FILM;
    float rough = alpha * alpha;
    float least = 1.0f - rough;
    v3 half_way = v3_add(to_light, v3_scale(ray, -1.0f));
    float length = rg_sqrt(rg_max(v3_dot(half_way, half_way), 1e-6f));
    float c = rg_max(v3_dot(n, half_way), 0.0f) / length;
    float seen = rg_max(-v3_dot(n, ray), 1e-3f);
    float between = 1.0f - rg_min(v3_dot(to_light, half_way) / length, 1.0f);
    float between2 = between * between;
    float reflected = 0.02f + 0.98f * between2 * between2 * between;
    float narrow = 1.0f - c * c * least;
    float apart = facing * rg_sqrt(rough + least * seen * seen) +
                  seen * rg_sqrt(rough + least * facing * facing);
    return 0.5f * reflected * rough * facing / (narrow * narrow * rg_max(apart, 1e-6f));
}

RG_DRAW_LIGHT(streaks_city_shade)
{
    scenery_light l = lights_at(rg, light);
    scenery_seen s = scenery_seen_at(rg, p, px, py);
    uint normal = scenery_word(rg, s, SCENERY_NORMAL);
    v3 n = mesh_normal_unpack(normal);
    float wet = p.wet * scenery_wetness(normal);
    scenery_reach reach = scenery_light_reach(l, s.at);
    float facing = rg_max(v3_dot(n, reach.to_light), 0.0f);
    float share = reach.share * scenery_unshadowed_soft(rg, l, scenery_off_surface(l, s.at, n));
    float matt = share * facing;
    float gloss = share * wet * scenery_gleam(l.kind, n, s.ray, reach.to_light, facing);
    rg_lit falls;
    falls.r = l.r * matt;
    falls.g = l.g * matt;
    falls.b = l.b * matt;
    falls.gloss_r = l.r * gloss;
    falls.gloss_g = l.g * gloss;
    falls.gloss_b = l.b * gloss;
    return falls;
}

// --- what a pixel shows ---

// The share of the sky's light that a wet ground mirrors: more for a flatter view (Schlick, 1994).
RG_FN float scenery_mirrored(float wet, float facing)
{
    float slant = 1.0f - facing;
    float slant2 = slant * slant;
    return wet * (0.02f + 0.6f * slant2 * slant2 * slant);
}

RG_DRAW_FRAGMENT(streaks_city_shade)
{
    scenery_seen s = scenery_seen_at(rg, p, px, py);
    uint look = scenery_word(rg, s, SCENERY_LOOK);
    uint normal = scenery_word(rg, s, SCENERY_NORMAL);
    v3 n = mesh_normal_unpack(normal);
    float facing = rg_abs(v3_dot(n, s.ray));
    rgba t = scenery_painted(rg, p, s, n, look, facing);
    float wet = p.wet * scenery_wetness(normal);
    float open = scenery_openness(rg, v3_add(s.at, v3_scale(n, SCENERY_BEFORE_M)));
    float above = p.ambient * open;
    float beside = p.bounced * (1.0f - open);
    float glow = p.glow * t.a + rg_to_float((look >> SCENERY_GLOW_BIT) & 7u) * (1.0f / 7.0f);
    float mirrored = scenery_mirrored(wet, facing) * open;
    // A surface lit by a lamp behind it shows little of the light that falls on its front.
    float front = 1.0f - 0.7f * t.a;
    // Water in its pores darkens it.
    float own = (1.0f - 0.45f * wet) * front;
    float shown = 1.0f - rg_exp(-s.distance * p.sky.haze_per_m);
    v3 seen =
        v3_make(t.r * (own * (above * p.sky.zenith_r + beside * p.sky.horizon_r + lit.r) + glow) +
                    mirrored * p.sky.horizon_r + front * lit.gloss_r,
                t.g * (own * (above * p.sky.zenith_g + beside * p.sky.horizon_g + lit.g) + glow) +
                    mirrored * p.sky.horizon_g + front * lit.gloss_g,
                t.b * (own * (above * p.sky.zenith_b + beside * p.sky.horizon_b + lit.b) + glow) +
                    mirrored * p.sky.horizon_b + front * lit.gloss_b);
    seen = v3_make(seen.x + (p.sky.horizon_r - seen.x) * shown,
                   seen.y + (p.sky.horizon_g - seen.y) * shown,
                   seen.z + (p.sky.horizon_b - seen.z) * shown);
    v3 sky = scenery_sky_light(p.sky, s.ray);
    return rg_fragment_make(rg_rgba(s.nothing != 0 ? sky.x : seen.x,
                                    s.nothing != 0 ? sky.y : seen.y,
                                    s.nothing != 0 ? sky.z : seen.z, 1.0f),
                            1.0f);
}
