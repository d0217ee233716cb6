// Applies one operation of RG_PROBE_BUILTINS to every item: each language's own functions, which
// the dialect forbids everywhere else. `doctor` shows how far drivers differ in them.
#include "kernels/probe/slots.h"

#if RG_GLSL

#define probe_fma(a, b, c)       fma(a, b, c)
#define probe_mix(a, b, c)       mix(a, b, c)
#define probe_dot(a, b, c)       dot(vec3(a, b, c), vec3(b, c, a))
#define probe_length(a, b, c)    length(vec3(a, b, c))
#define probe_normalize(a, b, c) normalize(vec3(a, b, c)).x
#define probe_smoothstep(a)      smoothstep(0.0f, 1.0f, a)
#define probe_sin(a)             sin(a)
#define probe_cos(a)             cos(a)
#define probe_exp(a)             exp(a)
#define probe_exp2(a)            exp2(a)
#define probe_log2(a)            log2(a)
#define probe_pow(a, b)          pow(a, b)
#define probe_inversesqrt(a)     inversesqrt(a)
#define probe_round(a)           round(a)
#define probe_min(a, b)          min(a, b)
#define probe_max(a, b)          max(a, b)

#elif RG_OPENCL

#define probe_fma(a, b, c)       fma(a, b, c)
#define probe_mix(a, b, c)       mix(a, b, c)
#define probe_dot(a, b, c)       dot((float3)(a, b, c), (float3)(b, c, a))
#define probe_length(a, b, c)    length((float3)(a, b, c))
#define probe_normalize(a, b, c) normalize((float3)(a, b, c)).x
#define probe_smoothstep(a)      smoothstep(0.0f, 1.0f, a)
#define probe_sin(a)             sin(a)
#define probe_cos(a)             cos(a)
#define probe_exp(a)             exp(a)
#define probe_exp2(a)            exp2(a)
#define probe_log2(a)            log2(a)
#define probe_pow(a, b)          pow(a, b)
#define probe_inversesqrt(a)     rsqrt(a)
#define probe_round(a)           round(a)
#define probe_min(a, b)          fmin(a, b)
#define probe_max(a, b)          fmax(a, b)

#else

#define probe_fma(a, b, c)       fmaf(a, b, c)
#define probe_mix(a, b, c)       ((a) * (1.0f - (c)) + (b) * (c))
#define probe_dot(a, b, c)       ((a) * (b) + (b) * (c) + (c) * (a))
#define probe_length(a, b, c)    sqrtf((a) * (a) + (b) * (b) + (c) * (c))
#define probe_normalize(a, b, c) ((a) / probe_length(a, b, c))
#define probe_smoothstep(a)      (probe_unit(a) * probe_unit(a) * (3.0f - 2.0f * probe_unit(a)))
#define probe_unit(a)            fminf(fmaxf(a, 0.0f), 1.0f)
#define probe_sin(a)             sinf(a)
#define probe_cos(a)             cosf(a)
#define probe_exp(a)             expf(a)
#define probe_exp2(a)            exp2f(a)
#define probe_log2(a)            log2f(a)
#define probe_pow(a, b)          powf(a, b)
#define probe_inversesqrt(a)     (1.0f / sqrtf(a))
#define probe_round(a)           roundf(a)
#define probe_min(a, b)          fminf(a, b)
#define probe_max(a, b)          fmaxf(a, b)

#endif

RG_FN uint probe_apply(int op, float a, float b, float c)
{
    uint bits = 0u;
    RG_PROBE_BUILTINS(RG_PROBE_TRY)
    return bits;
}

RG_GRID_KERNEL(probe_builtin)
{
    result_put(rg, x,
               probe_apply(p.op, rg_bits_float(first_at(rg, x)), rg_bits_float(second_at(rg, x)),
                           rg_bits_float(third_at(rg, x))));
}
