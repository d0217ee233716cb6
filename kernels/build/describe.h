// Turns the kernel header that was just included into its row for backends/kernel.h. C only.
#include "backends/kernel.h"

#define RG_CAT_(a, b)            a##b
#define RG_CAT(a, b)             RG_CAT_(a, b)
#define RG_STRING_(a)            #a
#define RG_STRING(a)             RG_STRING_(a)
#define IN(slot, T, name)        RG_BUFFER(slot, T, name, RG_SLOT_IN)
#define OUT(slot, T, name)       RG_BUFFER(slot, T, name, RG_SLOT_OUT)
#define INOUT(slot, T, name)     RG_BUFFER(slot, T, name, RG_SLOT_INOUT)
#define ATOMIC(slot, T, name)    RG_BUFFER(slot, T, name, RG_SLOT_ATOMIC)
#define IMAGE(slot, F, name)     {#name, slot, RG_SLOT_IMAGE, 0, RG_##F, NULL, RG_TEXELS},
#define OUT_IMAGE(slot, F, name) {#name, slot, RG_SLOT_OUT_IMAGE, 0, RG_##F, NULL, RG_TEXELS},
#undef SAMPLED
#define SAMPLED(slot, F, name, how)                                                                \
    {#name, slot, RG_SLOT_IMAGE, 0, RG_##F, NULL, RG_CAT(RG_SAMPLER_, RG_KERNEL_KIND)(how)},

// Stages that pack sample nothing, and native devices run none.
#define RG_SAMPLER_packer(how) RG_TEXELS
#define RG_SAMPLER_program(how)                                                                    \
    _Pragma("GCC error \"a DRAW program with a SAMPLED slot is also in sampling_programs\"")       \
        RG_TEXELS
#define RG_SAMPLER_lit(how)      RG_SAMPLER_program(how)
#define RG_SAMPLER_sampling(how) RG_SAMPLED_##how
#define RG_SAMPLER_grid(how)                                                                       \
    _Pragma("GCC error \"a GRID kernel with a SAMPLED slot is listed in sampling_kernels\"")       \
        RG_TEXELS

// The kinds of a type's words (enum rg_word), after a comma; a type without a row here has NULL.
// tests/structure/words.py compares them with the structs.
#define RG_WORDS_float            , "f"
#define RG_WORDS_int              , "i"
#define RG_WORDS_uint             , "u"
#define RG_WORDS_flow_pane        , "iiiifffiiiiiiiiiiiifffffffff"
#define RG_WORDS_drops_drop       , "uuufffffuuu"
#define RG_WORDS_scenery_light    , "ifffffffffffiiffffffffffffffffff"
#define RG_WORDS_cartoon_raindrop , "ffffffffffffffiiuu"
#define RG_WORDS_cartoon_spray    , "fffffffffiiiu"
#define RG_WORDS_cartoon_surface  , "ffff"
#define RG_SECOND_(a, b, ...)     b
#define RG_SECOND(...)            RG_SECOND_(__VA_ARGS__)
#define RG_BUFFER(slot, T, name, kind)                                                             \
    {#name, slot, kind, sizeof(T), RG_FORMAT_NONE, RG_SECOND(RG_WORDS_##T, NULL, ), RG_TEXELS},

static const struct rg_slot_info slots[] = {RG_ALL_SLOTS};

static_assert(sizeof(RG_RUN_PARAMS) % 4 == 0 && sizeof(RG_RUN_PARAMS) <= RG_MAX_PARAMS_SIZE,
              "parameters are 4-byte scalars, at most RG_MAX_PARAMS_SIZE bytes");

#undef IN
#undef OUT
#undef INOUT
#undef ATOMIC
#undef IMAGE
#undef OUT_IMAGE
#undef SAMPLED
#if RG_IS_PASS
#define IN(slot, T, name)
#define OUT(slot, T, name)    +2
#define INOUT(slot, T, name)  +2
#define ATOMIC(slot, T, name) +2
#define IMAGE(slot, F, name)
#define OUT_IMAGE(slot, F, name) +1
#define SAMPLED(slot, F, name, how)
static_assert((0 RG_ALL_SLOTS) == 1, "a kernel with RG_OWN_TEXELS writes one OUT_IMAGE alone");

static int layer_of(const void *params, int z RG_UNUSED)
{
    RG_RUN_PARAMS p;
    memcpy(&p, params, sizeof(p));
    return RG_OWN_TEXELS;
}
#elif defined(RG_OWN_TEXELS)
#error "a GRID kernel with RG_OWN_TEXELS is also in passing_kernels"
#endif

#if RG_IS_PROGRAM
#if defined(RG_LIGHTS)
#define RG_LIGHTS_AT (int)offsetof(RG_PARAMS, lights)
#else
#define RG_LIGHTS_AT -1
#endif
static const struct rg_draw_info draw = {
    .corners = RG_CORNERS,
    .prim_size = sizeof(rg_prim),
    .call_size = sizeof(rg_draw_call),
    .lights_at = RG_LIGHTS_AT,
    .count = RG_STRING(RG_KERNEL_NAME) "_count",
    .emit = RG_STRING(RG_KERNEL_NAME) "_emit",
};
static_assert(RG_CORNERS == 3 || RG_CORNERS == 4, "items have 3 or 4 corners");
#endif

extern const struct rg_embedded_code RG_CAT(rg_code_, RG_KERNEL_NAME)[RG_CODE_COUNT];
extern const struct rg_kernel RG_CAT(rg_kernel_, RG_KERNEL_NAME);

const struct rg_kernel RG_CAT(rg_kernel_, RG_KERNEL_NAME) = {
    .name = RG_STRING(RG_KERNEL_NAME),
#if RG_IS_PROGRAM
    .params_size = sizeof(RG_PARAMS),
    .draw = &draw,
#else
    .params_size = sizeof(RG_RUN_PARAMS),
#endif
#if RG_IS_PASS
    .layer = layer_of,
#endif
    .slot_count = sizeof(slots) / sizeof(slots[0]),
    .slots = slots,
    .code = RG_CAT(rg_code_, RG_KERNEL_NAME),
};
