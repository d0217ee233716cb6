#include "core/scene/atlas/optics/trace.h"

#include <math.h>

#include "core/image/compare/multiversion.h"
#include "kernels/dialect/dielectric.h"

#define INLINE static inline __attribute__((always_inline))

// Steps of Newton's method that find a point on the surface: from outside, and through the drop,
// where the sphere's chord is a good guess. One step fewer through the drop, and the rays that bend
// most go astray.
enum { STEPS_IN = 7, STEPS_THROUGH = 6 };

struct vector {
    float x, y, z;
};

// The distance of a point from the surface (negative: inside), and its gradient.
struct field {
    float value;
    struct vector gradient;
};

// A ray split at the surface: the share that is reflected, and both directions.
struct parted {
    float reflectance;
    struct vector reflected, refracted;
};

INLINE float least(float a, float b)
{
    return a < b ? a : b;
}

INLINE float most(float a, float b)
{
    return a > b ? a : b;
}

INLINE float dot(struct vector a, struct vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// a + t b
INLINE struct vector along(struct vector a, float t, struct vector b)
{
    return (struct vector){a.x + t * b.x, a.y + t * b.y, a.z + t * b.z};
}

INLINE struct vector scaled(struct vector a, float t)
{
    return (struct vector){a.x * t, a.y * t, a.z * t};
}

// The distance function |p| - r(direction of p), with c = cos theta and q = sin theta cos(phi -
// phi_drop).
INLINE struct field field_at(struct rg_drop_shape s, struct vector p)
{
    const float squared = most(dot(p, p), 1e-6f);
    const float inverse = 1 / sqrtf(squared);
    const float c = p.y * inverse, q = (p.x * s.mx + p.z * s.mz) * inverse;
    const float lobe = 1.5f * s.b * (5 * c * c - 1);
    const float by_c = 3 * s.a * c + 15 * s.b * c * q;
    const float radial = inverse + inverse * inverse * (by_c * c + lobe * q);
    return (struct field){squared * inverse - 1 - s.a * (1.5f * c * c - 0.5f) - lobe * q,
                          {p.x * radial - inverse * lobe * s.mx, p.y * radial - inverse * by_c,
                           p.z * radial - inverse * lobe * s.mz}};
}

// The t between low (inside) and high (outside) at which the ray p + t d meets the surface.
INLINE float solve(struct rg_drop_shape s, struct vector p, struct vector d, float guess, float low,
                   float high, int steps)
{
    float t = guess;
#pragma GCC unroll 8
    for (int i = 0; i < steps; i++) {
        const struct field f = field_at(s, along(p, t, d));
        const float next = t - f.value / dot(f.gradient, d);
        low = f.value < 0 ? t : low;
        high = f.value < 0 ? high : t;
        const float middle = 0.5f * (low + high);
        t = next >= low ? next : middle;
        t = next <= high ? t : middle;
    }
    return t;
}

// The distance along d at which a line enters the drop, on the viewer's side; `hit` becomes 0 if
// the line misses it.
INLINE float enter(struct rg_drop_shape s, struct vector p, struct vector d, float *hit)
{
    // p is the line's point nearest to the centre. Near the rim p may be outside the drop, so a
    // point deeper in the field is sought. Near the centre the field is too steep for that.
    const float outside_here = field_at(s, p).value > 0 ? 1.0f : 0.0f;
    float deepest = 0;
#pragma GCC unroll 8
    for (int i = 0; i < 3; i++)
        deepest -= outside_here * dot(field_at(s, along(p, deepest, d)).gradient, d);
    *hit = field_at(s, along(p, deepest, d)).value < 0 ? 1.0f : 0.0f;
    const float room = RG_DROP_REACH * RG_DROP_REACH - dot(p, p);
    const float outside = most(sqrtf(most(room, 0)), deepest);
    return solve(s, p, d, outside, deepest, outside, STEPS_IN);
}

// How far a ray goes from a point on the surface through the drop in direction d.
INLINE float cross(struct rg_drop_shape s, struct vector p, struct vector d)
{
    const float middle = -dot(p, d);
    const float chord = most(2 * middle, 0.1f);
    const float room = middle * middle + RG_DROP_REACH * RG_DROP_REACH - dot(p, p);
    const float outside = middle + sqrtf(most(room, 0));
    return solve(s, p, d, chord, 0.05f, most(outside, chord), STEPS_THROUGH);
}

// Splits unpolarised light in direction d at a surface with unit normal n against d; `ratio` is the
// index of refraction on this side over that on the other. Beyond the critical angle all is
// reflected.
INLINE struct parted part(struct vector d, struct vector n, float ratio)
{
    const float cos_in = least(most(-dot(d, n), 0), 1);
    const float squared = rg_cos_refracted2(cos_in, ratio);
    const float cos_out = sqrtf(most(squared, 0));
    const float fresnel = rg_reflectance(cos_in, cos_out, ratio);
    return (struct parted){squared > 0 ? fresnel : 1, along(d, 2 * cos_in, n),
                           along(scaled(d, ratio), ratio * cos_in - cos_out, n)};
}

INLINE struct vector unit(struct vector a)
{
    return scaled(a, 1 / sqrtf(dot(a, a)));
}

INLINE void keep(struct rg_drop_row *row, int way, int i, struct vector d, float share)
{
    d = unit(d);
    row->x[way][i] = d.x;
    row->y[way][i] = d.y;
    row->z[way][i] = d.z;
    row->share[way][i] = share;
}

// Traces one ray backwards, from the viewer to the light.
INLINE void trace(struct rg_drop_shape s, struct vector towards, struct vector start, int i,
                  struct rg_drop_row *row)
{
    float left;
    struct vector p = along(start, enter(s, start, towards, &left), towards);
    row->hit[i] = left;
    const struct parted outside =
        part(scaled(towards, -1), unit(field_at(s, p).gradient), 1 / RG_DROP_INDEX);
    keep(row, 0, i, outside.reflected, left * outside.reflectance);
    left *= 1 - outside.reflectance;
    struct vector d = unit(outside.refracted);
#pragma GCC unroll 8
    for (int way = 1; way < RG_DROP_WAYS; way++) {
        const float t = cross(s, p, d), seen = t < s.blind ? 0.0f : 1.0f;
        p = along(p, t, d);
        const struct vector inward = scaled(unit(field_at(s, p).gradient), -1);
        const struct parted inside = part(d, inward, RG_DROP_INDEX);
        const float reflectance = seen * inside.reflectance;
        keep(row, way, i, along(scaled(inside.refracted, seen), 1 - seen, d),
             left * (1 - reflectance));
        left *= reflectance;
        d = unit(inside.reflected);
    }
}

RG_MULTIVERSION
void rg_drop_trace(const struct rg_drop_shape *shape, const struct rg_drop_view *view, float v,
                   float first_u, float step_u, int count, struct rg_drop_row *row)
{
    const struct rg_drop_shape s = *shape;
    const struct vector towards = {view->towards[0], view->towards[1], view->towards[2]};
    const struct vector right = {view->right[0], view->right[1], view->right[2]};
    const struct vector centre = {v * view->up[0], v * view->up[1], v * view->up[2]};
#pragma omp simd
    for (int i = 0; i < count; i++)
        trace(s, towards, along(centre, first_u + step_u * (float)i, right), i, row);
}

struct rg_drop_view rg_drop_view(double elevation_deg)
{
    const float c = (float)cos(elevation_deg * M_PI / 180),
                s = (float)sin(elevation_deg * M_PI / 180);
    return (struct rg_drop_view){{0, s, c}, {1, 0, 0}, {0, c, -s}};
}
