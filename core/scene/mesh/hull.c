#include "core/scene/mesh/hull.h"

#include <stdbool.h>
#include <string.h>

// Above 0 if c is to the left of the line from a to b.
static double turn(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool comes_before(const double a[2], const double b[2])
{
    return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
}

static void sort(double (*points)[2], int count)
{
    for (int i = 1; i < count; i++) {
        double point[2];
        memcpy(point, points[i], sizeof(point));
        int at = i;
        for (; at > 0 && comes_before(point, points[at - 1]); at--)
            memcpy(points[at], points[at - 1], sizeof(point));
        memcpy(points[at], point, sizeof(point));
    }
}

// Andrew's monotone chain.
int rg_hull(double (*points)[2], int count, double (*hull)[2])
{
    sort(points, count);
    if (count < 3) {
        memcpy(hull, points, (size_t)count * sizeof(*points));
        return count;
    }
    int size = 0;
    for (int pass = 0; pass < 2; pass++) {
        const int begin = size + 1;
        for (int i = 0; i < count; i++) {
            const double *point = points[pass == 0 ? i : count - 1 - i];
            while (size > begin && turn(hull[size - 2], hull[size - 1], point) <= 0)
                size--;
            memcpy(hull[size++], point, sizeof(*hull));
        }
        size--;
    }
    return size;
}
