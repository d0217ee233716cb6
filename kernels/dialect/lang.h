// The kernel dialect: the common part of C11, OpenCL C 1.2 and GLSL 4.50, and words for the few
// differences.
//
// A kernel body is a pure function over float, int, uint and structs of them, passed and returned
// by value: no pointers, no native vectors, no arrays, no recursion. It uses only exactly rounded
// operations: + - * /, sqrt, floor, comparisons and integers; math.h builds everything else from
// these. So every device computes the same bits. docs/dialect.md is the guide.
//
// The build defines RG_GLSL or RG_OPENCL when it flattens a kernel for a driver
// (kernels/build/flatten.py); a C compiler defines neither. Feature words are 0 or 1 and tested
// with #if.
#ifndef RG_KERNELS_DIALECT_LANG_H
#define RG_KERNELS_DIALECT_LANG_H

#ifndef RG_GLSL
#define RG_GLSL 0
#endif
#ifndef RG_OPENCL
#define RG_OPENCL 0
#endif
// 1 in the GLSL of native devices (docs/native.md): the driver's samplers filter, and it sets up
// items: clips, culls and snaps their corners, and interpolates depth.
#ifndef RG_NATIVE_SAMPLERS
#define RG_NATIVE_SAMPLERS 0
#endif
#ifndef RG_NATIVE_SETUP
#define RG_NATIVE_SETUP 0
#endif
// What the driver has interpolated at a fragment (dialect/draw/draw.h), or what the fragment
// computes. The constant rg_interpolates, of such fragments alone, chooses.
#if RG_NATIVE_SETUP && defined(RG_STAGE_FRAGMENT)
#define RG_INTERPOLATED(interpolated, computed) (rg_interpolates ? (interpolated) : (computed))
#else
#define RG_INTERPOLATED(interpolated, computed) (computed)
#endif

// RG_STRUCT(name) { int a; float b; }; is a struct of 4-byte scalars that crosses the host
// boundary; RG_STRUCT_SIZE(name, words) checks its size. RG_FN starts every function that returns a
// value, RG_PROC every one that returns nothing, RG_SELDOM a long one that few items need. RG_APART
// before a loop says that no iteration reads what another one writes, so that compilers for
// processors vectorise it. RG_KEPT before a loop of few iterations keeps compilers from unrolling
// it, for the same end.
#if RG_GLSL

#define RG_STRUCT(name) struct name
#define RG_STRUCT_SIZE(name, words)
#define RG_FN
#define RG_PROC
#define RG_SELDOM
#define RG_APART
#define RG_KEPT

#define rg_to_float(i)   float(i)
#define rg_to_int(f)     int(f)
#define rg_to_uint(i)    uint(i)
#define rg_float_bits(f) floatBitsToUint(f)
#define rg_bits_float(u) uintBitsToFloat(u)
#define rg_sqrt(f)       RG_ROOT(f)
#define rg_floor(f)      floor(f)
#define rg_abs(f)        abs(f)

RG_FN uint rg_mul_hi(uint a, uint b)
{
    uint high;
    uint low;
    umulExtended(a, b, high, low);
    return high;
}

#elif RG_OPENCL

#pragma OPENCL FP_CONTRACT OFF
#define RG_STRUCT(name)                                                                            \
    typedef struct name name;                                                                      \
    struct name
#define RG_STRUCT_SIZE(name, words)
#define RG_GLOBAL __global // the memory of slots
// Inlined early; else structs that functions return keep LLVM from vectorising.
#define RG_FN     static inline __attribute__((always_inline))
#define RG_PROC   static inline __attribute__((always_inline))
// Called, not inlined: PoCL then compiles the kernels in two thirds of the time.
#define RG_SELDOM static __attribute__((noinline))
#define RG_APART
#define RG_KEPT

#define rg_to_float(i)   convert_float(i)
#define rg_to_int(f)     convert_int(f)
#define rg_to_uint(i)    convert_uint(i)
#define rg_float_bits(f) as_uint(f)
#define rg_bits_float(u) as_float(u)
#define rg_sqrt(f)       sqrt(f)
#define rg_floor(f)      floor(f)
#define rg_abs(f)        fabs(f)
#define rg_mul_hi(a, b)  mul_hi((uint)(a), (uint)(b))

#else

#include <assert.h>
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

static_assert(FLT_EVAL_METHOD == 0, "float expressions must be evaluated in float");

typedef unsigned int uint;
#define RG_STRUCT(name)                                                                            \
    typedef struct name name;                                                                      \
    struct name
#define RG_STRUCT_SIZE(name, words)                                                                \
    static_assert(sizeof(name) == 4 * (words), #name " has padding");
#define RG_GLOBAL
#define RG_FN     static inline __attribute__((always_inline, unused))
#define RG_PROC   static inline __attribute__((always_inline, unused))
#define RG_SELDOM RG_FN
#if defined(__GNUC__) && !defined(__clang__)
#define RG_APART _Pragma("GCC ivdep")
#define RG_KEPT  _Pragma("GCC unroll 1")
#else
#define RG_APART
#define RG_KEPT
#endif

#define rg_to_float(i) ((float)(i))
#define rg_to_int(f)   ((int)(f))
#define rg_to_uint(i)  ((uint)(i))
#define rg_sqrt(f)     sqrtf(f)
#define rg_floor(f)    floorf(f)
#define rg_abs(f)      fabsf(f)

RG_FN uint rg_float_bits(float f)
{
    uint u;
    memcpy(&u, &f, sizeof(u));
    return u;
}

RG_FN float rg_bits_float(uint u)
{
    float f;
    memcpy(&f, &u, sizeof(f));
    return f;
}

RG_FN uint rg_mul_hi(uint a, uint b)
{
    return (uint)(((uint64_t)a * b) >> 32);
}

#endif

// Written out, because each language's min and max differ on -0 and NaN.
RG_FN float rg_min(float a, float b)
{
    return b < a ? b : a;
}

RG_FN float rg_max(float a, float b)
{
    return a < b ? b : a;
}

RG_FN float rg_clamp(float a, float low, float high)
{
    return rg_min(rg_max(a, low), high);
}

RG_FN int rg_imin(int a, int b)
{
    return b < a ? b : a;
}

RG_FN int rg_imax(int a, int b)
{
    return a < b ? b : a;
}

RG_FN int rg_iclamp(int a, int low, int high)
{
    return rg_imin(rg_imax(a, low), high);
}

// A colour, linear, alpha last.
RG_STRUCT(rgba)
{
    float r;
    float g;
    float b;
    float a;
};
RG_STRUCT_SIZE(rgba, 4)

// Two texels of a row.
RG_STRUCT(rg_texels)
{
    rgba left;
    rgba right;
};
RG_STRUCT_SIZE(rg_texels, 8)

RG_FN rgba rg_rgba(float r, float g, float b, float a)
{
    rgba c;
    c.r = r;
    c.g = g;
    c.b = b;
    c.a = a;
    return c;
}

#endif
