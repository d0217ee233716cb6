// Conversions to formats of fewer bits.
//
// Either neighbour of a value is allowed (OpenGL, Conversion from Floating-Point to Normalized
// Fixed-Point, and 16-Bit Floating-Point Numbers; Vulkan, sections of the same names).
#include "shaders/fixed/bounds/span.h"

#include <stdint.h>
#include <string.h>

#include "shaders/fixed/fixed.h"

// A value this near to a code is that code, since the double's own errors are not the device's.
static const double near_code = 1e-6;

struct rg_span rg_round_unorm(struct rg_span a, int bits)
{
    const double most = (1 << bits) - 1;
    a = rg_span_scale(rg_span_clamp(a, 0, 1), most);
    return (struct rg_span){floor(a.low + near_code) / most, ceil(a.high - near_code) / most};
}

// The exponent of a value's lowest bit. A double's own exponent lies in its bits 52 to 62.
static int step_of(double value, int mantissa_bits, int least_exponent)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof(bits));
    const int exponent = (int)(bits >> 52 & 2047) - 1023;
    return (exponent < least_exponent ? least_exponent : exponent) - mantissa_bits;
}

static double two_to(int exponent)
{
    const uint64_t bits = (uint64_t)(exponent + 1023) << 52;
    double value;
    memcpy(&value, &bits, sizeof(value));
    return value;
}

struct rg_span rg_round_float(struct rg_span a, int mantissa_bits, int least_exponent)
{
    const int low = step_of(a.low, mantissa_bits, least_exponent);
    const int high = step_of(a.high, mantissa_bits, least_exponent);
    return (struct rg_span){isfinite(a.low) ? floor(a.low * two_to(-low)) * two_to(low) : a.low,
                            isfinite(a.high) ? ceil(a.high * two_to(-high)) * two_to(high)
                                             : a.high};
}

// 11 and 10 bits: a device rounds to the nearest or towards zero (OpenGL, Unsigned 11-Bit
// Floating-Point Numbers).
struct rg_span rg_round_small_float(struct rg_span a, int mantissa_bits)
{
    const int high = step_of(a.high, mantissa_bits, -14);
    const struct rg_span rounded = rg_round_float(a, mantissa_bits, -14);
    return (struct rg_span){
        rounded.low, isfinite(a.high) ? rint(a.high * two_to(-high)) * two_to(high) : a.high};
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
