#include "tests/oracle/optics/drop.h"

#include <math.h>
#include <string.h>

#include "tests/oracle/optics/fresnel.h"

#define PI 3.14159265358979323846

struct oracle_drop oracle_drop_at(bool database, int oscillation, double part)
{
    static const double azimuths[10] = {0, 0, 270, 0, 90, 180, 270, 0, 90, 180};
    const double upright = oscillation == 0 ? 0 : oscillation == 1 || oscillation > 5 ? 0.2 : 0.1;
    const double bent = oscillation < 2 ? 0 : database || oscillation > 5 ? 0.1 : 0.05;
    const double scale = database ? 1 : 0.25;
    const double w2 = sqrt(8 * 0.0728 / (1000 * pow(1.6e-3, 3))), turn = w2 * part / 60;
    return (struct oracle_drop){.a = (database ? 0 : -0.051) + scale * upright * sin(turn),
                                .b = scale * bent * sin(2 * turn),
                                .phi_drop = azimuths[oscillation] * PI / 180,
                                .index = 1.333,
                                .blind = database ? 0.6 : 0};
}

double oracle_drop_radius(const struct oracle_drop *drop, const double n[3])
{
    const double c = n[1], aside = n[0] * sin(drop->phi_drop) + n[2] * cos(drop->phi_drop);
    return 1 + drop->a * (3 * c * c - 1) / 2 + drop->b * 1.5 * (5 * c * c - 1) * aside;
}

// The depth of a point below the surface, in radii: the definition.
static double depth_at(const struct oracle_drop *drop, const double p[3])
{
    const double length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    const double n[3] = {p[0] / length, p[1] / length, p[2] / length};
    return oracle_drop_radius(drop, n) - length;
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

// Steps along a ray until it crosses the surface, then halves the step; moves p by this way. False
// if there is no surface. Of the rays that meet a sphere 6 in 100,000 are inside for less than a
// step, and may be missed. Rays start at most 4 radii before the middle.
static bool march(const struct oracle_drop *drop, double p[3], const double d[3], bool inside,
                  double *way)
{
    const double step = 1.0 / 64;
    double low = inside ? 0.02 : 0;
    for (double high = low + step; high < 6; low = high, high += step) {
        double q[3];
        for (int i = 0; i < 3; i++)
            q[i] = p[i] + high * d[i];
        if ((depth_at(drop, q) > 0) == inside)
            continue;
        for (int k = 0; k < 40; k++) {
            const double middle = 0.5 * (low + high);
            for (int i = 0; i < 3; i++)
                q[i] = p[i] + middle * d[i];
            if ((depth_at(drop, q) > 0) == inside)
                low = middle;
            else
                high = middle;
        }
        memcpy(p, q, 3 * sizeof(*p));
        *way = high;
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
    return fresnel(in, ratio);
}

bool oracle_drop_light(const struct oracle_drop *drop, const double start[3], const double ray[3],
                       double direction[ORACLE_WAYS][3], double share[ORACLE_WAYS])
{
    double p[3], d[3], normal[3], inside[3], way_radii;
    memcpy(p, start, sizeof(p));
    memset(share, 0, ORACLE_WAYS * sizeof(*share));
    if (!march(drop, p, ray, false, &way_radii))
        return false;
    normal_at(drop, p, normal);
    share[0] = part(ray, normal, 1 / drop->index, direction[0], d);
    double left = 1 - share[0];
    for (int way = 1; way < ORACLE_WAYS; way++) {
        if (!march(drop, p, d, true, &way_radii))
            return false;
        if (way_radii < drop->blind) {
            memcpy(direction[way], d, sizeof(d));
            share[way] = left;
            return true;
        }
        normal_at(drop, p, normal);
        const double reflected = part(d, normal, drop->index, inside, direction[way]);
        share[way] = left * (1 - reflected);
        left *= reflected;
        memcpy(d, inside, sizeof(d));
    }
    return true;
}
