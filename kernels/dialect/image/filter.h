// Filtered images, written out in plain arithmetic, because the filtering of devices rounds
// differently. Texel x of a level has its centre at (x + 0.5) / width; beyond an edge its texels
// repeat.

RG_FN rgba rgba_lerp(rgba a, rgba b, float t)
{
    return rg_rgba(a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t,
                   a.a + (b.a - a.a) * t);
}

// The texel that a coordinate lies in.
RG_FN int rg_filter_texel(float at, int size)
{
    return rg_iclamp(rg_to_int(rg_floor(at)), 0, size - 1);
}

#define RG_NEAREST(name)                                                                           \
    RG_FN rgba name##_nearest(rg_ctx rg, float u, float v, int layer, int level)                   \
    {                                                                                              \
        int width = name##_width(rg, level);                                                       \
        int height = name##_height(rg, level);                                                     \
        return name##_texel(rg, rg_filter_texel(u * rg_to_float(width), width),                    \
                            rg_filter_texel(v * rg_to_float(height), height), layer, level);       \
    }

#if RG_NATIVE_SAMPLERS

// The driver's samplers, clamped at the edges (enum rg_sampler of backends/kernel.h). A linear
// filter between levels reads one level alone if the level is whole.
#define RG_FILTERED(name)                                                                          \
    RG_NEAREST(name)                                                                               \
    RG_FN rgba name##_trilinear(rg_ctx rg, float u, float v, int layer, float lod)                 \
    {                                                                                              \
        vec4 t = textureLod(name##_sampler, vec3(u, v, rg_to_float(layer)), lod);                  \
        return rg_rgba(t.x, t.y, t.z, t.w);                                                        \
    }                                                                                              \
    RG_FN rgba name##_linear(rg_ctx rg, float u, float v, int layer, int level)                    \
    {                                                                                              \
        return name##_trilinear(rg, u, v, layer, rg_to_float(level));                              \
    }                                                                                              \
    RG_FN rgba name##_between(rg_ctx rg, float px, float py, int layer, int level)                 \
    {                                                                                              \
        float u = px / rg_to_float(name##_width(rg, level));                                       \
        float v = py / rg_to_float(name##_height(rg, level));                                      \
        return name##_linear(rg, u, v, layer, level);                                              \
    }
#define RG_TILED(name) RG_NEAREST(name)
#define RG_CUBE(name)
#define RG_SHADOW(name)

#else

#define RG_FILTERED(name)                                                                          \
    RG_NEAREST(name)                                                                               \
    RG_FN rgba name##_between(rg_ctx rg, float px, float py, int layer, int level)                 \
    {                                                                                              \
        int width = name##_width(rg, level);                                                       \
        int height = name##_height(rg, level);                                                     \
        float x = rg_clamp(px, 0.0f, rg_to_float(width)) - 0.5f;                                   \
        float y = rg_clamp(py, 0.0f, rg_to_float(height)) - 0.5f;                                  \
        float left = rg_floor(x);                                                                  \
        float top = rg_floor(y);                                                                   \
        int ix = rg_to_int(left);                                                                  \
        int iy = rg_to_int(top);                                                                   \
        int x0 = rg_iclamp(ix, 0, width - 1);                                                      \
        int x1 = rg_iclamp(ix + 1, 0, width - 1);                                                  \
        int y0 = rg_iclamp(iy, 0, height - 1);                                                     \
        int y1 = rg_iclamp(iy + 1, 0, height - 1);                                                 \
        rg_texels above = name##_texels(rg, x0, x1, y0, layer, level);                             \
        rg_texels below = name##_texels(rg, x0, x1, y1, layer, level);                             \
        return rgba_lerp(rgba_lerp(above.left, above.right, x - left),                             \
                         rgba_lerp(below.left, below.right, x - left), y - top);                   \
    }                                                                                              \
    RG_FN rgba name##_linear(rg_ctx rg, float u, float v, int layer, int level)                    \
    {                                                                                              \
        return name##_between(rg, u * rg_to_float(name##_width(rg, level)),                        \
                              v * rg_to_float(name##_height(rg, level)), layer, level);            \
    }                                                                                              \
    RG_FN rgba name##_trilinear(rg_ctx rg, float u, float v, int layer, float lod)                 \
    {                                                                                              \
        int last = name##_levels(rg) - 1;                                                          \
        float level = rg_clamp(lod, 0.0f, rg_to_float(last));                                      \
        int fine = rg_to_int(level);                                                               \
        int coarse = rg_imin(fine + 1, last);                                                      \
        return rgba_lerp(name##_linear(rg, u, v, layer, fine),                                     \
                         name##_linear(rg, u, v, layer, coarse), level - rg_to_float(fine));       \
    }
#define RG_TILED(name)  RG_NEAREST(name)
#define RG_CUBE(name)   RG_NEAREST(name)
#define RG_SHADOW(name) RG_NEAREST(name)

#endif

#define IN(slot, T, name)
#define OUT(slot, T, name)
#define INOUT(slot, T, name)
#define ATOMIC(slot, T, name)
#define IMAGE(slot, F, name) RG_NEAREST(name)
#define OUT_IMAGE(slot, F, name)

#undef SAMPLED
#define SAMPLED(slot, F, name, how) RG_##how(name)

RG_ALL_SLOTS

#undef SAMPLED
#define SAMPLED(slot, F, name, how) IMAGE(slot, F, name)

#undef IN
#undef OUT
#undef INOUT
#undef ATOMIC
#undef IMAGE
#undef OUT_IMAGE
