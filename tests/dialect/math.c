// Measures in double precision the error bounds that kernels/dialect/math.h states, and checks its
// edges.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdbool.h>
#include <stdio.h>

#include "kernels/dialect/math.h"
#include "tests/tools/expect.h"

// Every 1,009th float of every exponent, about two million of each sign.
enum { STRIDE = 1009, PAIRS = 2000000 };

struct worst {
    double error;
    float x, y;
};

static void keep_worst(struct worst *worst, double error, float x, float y)
{
    if (!(error <= worst->error))
        *worst = (struct worst){error, x, y};
}

// Errors in ulp, the distance of neighbouring floats at the true value; that distance is at least
// that of normal floats.
static double ulps(float got, double truth)
{
    int exponent;
    frexp(fabs(truth), &exponent);
    return fabs(got - truth) / ldexp(1.0, (exponent < -125 ? -125 : exponent) - 24);
}

static uint32_t random_bits(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(*state >> 32);
}

static float random_within(uint64_t *state, float low, float high)
{
    return low + (high - low) * ((float)(random_bits(state) >> 8) * 0x1p-24f);
}

static float call_rsqrt(float x)
{
    return rg_rsqrt(x);
}

static float call_exp2(float x)
{
    return rg_exp2(x);
}

static float call_exp(float x)
{
    return rg_exp(x);
}

static float call_log2(float x)
{
    return rg_log2(x);
}

static float call_log(float x)
{
    return rg_log(x);
}

static double true_rsqrt(double x)
{
    return 1.0 / sqrt(x);
}

static void bounds_in_ulp_hold(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        float (*ours)(float);
        double (*truth)(double);
        float low, high; // the domain
        double bound_ulp;
    } cases[] = {
        {"rg_rsqrt", call_rsqrt, true_rsqrt, FLT_MIN, FLT_MAX, 1.5},
        {"rg_exp2", call_exp2, exp2, -126.0f, 127.99999f, 1.2},
        {"rg_exp", call_exp, exp, -87.33654f, 88.72283f, 1.0},
        {"rg_log2", call_log2, log2, FLT_MIN, FLT_MAX, 1.0},
        {"rg_log", call_log, log, FLT_MIN, FLT_MAX, 1.0},
    };
    for (size_t c = 0; c < sizeof(cases) / sizeof(cases[0]); c++) {
        struct worst worst = {0};
        for (uint32_t bits = 0; bits < 0xff000000u; bits += STRIDE) {
            float x = rg_bits_float(bits);
            if (x >= cases[c].low && x <= cases[c].high)
                keep_worst(&worst, ulps(cases[c].ours(x), cases[c].truth((double)x)), x, 0.0f);
        }
        print_message("%s: %.3f ulp at %a\n", cases[c].name, worst.error, (double)worst.x);
        assert_above(worst.error, 0.0);
        assert_at_most(worst.error, cases[c].bound_ulp);
    }
}

// A logarithm's relative error is hardest to bound near 0: tries every float close to 1.
static void logarithms_hold_near_one(void **state)
{
    (void)state;
    struct worst worst = {0};
    for (uint32_t bits = 0x3f7f0000u; bits < 0x3f810000u; bits++) {
        float x = rg_bits_float(bits);
        keep_worst(&worst, ulps(rg_log2(x), log2((double)x)), x, 0.0f);
        keep_worst(&worst, ulps(rg_log(x), log((double)x)), x, 0.0f);
    }
    assert_at_most(worst.error, 1.0);
}

static void sine_and_cosine_hold(void **state)
{
    (void)state;
    const double bound = 1.0e-7;
    struct worst worst = {0};
    uint64_t seed = 1;
    for (uint32_t bits = 0; bits <= 0x46000000u; bits += 499) {
        float x = rg_bits_float(bits), spread = random_within(&seed, -8192.0f, 8192.0f);
        keep_worst(&worst, fabs(rg_sin(x) - sin((double)x)), x, 0.0f);
        keep_worst(&worst, fabs(rg_cos(-x) - cos((double)x)), x, 0.0f);
        keep_worst(&worst, fabs(rg_sin(spread) - sin((double)spread)), spread, 0.0f);
        keep_worst(&worst, fabs(rg_cos(spread) - cos((double)spread)), spread, 0.0f);
    }
    print_message("rg_sin, rg_cos: %.3g at %a\n", worst.error, (double)worst.x);
    assert_above(worst.error, 0.0);
    assert_at_most(worst.error, bound);
}

