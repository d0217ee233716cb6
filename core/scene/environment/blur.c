#include "core/scene/environment/blur.h"

#include <math.h>

#include "core/scene/environment/cube.h"
#include "kernels/dialect/image/cube.h"
#include "kernels/dialect/math.h"

enum { WIDE_TEXELS = 16, LEAST_SIZE = 16 };

// Fills in `count` evenly distributed places of a disc (Vogel, 1979): each lies a golden angle on
// from the one before. Only operations that every C library has alike are used, as in all of this
// file, so that environments are the same everywhere.
static void place_in_disc(int count, double reach, double *places)
{
    static const double golden_cos = -0.73736887807831985, golden_sin = 0.67549029426152363;
    double x = 1, y = 0;
    for (int i = 0; i < count; i++) {
        const double radius = reach * sqrt((i + 0.5) / count),
                     turned = x * golden_cos - y * golden_sin;
        places[2 * i] = radius * x;
        places[2 * i + 1] = radius * y;
        y = x * golden_sin + y * golden_cos;
        x = turned;
    }
}

// Adds the light from a direction of any length, interpolated between four texels.
static void add_light(const struct rg_environment *e, const double d[3], double light[3])
{
    const cube_point c = cube_locate(v3_make((float)d[0], (float)d[1], (float)d[2]), e->size);
    const float fx = c.x + 0.5f, fy = c.y + 0.5f; // relative to the border's centres
    const int x = (int)fx, y = (int)fy;
    const float *top = rg_environment_texel(e, c.face, x - 1, y - 1);
    const float *bottom = rg_environment_texel(e, c.face, x - 1, y);
    for (int i = 0; i < 3; i++) {
        const float above = top[i] + (top[i + 3] - top[i]) * (fx - (float)x);
        const float below = bottom[i] + (bottom[i + 3] - bottom[i]) * (fx - (float)x);
        light[i] += (double)(above + (below - above) * (fy - (float)y));
    }
}

// Sampling places of a disc around a direction.
struct disc {
    const struct rg_environment *from;
    double places[2 * 256]; // in units of the direction's length
    int count;
};

static void disc_light(const double d[3], const void *user, double light[3])
{
    const struct disc *disc = user;
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const int axis = fabs(d[0]) < fabs(d[1]) ? 0 : 1; // the axis farthest from the direction
    double right[3] = {0}, down[3];
    right[axis] = 1;
    const double along = d[axis] / (length * length);
    for (int i = 0; i < 3; i++)
        right[i] -= along * d[i];
    const double across = sqrt(right[0] * right[0] + right[1] * right[1] + right[2] * right[2]);
    for (int i = 0; i < 3; i++)
        right[i] *= length / across;
    for (int i = 0; i < 3; i++)
        down[i] =
            (d[(i + 1) % 3] * right[(i + 2) % 3] - d[(i + 2) % 3] * right[(i + 1) % 3]) / length;
    for (int i = 0; i < 3; i++)
        light[i] = 0;
    for (int k = 0; k < disc->count; k++) {
        const double u = disc->places[2 * k], v = disc->places[2 * k + 1];
        const double to[3] = {d[0] + u * right[0] + v * down[0], d[1] + u * right[1] + v * down[1],
                              d[2] + u * right[2] + v * down[2]};
        add_light(disc->from, to, light);
    }
    for (int i = 0; i < 3; i++)
        light[i] /= disc->count;
}

static double texels_of(double diameter_rad, int size)
{
    return diameter_rad * size / (M_PI / 2);
}

static struct rg_environment *blurred(const struct rg_environment *from, double diameter_rad)
{
    const int most = 256, least = 16;
    const double texels = texels_of(diameter_rad, from->size), area = texels * texels;
    const float half = (float)fmin(diameter_rad, 2.8) / 2;
    const double reach = (double)rg_sin(half) / (double)rg_cos(half);
    struct disc disc = {.from = from,
                        .count = area > most    ? most
                                 : area < least ? least
                                                : (int)area};
    place_in_disc(disc.count, reach, disc.places);
    struct rg_environment *made = rg_environment_create(from->size);
    if (made)
        rg_environment_fill(made, disc_light, &disc);
    return made;
}

struct rg_environment *rg_environment_blur(const struct rg_environment *environment,
                                           double diameter_rad)
{
    struct rg_environment *halved = NULL;
    const struct rg_environment *from = environment;
    while (texels_of(diameter_rad, from->size) >= WIDE_TEXELS && from->size >= 2 * LEAST_SIZE) {
        struct rg_environment *smaller = rg_environment_halve(from);
        rg_environment_destroy(halved);
        if (!smaller)
            return NULL;
        from = halved = smaller;
    }
    struct rg_environment *made = blurred(from, diameter_rad);
    rg_environment_destroy(halved);
    return made;
}
