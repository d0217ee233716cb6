// What is seen at a pixel, from the slots depth_map, normal_map and palette of the style that
// includes this, and the sky where there is nothing.
#ifndef RG_KERNELS_CARTOON_SCENE_SEEN_H
#define RG_KERNELS_CARTOON_SCENE_SEEN_H

RG_STRUCT(cartoon_seen)
{
    int nothing; // 1: the sky
    v3 normal;   // on the side that is seen, of unit length
    v3 colour;   // display values
    float shine;
    float facing; // cosine between normal and light
    float mirror; // cosine between the view and the light's mirrored direction, 0 at least
};

RG_FN v3 cartoon_place(cartoon_shade_params p, float depth, int px, int py)
{
    rg_corner c =
        m4_project(p.from_pixel, v3_make(rg_to_float(px) + 0.5f, rg_to_float(py) + 0.5f, depth));
    float over_w = 1.0f / rg_max(c.w, 1e-9f);
    return v3_make(c.x * over_w, c.y * over_w, c.z * over_w);
}

RG_FN cartoon_seen cartoon_seen_at(rg_ctx rg, cartoon_shade_params p, int px, int py)
{
    float depth = depth_map_texel(rg, px, py, 0, 0).r;
    rgba texel = normal_map_texel(rg, px, py, 0, 0);
    v3 at = cartoon_place(p, depth, px, py);
    v3 light = v3_make(p.light_x, p.light_y, p.light_z);
    cartoon_seen s;
    s.nothing = texel.a > 0.0f ? 0 : 1;
    s.normal = v3_make(texel.r, texel.g, texel.b);
    int word = rg_imax(rg_to_int(texel.a) - 1, 0) * CARTOON_MATERIAL_WORDS;
    s.colour = v3_make(palette_at(rg, word), palette_at(rg, word + 1), palette_at(rg, word + 2));
    s.shine = palette_at(rg, word + 3);
    s.facing = v3_dot(s.normal, light);
    v3 view = v3_make(p.eye_x - at.x, p.eye_y - at.y, p.eye_z - at.z);
    v3 mirrored = v3_add(v3_scale(s.normal, 2.0f * s.facing), v3_scale(light, -1.0f));
    s.mirror = rg_max(v3_dot(view, mirrored), 0.0f) / rg_sqrt(rg_max(v3_dot(view, view), 1e-12f));
    return s;
}

// A highlight: the mirror's cosine to the 32nd power.
RG_FN float cartoon_shine(cartoon_seen s)
{
    float c2 = s.mirror * s.mirror;
    float c4 = c2 * c2;
    float c8 = c4 * c4;
    float c16 = c8 * c8;
    return c16 * c16 * s.shine;
}

// The sky, from above to below.
RG_FN v3 cartoon_sky(cartoon_shade_params p, int py)
{
    float t = (rg_to_float(py) + 0.5f) / p.height_px;
    return v3_make(p.sky_r + (p.low_r - p.sky_r) * t, p.sky_g + (p.low_g - p.sky_g) * t,
                   p.sky_b + (p.low_b - p.sky_b) * t);
}

// What the target takes of a colour in display values.
RG_FN rg_fragment cartoon_shown(v3 c)
{
    float r = rg_clamp(c.x, 0.0f, 1.0f);
    float g = rg_clamp(c.y, 0.0f, 1.0f);
    float b = rg_clamp(c.z, 0.0f, 1.0f);
    return rg_fragment_make(rg_rgba(r * r, g * g, b * b, 1.0f), 1.0f);
}

#endif
