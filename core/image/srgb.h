// The sRGB transfer curve (IEC 61966-2-1), exactly: tables made from the double-precision formula.
#ifndef RG_CORE_IMAGE_SRGB_H
#define RG_CORE_IMAGE_SRGB_H

#include <stdint.h>
#include <string.h>

// Encoding finds a code by the upper bits of the float, 128 steps in each octave from 2^-13 to 1. A
// step is narrower than a code, so that one comparison with the next code's threshold makes it
// exact.
enum { RG_SRGB_STEPS = 13 * 128, RG_SRGB_LOWEST_BITS = 114 << 23 };

struct rg_srgb {
    float linear[256];    // linear value of each code
    float encoded[256];   // encoded value of that linear value, by the curve
    float threshold[257]; // the smallest linear value that rounds to this code or above
    uint8_t code[2048];   // the code at the start of each step; the rest is unused
};

// The tables; the first call, from any thread, makes them.
const struct rg_srgb *rg_srgb(void);

// A table of the linear light of each of `codes` codes, which the caller frees. `gamma` is the
// power of their curve; 0: sRGB's curve. NULL when memory runs out.
float *rg_light_of_codes(int codes, double gamma);

// The curve itself, for one value in 0..1.
double rg_srgb_decode(double encoded);
double rg_srgb_encode(double linear);

// The 8-bit code of a linear value: the encoded value times 255, rounded half up. Values outside
// 0..1 are clamped; NaN gives 0.
static inline uint8_t rg_srgb_code(const struct rg_srgb *srgb, float linear)
{
    if (!(linear >= srgb->threshold[1]))
        return 0;
    if (linear >= srgb->threshold[255])
        return 255;
    uint32_t bits;
    memcpy(&bits, &linear, sizeof(bits));
    uint8_t code = srgb->code[(bits - RG_SRGB_LOWEST_BITS) >> 16 & 2047];
    return (uint8_t)(code + (linear >= srgb->threshold[code + 1]));
}

// rg_srgb_encode for a linear value as a float; values decoded from 8 bits are looked up instead of
// computed.
static inline float rg_srgb_encoded(const struct rg_srgb *srgb, float linear)
{
    const uint8_t code = rg_srgb_code(srgb, linear);
    return srgb->linear[code] == linear ? srgb->encoded[code]
                                        : (float)rg_srgb_encode((double)linear);
}

// The 8-bit code of alpha, which has no curve.
static inline uint8_t rg_alpha_code(float alpha)
{
    return alpha >= 1.0f ? 255 : alpha > 0.0f ? (uint8_t)(alpha * 255.0f + 0.5f) : 0;
}

#endif
