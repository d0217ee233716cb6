// The texel being painted, and the noise that all texture painters share: for this folder alone.
#ifndef RG_CORE_SCENE_CITY_PAINT_SPOT_H
#define RG_CORE_SCENE_CITY_PAINT_SPOT_H

#include "core/scene/city/textures.h"
#include "kernels/dialect/lang.h"

// A colour as square roots of light, and the share of light from a lamp behind it.
struct paint {
    float r, g, b, a;
};

// Periodic noise shared by all textures, in squares of their size. All values are 0 to 1.
struct city_painter {
    struct city_settings settings;
    uint32_t seed;
    int size;     // texels along a side
    float *fine;  // white noise
    float *cloud; // features from a quarter of the square down to a few texels
    float *stain; // streaks drawn downwards, as running water leaves them
};

// A texel to be painted.
struct spot {
    const struct city_painter *painter;
    int texture;
    struct facade_style style; // of facades and curtain walls
    int shift_x, shift_y;      // offset of the noise, below half a side
    int x, y;
    float u, v; // 0 to 1, v from the top
};

// The noise at one place. Each texture, and each `part` of a texture, reads another region of it.
static inline float paint_noise(const struct spot *s, const float *noise, int part)
{
    const int size = s->painter->size;
    const int x = s->x + s->shift_x + (part & 1) * size / 2;
    const int y = s->y + s->shift_y + (part & 2) * size / 4;
    return noise[(y < size ? y : y - size) * size + (x < size ? x : x - size)];
}

static inline float paint_fine(const struct spot *s)
{
    return s->painter->fine[s->y * s->painter->size + s->x];
}

static inline float paint_cloud(const struct spot *s, int part)
{
    return paint_noise(s, s->painter->cloud, part);
}

static inline float paint_stain(const struct spot *s)
{
    return paint_noise(s, s->painter->stain, 0);
}

// A value of 0 to 1 for each lattice point.
static inline float paint_lattice(int x, int y, uint32_t seed)
{
    uint32_t h = (uint32_t)x * 0x9e3779b1u ^ (uint32_t)y * 0x85ebca77u ^ seed * 0xc2b2ae3du;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return (float)((h ^ h >> 15) >> 8) * 0x1p-24f;
}

// A pseudo-random number in [0, 1) for the k-th thing of a texture.
static inline float paint_chance(const struct spot *s, int k)
{
    return paint_lattice(s->texture, k, s->painter->seed);
}

static inline struct paint paint_mix(struct paint a, struct paint b, float t)
{
    return (struct paint){a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t,
                          a.a + (b.a - a.a) * t};
}

static inline struct paint paint_scaled(struct paint p, float by)
{
    return (struct paint){p.r * by, p.g * by, p.b * by, p.a};
}

// The distance to the nearest line's middle, in units of the lines' spacing `every`.
static inline float paint_line(float at, float every)
{
    const float lines = at * (1 / every), share = lines - rg_floor(lines);
    return rg_min(share, 1 - share);
}

#endif
