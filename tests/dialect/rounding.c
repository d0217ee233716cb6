// Quotients and roots equal C's for any driver within its limits of error.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "kernels/dialect/lang.h"

static int planted_ulps; // the driver's error

static float off(float exact)
{
    return rg_bits_float(rg_float_bits(exact) + (uint)planted_ulps);
}

#define RG_ROUGH_QUOTIENT(a, b) off((a) / (b))
#define RG_ROUGH_ROOT(x)        off(sqrtf(x))
#include "kernels/dialect/rounding.h"
#include "tests/tools/expect.h"

static uint64_t seed;

static uint random_bits(void)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (uint)(seed >> 32);
}

struct operands {
    uint of, by;
};

// Any two floats. Three of eight pairs have significands next to each other or at an end of their
// range, where the quotient's exponent changes. One of eight has a dividend near the smallest.
static struct operands draw(int i)
{
    struct operands o = {random_bits(), random_bits()};
    switch (i % 8) {
    case 0:
        o.by = o.of + random_bits() % 64 - 32;
        break;
    case 1:
        o.by = (o.by & 0xff800000u) | (random_bits() % 64);
        break;
    case 2:
        o.of = (o.of & 0xff800000u) | (0x7fffffu - random_bits() % 64);
        break;
    case 3:
        o.of = (o.of & 0x80000000u) | 0x00800000u | (o.of & 0x01ffffffu); // near the smallest
        break;
    default:
        break;
    }
    return o;
}

static void check_quotients(int ulps)
{
    int normal = 0;
    seed = 0x7a1d;
    for (int i = 0; i < 400000; i++) {
        const struct operands o = draw(i);
        const float a = rg_bits_float(o.of), b = rg_bits_float(o.by), exact = a / b;
        planted_ulps = ulps;
        if (!isnormal(a) || !isnormal(b) || !isnormal(exact))
            continue;
        const float got = rg_rounded_quotient(a, b);
        if (rg_float_bits(got) != rg_float_bits(exact))
            fail_msg("%a / %a: %a, not %a, of a quotient %d ulp off", (double)a, (double)b,
                     (double)got, (double)exact, ulps);
        normal++;
    }
    assert_above(normal, 250000);
}

static void quotients_are_exact(void **state)
{
    (void)state;
    for (int ulps = -3; ulps <= 3; ulps++)
        check_quotients(ulps);
}

static void check_roots(int ulps)
{
    seed = 0x7a1e;
    planted_ulps = ulps;
    for (int i = 0; i < 400000; i++) {
        const uint exponent = 1 + random_bits() % 254;
        const uint part = i % 4 ? random_bits() & 0x7fffffu
                                : (i % 8 ? random_bits() % 64 : 0x7fffffu - random_bits() % 64);
        const float x = rg_bits_float((exponent << 23) | part), got = rg_rounded_root(x);
        if (rg_float_bits(got) != rg_float_bits(sqrtf(x)))
            fail_msg("root of %a: %a, not %a, of one %d ulp off", (double)x, (double)got,
                     (double)sqrtf(x), ulps);
    }
}

static void roots_are_exact(void **state)
{
    (void)state;
    for (int ulps = -5; ulps <= 5; ulps++)
        check_roots(ulps);
}

// Operands and results that are not normal are left to the driver; 0 keeps its sign.
static void the_rest_is_the_drivers(void **state)
{
    (void)state;
    planted_ulps = 0;
    const float most = (float)INFINITY;
    const float rest[][2] = {{0.0f, 3.0f},   {-0.0f, 3.0f},  {1.0f, 0.0f},
                             {1e38f, 1e-5f}, {1e-38f, 1e5f}, {1e-40f, 2.0f},
                             {2.0f, 1e-40f}, {3.0f, most},   {most, 3.0f}};
    for (size_t i = 0; i < sizeof(rest) / sizeof(rest[0]); i++)
        assert_int_equal(rg_float_bits(rg_rounded_quotient(rest[i][0], rest[i][1])),
                         rg_float_bits(rest[i][0] / rest[i][1]));
    assert_int_equal(rg_float_bits(rg_rounded_root(0.0f)), 0);
    assert_int_equal(rg_float_bits(rg_rounded_root(-0.0f)), 0x80000000u);
    assert_int_equal(rg_float_bits(rg_rounded_root(1e-40f)), rg_float_bits(sqrtf(1e-40f)));
    assert_int_equal(rg_float_bits(rg_rounded_root(most)), rg_float_bits(most));
    assert_true(isnan(rg_rounded_root(-1.0f)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quotients_are_exact),
        cmocka_unit_test(roots_are_exact),
        cmocka_unit_test(the_rest_is_the_drivers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
