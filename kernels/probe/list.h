// The operations that the floating-point probe tries, one row each, for host and kernels alike.
//
//   X(number, name, inputs, result, expression)
//
// `expression` is over the floats a, b, c and their bits ua, ub, uc; `result` is its type, FLOAT or
// UINT; `inputs` names the set from which a, b and c are drawn (core/device/probe.c). Numbers count
// from 0 in each list. No operation of the first list may result in a subnormal number, an infinity
// or a NaN. Operations called _far leave the domain of their function.
#ifndef RG_KERNELS_PROBE_LIST_H
#define RG_KERNELS_PROBE_LIST_H

// The operations that the dialect allows, and functions that math.h, rng.h and image/format.h build
// from them: exact everywhere.
#define RG_PROBE_OPS(X)                                                                            \
    X(0, add, WIDE, FLOAT, a + b)                                                                  \
    X(1, subtract, WIDE, FLOAT, a - b)                                                             \
    X(2, multiply, WIDE, FLOAT, a *b)                                                              \
    X(3, divide, WIDE, FLOAT, a / b)                                                               \
    X(4, negate, WIDE, FLOAT, -a)                                                                  \
    X(5, abs, WIDE, FLOAT, rg_abs(a))                                                              \
    X(6, sqrt, POSITIVE, FLOAT, rg_sqrt(a))                                                        \
    X(7, one_over_sqrt, POSITIVE, FLOAT, 1.0f / rg_sqrt(a))                                        \
    X(8, floor, ANGLE, FLOAT, rg_floor(a))                                                         \
    X(9, multiply_add, WIDE, FLOAT, probe_multiply_add(a, b, c))                                   \
    X(10, modulo, MODULO, FLOAT, probe_modulo(a, b))                                               \
    X(11, lerp, SMALL, FLOAT, probe_lerp(a, b, c))                                                 \
    X(12, sum_of_squares, SMALL, FLOAT, probe_sum_of_squares(a, b, c))                             \
    X(13, less, WIDE, UINT, a < b ? 1u : 0u)                                                       \
    X(14, int_to_float, WORDS, FLOAT, rg_to_float(rg_to_int(ua >> 1) - 1073741824))                \
    X(15, uint_to_float, WORDS, FLOAT, rg_to_float(ua))                                            \
    X(16, float_to_int, ANGLE, UINT, rg_to_uint(rg_to_int(a * 1000.0f)))                           \
    X(17, bits_of_float, WIDE, UINT, rg_float_bits(a))                                             \
    X(18, float_of_bits, WIDE, FLOAT, rg_bits_float(ua ^ 0x80000001u))                             \
    X(19, shift_left, WORDS, UINT, ua << (ub & 31u))                                               \
    X(20, shift_right, WORDS, UINT, ua >> (ub & 31u))                                              \
    X(21, multiply_low, WORDS, UINT, ua *ub)                                                       \
    X(22, multiply_high, WORDS, UINT, rg_mul_hi(ua, ub))                                           \
    X(23, divide_uint, WORDS, UINT, ua / ((ub >> 9) + 1u))                                         \
    X(24, modulo_uint, WORDS, UINT, ua % ((ub >> 9) + 1u))                                         \
    X(25, min, WIDE, FLOAT, rg_min(a, b))                                                          \
    X(26, max, WIDE, FLOAT, rg_max(a, b))                                                          \
    X(27, clamp, WIDE, FLOAT, rg_clamp(a, -1.0f, 1.0f))                                            \
    X(28, philox, WORDS, UINT, probe_philox(ua, ub, uc))                                           \
    X(29, uniform, WORDS, FLOAT, rg_uniform(ua))                                                   \
    X(30, rg_sin, ANGLE, FLOAT, rg_sin(a))                                                         \
    X(31, rg_cos, ANGLE, FLOAT, rg_cos(a))                                                         \
    X(32, rg_exp, EXPONENT, FLOAT, rg_exp(a))                                                      \
    X(33, rg_exp2, EXPONENT, FLOAT, rg_exp2(a))                                                    \
    X(34, rg_log, POSITIVE, FLOAT, rg_log(a))                                                      \
    X(35, rg_log2, POSITIVE, FLOAT, rg_log2(a))                                                    \
    X(36, rg_pow, POWER, FLOAT, rg_pow(a, b))                                                      \
    X(37, rg_hypot, WIDE, FLOAT, rg_hypot(a, b))                                                   \
    X(38, rg_rsqrt, POSITIVE, FLOAT, rg_rsqrt(a))                                                  \
    X(39, pack_half, WIDE, UINT, rg_pack_half(rg_rounded_half(a)))                                 \
    X(40, unpack_half, WORDS, FLOAT, rg_unpack_half(ua % 0x7c00u + ((ub & 1u) << 15)))             \
    X(41, unpack_float11, WORDS, FLOAT, rg_unpack_float11(ua % 0x7c0u))                            \
    X(42, unpack_float10, WORDS, FLOAT, rg_unpack_float10(ua % 0x3e0u))                            \
    X(43, unorm8, SMALL, UINT, rg_unorm8(a))                                                       \
    X(44, rounded_unorm8, SMALL, FLOAT, rg_rounded_unorm8(a))                                      \
    X(45, rg_sin_far, WIDE, FLOAT, rg_sin(a))                                                      \
    X(46, rg_exp_far, WIDE, FLOAT, rg_exp(a))                                                      \
    X(47, rg_exp2_far, WIDE, FLOAT, rg_exp2(a))                                                    \
    X(48, rg_pow_far, WIDE, FLOAT, rg_pow(rg_abs(a), b))                                           \
    X(49, minus_product, WIDE, FLOAT, c - a * b)                                                   \
    X(50, member_multiply_add, WIDE, FLOAT, probe_member_multiply_add(rg_rgba(a, b, c, 1.0f)))     \
    X(51, rg_atan2, SMALL, FLOAT, rg_atan2(a, b))                                                  \
    X(52, rg_atan2_far, WIDE, FLOAT, rg_atan2(a, b))                                               \
    X(53, rg_asin, SMALL, FLOAT, rg_asin(a))                                                       \
    X(54, rg_acos, SMALL, FLOAT, rg_acos(a))

