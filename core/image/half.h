// 16-bit floats (halves), as in picture files.
#ifndef RG_CORE_IMAGE_HALF_H
#define RG_CORE_IMAGE_HALF_H

#include <stdint.h>
#include <string.h>

// Converts a half to a float, exactly for every half: zeros, subnormals, infinities and NaN too.
static inline float rg_float_of_half(uint16_t half)
{
    uint32_t magnitude = half & 0x7fffu, bits = magnitude << 13;
    float value;
    memcpy(&value, &bits, 4);
    value *= 0x1p112f;
    memcpy(&bits, &value, 4);
    bits |= (magnitude >= 0x7c00 ? 0x7f800000u : 0) | (uint32_t)(half & 0x8000) << 16;
    memcpy(&value, &bits, 4);
    return value;
}

#endif
