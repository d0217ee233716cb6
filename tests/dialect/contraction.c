// A compiler that fuses a product and a sum rounds once where C says twice. It may do so, unless it
// is told not to, where the processor has an instruction for both: -ffp-contract=off must reach
// this file as it must reach all others. On x86-64 these functions alone are compiled for
// processors with that instruction; on others the test proves nothing.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#ifdef __x86_64__
#define MAY_FUSE __attribute__((target("fma")))
#else
#define MAY_FUSE
#endif

// The square of 1 + 2^-12 is 1 + 2^-11 + 2^-24, whose last part no float has.
MAY_FUSE static void nothing_is_fused_in_floats(void **state)
{
    (void)state;
    volatile float one_more = 1 + 0x1p-12f, rounded = 1 + 0x1p-11f;
    const float a = one_more, b = rounded;
    assert_true(a * a - b == 0);
}

MAY_FUSE static void nothing_is_fused_in_doubles(void **state)
{
    (void)state;
    volatile double one_more = 1 + 0x1p-27, rounded = 1 + 0x1p-26;
    const double a = one_more, b = rounded;
    assert_true(a * a - b == 0);
}

int main(void)
{
#ifdef __x86_64__
    enum { UNSUPPORTED = 77 };
    if (!__builtin_cpu_supports("fma"))
        return UNSUPPORTED;
#endif
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_is_fused_in_floats),
        cmocka_unit_test(nothing_is_fused_in_doubles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
