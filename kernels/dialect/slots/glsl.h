// slots.h for GLSL: slots are global bindings, and the context carries the parameters alone.

#define RG_UNUSED

struct rg_ctx {
    RG_RUN_PARAMS p;
};

#define rg_all_plain(rg) 0

#define RG_LAYOUT_RGBA8   rgba8
#define RG_LAYOUT_RGBA16F rgba16f
#define RG_LAYOUT_RGBA32F rgba32f
#define RG_LAYOUT_R32F    r32f

#define RG_BLOCK(slot, access, T, name)                                                            \
    layout(std430, binding = slot) restrict access buffer rg_block_##name                          \
    {                                                                                              \
        T name##_data[];                                                                           \
    };

#define RG_AT(T, name)                                                                             \
    T name##_at(rg_ctx rg, int i)                                                                  \
    {                                                                                              \
        return name##_data[i];                                                                     \
    }

#define RG_PUT(T, name)                                                                            \
    void name##_put(rg_ctx rg, int i, T v)                                                         \
    {                                                                                              \
        name##_data[i] = v;                                                                        \
    }

// A buffer that is only read, of words or of structs. RG_WORDS, RG_STRUCTS and their like differ
// between OpenGL and Vulkan; flatten.py has them.
#define RG_IN_WORDS(slot, T, name, word)                                                           \
    RG_WORDS(slot, T, rg_block_##name, name##_words)                                               \
    T name##_at(rg_ctx rg, int i)                                                                  \
    {                                                                                              \
        return word(name##_words, i);                                                              \
    }

#define RG_IN_STRUCTS(slot, T, name, none)                                                         \
    RG_STRUCTS(slot, T, rg_block_##name, name##_words)                                             \
    T name##_at(rg_ctx rg, int i)                                                                  \
    {                                                                                              \
        return RG_STRUCT_OF(rg_##T##_of, name##_words, i);                                         \
    }

#define RG_WORD_float                                , RG_IN_WORDS, RG_FLOAT_OF
#define RG_WORD_int                                  , RG_IN_WORDS, RG_INT_OF
#define RG_WORD_uint                                 , RG_IN_WORDS, RG_UINT_OF
#define RG_IN_OF(slot, T, name, type, in, word, ...) in(slot, T, name, word)
#define RG_IN(slot, T, name, ...)                    RG_IN_OF(slot, T, name, __VA_ARGS__)
#define IN(slot, T, name)                            RG_IN(slot, T, name, RG_WORD_##T, RG_IN_STRUCTS, )

#define OUT(slot, T, name)                                                                         \
    RG_BLOCK(slot, writeonly, T, name)                                                             \
    RG_PUT(T, name)

#define INOUT(slot, T, name)                                                                       \
    RG_BLOCK(slot, , T, name)                                                                      \
    RG_AT(T, name)                                                                                 \
    RG_PUT(T, name)

#define RG_ATOMIC_OP(T, name, op, call)                                                            \
    void name##_##op(rg_ctx rg, int i, T v)                                                        \
    {                                                                                              \
        call(name##_data[i], v);                                                                   \
    }

#define ATOMIC(slot, T, name)                                                                      \
    RG_BLOCK(slot, coherent, T, name)                                                              \
    RG_ATOMIC_OP(T, name, add, atomicAdd)                                                          \
    RG_ATOMIC_OP(T, name, min, atomicMin)                                                          \
    RG_ATOMIC_OP(T, name, max, atomicMax)                                                          \
    RG_ATOMIC_OP(T, name, or, atomicOr)                                                            \
    RG_ATOMIC_OP(T, name, store, atomicExchange)                                                   \
    T name##_load(rg_ctx rg, int i)                                                                \
    {                                                                                              \
        return atomicOr(name##_data[i], T(0));                                                     \
    }                                                                                              \
    T name##_exchange_if(rg_ctx rg, int i, T expected, T v)                                        \
    {                                                                                              \
        return atomicCompSwap(name##_data[i], expected, v);                                        \
    }

// A level's size is computed from level 0's, because llvmpipe and lavapipe answer textureSize with
// the size of the first item's level for all items of a vector.
#define IMAGE(slot, F, name)                                                                       \
    layout(binding = slot) uniform sampler2DArray name##_sampler;                                  \
    rgba name##_texel(rg_ctx rg, int x, int y, int layer, int level)                               \
    {                                                                                              \
        vec4 t = texelFetch(name##_sampler, ivec3(x, y, layer), level);                            \
        return rg_fetched_##F(rg_rgba(t.x, t.y, t.z, t.w));                                        \
    }                                                                                              \
    RG_TEXELS_SINGLY(name)                                                                         \
    uint name##_bytes(rg_ctx rg, int x, int y, int layer, int level)                               \
    {                                                                                              \
        uvec4 t = uvec4(texelFetch(name##_sampler, ivec3(x, y, layer), level) * 255.0f + 0.5f);    \
        return t.x | (t.y << 8) | (t.z << 16) | (t.w << 24);                                       \
    }                                                                                              \
    RG_SIZES(name, name##_sampler)

#define RG_SIZES(name, sampler)                                                                    \
    int name##_width(rg_ctx rg, int level)                                                         \
    {                                                                                              \
        return rg_imax(textureSize(sampler, 0).x >> level, 1);                                     \
    }                                                                                              \
    int name##_height(rg_ctx rg, int level)                                                        \
    {                                                                                              \
        return rg_imax(textureSize(sampler, 0).y >> level, 1);                                     \
    }                                                                                              \
    int name##_levels(rg_ctx rg)                                                                   \
    {                                                                                              \
        return textureQueryLevels(sampler);                                                        \
    }

// A texel that is drawn (shaders/pass.frag) is the fragment's, and its driver rounds it.
#ifdef RG_STAGE_PASS
#define RG_OUT_IMAGE(slot, format, F, name)                                                        \
    void name##_store(rg_ctx rg, int x, int y, int layer, rgba c)                                  \
    {                                                                                              \
        rg_texel = vec4(c.r, c.g, c.b, c.a);                                                       \
        rg_is_stored[0] = true;                                                                    \
    }
#else
#define RG_OUT_IMAGE(slot, format, F, name)                                                        \
    layout(format, binding = slot) restrict writeonly uniform image2DArray name##_image;           \
    void name##_store(rg_ctx rg, int x, int y, int layer, rgba c)                                  \
    {                                                                                              \
        rgba v = rg_rounded_##F(c);                                                                \
        imageStore(name##_image, ivec3(x, y, layer), vec4(v.r, v.g, v.b, v.a));                    \
    }
#endif

#define OUT_IMAGE(slot, F, name) RG_OUT_IMAGE(slot, RG_LAYOUT_##F, F, name)

#if RG_NATIVE_SAMPLERS
// Cubes and shadows have samplers of their own, which fetch no texels. Their names differ, because
// OpenGL wants a name to have one type in all stages, and some stages sample nothing.
#define RG_AS_FILTERED(slot, F, name) IMAGE(slot, F, name)
#define RG_AS_TILED(slot, F, name)    IMAGE(slot, F, name)
#define RG_AS_CUBE(slot, F, name)                                                                  \
    layout(binding = slot) uniform samplerCube name##_cube;                                        \
    RG_SIZES(name, name##_cube)
#define RG_AS_SHADOW(slot, F, name)                                                                \
    layout(binding = slot) uniform sampler2DArrayShadow name##_compared;                           \
    RG_SIZES(name, name##_compared)
#undef SAMPLED
#define SAMPLED(slot, F, name, how) RG_AS_##how(slot, F, name)
#endif

RG_ALL_SLOTS

#undef SAMPLED
#define SAMPLED(slot, F, name, how) IMAGE(slot, F, name)
#undef IN
#undef OUT
#undef INOUT
#undef ATOMIC
#undef IMAGE
#undef OUT_IMAGE
