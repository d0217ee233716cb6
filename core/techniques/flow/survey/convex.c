// The share of a shape's convex hull that the shape covers, in texels.
#include "core/techniques/flow/survey/convex.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

#include "core/scene/mesh/hull.h"

static int common_divisor(int a, int b)
{
    return b ? common_divisor(b, a % b) : a;
}

// Pick's theorem: places in the hull and on its rim.
static double places_in(double (*hull)[2], int corners)
{
    double area2 = 0, rim = 0;
    for (int i = 0; i < corners; i++) {
        const double *a = hull[i], *b = hull[(i + 1) % corners];
        area2 += a[0] * b[1] - a[1] * b[0];
        rim += common_divisor(abs((int)(b[0] - a[0])), abs((int)(b[1] - a[1])));
    }
    return fabs(area2) / 2 + rim / 2 + 1;
}

// Writes the first and the last texel of each row, and returns their number. The others lie
// between.
static int put_ends(const int *texels, int count, int row, double (*points)[2])
{
    int top = texels[0] / row, bottom = top;
    for (int i = 0; i < count; i++) {
        top = texels[i] / row < top ? texels[i] / row : top;
        bottom = texels[i] / row > bottom ? texels[i] / row : bottom;
    }
    const int rows = bottom - top + 1;
    for (int k = 0; k < 2 * rows; k++) {
        points[k][0] = top + k / 2;
        points[k][1] = k % 2 ? 0 : row;
    }
    for (int i = 0; i < count; i++) {
        double(*ends)[2] = points + 2 * (ptrdiff_t)(texels[i] / row - top);
        ends[0][1] = fmin(ends[0][1], texels[i] % row);
        ends[1][1] = fmax(ends[1][1], texels[i] % row);
    }
    return 2 * rows;
}

double flow_convexity(const int *texels, int count, int row, double (*room)[2])
{
    const int ends = put_ends(texels, count, row, room);
    double(*hull)[2] = room + ends;
    return count / places_in(hull, rg_hull(room, ends, hull));
}
