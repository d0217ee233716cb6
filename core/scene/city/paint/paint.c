// Paints the city's textures: the shared noise, and which painter paints which texture.
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/scene/city/paint/ground.h"
#include "core/scene/city/paint/spot.h"
#include "core/scene/city/paint/walls.h"
#include "kernels/dialect/rng.h"

enum { CHANCE_NOISE = 401 };

// --- noise ---

static uint32_t noise_seed(const struct city_settings *settings)
{
    return rg_random((uint)settings->seed, 0, 0, CHANCE_NOISE).x;
}

// Periodic smooth noise of `across` x `down` cells over the unit square.
static float smooth(float u, float v, int across, int down, uint32_t seed)
{
    const float x = u * (float)across, y = v * (float)down;
    const int ix = (int)x, iy = (int)y;
    const int x0 = ix % across, x1 = (ix + 1) % across, y0 = iy % down, y1 = (iy + 1) % down;
    const float fx = x - (float)ix, fy = y - (float)iy;
    const float wx = fx * fx * (3 - 2 * fx), wy = fy * fy * (3 - 2 * fy);
    const float a = paint_lattice(x0, y0, seed), b = paint_lattice(x1, y0, seed);
    const float c = paint_lattice(x0, y1, seed), d = paint_lattice(x1, y1, seed);
    return a + (b - a) * wx + ((c + (d - c) * wx) - (a + (b - a) * wx)) * wy;
}

static float octaves(float u, float v, int across, int down, uint32_t seed, int count)
{
    float sum = 0, weight = 1, all = 0;
    for (int i = 0; i < count; i++) {
        sum += weight * smooth(u, v, across << i, down << i, seed + (uint32_t)i);
        all += weight;
        weight *= 0.6f;
    }
    return sum / all;
}

void city_painter_destroy(struct city_painter *painter)
{
    if (!painter)
        return;
    free(painter->fine);
    free(painter->cloud);
    free(painter->stain);
    free(painter);
}

struct city_painter *city_painter_create(const struct city_settings *settings)
{
    struct city_painter *p = rg_alloc(1, sizeof(*p), "painter");
    if (!p)
        return NULL;
    const int size = settings->size == CITY_FULL ? CITY_TEXTURE_PX : CITY_SMALL_TEXTURE_PX;
    const size_t texels = (size_t)size * (size_t)size;
    p->settings = *settings;
    p->size = size;
    p->fine = rg_alloc(texels, sizeof(float), "painter");
    p->cloud = p->fine ? rg_alloc(texels, sizeof(float), "painter") : NULL;
    p->stain = p->cloud ? rg_alloc(texels, sizeof(float), "painter") : NULL;
    if (!p->stain) {
        city_painter_destroy(p);
        return NULL;
    }
    const uint32_t seed = p->seed = noise_seed(settings);
#pragma omp parallel for
    for (int y = 0; y < size; y++) {
        for (int x = 0; x < size; x++) {
            const float u = (float)x / (float)size, v = (float)y / (float)size;
            const size_t i = (size_t)y * (size_t)size + (size_t)x;
            p->fine[i] = paint_lattice(x, y, seed);
            p->cloud[i] = octaves(u, v, 4, 4, seed + 1, 6);
            p->stain[i] = octaves(u, v, 48, 3, seed + 9, 3);
        }
    }
    return p;
}

bool city_shop_sign(const struct city_settings *settings, int texture, float tint[3])
{
    const struct city_painter painter = {.seed = noise_seed(settings)};
    struct spot s = {.painter = &painter, .texture = texture};
    return paint_sign_light(&s, tint);
}

// --- texels ---

static uint32_t byte_of(float v)
{
    return (uint32_t)(rg_clamp(v, 0, 1) * 255 + 0.5f);
}

static struct paint paint_of(const struct spot *s)
{
    if (s->texture < PAINT_CURTAIN)
        return paint_facade(s);
    if (s->texture < PAINT_SHOP)
        return paint_curtain(s);
    if (s->texture < PAINT_WALL)
        return paint_shop(s);
    if (s->texture < PAINT_ROOF)
        return paint_wall(s, s->texture - PAINT_WALL, s->u, s->v, 16, 40);
    return paint_ground(s);
}

void city_paint(const struct city_painter *painter, int texture, uint32_t *texels)
{
    const int size = painter->size;
    struct spot s = {.painter = painter,
                     .texture = texture,
                     .shift_x = texture * 101 % (size / 2),
                     .shift_y = texture * 67 % (size / 2)};
    if (texture < PAINT_SHOP)
        s.style = city_facade_style(&painter->settings, texture);
    for (s.y = 0; s.y < size; s.y++) {
        for (s.x = 0; s.x < size; s.x++) {
            s.u = ((float)s.x + 0.5f) / (float)size;
            s.v = ((float)s.y + 0.5f) / (float)size;
            const struct paint p = paint_of(&s);
            texels[s.y * size + s.x] =
                byte_of(p.r) | byte_of(p.g) << 8 | byte_of(p.b) << 16 | byte_of(p.a) << 24;
        }
    }
}
