#include "tests/oracle/rainfall.h"

#include <math.h>

struct rainfall_vector rainfall_sum(struct rainfall_vector a, struct rainfall_vector b,
                                    double share)
{
    return (struct rainfall_vector){a.x + share * b.x, a.y + share * b.y, a.z + share * b.z};
}

double rainfall_dot(struct rainfall_vector a, struct rainfall_vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

double rainfall_length(struct rainfall_vector a)
{
    return sqrt(rainfall_dot(a, a));
}

static struct rainfall_vector cross(struct rainfall_vector a, struct rainfall_vector b)
{
    return (struct rainfall_vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                                    a.x * b.y - a.y * b.x};
}

static struct rainfall_vector unit(struct rainfall_vector a)
{
    const double length = rainfall_length(a);
    return (struct rainfall_vector){a.x / length, a.y / length, a.z / length};
}

struct rainfall_vector rainfall_acceleration(const struct rainfall_air *air,
                                             struct rainfall_vector v)
{
    const struct rainfall_vector weight = {0, -air->gravity, 0};
    if (air->is_constant)
        return rainfall_sum(weight, (struct rainfall_vector){air->push_x, air->drag, air->push_z},
                            1);
    const struct rainfall_vector through = {v.x - air->push_x, v.y, v.z - air->push_z};
    return rainfall_sum(weight, through, -air->k * rainfall_length(through));
}

// --- the camera ---

struct rainfall_eye rainfall_eye_of(const double position[3], const double target[3],
                                    double angle_deg, double near_m, double far_m, int width,
                                    int height)
{
    const double pi = acos(-1);
    struct rainfall_eye eye = {.at = {position[0], position[1], position[2]},
                               .focal_px = height / 2.0 / tan(angle_deg * pi / 360),
                               .near_m = near_m,
                               .far_m = far_m,
                               .width = width,
                               .height = height};
    eye.ahead =
        unit(rainfall_sum((struct rainfall_vector){target[0], target[1], target[2]}, eye.at, -1));
    eye.right = unit(cross(eye.ahead, (struct rainfall_vector){0, 1, 0}));
    eye.up = cross(eye.right, eye.ahead);
    return eye;
}

double rainfall_depth_of(const struct rainfall_eye *eye, double distance_m)
{
    return eye->far_m / (eye->far_m - eye->near_m) * (1 - eye->near_m / distance_m);
}

static double distance_of(const struct rainfall_eye *eye, double depth)
{
    return eye->near_m / (1 - depth * (eye->far_m - eye->near_m) / eye->far_m);
}

struct rainfall_spot rainfall_spot_of(const struct rainfall_eye *eye, struct rainfall_vector p)
{
    const double doubt_px = 0.01;
    const struct rainfall_vector d = rainfall_sum(p, eye->at, -1);
    struct rainfall_spot s = {.distance_m = rainfall_dot(d, eye->ahead)};
    s.x_px = eye->width / 2.0 + eye->focal_px * rainfall_dot(d, eye->right) / s.distance_m;
    s.y_px = eye->height / 2.0 - eye->focal_px * rainfall_dot(d, eye->up) / s.distance_m;
    s.depth = rainfall_depth_of(eye, s.distance_m);
    const double inner =
        fmin(fmin(s.x_px, eye->width - s.x_px), fmin(s.y_px, eye->height - s.y_px));
    s.is_inside = s.distance_m > eye->near_m && s.distance_m < eye->far_m && inner > 0;
    s.is_at_border = fabs(inner) < doubt_px || fabs(s.distance_m - eye->near_m) < 1e-4;
    return s;
}

struct rainfall_samples rainfall_count(const struct rainfall_eye *eye, struct rainfall_vector p,
                                       double radius_m)
{
    const double doubt_px = 0.01, doubt_depth = 4e-7;
    const struct rainfall_spot s = rainfall_spot_of(eye, p);
    const double m_px = s.distance_m / eye->focal_px, radius_px = radius_m / m_px;
    struct rainfall_samples n = {0, 0};
    for (int y = 0; y < eye->height; y++) {
        if (fabs(y + 0.5 - s.y_px) > radius_px + 1)
            continue;
        for (int x = 0; x < eye->width; x++) {
            const double off_px = hypot(x + 0.5 - s.x_px, y + 0.5 - s.y_px);
            if (off_px > radius_px + doubt_px)
                continue;
            const double off_m = fmin(off_px * m_px, radius_m);
            const double near_m = s.distance_m - sqrt(radius_m * radius_m - off_m * off_m);
            const double before =
                (double)eye->depth[y * eye->width + x] - rainfall_depth_of(eye, near_m);
            // Near the rim, rounding of the place moves the sphere's surface far along the view.
            const double slack =
                doubt_depth + (off_px > radius_px - 0.1
                                   ? fabs(rainfall_depth_of(eye, s.distance_m) -
                                          rainfall_depth_of(eye, s.distance_m - 0.5 * radius_m))
                                   : 0);
            n.most += before > -slack;
            n.least += before > slack && off_px < radius_px - doubt_px;
        }
    }
    return n;
}

// --- visible surfaces ---

static double depth_at(const struct rainfall_eye *eye, int x, int y)
{
    const int column = x < 0 ? 0 : x >= eye->width ? eye->width - 1 : x;
    const int row = y < 0 ? 0 : y >= eye->height ? eye->height - 1 : y;
    return (double)eye->depth[row * eye->width + column];
}

// The slope of smaller size.
static double lesser(double a, double b)
{
    return fabs(a) < fabs(b) ? a : b;
}

struct rainfall_gap rainfall_behind(const struct rainfall_eye *eye, struct rainfall_vector p)
{
    const struct rainfall_spot s = rainfall_spot_of(eye, p);
    const int x = (int)floor(s.x_px), y = (int)floor(s.y_px);
    const double here = depth_at(eye, x, y);
    const double across = lesser(here - depth_at(eye, x - 1, y), depth_at(eye, x + 1, y) - here);
    const double down = lesser(here - depth_at(eye, x, y - 1), depth_at(eye, x, y + 1) - here);
    const double depth = here + (s.x_px - x - 0.5) * across + (s.y_px - y - 0.5) * down;
    const double seen_m = distance_of(eye, depth);
    const double to_edge = fmin(fabs(s.x_px - round(s.x_px)), fabs(s.y_px - round(s.y_px)));
    struct rainfall_gap gap = {s.distance_m - seen_m, 2e-4};
    // Rounding of the place may choose the next texel.
    if (to_edge < 0.01 || depth >= 0.9999)
        gap.doubt_m = 1e9;
    return gap;
}

double rainfall_meets(struct rainfall_vector from, struct rainfall_vector to,
                      const struct rainfall_vector corners[3])
{
    const struct rainfall_vector way = rainfall_sum(to, from, -1);
    const struct rainfall_vector a = rainfall_sum(corners[1], corners[0], -1);
    const struct rainfall_vector b = rainfall_sum(corners[2], corners[0], -1);
    const struct rainfall_vector p = cross(way, b), t = rainfall_sum(from, corners[0], -1);
    const double det = rainfall_dot(a, p);
    if (fabs(det) < 1e-15)
        return -1;
    const struct rainfall_vector q = cross(t, a);
    const double u = rainfall_dot(t, p) / det, v = rainfall_dot(way, q) / det;
    const double along = rainfall_dot(b, q) / det;
    const bool is_in = u >= -1e-9 && v >= -1e-9 && u + v <= 1 + 1e-9;
    return is_in && along >= 0 && along <= 1 ? along : -1;
}
