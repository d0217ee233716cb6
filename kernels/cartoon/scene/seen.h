// The surface that is seen at a pixel, or the sky where there is none. Reads the slots depth_map,
// normal_map, palette and ink of the style that includes this file.
#ifndef RG_KERNELS_CARTOON_SCENE_SEEN_H
#define RG_KERNELS_CARTOON_SCENE_SEEN_H

RG_STRUCT(cartoon_seen)
{
    int nothing; // 1: the sky
    v3 normal;   // on the side that is seen, of unit length
    v3 colour;   // display values
    float shine;
    float facing; // cosine between normal and light
};

RG_FN float cartoon_byte(uint bits)
{
    return rg_to_float(rg_to_int(bits & 255u)) * (1.0f / 255.0f);
}

// Reads a pixel's texel of the normal map, and its material in the palette, whose first word is the
// sky's.
RG_FN cartoon_seen cartoon_seen_at(rg_ctx rg, cartoon_shade_params p, int px, int py)
{
    rgba texel = normal_map_texel(rg, px, py, 0, 0);
    cartoon_seen s;
    s.nothing = texel.a > 0.0f ? 0 : 1;
    s.normal = v3_make(texel.r, texel.g, texel.b);
    uint material = palette_at(rg, rg_to_int(texel.a));
    s.colour =
        v3_make(cartoon_byte(material), cartoon_byte(material >> 8), cartoon_byte(material >> 16));
    s.shine = cartoon_byte(material >> 24);
    s.facing = v3_dot(s.normal, v3_make(p.light_x, p.light_y, p.light_z));
    return s;
}

RG_FN v3 cartoon_place(cartoon_shade_params p, float depth, int px, int py)
{
    rg_corner c =
        m4_project(p.from_pixel, v3_make(rg_to_float(px) + 0.5f, rg_to_float(py) + 0.5f, depth));
    float over_w = 1.0f / rg_max(c.w, 1e-9f);
    return v3_make(c.x * over_w, c.y * over_w, c.z * over_w);
}

// A highlight: the cosine between the view and the light's mirrored direction, to the 32nd power; 0
// where no light falls.
RG_FN float cartoon_shine(cartoon_shade_params p, cartoon_seen s, float depth, int px, int py)
{
    v3 at = cartoon_place(p, depth, px, py);
    v3 view = v3_make(p.eye_x - at.x, p.eye_y - at.y, p.eye_z - at.z);
    v3 mirrored =
        v3_add(v3_scale(s.normal, 2.0f * s.facing), v3_make(-p.light_x, -p.light_y, -p.light_z));
    float along = s.facing > 0.0f ? rg_max(v3_dot(view, mirrored), 0.0f) : 0.0f;
    float c2 = along * along / rg_max(v3_dot(view, view), 1e-12f);
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

RG_FN v3 cartoon_or(int first, v3 a, v3 b)
{
    return v3_make(first != 0 ? a.x : b.x, first != 0 ? a.y : b.y, first != 0 ? a.z : b.z);
}

RG_FN float cartoon_mix(float a, float b, float t)
{
    return a + (b - a) * t;
}

// A colour in display values under the ink, squared into light for the target. Without outlines,
// the image of the ink is a single texel without any.
RG_FN rg_fragment cartoon_inked(rg_ctx rg, cartoon_shade_params p, v3 c, int px, int py)
{
    float ink = 1.0f - ink_texel(rg, px * p.inked, py * p.inked, 0, 0).r;
    float r = cartoon_mix(rg_clamp(c.x, 0.0f, 1.0f), p.ink_r, ink);
    float g = cartoon_mix(rg_clamp(c.y, 0.0f, 1.0f), p.ink_g, ink);
    float b = cartoon_mix(rg_clamp(c.z, 0.0f, 1.0f), p.ink_b, ink);
    return rg_fragment_make(rg_rgba(r * r, g * g, b * b, 1.0f), 1.0f);
}

#endif
