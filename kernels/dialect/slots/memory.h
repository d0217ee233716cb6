// slots.h for C and OpenCL C: the context carries a pointer for each slot; images lie in plain
// memory.

#if RG_OPENCL
#define RG_UNUSED
#define RG_INDEX(rg, name, i)               (i)
#define RG_TEXEL_INDEX(rg, name, i, texels) (i)
#else
#define RG_UNUSED __attribute__((unused))
// The reference device is built with RG_CHECKED 1 and reports every index out of range.
#if RG_CHECKED
#define RG_INDEX(rg, name, i) rg_checked_index(rg.notes, i, rg.name##_count, #name)
#define RG_TEXEL_INDEX(rg, name, i, texels)                                                        \
    rg_checked_texels(rg.notes, i, rg.name##_count, #name, texels)
#else
#define RG_INDEX(rg, name, i)               (i)
#define RG_TEXEL_INDEX(rg, name, i, texels) (i)
#endif
#endif

#include "kernels/dialect/image/memory.h"

#define RG_ARRAY(T, name)                                                                          \
    RG_GLOBAL T *name;                                                                             \
    int name##_count;
#define IN(slot, T, name)        RG_ARRAY(const T, name)
#define OUT(slot, T, name)       RG_ARRAY(T, name)
#define INOUT(slot, T, name)     RG_ARRAY(T, name)
#define ATOMIC(slot, T, name)    RG_ARRAY(T, name)
#define IMAGE(slot, F, name)     RG_ARRAY(const uint, name) rg_image_shape name##_shape;
#define OUT_IMAGE(slot, F, name) RG_ARRAY(uint, name) rg_image_shape name##_shape;

typedef struct rg_ctx {
    RG_ALL_SLOTS
#if !RG_OPENCL
    struct rg_notes *notes;
    int plain; // kernels/dialect/draw/draw.h
#endif
} rg_ctx;

#if RG_OPENCL
#define rg_all_plain(rg) 0
#else
#define rg_all_plain(rg) ((rg).plain)
#endif

#undef IN
#undef OUT
#undef INOUT
#undef ATOMIC
#undef IMAGE
#undef OUT_IMAGE

#define RG_AT(T, name)                                                                             \
    RG_FN T name##_at(rg_ctx rg, int i)                                                            \
    {                                                                                              \
        return rg.name[RG_INDEX(rg, name, i)];                                                     \
    }

#define RG_PUT(T, name)                                                                            \
    RG_PROC void name##_put(rg_ctx rg, int i, T v)                                                 \
    {                                                                                              \
        rg.name[RG_INDEX(rg, name, i)] = v;                                                        \
    }

#define RG_ATOMIC_OP(T, name, op)                                                                  \
    RG_PROC void name##_##op(rg_ctx rg, int i, T v)                                                \
    {                                                                                              \
        RG_ATOMIC_##op(T, &rg.name[RG_INDEX(rg, name, i)], v);                                     \
    }

#if RG_OPENCL
#define RG_ATOMIC_add(T, at, v)   atomic_add((volatile __global T *)(at), v)
#define RG_ATOMIC_min(T, at, v)   atomic_min((volatile __global T *)(at), v)
#define RG_ATOMIC_max(T, at, v)   atomic_max((volatile __global T *)(at), v)
#define RG_ATOMIC_or(T, at, v)    atomic_or((volatile __global T *)(at), v)
#define RG_ATOMIC_store(T, at, v) atomic_xchg((volatile __global T *)(at), v)
#define RG_ATOMIC_LOAD(T, at)     atomic_or((volatile __global T *)(at), (T)0)
#define RG_ATOMIC_SWAP(T, at, expected, v)                                                         \
    return atomic_cmpxchg((volatile __global T *)(at), expected, v)
#else
// C11 has no atomic minimum; a lost exchange reloads `was`.
#define RG_ATOMIC_SELECT(T, at, v, better)                                                         \
    T *place = (at);                                                                               \
    T was = __atomic_load_n(place, __ATOMIC_RELAXED);                                              \
    while ((v)better was &&                                                                        \
           !__atomic_compare_exchange_n(place, &was, v, 1, __ATOMIC_RELAXED, __ATOMIC_RELAXED))    \
        ;
#define RG_ATOMIC_add(T, at, v)   __atomic_fetch_add(at, v, __ATOMIC_RELAXED)
#define RG_ATOMIC_min(T, at, v)   RG_ATOMIC_SELECT(T, at, v, <)
#define RG_ATOMIC_max(T, at, v)   RG_ATOMIC_SELECT(T, at, v, >)
#define RG_ATOMIC_or(T, at, v)    __atomic_fetch_or(at, v, __ATOMIC_RELAXED)
#define RG_ATOMIC_store(T, at, v) __atomic_store_n(at, v, __ATOMIC_RELAXED)
#define RG_ATOMIC_LOAD(T, at)     __atomic_load_n(at, __ATOMIC_RELAXED)
#define RG_ATOMIC_SWAP(T, at, expected, v)                                                         \
    __atomic_compare_exchange_n(at, &expected, v, 0, __ATOMIC_RELAXED, __ATOMIC_RELAXED);          \
    return expected
#endif

#define IN(slot, T, name)  RG_AT(T, name)
#define OUT(slot, T, name) RG_PUT(T, name)
#define INOUT(slot, T, name)                                                                       \
    RG_AT(T, name)                                                                                 \
    RG_PUT(T, name)
#define ATOMIC(slot, T, name)                                                                      \
    RG_ATOMIC_OP(T, name, add)                                                                     \
    RG_ATOMIC_OP(T, name, min)                                                                     \
    RG_ATOMIC_OP(T, name, max)                                                                     \
    RG_ATOMIC_OP(T, name, or)                                                                      \
    RG_ATOMIC_OP(T, name, store)                                                                   \
    RG_FN T name##_load(rg_ctx rg, int i)                                                          \
    {                                                                                              \
        return RG_ATOMIC_LOAD(T, &rg.name[RG_INDEX(rg, name, i)]);                                 \
    }                                                                                              \
    RG_FN T name##_exchange_if(rg_ctx rg, int i, T expected, T v)                                  \
    {                                                                                              \
        RG_ATOMIC_SWAP(T, &rg.name[RG_INDEX(rg, name, i)], expected, v);                           \
    }
#define RG_IMAGE_SIZES(name)                                                                       \
    RG_FN int name##_width(rg_ctx rg, int level)                                                   \
    {                                                                                              \
        return rg_imax(rg.name##_shape.width >> level, 1);                                         \
    }                                                                                              \
    RG_FN int name##_height(rg_ctx rg, int level)                                                  \
    {                                                                                              \
        return rg_imax(rg.name##_shape.height >> level, 1);                                        \
    }                                                                                              \
    RG_FN int name##_levels(rg_ctx rg)                                                             \
    {                                                                                              \
        return rg.name##_shape.levels;                                                             \
    }
#define RG_TEXEL_OF_WORDS(F, name)                                                                 \
    RG_FN rgba name##_texel(rg_ctx rg, int x, int y, int layer, int level)                         \
    {                                                                                              \
        int i = rg_texel_word(rg.name, rg.name##_shape, x, y, layer, level, RG_WORDS_##F);         \
        return rg_load_##F(rg.name, RG_TEXEL_INDEX(rg, name, i, 1));                               \
    }                                                                                              \
    RG_TEXELS_SINGLY(name)                                                                         \
    RG_FN uint name##_bytes(rg_ctx rg, int x, int y, int layer, int level)                         \
    {                                                                                              \
        int i = rg_texel_word(rg.name, rg.name##_shape, x, y, layer, level, RG_WORDS_##F);         \
        return rg.name[RG_TEXEL_INDEX(rg, name, i, 1)];                                            \
    }
#define RG_TEXEL_OF_HALVES(F, name)                                                                \
    RG_FN rgba name##_texel(rg_ctx rg, int x, int y, int layer, int level)                         \
    {                                                                                              \
        int i = rg_texel_half(rg.name, rg.name##_shape, x, y, layer, level);                       \
        return rg_load_##F(rg.name[RG_TEXEL_INDEX(rg, name, i >> 1, 1)], i);                       \
    }                                                                                              \
    RG_FN rg_texels name##_texels(rg_ctx rg, int x0, int x1, int y, int layer, int level)          \
    {                                                                                              \
        int i = rg_texel_half(rg.name, rg.name##_shape, x0, y, layer, level);                      \
        uint two = rg_two_halves(rg.name, RG_TEXEL_INDEX(rg, name, i >> 1, 2) * 2 + (i & 1));      \
        rg_texels t;                                                                               \
        t.left = rg_load_##F(two, 0);                                                              \
        t.right = rg_load_##F(two, x1 - x0);                                                       \
        return t;                                                                                  \
    }
// Selects one of the two: only formats of half a word have a macro RG_HALVES_F.
#define RG_HALVES_R16F                         , RG_TEXEL_OF_HALVES
#define RG_TEXEL_AS(F, name, form, texel, ...) texel(F, name)
#define RG_TEXEL(F, name, ...)                 RG_TEXEL_AS(F, name, __VA_ARGS__)
#define IMAGE(slot, F, name)                                                                       \
    RG_IMAGE_SIZES(name)                                                                           \
    RG_TEXEL(F, name, RG_HALVES_##F, RG_TEXEL_OF_WORDS, )
#define OUT_IMAGE(slot, F, name)                                                                   \
    RG_PROC void name##_store(rg_ctx rg, int x, int y, int layer, rgba c)                          \
    {                                                                                              \
        int i = rg_first_level_word(rg.name##_shape, x, y, layer, RG_WORDS_##F);                   \
        rg_store_##F(rg.name, RG_INDEX(rg, name, i), c);                                           \
    }

RG_ALL_SLOTS

#undef IN
#undef OUT
#undef INOUT
#undef ATOMIC
#undef IMAGE
#undef OUT_IMAGE
