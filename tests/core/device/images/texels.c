#include "tests/core/device/images/texels.h"

#include <math.h>
#include <string.h>

#include "tests/core/device/suite.h"

// A float with `mantissa` bits, five bits of exponent and perhaps a sign; never infinity or NaN.
static uint32_t random_small_float(uint32_t noise_bits, int mantissa, bool is_signed)
{
    const uint32_t magnitude = (noise_bits >> 8) % (31u << mantissa);
    return magnitude | (is_signed && magnitude > 0 ? (noise_bits & 1) << (mantissa + 5) : 0);
}

// A float from 0 to 1.
static uint32_t random_depth(uint32_t n)
{
    const float depth = (float)(n >> 8) / 16777215.0f;
    uint32_t word;
    memcpy(&word, &depth, 4);
    return word;
}

static uint32_t random_word(enum rg_format format, uint32_t n)
{
    switch (format) {
    case RG_RGBA16F:
        return random_small_float(n, 10, true) | random_small_float(noise(n), 10, true) << 16;
    case RG_RG11B10F:
        return random_small_float(n, 6, false) | random_small_float(noise(n), 6, false) << 11 |
               random_small_float(noise(~n), 5, false) << 22;
    case RG_RGBA32F:
    case RG_R32F:
        return (n & 0x807fffffu) | (1 + noise(n) % 254) << 23;
    case RG_D32F:
        return random_depth(n);
    default:
        return n;
    }
}

void random_texels(enum rg_format format, uint32_t seed, int count, void *texels)
{
    if (format == RG_R16F) {
        for (int i = 0; i < count; i++)
            ((uint16_t *)texels)[i] =
                (uint16_t)random_small_float(noise((uint32_t)i + seed), 10, true);
        return;
    }
    const int words = count * rg_format_size(format) / 4;
    for (int i = 0; i < words; i++)
        ((uint32_t *)texels)[i] = random_word(format, noise((uint32_t)i + seed));
}

static float decode_small_float(uint32_t bits, int mantissa)
{
    const int exponent = (int)(bits >> mantissa) & 31;
    const float fraction = (float)(bits & ((1u << mantissa) - 1));
    const float v = exponent == 0
                        ? ldexpf(fraction, -14 - mantissa)
                        : ldexpf(fraction + (float)(1 << mantissa), exponent - 15 - mantissa);
    return bits >> (mantissa + 5) & 1 ? -v : v;
}

struct colour decode_texel(enum rg_format format, const void *texel)
{
    struct colour c = {0.0f, 0.0f, 0.0f, 1.0f};
    const unsigned char *bytes = texel;
    uint16_t halves[4];
    uint32_t word = 0;
    memcpy(&word, texel, rg_format_size(format) < 4 ? 2 : 4);
    switch (format) {
    case RG_R16F:
        c.r = decode_small_float(word, 10);
        return c;
    case RG_RGBA8:
        return (struct colour){(float)bytes[0] / 255.0f, (float)bytes[1] / 255.0f,
                               (float)bytes[2] / 255.0f, (float)bytes[3] / 255.0f};
    case RG_RGBA16F:
        memcpy(halves, texel, 8);
        return (struct colour){decode_small_float(halves[0], 10), decode_small_float(halves[1], 10),
                               decode_small_float(halves[2], 10),
                               decode_small_float(halves[3], 10)};
    case RG_RG11B10F:
        return (struct colour){decode_small_float(word & 0x7ff, 6),
                               decode_small_float(word >> 11 & 0x7ff, 6),
                               decode_small_float(word >> 22, 5), 1.0f};
    case RG_RGBA32F:
        memcpy(&c, texel, 16);
        return c;
    default:
        memcpy(&c.r, texel, 4);
        return c;
    }
}

static unsigned char encode_unorm8(float v)
{
    const float inside = v < 0.0f ? 0.0f : (v > 1.0f ? 1.0f : v);
    return (unsigned char)floorf(inside * 255.0f + 0.5f);
}

// Rounds toward zero: too large numbers become the largest half, and too small ones zero.
static uint16_t encode_half(float v)
{
    const float magnitude = fabsf(v);
    const uint16_t sign = v < 0.0f ? 0x8000u : 0u;
    if (magnitude >= 65504.0f)
        return sign | 0x7bffu;
    if (magnitude < ldexpf(1.0f, -14))
        return 0;
    int exponent;
    const float fraction = frexpf(magnitude, &exponent); // 0.5 to 1
    const int mantissa = (int)truncf(ldexpf(fraction, 11)) - 1024;
    return (uint16_t)(sign | (exponent + 14) << 10 | mantissa);
}

void encode_texel(enum rg_format format, struct colour c, void *texel)
{
    if (format == RG_RGBA8) {
        const unsigned char bytes[4] = {encode_unorm8(c.r), encode_unorm8(c.g), encode_unorm8(c.b),
                                        encode_unorm8(c.a)};
        memcpy(texel, bytes, 4);
    } else if (format == RG_RGBA16F) {
        const uint16_t halves[4] = {encode_half(c.r), encode_half(c.g), encode_half(c.b),
                                    encode_half(c.a)};
        memcpy(texel, halves, 8);
    } else {
        memcpy(texel, &c, format == RG_RGBA32F ? 16 : 4);
    }
}