static void keep_worst_angle(struct worst *worst, float y, float x)
{
    const double truth = atan2((double)y, (double)x);
    if (fabs(truth) >= (double)FLT_MIN * 1.00001 && fmaxf(fabsf(x), fabsf(y)) >= 1e-30f)
        keep_worst(worst, ulps(rg_atan2(y, x), truth), y, x);
}

static void angles_hold(void **state)
{
    (void)state;
    struct worst any = {0}, slopes = {0}, arcs = {0};
    uint64_t seed = 6;
    for (int i = 0; i < PAIRS; i++) {
        const float x = random_within(&seed, -1.0f, 1.0f), y = random_within(&seed, -1.0f, 1.0f);
        const int power = (int)(random_bits(&seed) % 240u) - 120;
        keep_worst_angle(&any, ldexpf(y, power), ldexpf(x, power));
        keep_worst_angle(&any, ldexpf(y, power), x);
        keep_worst_angle(&any, y, ldexpf(x, power));
    }
    for (uint32_t bits = 0x00800000u; bits < 0x7f000000u; bits += STRIDE) {
        keep_worst_angle(&slopes, rg_bits_float(bits), 1.0f);
        keep_worst_angle(&slopes, -rg_bits_float(bits), -1.0f);
    }
    for (uint32_t bits = 0x00800000u; bits <= 0x3f800000u; bits += STRIDE / 10) {
        const float x = rg_bits_float(bits);
        keep_worst(&arcs, ulps(rg_asin(x), asin((double)x)), x, 0.0f);
        keep_worst(&arcs, ulps(rg_acos(x), acos((double)x)), x, 0.0f);
        keep_worst(&arcs, ulps(rg_acos(-x), acos(-(double)x)), -x, 0.0f);
    }
    print_message(
        "rg_atan2: %.3f ulp at %a, %a; %.3f ulp at %a, %a; rg_asin, rg_acos: %.3f at %a\n",
        any.error, (double)any.x, (double)any.y, slopes.error, (double)slopes.x, (double)slopes.y,
        arcs.error, (double)arcs.x);
    assert_above(any.error, 0.0);
    assert_at_most(any.error, 3.0);
    assert_at_most(slopes.error, 3.0);
    assert_above(arcs.error, 0.0);
    assert_at_most(arcs.error, 3.5);
}

static void check_pow(struct worst *worst, float x, float y)
{
    double truth = pow((double)x, (double)y);
    if (truth >= (double)FLT_MIN * 1.00001 && truth <= (double)FLT_MAX * 0.99999)
        keep_worst(worst, ulps(rg_pow(x, y), truth), x, y);
}

static void power_holds(void **state)
{
    (void)state;
    struct worst worst = {0};
    uint64_t seed = 2;
    for (int i = 0; i < PAIRS; i++) {
        float any = rg_bits_float(0x00800000u + random_bits(&seed) % 0x7f000000u);
        check_pow(&worst, any, random_within(&seed, -1.0f, 1.0f) * 128.0f / log2f(any));
        float near_one = random_within(&seed, 0.7f, 1.42f);
        check_pow(&worst, near_one, random_within(&seed, 120.0f, 128.0f) / log2f(near_one));
        check_pow(&worst, random_within(&seed, 0.0f, 1.0f), random_within(&seed, 0.0f, 100.0f));
    }
    print_message("rg_pow: %.3f ulp at %a, %a\n", worst.error, (double)worst.x, (double)worst.y);
    assert_above(worst.error, 0.0);
    assert_at_most(worst.error, 8.0);
}

