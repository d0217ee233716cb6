// Fresnel's law by sines and tangents, which the program's own code does without.
#ifndef RG_TESTS_ORACLE_OPTICS_FRESNEL_H
#define RG_TESTS_ORACLE_OPTICS_FRESNEL_H

#include <math.h>

// The share of unpolarised light that a surface reflects. `in` is the angle to the normal, in
// radians; `ratio` is the index of refraction before the surface over that behind it.
static inline double fresnel(double in, double ratio)
{
    if (sin(in) * ratio >= 1)
        return 1;
    if (in < 1e-6)
        return pow((1 - ratio) / (1 + ratio), 2);
    const double out = asin(sin(in) * ratio);
    return (pow(sin(in - out) / sin(in + out), 2) + pow(tan(in - out) / tan(in + out), 2)) / 2;
}

#endif
