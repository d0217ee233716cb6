// The dialect's mathematics, from exactly rounded operations alone, so that every device computes
// the same bits. The functions have no branches and no tables, so that a C compiler can vectorise
// them.
//
// Bounds are measured against double precision over all exponents and millions of values, and
// tests/dialect/math.c measures them again. An ulp is the distance of two neighbouring floats at
// the true result. Results are finite and never subnormal: RG_LARGEST or 0 replace those that would
// not be. No argument may be NaN, and none subnormal unless a function says what then happens.
#ifndef RG_KERNELS_DIALECT_MATH_H
#define RG_KERNELS_DIALECT_MATH_H

#include "kernels/dialect/lang.h"

#define RG_SMALLEST_NORMAL 1.17549435e-38f
#define RG_LARGEST         3.40282347e38f
#define RG_PI              3.14159265f

// 1 / sqrt(x). x > 0 and normal. At most 1.5 ulp.
RG_FN float rg_rsqrt(float x)
{
    return 1.0f / rg_sqrt(x);
}

// sqrt(x x + y y). Both 0, or the larger magnitude within 1e-16 to 1.3e19. At most 1.3 ulp.
RG_FN float rg_hypot(float x, float y)
{
    return rg_sqrt(x * x + y * y);
}

// --- sine and cosine ---

// Angle = quadrant pi/2 + rest, with |rest| <= pi/4.
RG_STRUCT(rg_angle)
{
    int quadrant;
    float rest;
};

RG_FN rg_angle rg_reduce_angle(float x)
{
    float inside = rg_clamp(x, -8192.0f, 8192.0f);
    float n = rg_floor(inside * 0.636619747f + 0.5f);
    rg_angle a;
    a.quadrant = rg_to_int(n);
    // pi/2 in three parts; n times the first two is exact
    a.rest = ((inside - n * 1.5703125f) - n * 4.837512969970703e-4f) - n * 7.54979013e-8f;
    return a;
}

RG_FN float rg_sin_quadrant(int quadrant, float r)
{
    float z = r * r;
    float s = -0.000194961482f;
    s = s * z + 0.00833198335f;
    s = s * z - 0.166666508f;
    s = s * z * r + r;
    float c = 2.44306702e-05f;
    c = c * z - 0.00138873013f;
    c = c * z + 0.0416666456f;
    c = c * z * z - 0.5f * z + 1.0f;
    float v = (quadrant & 1) != 0 ? c : s;
    return (quadrant & 2) != 0 ? -v : v;
}

// x in radians, |x| <= 8192 (the nearer end stands for anything beyond). Absolute error at most
// 1.0e-7.
RG_FN float rg_sin(float x)
{
    rg_angle a = rg_reduce_angle(x);
    return rg_sin_quadrant(a.quadrant, a.rest);
}

// As rg_sin.
RG_FN float rg_cos(float x)
{
    rg_angle a = rg_reduce_angle(x);
    return rg_sin_quadrant(a.quadrant + 1, a.rest);
}

// --- the angle of a direction ---

// The angle of (x, y) from the x axis towards the y axis, in radians, -pi to pi. The larger
// magnitude within 1e-30 to 1.7e38; if both are smaller, the result is 0. If y = 0, of either sign,
// and x < 0, it is pi. At most 3.0 ulp.
RG_FN float rg_atan2(float y, float x)
{
    float across = rg_abs(x);
    float up = rg_abs(y);
    float small = rg_min(across, up);
    float large = rg_max(across, up);
    // from the axis or from the diagonal, whichever is nearer: |t| <= tan(pi/8)
    bool diagonal = small > 0.414213568f * large;
    float t = (diagonal ? small - large : small) / rg_max(diagonal ? small + large : large, 1e-30f);
    t = rg_abs(t) < RG_SMALLEST_NORMAL ? 0.0f : t;
    float z = t * t;
    float r = 0.0805374458f;
    r = r * z - 0.138776854f;
    r = r * z + 0.199777111f;
    r = r * z - 0.333329499f;
    r = r * z * t + t + (diagonal ? 0.785398185f : 0.0f);
    r = up > across ? 1.57079637f - r : r;
    r = x < 0.0f ? RG_PI - r : r;
    r = large < 1e-30f ? 0.0f : r;
    return y < 0.0f ? -r : r;
}