static void whole_power_holds(void **state)
{
    (void)state;
    struct worst worst = {0};
    uint64_t seed = 5;
    for (int i = 0; i < PAIRS; i++) {
        const float x = random_within(&seed, 0.01f, 4.0f);
        const int power = (int)(random_bits(&seed) % 16u);
        keep_worst(&worst, ulps(rg_pow_whole(x, power), pow((double)x, power)), x, (float)power);
    }
    print_message("rg_pow_whole: %.3f ulp at %a, %a\n", worst.error, (double)worst.x,
                  (double)worst.y);
    assert_above(worst.error, 0.0);
    assert_at_most(worst.error, 14.0);
    assert_equals(rg_pow_whole(0.0f, 0), 1.0f);
    assert_equals(rg_pow_whole(3.0f, 5), 243.0f);
}

static void cube_root_holds(void **state)
{
    (void)state;
    struct worst worst = {0};
    uint64_t seed = 7;
    for (int i = 0; i < PAIRS; i++) {
        const float x = rg_bits_float(0x00800000u + random_bits(&seed) % 0x7f000000u);
        keep_worst(&worst, ulps(rg_cbrt(x), cbrt((double)x)), x, 0.0f);
    }
    print_message("rg_cbrt: %.3f ulp at %a\n", worst.error, (double)worst.x);
    assert_above(worst.error, 0.0);
    assert_at_most(worst.error, 1.0);
    assert_equals(rg_cbrt(0.0f), 0.0f);
    assert_equals(rg_cbrt(27.0f), 3.0f);
    assert_equals(rg_cbrt(1e-40f), 0.0f);
}

static void hypot_holds(void **state)
{
    (void)state;
    struct worst worst = {0};
    uint64_t seed = 3;
    for (int i = 0; i < PAIRS; i++) {
        float x = ldexpf(random_within(&seed, 1.0f, 2.0f), (int)(random_bits(&seed) % 115u) - 52);
        float y = x * random_within(&seed, -1.0f, 1.0f);
        keep_worst(&worst, ulps(rg_hypot(y, x), sqrt((double)x * x + (double)y * y)), x, y);
    }
    print_message("rg_hypot: %.3f ulp at %a, %a\n", worst.error, (double)worst.x, (double)worst.y);
    assert_above(worst.error, 0.0);
    assert_at_most(worst.error, 1.3);
    assert_equals(rg_hypot(0.0f, 0.0f), 0.0f);
}

static void exact_where_the_answer_is(void **state)
{
    (void)state;
    for (int n = -126; n <= 127; n++) {
        assert_equals(rg_exp2((float)n), ldexpf(1.0f, n));
        assert_equals(rg_log2(ldexpf(1.0f, n)), (float)n);
        assert_equals(rg_pow(2.0f, (float)n), ldexpf(1.0f, n));
    }
    assert_equals(rg_exp(0.0f), 1.0f);
    assert_equals(rg_log(1.0f), 0.0f);
    assert_equals(rg_sin(0.0f), 0.0f);
    assert_equals(rg_cos(0.0f), 1.0f);
    assert_equals(rg_rsqrt(4.0f), 0.5f);
}

