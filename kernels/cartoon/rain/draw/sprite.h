// Sprites: squares that face the eye, with a texture that is turned about its middle, (.5, .5).
// They read the slots rain_textures, whose texels are premultiplied, and boxes: the rectangle that
// is not transparent, for each level of each layer.
#ifndef RG_KERNELS_CARTOON_RAIN_DRAW_SPRITE_H
#define RG_KERNELS_CARTOON_RAIN_DRAW_SPRITE_H

#include "kernels/cartoon/rain/view.h"
#include "kernels/dialect/math.h"

#define CARTOON_TEXTURE_PX 64.0f // a side of level 0

// Layers: the drops' textures, then each pattern's.
#define CARTOON_SPLASH_LAYER(pattern, texture)                                                     \
    (CARTOON_DROP_TEXTURES + (pattern)*CARTOON_FRAMES + (texture))

// The level whose texels are nearest to pixels in size.
RG_FN int cartoon_level(cartoon_rain_params p, float side_px)
{
    float ratio = rg_max(CARTOON_TEXTURE_PX / rg_max(side_px, 1e-3f), 1.0f);
    return rg_imin(rg_to_int(rg_log2(ratio) + 0.5f), p.textures - 1);
}

// A square of `side_m` about a point; its v runs along (right, up) of the eye space.
RG_FN cartoon_sprite cartoon_sprite_at(cartoon_rain_params p, v3 at, float side_m, float right,
                                       float up)
{
    cartoon_spot s = cartoon_spot_of(p, at);
    float length = rg_sqrt(right * right + up * up);
    bool is_seen_along = length < 1e-6f;
    float inverse = 1.0f / rg_max(length, 1e-6f);
    cartoon_sprite r;
    r.x_px = s.x_px;
    r.y_px = s.y_px;
    r.side_px = side_m * p.focal_px / rg_max(s.distance_m, 1e-6f);
    r.along_x = is_seen_along ? 0.0f : right * inverse;
    r.along_y = is_seen_along ? 1.0f : -up * inverse;
    r.depth = s.depth;
    r.alpha = 1.0f;
    r.layer = 0;
    r.level = cartoon_level(p, r.side_px);
    r.seen = (s.distance_m > 0.0f ? 1 : 0) & (s.depth > 0.0f ? 1 : 0);
    return r;
}

// The corner at (u, v) of the texture.
RG_FN rg_corner cartoon_sprite_corner(cartoon_rain_params p, cartoon_sprite s, float u, float v)
{
    float across = (u - 0.5f) * s.side_px;
    float along = (v - 0.5f) * s.side_px;
    float x = s.x_px + along * s.along_x + across * s.along_y;
    float y = s.y_px + along * s.along_y - across * s.along_x;
    return rg_corner_make(x / rg_to_float(p.width) * 2.0f - 1.0f,
                          y / rg_to_float(p.height) * 2.0f - 1.0f, s.depth, 1.0f);
}

RG_FN rg_item cartoon_sprite_item(rg_ctx rg, cartoon_rain_params p, cartoon_sprite s)
{
    int box = (s.layer * p.textures + s.level) * 4;
    bool is_cut = p.cut != 0;
    float left = is_cut ? boxes_at(rg, box) : 0.0f;
    float top = is_cut ? boxes_at(rg, box + 1) : 0.0f;
    float right = is_cut ? boxes_at(rg, box + 2) : 1.0f;
    float bottom = is_cut ? boxes_at(rg, box + 3) : 1.0f;
    rg_item t;
    t.alive = s.seen;
    t.a = cartoon_sprite_corner(p, s, left, top);
    t.b = cartoon_sprite_corner(p, s, left, bottom);
    t.c = cartoon_sprite_corner(p, s, right, bottom);
    t.d = cartoon_sprite_corner(p, s, right, top);
    return t;
}

// The rotation of figure 4, about the middle of the texture.
RG_FN rg_fragment cartoon_sprite_fragment(rg_ctx rg, cartoon_sprite s, int px, int py)
{
    float x = (rg_to_float(px) + 0.5f - s.x_px) / s.side_px;
    float y = (rg_to_float(py) + 0.5f - s.y_px) / s.side_px;
    float u = x * s.along_y - y * s.along_x + 0.5f;
    float v = x * s.along_x + y * s.along_y + 0.5f;
    rgba c = rain_textures_linear(rg, u, v, s.layer, s.level);
    rg_fragment f = rg_fragment_make(
        rg_rgba(c.r * s.alpha, c.g * s.alpha, c.b * s.alpha, c.a * s.alpha), s.depth);
    f.kept = (u >= 0.0f ? 1 : 0) & (u <= 1.0f ? 1 : 0) & (v >= 0.0f ? 1 : 0) & (v <= 1.0f ? 1 : 0) &
             (c.a > 0.0f ? 1 : 0);
    return f;
}

#endif
