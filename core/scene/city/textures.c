#include "core/scene/city/textures.h"

#include "kernels/dialect/rng.h"

enum { CHANCE_FACADE = 400 };

struct facade_style city_facade_style(const struct city_settings *settings, int texture)
{
    const rg_uint4 c = rg_random((uint)settings->seed, (uint)texture, 0, CHANCE_FACADE);
    const double a = (double)rg_uniform(c.x), d = (double)rg_uniform(c.y);
    const double e = (double)rg_uniform(c.z);
    if (texture >= PAINT_CURTAIN)
        return (struct facade_style){0.05, 0.95, 0.22, 0.97, PAINT_METAL + (int)(2 * a), 0.12};
    const double side = 0.16 + 0.12 * a;
    return (struct facade_style){
        side, 1 - side, 0.2 + 0.12 * d, 0.78 + 0.08 * e, PAINT_WALL + texture % PAINT_WALLS, 0.25};
}
