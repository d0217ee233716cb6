// Random numbers without state: Philox4x32-10 (Salmon et al., 2011), integers alone.
//
// A number is a function of who asks: the item (a drop), the step (a frame), the stream (what the
// number is for) and the seed. So every device draws the same ones in any order, and an item's
// numbers do not change when others come or go.
#ifndef RG_KERNELS_DIALECT_RNG_H
#define RG_KERNELS_DIALECT_RNG_H

#include "kernels/dialect/lang.h"

RG_STRUCT(rg_uint4)
{
    uint x;
    uint y;
    uint z;
    uint w;
};
RG_STRUCT_SIZE(rg_uint4, 4)

RG_FN rg_uint4 rg_philox_round(rg_uint4 c, uint key_0, uint key_1)
{
    rg_uint4 r;
    r.x = rg_mul_hi(0xcd9e8d57u, c.z) ^ c.y ^ key_0;
    r.y = 0xcd9e8d57u * c.z;
    r.z = rg_mul_hi(0xd2511f53u, c.x) ^ c.w ^ key_1;
    r.w = 0xd2511f53u * c.x;
    return r;
}

// Philox4x32-10 of a counter under a key of two words, as in Random123.
RG_FN rg_uint4 rg_philox(rg_uint4 counter, uint key_0, uint key_1)
{
    rg_uint4 c = counter;
    uint k0 = key_0;
    uint k1 = key_1;
    for (int i = 0; i < 10; i++) {
        c = rg_philox_round(c, k0, k1);
        k0 += 0x9e3779b9u;
        k1 += 0xbb67ae85u;
    }
    return c;
}

// Four independent numbers of 32 bits: counter (item, step, stream, 0), key (seed, 0).
RG_FN rg_uint4 rg_random(uint seed, uint item, uint step, uint stream)
{
    rg_uint4 counter;
    counter.x = item;
    counter.y = step;
    counter.z = stream;
    counter.w = 0u;
    return rg_philox(counter, seed, 0u);
}

// A multiple of 2^-24 in [0, 1), from the upper 24 bits.
RG_FN float rg_uniform(uint bits)
{
    return rg_to_float(bits >> 8) * 5.9604644775390625e-8f;
}

#endif
