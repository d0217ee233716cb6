// The bits of a colour in each image format, so that every device reads and writes the same value.
//
// rg_rounded_F(c) is the colour that a format F can hold exactly, nearest below in magnitude for
// floats. Kernels store only such colours, so that a driver's own conversion has nothing left to
// round. rg_fetched_F(c) corrects a fetched colour that a driver may leave inexact. The packing and
// unpacking below serve the devices that keep images in plain memory (cpu and opencl).
#ifndef RG_KERNELS_DIALECT_IMAGE_FORMAT_H
#define RG_KERNELS_DIALECT_IMAGE_FORMAT_H

#include "kernels/dialect/lang.h"

// --- RGBA8: unsigned normalised, 1 word per texel ---

RG_FN uint rg_unorm8(float v)
{
    return rg_to_uint(rg_to_int(rg_floor(rg_clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f)));
}

RG_FN float rg_rounded_unorm8(float v)
{
    return rg_to_float(rg_unorm8(v)) / 255.0f;
}

RG_FN rgba rg_rounded_RGBA8(rgba c)
{
    return rg_rgba(rg_rounded_unorm8(c.r), rg_rounded_unorm8(c.g), rg_rounded_unorm8(c.b),
                   rg_rounded_unorm8(c.a));
}

// Drivers may multiply by 1/255 where we divide by 255; both give the same integer.
RG_FN rgba rg_fetched_RGBA8(rgba c)
{
    return rg_rounded_RGBA8(c);
}

// --- RGBA16F: half floats, 2 words per texel. Subnormal halves are stored as zero. ---

// The magnitude cut off to one that a half can hold, as a float's bits: at most 65504, also for
// NaN.
RG_FN uint rg_half_magnitude(uint float_bits)
{
    uint magnitude = float_bits & 0x7fffffffu;
    return magnitude < 0x477fe000u ? magnitude & 0xffffe000u : 0x477fe000u;
}

RG_FN float rg_rounded_half(float v)
{
    uint bits = rg_float_bits(v);
    uint magnitude = rg_half_magnitude(bits);
    return magnitude < 0x38800000u ? 0.0f : rg_bits_float(magnitude | (bits & 0x80000000u));
}

RG_FN rgba rg_rounded_RGBA16F(rgba c)
{
    return rg_rgba(rg_rounded_half(c.r), rg_rounded_half(c.g), rg_rounded_half(c.b),
                   rg_rounded_half(c.a));
}

// The half nearest to a float; of two as near, the even one. There is none between 0 and the least
// normal half.
RG_FN float rg_nearest_half(float v)
{
    uint bits = rg_float_bits(v);
    uint magnitude = bits & 0x7fffffffu;
    uint nearest = rg_half_magnitude(magnitude + 0xfffu + ((magnitude >> 13) & 1u));
    uint least = magnitude > 0x38000000u ? 0x38800000u : 0u;
    return rg_bits_float((magnitude < 0x38800000u ? least : nearest) | (bits & 0x80000000u));
}

RG_FN rgba rg_nearest_RGBA16F(rgba c)
{
    return rg_rgba(rg_nearest_half(c.r), rg_nearest_half(c.g), rg_nearest_half(c.b),
                   rg_nearest_half(c.a));
}

RG_FN rgba rg_fetched_RGBA16F(rgba c)
{
    return c;
}

// The bits of rg_rounded_half(v) as a half.
RG_FN uint rg_pack_half(float v)
{
    uint bits = rg_float_bits(v);
    uint magnitude = rg_half_magnitude(bits);
    uint half_bits = ((magnitude >> 13) - 0x1c000u) | ((bits >> 16) & 0x8000u);
    return magnitude < 0x38800000u ? 0u : half_bits;
}

// The value of a small float, whose bits are aligned with a float's exponent: as a float times
// 2^112, exactly.
RG_FN float rg_raised(uint bits)
{
#if RG_GLSL // drivers may take subnormal floats for 0
    uint magnitude = bits & 0x7fffffffu;
    float least = rg_to_float(rg_to_int(magnitude)) * 7.275957614183426e-12f; // 2^-37
    float v = magnitude < 0x00800000u ? least : rg_bits_float(magnitude + 0x38000000u);
    return bits != magnitude ? -v : v;
#else
    return rg_bits_float(bits) * 5.192296858534828e33f;
#endif
}

// The half in the upper bits of a word: shifted to align with a float's exponent, after copies of
// its sign.
RG_FN float rg_unpack_upper_half(uint word)
{
    uint bits = rg_to_uint(rg_to_int(word) >> 3) & 0x8fffe000u;
    return rg_raised(bits);
}

RG_FN float rg_unpack_half(uint half_bits)
{
    return rg_unpack_upper_half(half_bits << 16);
}

// --- R16F: one half float, half a word per texel; fetched only ---

RG_FN rgba rg_fetched_R16F(rgba c)
{
    return c;
}

// --- RGBA32F and R32F: floats as they are, 4 words and 1 word per texel ---

RG_FN rgba rg_rounded_RGBA32F(rgba c)
{
    return c;
}

RG_FN rgba rg_fetched_RGBA32F(rgba c)
{
    return c;
}

RG_FN rgba rg_rounded_R32F(rgba c)
{
    return rg_rgba(c.r, 0.0f, 0.0f, 1.0f);
}

RG_FN rgba rg_fetched_R32F(rgba c)
{
    return c;
}

// --- D32F: the depth of a DRAW pass's target, a float from 0 to 1, 1 word per texel ---

RG_FN rgba rg_fetched_D32F(rgba c)
{
    return rg_rgba(c.r, 0.0f, 0.0f, 1.0f);
}

// --- RG11B10F: unsigned floats of 11, 11 and 10 bits, 1 word per texel; fetched only ---

RG_FN float rg_unpack_float11(uint bits)
{
    return rg_raised(bits << 17);
}

RG_FN float rg_unpack_float10(uint bits)
{
    return rg_raised(bits << 18);
}

RG_FN rgba rg_fetched_RG11B10F(rgba c)
{
    return c;
}

#endif
