// Images in plain memory, for C and OpenCL C: a header with the word at which each level begins,
// then level 0 of all layers, then level 1, and so on; rows without padding. Texels are packed in
// 32-bit words as in format.h. Two texels of half a word share a word, even across rows or layers,
// so that only a level's end may leave a half unused. The header lies in memory, not in the shape,
// so that the shape is small enough for compilers to keep in registers, and items of one vector may
// read different levels.
#ifndef RG_KERNELS_DIALECT_IMAGE_MEMORY_H
#define RG_KERNELS_DIALECT_IMAGE_MEMORY_H

#include "kernels/dialect/image/format.h"
#include "kernels/dialect/limits.h"

typedef struct rg_image_shape {
    int width;
    int height;
    int layers;
    int levels;
} rg_image_shape;

// The word at which a level begins. Level 0 follows the header: where the compiler knows that it is
// meant, it sees that neighbours lie side by side, and loads them together instead of gathering.
RG_FN int rg_level_word(RG_GLOBAL const uint *image, int level)
{
    return __builtin_constant_p(level) && level == 0 ? RG_MAX_LEVELS : rg_to_int(image[level]);
}

// The word at which a texel of `words` words begins.
RG_FN int rg_texel_word(RG_GLOBAL const uint *image, rg_image_shape s, int x, int y, int layer,
                        int level, int words)
{
    int width = rg_imax(s.width >> level, 1);
    int height = rg_imax(s.height >> level, 1);
    return rg_level_word(image, level) + ((layer * height + y) * width + x) * words;
}

// The same for level 0, which follows the header.
RG_FN int rg_first_level_word(rg_image_shape s, int x, int y, int layer, int words)
{
    return RG_MAX_LEVELS + ((layer * s.height + y) * s.width + x) * words;
}

// The place of a texel of half a word, counted in halves: an even one is the lower half of its
// word.
RG_FN int rg_texel_half(RG_GLOBAL const uint *image, rg_image_shape s, int x, int y, int layer,
                        int level)
{
    int width = rg_imax(s.width >> level, 1);
    int height = rg_imax(s.height >> level, 1);
    return rg_level_word(image, level) * 2 + ((layer * height + y) * width + x);
}

// Two halves, one after the other, the first in the lower bits. One more word follows the last
// texel, so that any half may be the first.
RG_FN uint rg_two_halves(RG_GLOBAL const uint *image, int half_of)
{
#if RG_OPENCL
    ushort2 two = vload2(0, (RG_GLOBAL const ushort *)image + half_of);
    return rg_to_uint(two.x) | (rg_to_uint(two.y) << 16);
#else
    uint two;
    memcpy(&two, (const unsigned short *)image + half_of, sizeof(two));
    return two;
#endif
}

#define RG_WORDS_RGBA8    1
#define RG_WORDS_RGBA16F  2
#define RG_WORDS_RGBA32F  4
#define RG_WORDS_R32F     1
#define RG_WORDS_D32F     1
#define RG_WORDS_RG11B10F 1

RG_FN rgba rg_load_RGBA8(RG_GLOBAL const uint *texels, int i)
{
    uint t = texels[i];
    return rg_rgba(rg_to_float(t & 255u) / 255.0f, rg_to_float((t >> 8) & 255u) / 255.0f,
                   rg_to_float((t >> 16) & 255u) / 255.0f, rg_to_float(t >> 24) / 255.0f);
}

RG_PROC void rg_store_RGBA8(RG_GLOBAL uint *texels, int i, rgba c)
{
    texels[i] =
        rg_unorm8(c.r) | (rg_unorm8(c.g) << 8) | (rg_unorm8(c.b) << 16) | (rg_unorm8(c.a) << 24);
}

RG_FN rgba rg_load_RGBA16F(RG_GLOBAL const uint *texels, int i)
{
    uint rg = texels[i];
    uint ba = texels[i + 1];
    return rg_rgba(rg_unpack_half(rg), rg_unpack_upper_half(rg), rg_unpack_half(ba),
                   rg_unpack_upper_half(ba));
}

RG_PROC void rg_store_RGBA16F(RG_GLOBAL uint *texels, int i, rgba c)
{
    texels[i] = rg_pack_half(c.r) | (rg_pack_half(c.g) << 16);
    texels[i + 1] = rg_pack_half(c.b) | (rg_pack_half(c.a) << 16);
}

// The lower half of a word if `half_of` is even, else the upper one.
RG_FN rgba rg_load_R16F(uint word, int half_of)
{
    uint upper = (half_of & 1) != 0 ? word : word << 16;
    return rg_rgba(rg_unpack_upper_half(upper), 0.0f, 0.0f, 1.0f);
}

RG_FN rgba rg_load_RGBA32F(RG_GLOBAL const uint *texels, int i)
{
    return rg_rgba(rg_bits_float(texels[i]), rg_bits_float(texels[i + 1]),
                   rg_bits_float(texels[i + 2]), rg_bits_float(texels[i + 3]));
}

RG_PROC void rg_store_RGBA32F(RG_GLOBAL uint *texels, int i, rgba c)
{
    texels[i] = rg_float_bits(c.r);
    texels[i + 1] = rg_float_bits(c.g);
    texels[i + 2] = rg_float_bits(c.b);
    texels[i + 3] = rg_float_bits(c.a);
}

RG_FN rgba rg_load_R32F(RG_GLOBAL const uint *texels, int i)
{
    return rg_rgba(rg_bits_float(texels[i]), 0.0f, 0.0f, 1.0f);
}

RG_PROC void rg_store_R32F(RG_GLOBAL uint *texels, int i, rgba c)
{
    texels[i] = rg_float_bits(c.r);
}

RG_FN rgba rg_load_D32F(RG_GLOBAL const uint *texels, int i)
{
    return rg_load_R32F(texels, i);
}

RG_FN rgba rg_load_RG11B10F(RG_GLOBAL const uint *texels, int i)
{
    uint t = texels[i];
    return rg_rgba(rg_unpack_float11(t & 0x7ffu), rg_unpack_float11((t >> 11) & 0x7ffu),
                   rg_unpack_float10(t >> 22), 1.0f);
}

#endif
