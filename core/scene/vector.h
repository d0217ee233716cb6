// Vectors of three doubles, for the host's computations on scenes before they are rounded once.
#ifndef RG_CORE_SCENE_VECTOR_H
#define RG_CORE_SCENE_VECTOR_H

#include <math.h>

static inline double rg_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// `product` must be neither of the two.
static inline void rg_cross(const double a[3], const double b[3], double product[3])
{
    for (int i = 0; i < 3; i++)
        product[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

// Scales a vector to length 1; it must not be 0.
static inline void rg_to_unit(double a[3])
{
    const double length = sqrt(rg_dot(a, a));
    for (int i = 0; i < 3; i++)
        a[i] /= length;
}

#endif
