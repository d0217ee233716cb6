// Light at the smooth surface of a dielectric, such as water.
#ifndef RG_KERNELS_DIALECT_DIELECTRIC_H
#define RG_KERNELS_DIALECT_DIELECTRIC_H

#include "kernels/dialect/vec.h"

// The share of unpolarised light that is reflected, by Fresnel's equations. `ratio` is the index of
// refraction on the side that the light comes from, over that on the other side. The cosines, not
// negative, are of the angles between the surface's normal and the light before and after. Callers
// do not ask if nothing passes (rg_cos_refracted2 is not above 0).
RG_FN float rg_reflectance(float cos_in, float cos_out, float ratio)
{
    float across = (ratio * cos_in - cos_out) / (ratio * cos_in + cos_out + 1e-12f);
    float in_plane = (cos_in - ratio * cos_out) / (cos_in + ratio * cos_out + 1e-12f);
    return 0.5f * (across * across + in_plane * in_plane);
}

// The squared cosine of the angle of the light that passes, by Snell's law; below 0: all is
// reflected.
RG_FN float rg_cos_refracted2(float cos_in, float ratio)
{
    return 1.0f - ratio * ratio * (1.0f - cos_in * cos_in);
}

#endif
