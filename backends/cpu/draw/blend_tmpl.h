// Depth test and blending of fragments whose pixels all differ, vectorised. The pixels' texels and
// depths are gathered before and scattered after; pixels that fail the test are written back
// unchanged. Loops run to a multiple of CPU_LANES. Properties that are constant for a run are
// constants in each loop.
#ifndef RG_BACKENDS_CPU_DRAW_BLEND_TMPL_H
#define RG_BACKENDS_CPU_DRAW_BLEND_TMPL_H

#include "backends/cpu/draw/program.h"
#include "kernels/dialect/draw/blend.h"

#define ALWAYS static inline __attribute__((always_inline))

// The depths and colours that fragments are tested against and blended with.
struct pixels {
    uint depth[CPU_FRAGMENTS];
    uint texels[4 * CPU_FRAGMENTS];
};

// Sets `kept` to 1 for fragments that pass, 0 for others.
ALWAYS void test_as(struct cpu_fragments *f, struct pixels *pixels, int mode)
{
    const int padded = cpu_padded(f->count);
#pragma omp simd
    for (int i = 0; i < padded; i++) {
        int passes = f->kept[i] != 0 ? 1 : 0;
        if (mode != RG_DEPTH_IS_OFF) {
            const uint behind = pixels->depth[i];
            passes &= f->depth[i] < rg_bits_float(behind) ? 1 : 0;
            if (mode == RG_DEPTH_IS_WRITE)
                pixels->depth[i] = passes != 0 ? rg_float_bits(f->depth[i]) : behind;
        }
        f->kept[i] = passes;
    }
}

static void test_fragments(struct cpu_fragments *f, struct pixels *pixels, int mode)
{
    if (mode == RG_DEPTH_IS_OFF)
        test_as(f, pixels, RG_DEPTH_IS_OFF);
    else if (mode == RG_DEPTH_IS_TEST)
        test_as(f, pixels, RG_DEPTH_IS_TEST);
    else
        test_as(f, pixels, RG_DEPTH_IS_WRITE);
}

ALWAYS void blend_RGBA8(const struct cpu_fragments *f, uint *texels, int blend)
{
    const int padded = cpu_padded(f->count);
#pragma omp simd
    for (int i = 0; i < padded; i++) {
        const uint was = texels[i];
        const uint is = rg_blended_RGBA8(was, rg_rgba(f->r[i], f->g[i], f->b[i], f->a[i]), blend);
        texels[i] = f->kept[i] != 0 ? is : was;
    }
}

ALWAYS uint packed_half(float v, int blend)
{
    return blend == RG_BLEND_IS_OFF ? rg_pack_half(v) : rg_cut_half(v);
}

ALWAYS void blend_RGBA16F(const struct cpu_fragments *f, uint *texels, int blend)
{
    const int padded = cpu_padded(f->count);
#pragma omp simd
    for (int i = 0; i < padded; i++) {
        const uint was_rg = texels[2 * i], was_ba = texels[2 * i + 1];
        const rgba was = rg_rgba(rg_unpack_half(was_rg), rg_unpack_upper_half(was_rg),
                                 rg_unpack_half(was_ba), rg_unpack_upper_half(was_ba));
        const rgba is = rg_blend_floats(rg_rgba(f->r[i], f->g[i], f->b[i], f->a[i]), was, blend);
        const uint is_rg = packed_half(is.r, blend) | (packed_half(is.g, blend) << 16);
        const uint is_ba = packed_half(is.b, blend) | (packed_half(is.a, blend) << 16);
        texels[2 * i] = f->kept[i] != 0 ? is_rg : was_rg;
        texels[2 * i + 1] = f->kept[i] != 0 ? is_ba : was_ba;
    }
}

ALWAYS void blend_RGBA32F(const struct cpu_fragments *f, uint *texels, int blend)
{
    const int padded = cpu_padded(f->count);
#pragma omp simd
    for (int i = 0; i < padded; i++) {
        const uint r = texels[4 * i], g = texels[4 * i + 1];
        const uint b = texels[4 * i + 2], a = texels[4 * i + 3];
        const rgba was =
            rg_rgba(rg_bits_float(r), rg_bits_float(g), rg_bits_float(b), rg_bits_float(a));
        const rgba is = rg_blend_floats(rg_rgba(f->r[i], f->g[i], f->b[i], f->a[i]), was, blend);
        texels[4 * i] = f->kept[i] != 0 ? rg_float_bits(is.r) : r;
        texels[4 * i + 1] = f->kept[i] != 0 ? rg_float_bits(is.g) : g;
        texels[4 * i + 2] = f->kept[i] != 0 ? rg_float_bits(is.b) : b;
        texels[4 * i + 3] = f->kept[i] != 0 ? rg_float_bits(is.a) : a;
    }
}

ALWAYS void blend_as(const struct cpu_fragments *f, uint *texels, int format, int blend)
{
    if (format == RG_RGBA8_FORMAT)
        blend_RGBA8(f, texels, blend);
    else if (format == RG_RGBA16F_FORMAT)
        blend_RGBA16F(f, texels, blend);
    else
        blend_RGBA32F(f, texels, blend);
}

static void blend_fragments(const struct cpu_fragments *f, struct pixels *pixels, int format,
                            int blend)
{
    if (blend == RG_BLEND_IS_OFF)
        blend_as(f, pixels->texels, format, RG_BLEND_IS_OFF);
    else if (blend == RG_BLEND_IS_OVER)
        blend_as(f, pixels->texels, format, RG_BLEND_IS_OVER);
    else
        blend_as(f, pixels->texels, format, RG_BLEND_IS_ADD);
}

#undef ALWAYS

#endif
