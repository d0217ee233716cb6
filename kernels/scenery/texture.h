// The scene's textures: squares of equal size that repeat, RGBA8. Colours are stored as the square
// roots of their light: eight bits hold these nearly as well as the sRGB curve, and every device
// squares them alike. Alpha says how much of the light a lamp behind the surface gives at night.
//
// Filters in integers of 8 bits, two channels at a time: half the work of floats, and exact.
// Programs include this file after their slots, which have SAMPLED(n, RGBA8, textures, TILED).
#ifndef RG_KERNELS_SCENERY_TEXTURE_H
#define RG_KERNELS_SCENERY_TEXTURE_H

// In all of these `texels` is the square of a pixel's width in texels of level 0.

// The nearest level: log2 of a pixel's width in texels of level 0, rounded, from the exponent of
// twice its square. Only this level is read. A mix of two would make the whole scene take half as
// long again, and the eye finds no edge between levels in these textures.
RG_FN int scenery_texture_level(float texels, int last_level)
{
    uint bits = rg_float_bits(rg_clamp(texels + texels, 1.0f, 1e9f)) - 0x3f800000u;
    return rg_imin(rg_to_int(bits >> 24), last_level);
}

#if RG_NATIVE_SAMPLERS

// The driver filters, in the same level as elsewhere. Between two levels thin dark bars, such as
// those of shop windows by night, would be sharper than in the nearest.
RG_FN rgba scenery_texture(rg_ctx rg, float u, float v, int layer, float texels, int texture_px,
                           int last_level)
{
    float level = rg_to_float(scenery_texture_level(texels, last_level));
    vec4 t = textureLod(textures_sampler, vec3(u, v, rg_to_float(layer)), level);
    return rg_rgba(t.x * t.x, t.y * t.y, t.z * t.z, t.w);
}

#else

// Channels r and b in one word, g and a in another, each in 16 bits.
RG_STRUCT(scenery_texel)
{
    uint rb;
    uint ga;
};

// Mixes a and b, with t from 0 to 256.
RG_FN scenery_texel scenery_texel_mix(scenery_texel a, scenery_texel b, uint t)
{
    scenery_texel c;
    c.rb = ((a.rb * (256u - t) + b.rb * t + 0x00800080u) >> 8) & 0x00ff00ffu;
    c.ga = ((a.ga * (256u - t) + b.ga * t + 0x00800080u) >> 8) & 0x00ff00ffu;
    return c;
}

RG_FN scenery_texel scenery_texel_at(rg_ctx rg, int x, int y, int layer, int level)
{
    uint bytes = textures_bytes(rg, x, y, layer, level);
    scenery_texel t;
    t.rb = bytes & 0x00ff00ffu;
    t.ga = (bytes >> 8) & 0x00ff00ffu;
    return t;
}

// u and v from 0 to 1.
RG_FN scenery_texel scenery_texture_linear(rg_ctx rg, float u, float v, int size, int layer,
                                           int level)
{
    float x = u * rg_to_float(size) - 0.5f;
    float y = v * rg_to_float(size) - 0.5f;
    float left = rg_floor(x);
    float top = rg_floor(y);
    int x0 = rg_to_int(left);
    int y0 = rg_to_int(top);
    int x1 = x0 + 1 < size ? x0 + 1 : 0;
    int y1 = y0 + 1 < size ? y0 + 1 : 0;
    x0 = x0 < 0 ? size - 1 : x0;
    y0 = y0 < 0 ? size - 1 : y0;
    uint across = rg_to_uint(rg_to_int((x - left) * 256.0f));
    uint down = rg_to_uint(rg_to_int((y - top) * 256.0f));
    scenery_texel above = scenery_texel_mix(scenery_texel_at(rg, x0, y0, layer, level),
                                            scenery_texel_at(rg, x1, y0, layer, level), across);
    scenery_texel below = scenery_texel_mix(scenery_texel_at(rg, x0, y1, layer, level),
                                            scenery_texel_at(rg, x1, y1, layer, level), across);
    return scenery_texel_mix(above, below, down);
}

RG_FN rgba scenery_texture(rg_ctx rg, float u, float v, int layer, float texels, int texture_px,
                           int last_level)
{
    float across = u - rg_floor(u);
    float down = v - rg_floor(v);
    int level = scenery_texture_level(texels, last_level);
    scenery_texel t =
        scenery_texture_linear(rg, across, down, rg_imax(texture_px >> level, 1), layer, level);
    float r = rg_to_float(t.rb & 0xffffu) * (1.0f / 255.0f);
    float g = rg_to_float(t.ga & 0xffffu) * (1.0f / 255.0f);
    float b = rg_to_float(t.rb >> 16) * (1.0f / 255.0f);
    return rg_rgba(r * r, g * g, b * b, rg_to_float(t.ga >> 16) * (1.0f / 255.0f));
}

#endif

#endif
