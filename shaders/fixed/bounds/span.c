// Conversions to formats of fewer bits.
//
// Either neighbour of a value is allowed (OpenGL, Conversion from Floating-Point to Normalized
// Fixed-Point, and 16-Bit Floating-Point Numbers; Vulkan, sections of the same names).
#include "shaders/fixed/bounds/span.h"

#include "shaders/fixed/fixed.h"

// A value this near to a code is that code, since the double's own errors are not the device's.
static const double near_code = 1e-6;

struct rg_span rg_round_unorm(struct rg_span a, int bits)
{
    const double most = ldexp(1, bits) - 1;
    a = rg_span_scale(rg_span_clamp(a, 0, 1), most);
    return (struct rg_span){floor(a.low + near_code) / most, ceil(a.high - near_code) / most};
}

static double step_of(double value, int mantissa_bits, int least_exponent)
{
    int exponent;
    frexp(value, &exponent);
    exponent = exponent - 1 < least_exponent ? least_exponent : exponent - 1;
    return ldexp(1, exponent - mantissa_bits);
}

struct rg_span rg_round_float(struct rg_span a, int mantissa_bits, int least_exponent)
{
    const double low = step_of(a.low, mantissa_bits, least_exponent);
    const double high = step_of(a.high, mantissa_bits, least_exponent);
    return (struct rg_span){isfinite(a.low) ? floor(a.low / low) * low : a.low,
                            isfinite(a.high) ? ceil(a.high / high) * high : a.high};
}

// 11 and 10 bits: a device rounds to the nearest or towards zero (OpenGL, Unsigned 11-Bit
// Floating-Point Numbers).
struct rg_span rg_round_small_float(struct rg_span a, int mantissa_bits)
{
    const double high = step_of(a.high, mantissa_bits, -14);
    const struct rg_span rounded = rg_round_float(a, mantissa_bits, -14);
    return (struct rg_span){rounded.low, isfinite(a.high) ? rint(a.high / high) * high : a.high};
}

struct rg_span rg_round_colour(int format, struct rg_span a)
{
    return format == RG_FIXED_RGBA8     ? rg_round_unorm(a, 8)
           : format == RG_FIXED_RGBA16F ? rg_round_float(a, 10, -14)
                                        : rg_round_float(a, 23, -126);
}

struct rg_span rg_round_depth(int depth, struct rg_span a)
{
    a = rg_span_clamp(a, 0, 1);
    return depth == RG_FIXED_D16 ? rg_round_unorm(a, 16) : rg_round_float(a, 23, -126);
}
