// Paints the city's textures.
#include "core/scene/city/paint.h"

#include <math.h>

#include "core/scene/city/build.h"
#include "kernels/rng.h"

struct facade_style city_facade_style(const struct city_settings *settings, int texture)
{
    const rg_uint4 c = rg_random((uint)settings->seed, (uint)texture, 0, 400);
    const double a = (double)rg_uniform(c.x), d = (double)rg_uniform(c.y),
                 e = (double)rg_uniform(c.z);
    if (texture >= PAINT_CURTAIN)
        return (struct facade_style){0.05, 0.95, 0.22, 0.97, PAINT_METAL + (int)(2 * a), 0.12};
    const double side = 0.16 + 0.12 * a;
    return (struct facade_style){
        side, 1 - side, 0.2 + 0.12 * d, 0.78 + 0.08 * e, PAINT_WALL + texture % 16, 0.25};
}

void city_paint(const struct city_settings *settings, int texture, uint32_t *texels)
{
    const int size = settings->size == CITY_FULL ? CITY_TEXTURE_PX : CITY_SMALL_TEXTURE_PX;
    for (int y = 0; y < size; y++)
        for (int x = 0; x < size; x++) {
            uint32_t h =
                (uint32_t)x * 2654435761u ^ (uint32_t)y * 40503u ^ (uint32_t)texture * 977u;
            h ^= h >> 15;
            h *= 0x2c1b3c6du;
            h ^= h >> 13;
            const uint32_t base = 120 + (uint32_t)(texture * 37) % 80;
            const uint32_t v = base + (h & 31);
            texels[y * size + x] =
                v | v << 8 | v << 16 | (texture == PAINT_LIGHT ? 0xffu << 24 : 0);
        }
}
