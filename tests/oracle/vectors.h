// Vectors of three doubles.
#ifndef RG_TESTS_ORACLE_VECTORS_H
#define RG_TESTS_ORACLE_VECTORS_H

#include <math.h>

static inline double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static inline void add(const double a[3], const double b[3], double times, double sum[3])
{
    for (int i = 0; i < 3; i++)
        sum[i] = a[i] + times * b[i];
}

static inline void make_unit(double a[3])
{
    const double length = sqrt(dot(a, a));
    for (int i = 0; i < 3; i++)
        a[i] /= length;
}

static inline double clamped(double value, double least, double most)
{
    return fmin(fmax(value, least), most);
}

#endif