// The functions that the dialect forbids, because each language's own differ from driver to driver.
#define RG_PROBE_BUILTINS(X)                                                                       \
    X(0, fma, WIDE, FLOAT, probe_fma(a, b, c))                                                     \
    X(1, mix, SMALL, FLOAT, probe_mix(a, b, c))                                                    \
    X(2, dot, SMALL, FLOAT, probe_dot(a, b, c))                                                    \
    X(3, length, SMALL, FLOAT, probe_length(a, b, c))                                              \
    X(4, normalize, SMALL, FLOAT, probe_normalize(a, b, c))                                        \
    X(5, smoothstep, SMALL, FLOAT, probe_smoothstep(a))                                            \
    X(6, sin, ANGLE, FLOAT, probe_sin(a))                                                          \
    X(7, cos, ANGLE, FLOAT, probe_cos(a))                                                          \
    X(8, exp, EXPONENT, FLOAT, probe_exp(a))                                                       \
    X(9, exp2, EXPONENT, FLOAT, probe_exp2(a))                                                     \
    X(10, log2, POSITIVE, FLOAT, probe_log2(a))                                                    \
    X(11, pow, POWER, FLOAT, probe_pow(a, b))                                                      \
    X(12, inversesqrt, POSITIVE, FLOAT, probe_inversesqrt(a))                                      \
    X(13, round, ANGLE, FLOAT, probe_round(a))                                                     \
    X(14, native_min, WIDE, FLOAT, probe_min(a, b))                                                \
    X(15, native_max, WIDE, FLOAT, probe_max(a, b))

#endif
