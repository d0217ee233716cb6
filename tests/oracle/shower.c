#include "tests/oracle/shower.h"

#include <math.h>

double oracle_farthest(double drop_height_m, double beta, int height_px)
{
    return height_px * drop_height_m / (2 * tan(beta / 2));
}

// The viewer looks along (-sin p, 0, -cos p); its right is (cos p, 0, -sin p).
struct oracle_sight oracle_sight_of(const struct oracle_rain *r, const struct oracle_drop *d)
{
    const double x = d->x - r->eye[0], y = d->y - r->eye[1], z = d->z - r->eye[2];
    const double ahead = -x * sin(r->heading) - z * cos(r->heading);
    const double beside = x * cos(r->heading) - z * sin(r->heading);
    return (struct oracle_sight){ahead, beside / (ahead * tan(r->alpha / 2)),
                                 y / (ahead * tan(r->beta / 2))};
}

struct oracle_drop oracle_drop_at(const struct oracle_rain *r, const struct oracle_sight *s)
{
    const double beside = s->across * s->ahead * tan(r->alpha / 2);
    return (struct oracle_drop){r->eye[0] - s->ahead * sin(r->heading) + beside * cos(r->heading),
                                r->eye[1] + s->up * s->ahead * tan(r->beta / 2),
                                r->eye[2] - s->ahead * cos(r->heading) - beside * sin(r->heading),
                                0};
}

double oracle_share(const struct oracle_rain *r, const struct oracle_drop *d)
{
    const double third = (r->far_m - r->near_m) / 3;
    const double behind = oracle_sight_of(r, d).ahead - r->near_m;
    if (!r->is_layered || behind < third)
        return 1;
    return behind < 2 * third ? 1.0 / 2 : 1.0 / 3;
}

struct oracle_drop oracle_moved(const struct oracle_rain *r, const struct oracle_drop *d)
{
    const double gained = r->accelerates ? r->gravity_m_s2 * r->step_s : 0;
    return (struct oracle_drop){d->x + r->wind_x * r->step_s, d->y - d->fall_m_s * r->step_s,
                                d->z + r->wind_z * r->step_s, d->fall_m_s + gained};
}

// The offset of a drop's upper end: against its velocity, as high as the drop.
static void up_of(const struct oracle_rain *r, const struct oracle_drop *d, double up[3])
{
    const double high = r->height_m * oracle_share(r, d);
    const double seconds = high / d->fall_m_s;
    up[0] = -r->wind_x * seconds;
    up[1] = high;
    up[2] = -r->wind_z * seconds;
}

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

// The distance of a point from a side through the eye and two corners of the view, positive towards
// the view's middle.
static double from_side(const struct oracle_rain *r, const double a[2], const double b[2],
                        const double point[3])
{
    const double *const signs[2] = {a, b};
    double rays[2][3], normal[3], length = 0, by_point = 0, by_middle = 0;
    const struct oracle_sight middle = {1, 0, 0};
    for (int k = 0; k < 2; k++) {
        const struct oracle_sight corner = {1, signs[k][0], signs[k][1]};
        const struct oracle_drop at = oracle_drop_at(r, &corner);
        const double place[3] = {at.x, at.y, at.z};
        for (int i = 0; i < 3; i++)
            rays[k][i] = place[i] - r->eye[i];
    }
    cross(rays[0], rays[1], normal);
    const struct oracle_drop on = oracle_drop_at(r, &middle);
    const double axis[3] = {on.x - r->eye[0], on.y - r->eye[1], on.z - r->eye[2]};
    for (int i = 0; i < 3; i++) {
        length += normal[i] * normal[i];
        by_point += normal[i] * (point[i] - r->eye[i]);
        by_middle += normal[i] * axis[i];
    }
    return by_point / sqrt(length) * (by_middle < 0 ? -1 : 1);
}

// The distance inside one of the six sides.
static double from_plane(const struct oracle_rain *r, int side, const double point[3])
{
    static const double corners[4][2] = {{-1, 1}, {1, 1}, {1, -1}, {-1, -1}};
    const struct oracle_drop at = {point[0], point[1], point[2], 0};
    if (side == 4)
        return oracle_sight_of(r, &at).ahead - r->near_m;
    if (side == 5)
        return r->far_m - oracle_sight_of(r, &at).ahead;
    return from_side(r, corners[side], corners[(side + 1) % 4], point);
}

double oracle_inside(const struct oracle_rain *r, const struct oracle_drop *d)
{
    double up[3] = {0}, least = INFINITY;
    const double beside = r->tests_corners ? r->width_m / 2 * oracle_share(r, d) : 0;
    if (r->tests_corners)
        up_of(r, d, up);
    for (int side = 0; side < 6; side++) {
        double most = -INFINITY;
        for (int k = 0; k < 4; k++) {
            const double by = k & 1 ? beside : -beside, high = k & 2 ? 1 : 0;
            const double point[3] = {d->x + by * cos(r->heading) + up[0] * high,
                                     d->y + up[1] * high,
                                     d->z - by * sin(r->heading) + up[2] * high};
            most = fmax(most, from_plane(r, side, point));
        }
        least = fmin(least, most);
    }
    return least;
}

struct oracle_sphere oracle_sphere_of(const struct oracle_rain *r, const struct oracle_drop *d)
{
    const double x = d->x - r->eye[0], y = d->y - r->eye[1], z = d->z - r->eye[2];
    const double length = sqrt(x * x + y * y + z * z);
    return (struct oracle_sphere){length, acos(y / length), atan2(x, z)};
}

// A pinhole camera's projection of a place ahead.
static void project(const struct oracle_rain *r, const double place[3], double pixel[2])
{
    const struct oracle_drop at = {place[0], place[1], place[2], 0};
    const struct oracle_sight s = oracle_sight_of(r, &at);
    pixel[0] = (1 + s.across) / 2 * r->width_px;
    pixel[1] = (1 - s.up) / 2 * r->height_px;
}

struct oracle_streak oracle_streak_of(const struct oracle_rain *r, const struct oracle_drop *d)
{
    double up[3];
    up_of(r, d, up);
    const double low[3] = {d->x, d->y, d->z};
    const double high[3] = {d->x + up[0], d->y + up[1], d->z + up[2]};
    const double per_m = r->height_px / (2 * tan(r->beta / 2) * oracle_sight_of(r, d).ahead);
    struct oracle_streak s = {.width_px = r->width_m * oracle_share(r, d) * per_m};
    project(r, low, s.low);
    project(r, high, s.high);
    return s;
}