// Angles in radians whose sine or cosine is x: -pi/2 to pi/2, and 0 to pi. An x beyond -1 or 1 is
// clamped. At most 3.5 ulp of the angle.
RG_FN float rg_asin(float x)
{
    float s = rg_clamp(x, -1.0f, 1.0f);
    return rg_atan2(s, rg_sqrt((1.0f - s) * (1.0f + s)));
}

RG_FN float rg_acos(float x)
{
    float c = rg_clamp(x, -1.0f, 1.0f);
    return rg_atan2(rg_sqrt((1.0f - c) * (1.0f + c)), c);
}

// --- powers ---

// v 2^n for v within 0.7 to 1.42 and n within -126 to 128; 0 if that is no normal number.
RG_FN float rg_scale(float v, int n)
{
    uint bits = rg_float_bits(v) + (rg_to_uint(n) << 23);
    return rg_bits_float(bits < 0x00800000u ? 0u : bits);
}

// 2^f for |f| <= 0.5.
RG_FN float rg_exp2_fraction(float f)
{
    float p = 0.000133770998f;
    p = p * f + 0.00133874454f;
    p = p * f + 0.00962527096f;
    p = p * f + 0.0555036701f;
    p = p * f + 0.240225956f;
    p = p * f + 0.693147182f;
    return p * f + 1.0f;
}

// 2^x. Any x: below -126 the result is 0, from 128 on RG_LARGEST. At most 1.2 ulp.
RG_FN float rg_exp2(float x)
{
    float inside = rg_clamp(x, -126.0f, 127.99999f);
    float n = rg_floor(inside + 0.5f);
    float v = rg_scale(rg_exp2_fraction(inside - n), rg_to_int(n));
    v = x < 128.0f ? v : RG_LARGEST;
    return x < -126.0f ? 0.0f : v;
}

// e^x. Any x: below -87.33654 the result is 0, above 88.72283 RG_LARGEST. At most 1.0 ulp.
RG_FN float rg_exp(float x)
{
    float inside = rg_clamp(x, -87.33654f, 88.72283f);
    float n = rg_floor(inside * 1.44269502f + 0.5f);
    // ln 2 in two parts; n times the first is exact
    float r = (inside - n * 0.693115234375f) - n * 3.19461833e-5f;
    float p = 0.00138317607f;
    p = p * r + 0.00836878177f;
    p = p * r + 0.0416681468f;
    p = p * r + 0.166665196f;
    p = p * r + 0.49999994f;
    p = p * r * r + r + 1.0f;
    float v = rg_scale(p, rg_to_int(n));
    v = x <= 88.72283f ? v : RG_LARGEST;
    return x < -87.33654f ? 0.0f : v;
}

// --- logarithms ---

// The first 12 bits of v, so that a product of two such floats is exact.
RG_FN float rg_high_bits(float v)
{
    return rg_bits_float(rg_float_bits(v) & 0xfffff000u);
}

// x = 2^exponent m with m within sqrt(1/2) to sqrt(2), and ln m = high + low, where low completes
// high to about 30 correct bits.
RG_STRUCT(rg_log_parts)
{
    float exponent;
    float high;
    float low;
};

RG_FN rg_log_parts rg_log_split(float x)
{
    uint bits = rg_float_bits(rg_max(x, RG_SMALLEST_NORMAL)) + 0x004afb0du;
    float m = rg_bits_float((bits & 0x007fffffu) + 0x3f3504f3u);
    // ln m = 2 s + 2/3 s^3 + ..., s = (m - 1) / (m + 1), twice as precise as a float
    float f = m - 1.0f;
    float inverse = 1.0f / (m + 1.0f);
    float s = f * inverse;
    float sum_high = rg_high_bits(m + 1.0f);
    float sum_low = m - (sum_high - 1.0f);
    float s_high = rg_high_bits(s);
    float s_low = ((f - s_high * sum_high) - s_high * sum_low) * inverse;
    float z = s * s;
    float r = 0.242788345f;
    r = r * z + 0.284987926f;
    r = r * z + 0.400009722f;
    r = r * z + 0.666666627f;
    float large = 2.0f * s_high;
    float small = 2.0f * s_low + r * z * s;
    rg_log_parts parts;
    parts.exponent = rg_to_float(rg_to_int(bits >> 23) - 127);
    parts.high = large + small;
    parts.low = (large - parts.high) + small;
    return parts;
}

