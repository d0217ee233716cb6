// Vectors of three floats, against cases worked out by hand.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdbool.h>
#include <stdio.h>

#include "kernels/dialect/vec.h"
#include "tests/tools/expect.h"

static void expect_vector(v3 found, double x, double y, double z)
{
    const double off = fmax(fmax(fabs(found.x - x), fabs(found.y - y)), fabs(found.z - z));
    assert_at_most(off, 1e-6);
}

// Shorter and longer than 1.
static void vectors_of_any_length_become_unit(void **state)
{
    (void)state;
    for (double length = 1e-12; length < 1e12; length *= 7)
        expect_vector(v3_unit(v3_make((float)(0.48 * length), (float)(-0.6 * length),
                                      (float)(0.64 * length))),
                      0.48, -0.6, 0.64);
}

static void products_are_those_of_the_axes(void **state)
{
    (void)state;
    const v3 x = v3_make(1, 0, 0), y = v3_make(0, 1, 0), z = v3_make(0, 0, 1);
    expect_vector(v3_cross(x, y), 0, 0, 1);
    expect_vector(v3_cross(y, z), 1, 0, 0);
    expect_vector(v3_cross(z, x), 0, 1, 0);
    expect_vector(v3_cross(v3_make(2, 3, 4), v3_make(5, 6, 7)), -3, 6, -3);
    assert_equals(v3_dot(v3_make(2, 3, 4), v3_make(5, 6, 7)), 56);
}

// From a floor, and from a mirror that stands at 45 degrees.
static void rays_are_reflected(void **state)
{
    (void)state;
    expect_vector(v3_reflect(v3_make(3, -2, 1), v3_make(0, 1, 0)), 3, 2, 1);
    expect_vector(v3_reflect(v3_make(1, 0, 0), v3_unit(v3_make(-1, 1, 0))), 0, 1, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(vectors_of_any_length_become_unit),
        cmocka_unit_test(products_are_those_of_the_axes),
        cmocka_unit_test(rays_are_reflected),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
