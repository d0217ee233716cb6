// Convex hulls of random points, against the definition: corners are points, turn left, and have no
// point outside.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "core/scene/mesh/hull.h"
#include "tests/oracle/streaks/packets.h"
#include "tests/tools/expect.h"

static double turn(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static void test_hulls_hold_all_points(void **state)
{
    (void)state;
    enum { MOST = 40 };
    uint64_t random = 3;
    for (int round = 0; round < 2000; round++) {
        const int count = 3 + round % (MOST - 2);
        double points[MOST][2], hull[2 * MOST][2];
        for (int i = 0; i < count; i++) // whole numbers, so that many lie on lines
            for (int k = 0; k < 2; k++)
                points[i][k] = (double)(oracle_random(&random) % 7);
        points[0][0] = 9; // the first three are no line
        points[1][1] = -3;
        points[2][0] = -4;
        const int corners = rg_hull(points, count, hull);
        assert_at_least(corners, 3);
        for (int i = 0; i < corners; i++) {
            const double *a = hull[i], *b = hull[(i + 1) % corners];
            assert_above(turn(a, b, hull[(i + 2) % corners]), 0);
            int found = 0;
            for (int k = 0; k < count; k++) {
                assert_at_least(turn(a, b, points[k]), 0);
                found += !memcmp(points[k], a, sizeof(points[k]));
            }
            assert_above(found, 0);
        }
    }
}

// Points in one place, and on a line.
static void test_hulls_may_be_flat(void **state)
{
    (void)state;
    double one[1][2] = {{5, 6}}, line[3][2] = {{3, 3}, {1, 1}, {2, 2}}, hull[6][2];
    assert_int_equal(rg_hull(one, 1, hull), 1);
    assert_equals(hull[0][1], 6);
    assert_int_equal(rg_hull(line, 3, hull), 2);
    assert_equals(hull[0][0], 1);
    assert_equals(hull[1][0], 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hulls_hold_all_points),
        cmocka_unit_test(test_hulls_may_be_flat),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
