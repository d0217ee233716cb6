// Depth test, counting and blending of fragments: lists one after the other, for their pixels may
// coincide, rows side by side. What is the same for a whole run is a constant in each loop.
#ifndef RG_BACKENDS_CPU_DRAW_BLEND_H
#define RG_BACKENDS_CPU_DRAW_BLEND_H

#include "backends/cpu/draw.h"
#include "kernels/blend.h"

#define ALWAYS static inline __attribute__((always_inline))

// Channels lie in memory as the parts of a word do.
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "channels are addressed one by one");
typedef uint8_t __attribute__((may_alias)) byte_channel;
typedef uint16_t __attribute__((may_alias)) half_channel;
typedef float __attribute__((may_alias)) float_channel;

// What passed the tests, in order.
struct passed {
    int count;
    int which[CPU_FRAGMENTS]; // of the list
    int texel[CPU_FRAGMENTS];
};

// --- lists ---

ALWAYS void test_listed(const struct cpu_list *list, uint *depth, int width, int mode,
                        struct passed *passed)
{
    int count = 0;
    for (int i = 0; i < list->count; i++) {
        const int texel = list->y[i] * width + list->x[i];
        int passes = list->kept[i] != 0 ? 1 : 0;
        if (mode != RG_DEPTH_OFF) {
            const uint behind = depth[texel];
            passes &= list->depth[i] < rg_bits_float(behind) ? 1 : 0;
            if (mode == RG_DEPTH_WRITE)
                depth[texel] = passes ? rg_float_bits(list->depth[i]) : behind;
        }
        passed->which[count] = i;
        passed->texel[count] = texel;
        count += passes;
    }
    passed->count = count;
}

static void test_list(const struct cpu_list *list, uint *depth, int width, int mode,
                      struct passed *passed)
{
    if (mode == RG_DEPTH_OFF)
        test_listed(list, depth, width, RG_DEPTH_OFF, passed);
    else if (mode == RG_DEPTH_TEST)
        test_listed(list, depth, width, RG_DEPTH_TEST, passed);
    else
        test_listed(list, depth, width, RG_DEPTH_WRITE, passed);
}

ALWAYS void blend_bytes(byte_channel *texel, const float *colour, int blend)
{
    uint source[4];
    for (int k = 0; k < 4; k++)
        source[k] = rg_unorm8(colour[k]);
    const uint rest = 255u - source[3];
    for (int k = 0; k < 4; k++)
        texel[k] = (byte_channel)rg_blend_unorm8(source[k], texel[k], rest, blend);
}

ALWAYS void blend_halves(half_channel *texel, const float *colour, int blend)
{
    const float rest = 1.0f - colour[3];
    for (int k = 0; k < 4; k++)
        texel[k] = (half_channel)(blend == RG_BLEND_IS_OFF
                                      ? rg_pack_half(colour[k])
                                      : rg_cut_half(rg_blend_float(
                                            colour[k], rg_unpack_half(texel[k]), rest, blend)));
}

ALWAYS void blend_float4(float_channel *texel, const float *colour, int blend)
{
    const float rest = 1.0f - colour[3];
    for (int k = 0; k < 4; k++)
        texel[k] = rg_blend_float(colour[k], texel[k], rest, blend);
}

ALWAYS void blend_passed(uint *texels, const struct cpu_list *list, const struct passed *passed,
                         int format, int blend)
{
    for (int i = 0; i < passed->count; i++) {
        const rgba c = list->colour[passed->which[i]];
        const float colour[4] = {c.r, c.g, c.b, c.a};
        const size_t texel = (size_t)passed->texel[i];
        if (format == RG_RGBA8)
            blend_bytes((byte_channel *)(texels + texel), colour, blend);
        else if (format == RG_RGBA16F)
            blend_halves((half_channel *)(texels + texel * 2), colour, blend);
        else
            blend_float4((float_channel *)(texels + texel * 4), colour, blend);
    }
}

ALWAYS void blend_passed_as(uint *texels, const struct cpu_list *list, const struct passed *passed,
                            int format, int blend)
{
    if (blend == RG_BLEND_IS_OFF)
        blend_passed(texels, list, passed, format, RG_BLEND_IS_OFF);
    else if (blend == RG_BLEND_IS_OVER)
        blend_passed(texels, list, passed, format, RG_BLEND_IS_OVER);
    else
        blend_passed(texels, list, passed, format, RG_BLEND_IS_ADD);
}

static void blend_list(uint *texels, const struct cpu_list *list, const struct passed *passed,
                       int format, int blend)
{
    if (format == RG_RGBA8)
        blend_passed_as(texels, list, passed, RG_RGBA8, blend);
    else if (format == RG_RGBA16F)
        blend_passed_as(texels, list, passed, RG_RGBA16F, blend);
    else
        blend_passed_as(texels, list, passed, RG_RGBA32F, blend);
}

