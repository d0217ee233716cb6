// Blends a fragment's colour with the target's, format by format, as llvmpipe and lavapipe do
// (docs/drawing.md has the rule). Devices that keep images in plain memory and programs
// that blend by themselves share these functions.
#ifndef RG_KERNELS_DIALECT_DRAW_BLEND_H
#define RG_KERNELS_DIALECT_DRAW_BLEND_H

#include "kernels/dialect/image/format.h"

// enum rg_blend of backends/backend.h.
#define RG_BLEND_IS_OFF  0
#define RG_BLEND_IS_OVER 1
#define RG_BLEND_IS_ADD  2

// --- RGBA8: integers of 8 bits ---

// a b / 255, rounded; for some a and b the result is 1 too high or too low.
RG_FN uint rg_unorm8_times(uint a, uint b)
{
    uint t = a * b;
    return (t + (t >> 8) + 128u) >> 8;
}

RG_FN uint rg_blend_unorm8(uint source, uint target, uint rest, int blend)
{
    uint kept = blend == RG_BLEND_IS_ADD ? target : rg_unorm8_times(target, rest);
    uint sum = source + (blend == RG_BLEND_IS_OFF ? 0u : kept);
    return sum > 255u ? 255u : sum;
}

RG_FN uint rg_blended_RGBA8(uint target, rgba c, int blend)
{
    uint a = rg_unorm8(c.a);
    return rg_blend_unorm8(rg_unorm8(c.r), target & 255u, 255u - a, blend) |
           (rg_blend_unorm8(rg_unorm8(c.g), (target >> 8) & 255u, 255u - a, blend) << 8) |
           (rg_blend_unorm8(rg_unorm8(c.b), (target >> 16) & 255u, 255u - a, blend) << 16) |
           (rg_blend_unorm8(a, target >> 24, 255u - a, blend) << 24);
}

// --- floats: source + target (1 - alpha), each operation rounded; subnormal results are 0 ---

RG_FN float rg_not_subnormal(float v)
{
    return rg_abs(v) < 1.17549435e-38f ? 0.0f : v;
}

RG_FN float rg_blend_float(float source, float target, float rest, int blend)
{
    float kept = blend == RG_BLEND_IS_ADD ? target : rg_not_subnormal(target * rest);
    return blend == RG_BLEND_IS_OFF ? source : rg_not_subnormal(source + kept);
}

RG_FN rgba rg_blend_floats(rgba source, rgba target, int blend)
{
    float rest = 1.0f - source.a;
    return rg_rgba(rg_blend_float(source.r, target.r, rest, blend),
                   rg_blend_float(source.g, target.g, rest, blend),
                   rg_blend_float(source.b, target.b, rest, blend),
                   rg_blend_float(source.a, target.a, rest, blend));
}

// A float cut off to a half; subnormal halves stay, since blending may make them.
RG_FN uint rg_cut_half(float v)
{
    uint bits = rg_float_bits(v);
    uint magnitude = rg_half_magnitude(bits);
    uint subnormal = rg_to_uint(rg_to_int(rg_min(rg_abs(v), 1.0f) * 16777216.0f));
    return (magnitude < 0x38800000u ? subnormal : (magnitude >> 13) - 0x1c000u) |
           ((bits >> 16) & 0x8000u);
}

#include "kernels/dialect/draw/state.h"

#if RG_GLSL
// --- a fragment that knows what its pixel holds; what it returns leaves nothing to round ---

RG_FN float rg_blended_unorm8(float source, float target, uint rest, int blend)
{
    return rg_to_float(rg_blend_unorm8(rg_unorm8(source), rg_unorm8(target), rest, blend)) / 255.0f;
}

RG_FN rgba rg_blended_in_RGBA8(rgba c, rgba target, int blend)
{
    uint rest = 255u - rg_unorm8(c.a);
    return rg_rgba(rg_blended_unorm8(c.r, target.r, rest, blend),
                   rg_blended_unorm8(c.g, target.g, rest, blend),
                   rg_blended_unorm8(c.b, target.b, rest, blend),
                   rg_blended_unorm8(c.a, target.a, rest, blend));
}

RG_FN rgba rg_cut_RGBA16F(rgba c)
{
    return rg_rgba(rg_unpack_half(rg_cut_half(c.r)), rg_unpack_half(rg_cut_half(c.g)),
                   rg_unpack_half(rg_cut_half(c.b)), rg_unpack_half(rg_cut_half(c.a)));
}

// Blends a colour that rg_drawn has made.
RG_FN rgba rg_blended(rg_draw_state draw, rgba c, rgba target)
{
    rgba blended = c;
    if (draw.blend != RG_BLEND_IS_OFF) {
        blended = rg_blend_floats(c, target, draw.blend);
        if (draw.colour_format == RG_RGBA8_FORMAT)
            blended = rg_blended_in_RGBA8(c, target, draw.blend);
        if (draw.colour_format == RG_RGBA16F_FORMAT)
            blended = rg_cut_RGBA16F(blended);
    }
    return blended;
}

#else
#include "kernels/dialect/image/memory.h"

// --- a texel's words, of which a format has one, two or four; blend off stores as kernels do ---

typedef struct rg_texel {
    uint a;
    uint b;
    uint c;
    uint d;
} rg_texel;

RG_FN rg_texel rg_blended_RGBA16F(rg_texel t, rgba c, int blend)
{
    rgba target = rg_rgba(rg_unpack_half(t.a), rg_unpack_upper_half(t.a), rg_unpack_half(t.b),
                          rg_unpack_upper_half(t.b));
    rgba b = rg_blend_floats(c, target, blend);
    bool is_off = blend == RG_BLEND_IS_OFF;
    t.a = is_off ? rg_pack_half(c.r) | (rg_pack_half(c.g) << 16)
                 : rg_cut_half(b.r) | (rg_cut_half(b.g) << 16);
    t.b = is_off ? rg_pack_half(c.b) | (rg_pack_half(c.a) << 16)
                 : rg_cut_half(b.b) | (rg_cut_half(b.a) << 16);
    return t;
}

RG_FN rg_texel rg_blended_RGBA32F(rg_texel t, rgba c, int blend)
{
    rgba target =
        rg_rgba(rg_bits_float(t.a), rg_bits_float(t.b), rg_bits_float(t.c), rg_bits_float(t.d));
    rgba b = rg_blend_floats(c, target, blend);
    t.a = rg_float_bits(b.r);
    t.b = rg_float_bits(b.g);
    t.c = rg_float_bits(b.b);
    t.d = rg_float_bits(b.a);
    return t;
}

// --- one texel of an image in memory ---

RG_PROC void rg_blend_RGBA8(RG_GLOBAL uint *texels, int i, rgba c, int blend)
{
    texels[i] = rg_blended_RGBA8(texels[i], c, blend);
}

RG_PROC void rg_blend_RGBA16F(RG_GLOBAL uint *texels, int i, rgba c, int blend)
{
    rg_texel t = {texels[i], texels[i + 1], 0, 0};
    t = rg_blended_RGBA16F(t, c, blend);
    texels[i] = t.a;
    texels[i + 1] = t.b;
}

RG_PROC void rg_blend_RGBA32F(RG_GLOBAL uint *texels, int i, rgba c, int blend)
{
    rg_texel t = {texels[i], texels[i + 1], texels[i + 2], texels[i + 3]};
    t = rg_blended_RGBA32F(t, c, blend);
    texels[i] = t.a;
    texels[i + 1] = t.b;
    texels[i + 2] = t.c;
    texels[i + 3] = t.d;
}

#endif

#endif
