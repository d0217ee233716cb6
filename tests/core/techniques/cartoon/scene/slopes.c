// How fast the depth of a face changes (kernels/cartoon/scene/ink.h), against the depths of its
// plane around a pixel in double precision, for faces that fall away to all sides.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "backends/cpu/kernels/notes.h"
#include "kernels/cartoon/scene/ink.h"
#include "tests/tools/expect.h"

// 1 / the distance ahead at which a ray meets the plane through (0, 0, 5) with this normal. The ray
// goes x to the right and y down for 1 ahead.
static double near_at(double x, double y, const double normal[3])
{
    return (normal[0] * x + normal[1] * y + normal[2]) / (normal[2] * 5);
}

static void slopes_are_those_of_the_plane(void **state)
{
    (void)state;
    const double px = 0.01, fall = 0.3;
    const cartoon_ink_params p = {
        .right_x = (float)px, .down_y = (float)px, .depth_fall = (float)fall};
    for (int right = -1; right <= 1; right++)
        for (int down = -1; down <= 1; down++)
            for (int toward = -1; toward <= 1; toward += 2) {
                const double normal[3] = {0.6 * right, 0.35 * down, 0.5 * toward};
                const v3 n = v3_make((float)normal[0], (float)normal[1], (float)normal[2]);
                double most = 0; // change to a corner of three quarters of a pixel each way
                for (int corner = 0; corner < 4; corner++) {
                    const double x = corner & 1 ? 0.75 * px : -0.75 * px;
                    const double y = corner & 2 ? 0.75 * px : -0.75 * px;
                    most = fmax(most, fall * fabs(near_at(x, y, normal) - near_at(0, 0, normal)));
                }
                const double slope = (double)cartoon_slope(p, n, v3_make(0, 0, 5));
                assert_at_most(fabs(slope - most), 1e-6 * most);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(slopes_are_those_of_the_plane)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
