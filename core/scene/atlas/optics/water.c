#include "core/scene/atlas/optics/water.h"

#include <math.h>
#include <string.h>

#include "core/scene/atlas/optics/drop.h"
#include "core/scene/vector.h"
#include "kernels/dialect/dielectric.h"

static const double index_of_water = (double)RG_DROP_INDEX;

static void along(const double from[3], double far, const double way[3], double to[3])
{
    for (int i = 0; i < 3; i++)
        to[i] = from[i] + far * way[i];
}

// The cosine inside of light that enters water, and the share that is reflected there.
static double refracted(double cosine)
{
    return (double)sqrtf(rg_cos_refracted2((float)cosine, 1 / RG_DROP_INDEX));
}

static double reflectance(double cosine)
{
    return (double)rg_reflectance((float)cosine, (float)refracted(cosine), 1 / RG_DROP_INDEX);
}

static void add(struct rg_water_light *light, const double from[3], double share)
{
    if (light->count == RG_WATER_WAYS || share <= 0)
        return;
    memcpy(light->from[light->count], from, 3 * sizeof(*from));
    light->share[light->count++] = share;
}

// --- balls ---

enum { BALLS_DEEP = 3 };

static void see_ball(const struct rg_water *w, const struct rg_water_ball *ball,
                     const double start[3], const double way[3], double left, int deep,
                     struct rg_water_light *light);

// The nearest ball that a ray meets after it has left another, or the sheet (NULL).
static const struct rg_water_ball *next_ball(const struct rg_water *w,
                                             const struct rg_water_ball *leaves,
                                             const double start[3], const double way[3])
{
    const struct rg_water_ball *nearest = NULL;
    double least = INFINITY;
    for (int i = 0; i < w->count; i++) {
        const struct rg_water_ball *b = &w->balls[i];
        double to[3];
        if (b == leaves)
            continue;
        along(b->at, -1, start, to);
        const double middle = rg_dot(to, way),
                     inner = middle * middle - rg_dot(to, to) + b->radius_m * b->radius_m;
        if (middle <= 0 || inner <= 0)
            continue;
        const double far = middle - sqrt(inner);
        if (far > 0 && far < least) {
            least = far;
            nearest = b;
        }
    }
    return nearest;
}

// Follows light on its way from a ball, or from the sheet (NULL).
static void follow(const struct rg_water *w, const struct rg_water_ball *ball,
                   const double start[3], const double way[3], double share, int deep,
                   struct rg_water_light *light)
{
    const struct rg_water_ball *next =
        share > 1e-3 && deep < BALLS_DEEP ? next_ball(w, ball, start, way) : NULL;
    if (next)
        see_ball(w, next, start, way, share, deep, light);
    else
        add(light, way, share);
}

// A ball shows what it mirrors, and what it refracts without and with one reflection inside. All
// angles at its surface are the same two. Less than 0.1 % of the light has more reflections.
static void see_ball(const struct rg_water *w, const struct rg_water_ball *ball,
                     const double start[3], const double way[3], double left, int deep,
                     struct rg_water_light *light)
{
    double from[3], normal[3], inside[3], out[3], at[3];
    along(start, -1, ball->at, from);
    const double middle = -rg_dot(from, way), squared = rg_dot(from, from) - middle * middle;
    const double half = sqrt(fmax(ball->radius_m * ball->radius_m - squared, 0));
    along(from, middle - half, way, normal);
    for (int i = 0; i < 3; i++)
        normal[i] /= ball->radius_m;
    const double in = fmin(half / ball->radius_m, 1), mirrors = reflectance(in);
    const double after = refracted(in);
    along(way, 2 * in, normal, out);
    along(ball->at, ball->radius_m, normal, at);
    follow(w, ball, at, out, left * mirrors, deep + 1, light);
    for (int i = 0; i < 3; i++)
        inside[i] = (way[i] + (in - index_of_water * after) * normal[i]) / index_of_water;
    double share = left * (1 - mirrors) * (1 - mirrors);
    for (int turns = 0; turns < 2; turns++) {
        along(normal, 2 * after, inside, normal);
        for (int i = 0; i < 3; i++)
            out[i] = index_of_water * inside[i] + (in - index_of_water * after) * normal[i];
        along(ball->at, ball->radius_m, normal, at);
        follow(w, ball, at, out, share, deep + 1, light);
        share *= mirrors;
        along(inside, -2 * after, normal, inside);
    }
}

