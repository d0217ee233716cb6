// Applies one operation of RG_PROBE_OPS to every item, to prove that devices agree on it.
#include "kernels/probe/slots.h"
#include "kernels/dialect/math.h"
#include "kernels/dialect/rng.h"

// Written so that a compiler which contracts would fuse it.
RG_FN float probe_multiply_add(float a, float b, float c)
{
    return a * b + c;
}

// The same over a struct's members.
RG_FN float probe_member_multiply_add(rgba v)
{
    return rg_rgba(v.r * v.g + v.b, v.g, v.b, v.a).r;
}

RG_FN float probe_modulo(float a, float b)
{
    return a - b * rg_floor(a / b);
}

RG_FN float probe_lerp(float a, float b, float t)
{
    return a * (1.0f - t) + b * t;
}

RG_FN float probe_sum_of_squares(float a, float b, float c)
{
    return a * a + b * b + c * c;
}

RG_FN uint probe_philox(uint ua, uint ub, uint uc)
{
    rg_uint4 r = rg_random(ua, ub, uc, 1u);
    return r.x ^ (r.y << 1) ^ (r.z << 2) ^ (r.w << 3);
}

RG_FN uint probe_apply(int op, float a, float b, float c, uint ua, uint ub, uint uc)
{
    uint bits = 0u;
    RG_PROBE_OPS(RG_PROBE_TRY)
    return bits;
}

RG_GRID_KERNEL(probe_ops)
{
    uint ua = first_at(rg, x);
    uint ub = second_at(rg, x);
    uint uc = third_at(rg, x);
    result_put(
        rg, x,
        probe_apply(p.op, rg_bits_float(ua), rg_bits_float(ub), rg_bits_float(uc), ua, ub, uc));
}