// ln x. Normal x > 0: anything smaller counts as the smallest normal, 2^-126. At most 1.0 ulp.
RG_FN float rg_log(float x)
{
    rg_log_parts l = rg_log_split(x);
    return l.exponent * 0.693115234375f + (l.high + (l.low + l.exponent * 3.19461833e-5f));
}

// log2 x = high + low, to about 30 bits.
RG_STRUCT(rg_log2_parts)
{
    float high;
    float low;
};

RG_FN rg_log2_parts rg_log2_split(float x)
{
    rg_log_parts l = rg_log_split(x);
    float ln_high = rg_high_bits(l.high);
    float ln_low = (l.high - ln_high) + l.low;
    // 1 / ln 2 in two parts; ln_high times the first is exact
    float scaled = ln_high * 1.4423828125f;
    float scaled_low = ln_high * 3.12228396e-4f + ln_low * 1.44269502f;
    float sum = l.exponent + scaled;
    float lost = (l.exponent - sum) + scaled;
    rg_log2_parts parts;
    float low = lost + scaled_low;
    parts.high = sum + low;
    parts.low = (sum - parts.high) + low;
    return parts;
}

// log2 x, domain as rg_log. At most 1.0 ulp.
RG_FN float rg_log2(float x)
{
    return rg_log2_split(x).high;
}

// x^y for x >= 0 and |y| <= 1e30. An x below the smallest normal counts as 0 if y > 0, else as the
// smallest normal; x^0 is 1. At most 8 ulp.
RG_FN float rg_pow(float x, float y)
{
    rg_log2_parts l = rg_log2_split(x);
    float l_high = rg_high_bits(l.high);
    float l_low = (l.high - l_high) + l.low;
    float y_high = rg_high_bits(y);
    float product = y_high * l_high; // exact
    float rest = (y - y_high) * l_high + y * l_low;
    float t = product + rest;
    float n = rg_floor(rg_clamp(t, -126.0f, 127.99999f) + 0.5f);
    float v = rg_scale(rg_exp2_fraction((product - n) + rest), rg_to_int(n));
    v = t < 128.0f ? v : RG_LARGEST;
    return t < -126.0f || (x < RG_SMALLEST_NORMAL && y > 0.0f) ? 0.0f : v;
}

// A step of Newton's towards the cube root of x.
RG_FN float rg_cbrt_step(float x, float y)
{
    return y + (x / (y * y) - y) * 0.33333334f;
}

// The cube root of x >= 0; that of an x below the smallest normal is 0. At most 1 ulp. A third of a
// number's bits gives its root to within a twentieth, and each step squares the error.
RG_FN float rg_cbrt(float x)
{
    float y = rg_bits_float(rg_float_bits(x) / 3u + 0x2a5137a0u);
    y = rg_cbrt_step(x, rg_cbrt_step(x, rg_cbrt_step(x, y)));
    return x < RG_SMALLEST_NORMAL ? 0.0f : y;
}

// x to a whole power from 0 to 15, by squaring. Squaring doubles rounding errors. They add up to a
// relative error of at most 14 * 2^-24, for the power 15: below 14 ulp, 9.7 ulp seen.
RG_FN float rg_pow_whole(float x, int power)
{
    float x2 = x * x;
    float x4 = x2 * x2;
    float low = ((power & 1) != 0 ? x : 1.0f) * ((power & 2) != 0 ? x2 : 1.0f);
    float high = ((power & 4) != 0 ? x4 : 1.0f) * ((power & 8) != 0 ? x4 * x4 : 1.0f);
    return low * high;
}

#endif