static void edges_are_as_documented(void **state)
{
    (void)state;
    assert_equals(rg_atan2(0.0f, 0.0f), 0.0f);
    assert_equals(rg_atan2(-0.0f, -0.0f), 0.0f);
    assert_equals(rg_atan2(0.0f, -2.0f), RG_PI);
    assert_equals(rg_atan2(-0.0f, -2.0f), RG_PI);
    assert_equals(rg_atan2(0.0f, 2.0f), 0.0f);
    assert_equals(rg_atan2(1e-38f, 1e20f), 0.0f);
    assert_equals(rg_atan2(3.0f, 0.0f), RG_PI / 2);
    assert_equals(rg_atan2(-3.0f, 0.0f), -RG_PI / 2);
    assert_equals(rg_atan2(5.0f, 5.0f), RG_PI / 4);
    assert_equals(rg_atan2(1.7e38f, 1.7e38f), RG_PI / 4);
    assert_equals(rg_atan2(9e-31f, -9e-31f), 0.0f);
    assert_equals(rg_atan2(-1e-40f, 0.0f), 0.0f);
    assert_equals(rg_asin(2.0f), RG_PI / 2);
    assert_equals(rg_asin(-2.0f), -RG_PI / 2);
    assert_equals(rg_acos(2.0f), 0.0f);
    assert_equals(rg_acos(-2.0f), RG_PI);
    assert_equals(rg_acos(0.0f), RG_PI / 2);
    assert_equals(rg_exp2(-126.00001f), 0.0f);
    assert_equals(rg_exp2(-1e30f), 0.0f);
    assert_equals(rg_exp2(128.0f), FLT_MAX);
    assert_equals(rg_exp2(1e30f), FLT_MAX);
    assert_equals(rg_exp(-87.4f), 0.0f);
    assert_equals(rg_exp(-1e30f), 0.0f);
    assert_equals(rg_exp(88.8f), FLT_MAX);
    assert_equals(rg_exp(1e30f), FLT_MAX);
    assert_equals(rg_log2(0.0f), -126.0f);
    assert_equals(rg_log2(-1.0f), -126.0f);
    assert_equals(rg_log2(1e-40f), -126.0f);
    assert_equals(rg_sin(1e30f), rg_sin(8192.0f));
    assert_equals(rg_cos(-1e30f), rg_cos(-8192.0f));
    assert_equals(rg_pow(0.0f, 2.0f), 0.0f);
    assert_equals(rg_pow(0.0f, 0.0f), 1.0f);
    assert_equals(rg_pow(1e-40f, 0.5f), 0.0f);
    assert_equals(rg_pow(7.0f, 0.0f), 1.0f);
    assert_equals(rg_pow(2.0f, 1e30f), FLT_MAX);
    assert_equals(rg_pow(2.0f, -1e30f), 0.0f);
    assert_equals(rg_pow(0.5f, 1e30f), 0.0f);
    assert_equals(rg_pow(0.5f, -1e30f), FLT_MAX);
    assert_equals(rg_pow(1.0f, 1e30f), 1.0f);
}

static bool normal_or_zero(float v)
{
    return v == 0.0f || (fabsf(v) >= FLT_MIN && fabsf(v) <= FLT_MAX);
}

static void results_are_normal_or_zero(void **state)
{
    (void)state;
    for (uint32_t bits = 0; bits < 0xff800000u; bits += 100 * STRIDE + 1) {
        if ((bits & 0x7f800000u) == 0x7f800000u)
            continue;
        float x = rg_bits_float(bits);
        assert_true(normal_or_zero(rg_exp2(x)) && normal_or_zero(rg_exp(x)));
        assert_true(normal_or_zero(rg_atan2(x, 1e30f)) && normal_or_zero(rg_atan2(1e-30f, x)));
        assert_true(normal_or_zero(rg_asin(x)) && normal_or_zero(rg_acos(x)));
        assert_true(normal_or_zero(rg_log2(x)) && normal_or_zero(rg_log(x)));
        assert_true(normal_or_zero(rg_pow(fabsf(x), 0.7f)) && normal_or_zero(rg_pow(0.7f, x)));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_in_ulp_hold),
        cmocka_unit_test(logarithms_hold_near_one),
        cmocka_unit_test(sine_and_cosine_hold),
        cmocka_unit_test(angles_hold),
        cmocka_unit_test(power_holds),
        cmocka_unit_test(whole_power_holds),
        cmocka_unit_test(cube_root_holds),
        cmocka_unit_test(hypot_holds),
        cmocka_unit_test(exact_where_the_answer_is),
        cmocka_unit_test(edges_are_as_documented),
        cmocka_unit_test(results_are_normal_or_zero),
    };
    return cmocka_run_group_tests_name("math", tests, NULL, NULL);
}
