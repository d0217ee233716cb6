#include "tests/oracle/drop.h"

#include <math.h>
#include <string.h>

// The depth of a point below the surface, in radii: the definition, by angles.
static double depth_at(const struct oracle_drop *drop, const double p[3])
{
    const double length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    const double theta = acos(p[1] / length), phi = atan2(p[0], p[2]), c = cos(theta);
    const double r = 1 + drop->a * (3 * c * c - 1) / 2 +
                     drop->b * 1.5 * sin(theta) * (5 * c * c - 1) * cos(phi - drop->phi_drop);
    return r - length;
}

static void normal_at(const struct oracle_drop *drop, const double p[3], double normal[3])
{
    const double h = 1e-5;
    double length = 0;
    for (int i = 0; i < 3; i++) {
        double q[3];
        memcpy(q, p, sizeof(q));
        q[i] = p[i] - h;
        normal[i] = depth_at(drop, q);
        q[i] = p[i] + h;
        normal[i] -= depth_at(drop, q);
        length += normal[i] * normal[i];
    }
    for (int i = 0; i < 3; i++)
        normal[i] /= sqrt(length);
}

// Steps along a ray until it crosses the surface, then halves the step; moves p there.
static bool march(const struct oracle_drop *drop, double p[3], const double d[3], bool inside)
{
    const double step = 1.0 / 512;
    double low = inside ? 0.02 : 0;
    for (double high = low + step; high < 8; low = high, high += step) {
        double q[3];
        for (int i = 0; i < 3; i++)
            q[i] = p[i] + high * d[i];
        if ((depth_at(drop, q) > 0) == inside)
            continue;
        for (int k = 0; k < 60; k++) {
            const double middle = 0.5 * (low + high);
            for (int i = 0; i < 3; i++)
                q[i] = p[i] + middle * d[i];
            if ((depth_at(drop, q) > 0) == inside)
                low = middle;
            else
                high = middle;
        }
        memcpy(p, q, 3 * sizeof(*p));
        return true;
    }
    return false;
}

// Splits light at a surface, by Snell's angles. Returns the reflected share.
static double part(const double d[3], const double outward[3], double ratio, double reflected[3],
                   double refracted[3])
{
    double along = d[0] * outward[0] + d[1] * outward[1] + d[2] * outward[2];
    const double sign = along > 0 ? -1 : 1, in = acos(fmin(fabs(along), 1));
    const double sine = sin(in) * ratio;
    for (int i = 0; i < 3; i++)
        reflected[i] = d[i] - 2 * along * outward[i];
    if (sine >= 1)
        return 1;
    const double out = asin(sine);
    for (int i = 0; i < 3; i++)
        refracted[i] = ratio * d[i] + (ratio * cos(in) - cos(out)) * sign * outward[i];
    if (in < 1e-6)
        return (1 - ratio) * (1 - ratio) / ((1 + ratio) * (1 + ratio));
    const double across = sin(in - out) / sin(in + out), plane = tan(in - out) / tan(in + out);
    return 0.5 * (across * across + plane * plane);
}

bool oracle_drop_light(const struct oracle_drop *drop, const double start[3], const double ray[3],
                       double direction[ORACLE_WAYS][3], double share[ORACLE_WAYS])
{
    double p[3], d[3], normal[3], inside[3];
    memcpy(p, start, sizeof(p));
    memset(share, 0, ORACLE_WAYS * sizeof(*share));
    if (!march(drop, p, ray, false))
        return false;
    normal_at(drop, p, normal);
    share[0] = part(ray, normal, 1 / drop->index, direction[0], d);
    double left = 1 - share[0];
    for (int way = 1; way < ORACLE_WAYS; way++) {
        if (!march(drop, p, d, true))
            return false;
        normal_at(drop, p, normal);
        const double reflected = part(d, normal, drop->index, inside, direction[way]);
        share[way] = left * (1 - reflected);
        left *= reflected;
        memcpy(d, inside, sizeof(d));
    }
    return true;
}