// --- rows: what is not kept is written as it was ---

// Leaves in `kept` what passes; returns its number.
ALWAYS int test_pixels(struct cpu_row *row, uint *depth, int mode)
{
    const int count = row->count;
    int passing = 0;
#pragma omp simd reduction(+ : passing)
    for (int i = 0; i < count; i++) {
        int passes = row->kept[i] != 0 ? 1 : 0;
        if (mode != RG_DEPTH_OFF) {
            const uint behind = depth[i];
            passes &= row->depth[i] < rg_bits_float(behind) ? 1 : 0;
            if (mode == RG_DEPTH_WRITE)
                depth[i] = passes != 0 ? rg_float_bits(row->depth[i]) : behind;
        }
        row->kept[i] = passes;
        passing += passes;
    }
    return passing;
}

static int test_row(struct cpu_row *row, uint *depth, int mode)
{
    if (mode == RG_DEPTH_OFF)
        return test_pixels(row, depth, RG_DEPTH_OFF);
    if (mode == RG_DEPTH_TEST)
        return test_pixels(row, depth, RG_DEPTH_TEST);
    return test_pixels(row, depth, RG_DEPTH_WRITE);
}

ALWAYS void blend_row_RGBA8(uint *texels, const struct cpu_row *row, int blend)
{
    const int count = row->count;
#pragma omp simd
    for (int i = 0; i < count; i++) {
        const uint was = texels[i];
        const rgba c = rg_rgba(row->r[i], row->g[i], row->b[i], row->a[i]);
        const uint is = rg_blended_RGBA8(was, c, blend);
        texels[i] = row->kept[i] != 0 ? is : was;
    }
}

ALWAYS uint packed_half(float v, int blend)
{
    return blend == RG_BLEND_IS_OFF ? rg_pack_half(v) : rg_cut_half(v);
}

ALWAYS void blend_row_RGBA16F(uint *texels, const struct cpu_row *row, int blend)
{
    const int count = row->count;
#pragma omp simd
    for (int i = 0; i < count; i++) {
        const uint was_rg = texels[2 * i], was_ba = texels[2 * i + 1];
        const rgba c = rg_rgba(row->r[i], row->g[i], row->b[i], row->a[i]);
        const rgba was = rg_rgba(rg_unpack_half(was_rg & 0xffffu), rg_unpack_half(was_rg >> 16),
                                 rg_unpack_half(was_ba & 0xffffu), rg_unpack_half(was_ba >> 16));
        const rgba is = rg_blend_floats(c, was, blend);
        const uint is_rg = packed_half(is.r, blend) | (packed_half(is.g, blend) << 16);
        const uint is_ba = packed_half(is.b, blend) | (packed_half(is.a, blend) << 16);
        texels[2 * i] = row->kept[i] != 0 ? is_rg : was_rg;
        texels[2 * i + 1] = row->kept[i] != 0 ? is_ba : was_ba;
    }
}

ALWAYS void blend_row_RGBA32F(uint *texels, const struct cpu_row *row, int blend)
{
    const int count = row->count;
#pragma omp simd
    for (int i = 0; i < count; i++) {
        const rgba c = rg_rgba(row->r[i], row->g[i], row->b[i], row->a[i]);
        const uint r = texels[4 * i], g = texels[4 * i + 1];
        const uint b = texels[4 * i + 2], a = texels[4 * i + 3];
        const rgba was =
            rg_rgba(rg_bits_float(r), rg_bits_float(g), rg_bits_float(b), rg_bits_float(a));
        const rgba is = rg_blend_floats(c, was, blend);
        texels[4 * i] = row->kept[i] != 0 ? rg_float_bits(is.r) : r;
        texels[4 * i + 1] = row->kept[i] != 0 ? rg_float_bits(is.g) : g;
        texels[4 * i + 2] = row->kept[i] != 0 ? rg_float_bits(is.b) : b;
        texels[4 * i + 3] = row->kept[i] != 0 ? rg_float_bits(is.a) : a;
    }
}

ALWAYS void blend_pixels(uint *texels, size_t first, const struct cpu_row *row, int format,
                         int blend)
{
    if (format == RG_RGBA8)
        blend_row_RGBA8(texels + first, row, blend);
    else if (format == RG_RGBA16F)
        blend_row_RGBA16F(texels + first * 2, row, blend);
    else
        blend_row_RGBA32F(texels + first * 4, row, blend);
}

static void blend_row(uint *texels, size_t first, const struct cpu_row *row, int format, int blend)
{
    if (blend == RG_BLEND_IS_OFF)
        blend_pixels(texels, first, row, format, RG_BLEND_IS_OFF);
    else if (blend == RG_BLEND_IS_OVER)
        blend_pixels(texels, first, row, format, RG_BLEND_IS_OVER);
    else
        blend_pixels(texels, first, row, format, RG_BLEND_IS_ADD);
}

#undef ALWAYS

#endif
