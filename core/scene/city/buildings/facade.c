#include "core/scene/city/buildings/facade.h"

#include <math.h>

#include "core/base/array.h"

point city_facade_at(const struct city_facade *f, double u, double y, double d)
{
    return (point){f->x + f->out.z * u + f->out.x * d, y, f->z - f->out.x * u + f->out.z * d};
}

void city_facade_quad(struct city_builder *b, const struct city_facade *f, double u0, double u1,
                      double y0, double y1, double d, uint32_t surface)
{
    const point corners[4] = {city_facade_at(f, u0, y0, d), city_facade_at(f, u1, y0, d),
                              city_facade_at(f, u1, y1, d), city_facade_at(f, u0, y1, d)};
    city_quad_on(b, corners, surface);
}

struct mapping city_facade_mapping(const struct city_facade *f, double bays, double y0,
                                   double tall_m)
{
    return (struct mapping){1 / (bays * f->bay_m), -1 / tall_m, f->out.z * f->x - f->out.x * f->z,
                            y0, false};
}

void city_facade_core(struct city_builder *b, struct city_facade *f)
{
    const struct look look = {
        f->texture, f->texture < PAINT_CURTAIN ? SCENERY_KIND_WALL : SCENERY_KIND_GLASS, 0, 0, 0};
    const struct mapping m = city_facade_mapping(f, PAINT_CELLS, f->y0, PAINT_CELLS * f->floor_m);
    // With a frame, the windows' plane ends where that of the adjacent sides begins.
    const bool framed = b->settings.size == CITY_FULL;
    const double in = framed ? f->style.depth_m : 0;
    f->core = -in;
    f->front = framed ? 0 : 0.1;
    f->painted = city_surface(b, &look, f->out, &m);
    city_facade_quad(b, f, in, f->length - in, f->y0, f->y0 + f->height_m, f->core, f->painted);
}

void city_facade_ends(struct city_builder *b, const struct city_facade *f, double y0)
{
    const double d = f->style.depth_m, y1 = f->y0 + f->height_m;
    const double wide = fmax(f->style.left * f->bay_m, d + 0.05);
    for (int end = 0; end < 2; end++) {
        const double u0 = end ? f->length - wide : 0, u1 = end ? f->length : wide;
        const double inner = end ? u0 : u1, turn = end ? -1 : 1;
        city_quad(b, city_facade_at(f, u0, y0, 0), city_facade_at(f, u1, y0, 0),
                  city_facade_at(f, u1, y1, 0), city_facade_at(f, u0, y1, 0), &f->wall);
        const point near0 = city_facade_at(f, inner, y0, 0),
                    far0 = city_facade_at(f, inner, y0, -d);
        const point near1 = city_facade_at(f, inner, y1, 0),
                    far1 = city_facade_at(f, inner, y1, -d);
        if (turn > 0)
            city_quad(b, near0, far0, far1, near1, &f->wall);
        else
            city_quad(b, far0, near0, near1, far1, &f->wall);
    }
}

void city_facade_keep(struct city_builder *b, struct city_facades *all, const struct city_facade *f)
{
    if (rg_array_fit(&all->facades, &all->room, (int64_t)all->count + 1, sizeof(*all->facades),
                     "city's facades"))
        all->facades[all->count++] = *f;
    else
        b->failed = true;
}