// --- the sheet ---

double rg_water_edge(const struct rg_water *water, double phi)
{
    return water->height_m * (0.87 + 0.13 * cos(water->spikes * phi + water->turn));
}

// Both surfaces of a thin sheet mirror; what passes goes straight on. Returns the share that does.
static double see_wall(const struct rg_water *w, const double start[3], const double way[3],
                       double far, double left, struct rg_water_light *light)
{
    double at[3], normal[3], out[3];
    along(start, far, way, at);
    if (at[1] < 0 || at[1] > rg_water_edge(w, atan2(at[2], at[0])))
        return left;
    const double radius = hypot(at[0], at[2]), length = sqrt(1 + w->flare * w->flare);
    normal[0] = at[0] / radius / length;
    normal[1] = -w->flare / length;
    normal[2] = at[2] / radius / length;
    const double one = reflectance(fabs(rg_dot(way, normal))), both = 2 * one / (1 + one);
    along(way, -2 * rg_dot(way, normal), normal, out);
    follow(w, NULL, at, out, left * both, 1, light);
    return left * (1 - both);
}

// Returns the share of the light that passes the sheet before `end`.
static double see_sheet(const struct rg_water *w, const double start[3], const double way[3],
                        double end, struct rg_water_light *light)
{
    const double f = w->flare, r = w->foot_m + f * start[1];
    const double a = way[0] * way[0] + way[2] * way[2] - f * f * way[1] * way[1];
    const double b = start[0] * way[0] + start[2] * way[2] - r * f * way[1];
    const double c = start[0] * start[0] + start[2] * start[2] - r * r, inner = b * b - a * c;
    double left = 1;
    if (w->height_m <= 0 || a <= 0 || inner <= 0)
        return left;
    for (int side = -1; side <= 1; side += 2) {
        const double far = (-b + side * sqrt(inner)) / a;
        if (far < end)
            left = see_wall(w, start, way, far, left, light);
    }
    return left;
}

// --- the wave ---

// Where the ground's water is tilted it mirrors more of the sky than flat water; the flat part is
// the scene's own.
static void see_wave(const struct rg_water *w, const double start[3], const double way[3],
                     double left, struct rg_water_light *light)
{
    double at[3], normal[3], out[3];
    along(start, -start[1] / way[1], way, at);
    const double radius = hypot(at[0], at[2]), across = (radius - w->ring_m) / w->ring_width_m;
    if (!(fabs(across) < 1) || radius < 1e-6)
        return;
    const double rise =
        -w->ring_height_m * M_PI / w->ring_width_m * sin(M_PI * across) / sqrt(radius / 0.01);
    const double length = sqrt(1 + rise * rise);
    normal[0] = -rise * at[0] / radius / length;
    normal[1] = 1 / length;
    normal[2] = -rise * at[2] / radius / length;
    const double facing = -rg_dot(way, normal);
    along(way, 2 * facing, normal, out);
    if (facing > 0)
        add(light, out, left * (reflectance(facing) - reflectance(-way[1])));
}

void rg_water_see(const struct rg_water *water, const struct rg_water_ball *ball,
                  const double start[3], const double way[3], struct rg_water_light *light)
{
    double end = -start[1] / way[1], to[3];
    light->count = 0;
    if (ball) {
        along(ball->at, -1, start, to);
        end = rg_dot(to, way);
    }
    const double left = see_sheet(water, start, way, end, light);
    if (ball)
        see_ball(water, ball, start, way, left, 0, light);
    else
        see_wave(water, start, way, left, light);
}
