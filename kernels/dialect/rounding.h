// Quotients and roots rounded as in C, for drivers that round differently: GLSL lets a quotient be
// 2.5 ulp off, and promises less for a root. The build can replace every `/` of floats and every
// rg_sqrt of GLSL by these two (kernels/build/quotients.py). Programs use them on devices whose own
// are not exact (backends/asked/rounding.h).
//
// The driver's result for significands within [1, 4) is a first guess. The remainder of the
// dividend after it is a small whole number, exact in 32 bits, which tells by how many ulps the
// guess is off. These are at most 3 for a quotient, and 5 for a root, which a driver may compute by
// two operations. RG_ROUGH_QUOTIENT(a, b) and RG_ROUGH_ROOT(x) are the driver's own.
#ifndef RG_KERNELS_DIALECT_ROUNDING_H
#define RG_KERNELS_DIALECT_ROUNDING_H

#include "kernels/dialect/lang.h"

// The significand of a normal number, 24 bits.
RG_FN uint rg_significand(uint float_bits)
{
    return (float_bits & 0x7fffffu) | 0x800000u;
}

// The significand of a guess, clamped to [1, 2), where the true result lies.
RG_FN uint rg_guessed_significand(float guess)
{
    uint bits = rg_float_bits(guess);
    uint least = bits < 0x3f800000u ? 0x3f800000u : bits;
    return rg_significand(least > 0x3fffffffu ? 0x3fffffffu : least);
}

RG_FN bool rg_is_normal_exponent(int exponent)
{
    return exponent > 0 && exponent < 255;
}

// a / b, to nearest, for normal numbers whose quotient is normal; else the driver's result. No
// quotient of two floats lies halfway between two others.
RG_FN float rg_rounded_quotient(float a, float b)
{
    uint a_bits = rg_float_bits(a);
    uint b_bits = rg_float_bits(b);
    uint of = rg_significand(a_bits);
    uint by = rg_significand(b_bits);
    uint less = of < by ? 1u : 0u;
    int a_exponent = rg_to_int((a_bits >> 23) & 255u);
    int b_exponent = rg_to_int((b_bits >> 23) & 255u);
    int exponent = a_exponent - b_exponent + 127 - rg_to_int(less);
    float dividend = rg_bits_float((a_bits & 0x7fffffu) | (less != 0u ? 0x40000000u : 0x3f800000u));
    float divisor = rg_bits_float((b_bits & 0x7fffffu) | 0x3f800000u);
    float guess = RG_ROUGH_QUOTIENT(dividend, divisor);
    uint quotient = rg_guessed_significand(guess);
    int rest = rg_to_int((of << (23u + less)) - quotient * by);
    int whole = rg_to_int(by);
    for (int i = 0; i < 3; i++) {
        int twice = rest + rest;
        int step = twice > whole ? 1 : (twice < -whole ? -1 : 0);
        quotient += rg_to_uint(step);
        rest -= step * whole;
    }
    uint bits =
        ((a_bits ^ b_bits) & 0x80000000u) | (rg_to_uint(exponent) << 23) | (quotient & 0x7fffffu);
    bool normal = rg_is_normal_exponent(a_exponent) && rg_is_normal_exponent(b_exponent) &&
                  rg_is_normal_exponent(exponent);
    float rough = RG_ROUGH_QUOTIENT(a, b);
    return normal ? rg_bits_float(bits) : rough;
}

// The square root of x, to nearest, for normal numbers above 0; else the driver's result. No root
// of a float lies halfway between two others.
RG_FN float rg_rounded_root(float x)
{
    uint x_bits = rg_float_bits(x);
    int exponent = rg_to_int(x_bits >> 23); // beyond 255 below 0
    uint odd = 1u - (rg_to_uint(exponent) & 1u);
    float guess = RG_ROUGH_ROOT(
        rg_bits_float((x_bits & 0x7fffffu) | (odd != 0u ? 0x40000000u : 0x3f800000u)));
    uint root = rg_guessed_significand(guess);
    int rest = rg_to_int((rg_significand(x_bits) << (23u + odd)) - root * root);
    for (int i = 0; i < 5; i++) {
        int at = rg_to_int(root);
        int step = rest > at ? 1 : (rest <= -at ? -1 : 0);
        rest -= step * (at + at + step);
        root += rg_to_uint(step);
    }
    uint bits = (rg_to_uint((exponent + 127 - rg_to_int(odd)) / 2) << 23) | (root & 0x7fffffu);
    float rough = RG_ROUGH_ROOT(x);
    return rg_is_normal_exponent(exponent) ? rg_bits_float(bits) : rough;
}

#endif
