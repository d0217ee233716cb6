// Hatching (Praun et al., 2001): a pixel mixes two neighbouring tones. Each tone is a texture of
// strokes, which contains the strokes of lighter tones and coarser levels. Strokes are fixed to the
// world: they lie in the plane of two axes that the surface is nearest to.
#include "kernels/cartoon/scene/shade_params.h"
#include "kernels/dialect/math.h"

#define RG_PARAMS cartoon_shade_params
#define RG_SLOTS                                                                                   \
    IMAGE(1, D32F, depth_map)                                                                      \
    IMAGE(2, RGBA16F, normal_map) IN(3, uint, palette) IMAGE(4, D32F, ink) IMAGE(5, RGBA8, strokes)
#include "kernels/dialect/draw/view_quad.h"

#include "kernels/cartoon/scene/seen.h"

RG_DRAW_ITEM(cartoon_hatching)
{
    return view_quad();
}

RG_DRAW_RECORD(cartoon_hatching)
{
    return view_quad_record();
}

// A place on the texture of strokes, in tiles.
RG_STRUCT(cartoon_uv)
{
    float u;
    float v;
};

RG_FN cartoon_uv cartoon_uv_of(cartoon_shade_params p, v3 n, v3 at)
{
    float x = rg_abs(n.x);
    float y = rg_abs(n.y);
    float z = rg_abs(n.z);
    bool level = y >= x && y >= z;
    bool sideways = x > z;
    cartoon_uv t;
    t.u = (level ? at.x : sideways ? at.z : at.x) * p.per_tile;
    t.v = (level ? at.z : at.y) * p.per_tile;
    return t;
}

// A texel's tones `tone` and `tone` + 1, 0 to 255, mixed.
RG_FN float cartoon_stroke(rg_ctx rg, int x, int y, int tone, float t, int level)
{
    int mask = strokes_width(rg, level) - 1;
    int layer = tone >= 3 ? 1 : 0;
    uint word = strokes_bytes(rg, x & mask, y & mask, layer, level);
    uint channel = rg_to_uint(tone - 3 * layer);
    float a = rg_to_float(rg_to_int((word >> (8u * channel)) & 255u));
    float b = rg_to_float(rg_to_int((word >> (8u * channel + 8u)) & 255u));
    return cartoon_mix(a, b, t);
}

// Interpolates between four texels of a level, which repeats in every tile.
RG_FN float cartoon_level(rg_ctx rg, cartoon_uv at, int tone, float t, int level)
{
    float size = rg_to_float(strokes_width(rg, level));
    float x = at.u * size - 0.5f;
    float y = at.v * size - 0.5f;
    float left = rg_floor(x);
    float top = rg_floor(y);
    int ix = rg_to_int(left);
    int iy = rg_to_int(top);
    float above = cartoon_mix(cartoon_stroke(rg, ix, iy, tone, t, level),
                              cartoon_stroke(rg, ix + 1, iy, tone, t, level), x - left);
    float below = cartoon_mix(cartoon_stroke(rg, ix, iy + 1, tone, t, level),
                              cartoon_stroke(rg, ix + 1, iy + 1, tone, t, level), x - left);
    return cartoon_mix(above, below, y - top);
}

// The lightness of the strokes, 0 to 1, for a light of 0 to 1.
RG_FN float cartoon_hatch(rg_ctx rg, cartoon_uv at, float light, float lod)
{
    float tones = rg_clamp(light, 0.0f, 1.0f) * rg_to_float(CARTOON_TONES);
    int tone = rg_imin(rg_to_int(tones), CARTOON_TONES - 1);
    float t = tones - rg_to_float(tone);
    int last = strokes_levels(rg) - 1;
    float fine = rg_clamp(lod, 0.0f, rg_to_float(last));
    int level = rg_imin(rg_to_int(fine), last - 1);
    float near_by = cartoon_level(rg, at, tone, t, level);
    float far_off = cartoon_level(rg, at, tone, t, level + 1);
    return cartoon_mix(near_by, far_off, fine - rg_to_float(level)) * (1.0f / 255.0f);
}

RG_DRAW_FRAGMENT(cartoon_hatching)
{
    cartoon_seen s = cartoon_seen_at(rg, p, px, py);
    v3 at = cartoon_place(p, depth_map_texel(rg, px, py, 0, 0).r, px, py);
    v3 view = v3_make(at.x - p.eye_x, at.y - p.eye_y, at.z - p.eye_z);
    float far2 = rg_max(v3_dot(view, view), 1e-12f);
    float slant = rg_max(rg_abs(v3_dot(view, s.normal)) / rg_sqrt(far2), 0.05f);
    float lod = p.lod + 0.5f * rg_log2(far2 / slant);
    float grey = 0.3f * s.colour.x + 0.6f * s.colour.y + 0.1f * s.colour.z;
    float light = cartoon_mix(p.ambient, p.lit, rg_max(s.facing, 0.0f)) * (0.5f + 0.5f * grey);
    float hatch = cartoon_hatch(rg, cartoon_uv_of(p, s.normal, at), light, lod);
    v3 paper = v3_make(p.paper_r, p.paper_g, p.paper_b);
    v3 washed =
        v3_make(cartoon_mix(1.0f, s.colour.x, p.wash), cartoon_mix(1.0f, s.colour.y, p.wash),
                cartoon_mix(1.0f, s.colour.z, p.wash));
    v3 c = v3_make(cartoon_mix(p.ink_r, paper.x * washed.x, hatch),
                   cartoon_mix(p.ink_g, paper.y * washed.y, hatch),
                   cartoon_mix(p.ink_b, paper.z * washed.z, hatch));
    return cartoon_inked(rg, p, cartoon_or(s.nothing, paper, c), px, py);
}
