// Buildings: tiers that step back, with facades, cornices, roofs and structures on them.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/scene/city/buildings/facade.h"
#include "core/scene/city/buildings/lots.h"
#include "core/scene/city/buildings/relief.h"

enum { CHANCE_HEIGHT = 300, CHANCE_STYLE, CHANCE_TIER, CHANCE_ROOF, CHANCE_SHOP };

#define SHOP_M    4.4 // a ground floor's height
#define CORNICE_M 0.35
#define WITHIN_M  0.6 // so far inside a tier's sides, its faces hide everything

// The state of a building in construction.
struct building {
    struct city_builder *b;
    struct city_facades *facades;
    struct city_lot lot;
    double height_m;
    int texture; // texture of its facades
    struct look wall, roof;
    bool landmark; // the highest building
};

struct tier {
    double x0, z0, x1, z1, y0, y1;
    int street; // bits of the sides with windows
};

static double chance(const struct building *t, int what, uint32_t k)
{
    return city_chance(t->b, (uint32_t)what, t->lot.id, k);
}

// --- facades ---

// The lights of shining signs. A point stands for a sign 7 m wide and 0.7 m high that is 0.5 m
// behind the posts; 0.5 m further back, it is neither too bright nearby nor too faint far away.
static void light_signs(struct building *t, const struct city_facade *f, double y0, int shops,
                        int texture)
{
    const double y = y0 + SHOP_M * (double)(CITY_SIGN_LOW + CITY_SIGN_HIGH) / 2;
    const int shop = texture - PAINT_SHOP;
    if (!t->b->signs[shop].is_known) {
        t->b->signs[shop].is_known = true;
        t->b->signs[shop].shines = city_shop_sign(&t->b->settings, texture, t->b->signs[shop].tint);
    }
    for (int i = 0; t->b->signs[shop].shines && i < shops; i++) {
        const point at = city_facade_at(f, (i + 0.5) * f->length / shops, y, -1);
        struct city_lamp *lamp = city_lamp_add(t->b, CITY_SIGN, at, f->out);
        if (lamp)
            memcpy(lamp->tint, t->b->signs[shop].tint, sizeof(lamp->tint));
    }
}

// The ground floor: shops behind posts, with a band of signs above.
static void build_shops(struct building *t, const struct city_facade *f, double y0)
{
    const struct look look = {PAINT_SHOP + (int)(CITY_SHOPS * chance(t, CHANCE_SHOP, 0)),
                              SCENERY_KIND_GLASS, 0, 0, 0};
    const bool framed = t->b->settings.size == CITY_FULL;
    const double d = framed ? 0.5 : 0, y1 = y0 + SHOP_M;
    const double shops = fmax(1, floor(f->length / 7 + 0.5));
    struct city_facade wide = *f;
    wide.bay_m = f->length / shops;
    light_signs(t, f, y0, (int)shops, look.texture);
    const struct mapping m = city_facade_mapping(&wide, 1, y1, SHOP_M);
    const uint32_t surface = city_surface(t->b, &look, f->out, &m);
    city_facade_quad(t->b, f, d, f->length - d, y0, y1, -d, surface);
    if (!framed)
        return;
    // the band over the windows, and its underside
    city_quad(t->b, city_facade_at(f, 0, y1 - 0.45, 0), city_facade_at(f, f->length, y1 - 0.45, 0),
              city_facade_at(f, f->length, y1, 0), city_facade_at(f, 0, y1, 0), &t->wall);
    city_quad(
        t->b, city_facade_at(f, 0, y1 - 0.45, -d), city_facade_at(f, f->length, y1 - 0.45, -d),
        city_facade_at(f, f->length, y1 - 0.45, 0), city_facade_at(f, 0, y1 - 0.45, 0), &t->wall);
    for (int i = 0; i <= (int)shops; i++) {
        const double u0 = fmax(0, i * wide.bay_m - 0.35),
                     u1 = fmin(f->length, i * wide.bay_m + 0.35);
        city_quad(t->b, city_facade_at(f, u0, y0, 0), city_facade_at(f, u1, y0, 0),
                  city_facade_at(f, u1, y1 - 0.45, 0), city_facade_at(f, u0, y1 - 0.45, 0),
                  &t->wall);
        if (i < (int)shops)
            city_quad(t->b, city_facade_at(f, u1, y0, 0), city_facade_at(f, u1, y0, -d),
                      city_facade_at(f, u1, y1 - 0.45, -d), city_facade_at(f, u1, y1 - 0.45, 0),
                      &t->wall);
        if (i > 0)
            city_quad(t->b, city_facade_at(f, u0, y0, -d), city_facade_at(f, u0, y0, 0),
                      city_facade_at(f, u0, y1 - 0.45, 0), city_facade_at(f, u0, y1 - 0.45, -d),
                      &t->wall);
    }
}

// One side of a tier.
static void build_side(struct building *t, const struct tier *r, int side)
{
    struct city_facade f = {.y0 = r->y0, .texture = t->texture, .wall = t->wall};
    const double wide = r->x1 - r->x0, deep = r->z1 - r->z0;
    f.x = side == BOX_X0 || side == BOX_Z1 ? r->x0 : r->x1;
    f.z = side == BOX_X0 || side == BOX_Z0 ? r->z0 : r->z1;
    if (side == BOX_Z0 || side == BOX_Z1)
        f.out.z = side == BOX_Z1 ? 1 : -1;
    else
        f.out.x = side == BOX_X1 ? 1 : -1;
    f.length = f.out.z != 0 ? wide : deep;
    if (!(r->street & side)) { // a blank wall, which a neighbour may hide
        city_quad(t->b, city_facade_at(&f, 0, r->y0, 0), city_facade_at(&f, f.length, r->y0, 0),
                  city_facade_at(&f, f.length, r->y1, 0), city_facade_at(&f, 0, r->y1, 0),
                  &t->wall);
        return;
    }
    f.style = city_facade_style(&t->b->settings, t->texture);
    f.bays = (int)fmax(2, floor(f.length / (t->texture < PAINT_CURTAIN ? 3.0 : 2.6) + 0.5));
    f.bay_m = f.length / f.bays;
    if (r->y0 < 1) {
        build_shops(t, &f, r->y0);
        f.y0 += SHOP_M;
    }
    f.height_m = r->y1 - f.y0;
    f.floors = (int)fmax(1, floor(f.height_m / 3.5 + 0.5));
    f.floor_m = f.height_m / f.floors;
    city_facade_core(t->b, &f);
    if (t->b->settings.size == CITY_FULL)
        city_facade_ends(t->b, &f, f.y0);
    city_facade_keep(t->b, t->facades, &f);
}

// --- roofs ---

// A box-shaped ring without lid: outside, top, inside, and the overhanging underside.
static void build_cornice(struct building *t, const struct tier *r)
{
    const double out = CORNICE_M, in = 0.3, y0 = r->y1 - 0.5, y1 = r->y1 + 0.8;
    const double ox0 = r->x0 - (r->street & BOX_X0 ? out : 0);
    const double ox1 = r->x1 + (r->street & BOX_X1 ? out : 0);
    const double oz0 = r->z0 - (r->street & BOX_Z0 ? out : 0);
    const double oz1 = r->z1 + (r->street & BOX_Z1 ? out : 0);
    const double ix0 = r->x0 + in, ix1 = r->x1 - in, iz0 = r->z0 + in, iz1 = r->z1 - in;
    city_box(t->b, (point){ox0, y0, oz0}, (point){ox1, y1, oz1}, BOX_WALLS, &t->wall);
    const point o[4] = {{ox0, y1, oz1}, {ox1, y1, oz1}, {ox1, y1, oz0}, {ox0, y1, oz0}};
    const point i[4] = {{ix0, y1, iz1}, {ix1, y1, iz1}, {ix1, y1, iz0}, {ix0, y1, iz0}};
    const point f[4] = {{ix0, r->y1, iz1}, {ix1, r->y1, iz1}, {ix1, r->y1, iz0}, {ix0, r->y1, iz0}};
    const point under_o[4] = {{ox0, y0, oz1}, {ox1, y0, oz1}, {ox1, y0, oz0}, {ox0, y0, oz0}};
    const double c = 0.5; // deep enough to meet the windows' plane
    const point under_i[4] = {{r->x0 + c, y0, r->z1 - c},
                              {r->x1 - c, y0, r->z1 - c},
                              {r->x1 - c, y0, r->z0 + c},
                              {r->x0 + c, y0, r->z0 + c}};
    for (int k = 0; k < 4; k++) {
        const int n = (k + 1) % 4;
        city_quad(t->b, o[k], o[n], i[n], i[k], &t->wall);
        city_quad(t->b, i[k], i[n], f[n], f[k], &t->wall);
        city_quad(t->b, under_o[n], under_o[k], under_i[k], under_i[n], &t->wall);
    }
    city_quad(t->b, f[0], f[1], f[2], f[3], &t->roof);
}

static void build_plant(struct building *t, const struct tier *r)
{
    const struct look metal = {PAINT_METAL, SCENERY_KIND_METAL, 2, 0, 0};
    const int boxes = 2 + (int)(4 * chance(t, CHANCE_ROOF, 0));
    const double wide = r->x1 - r->x0 - 3, deep = r->z1 - r->z0 - 3;
    for (int i = 0; i < boxes && wide > 4 && deep > 4; i++) {
        const uint32_t k = 10 * (uint32_t)(i + 1);
        const double w = 1 + 2.4 * chance(t, CHANCE_ROOF, k),
                     h = 1 + 2.2 * chance(t, CHANCE_ROOF, k + 1);
        const double d = 1 + 2.4 * chance(t, CHANCE_ROOF, k + 2);
        const double x = r->x0 + 1.5 + (wide - w) * chance(t, CHANCE_ROOF, k + 3);
        const double z = r->z0 + 1.5 + (deep - d) * chance(t, CHANCE_ROOF, k + 4);
        city_box(t->b, (point){x, r->y1, z}, (point){x + w, r->y1 + h, z + d}, BOX_ON_GROUND,
                 i ? &metal : &t->wall);
    }
    if (t->b->settings.size == CITY_FULL && r->y1 < 60 && chance(t, CHANCE_ROOF, 1) < 0.4) {
        const struct look wood = {PAINT_BARK, SCENERY_KIND_WALL, 2, 0x80a0c0u, 0}; // water tank
        const double x = (r->x0 + r->x1) / 2, z = (r->z0 + r->z1) / 2, y = r->y1;
        for (int i = 0; i < 4; i++)
            city_post(t->b, x + (i & 1 ? 1 : -1), z + (i & 2 ? 1 : -1), y, y + 2.2, 0.1, 0.1, 4,
                      &metal);
        city_post(t->b, x, z, y + 2.2, y + 5.2, 1.7, 1.7, 12, &wood);
        city_post(t->b, x, z, y + 5.2, y + 6.3, 1.8, 0, 12, &metal);
    }
    if (r->y1 > 45 && !t->landmark)
        city_post(t->b, (r->x0 + r->x1) / 2 + 1, (r->z0 + r->z1) / 2, r->y1,
                  r->y1 + 6 + 10 * chance(t, CHANCE_ROOF, 2), 0.15, 0.05, 4, &metal);
}

// The landmark's mast ends in three faces, which make the city's number of triangles odd.
static void build_mast(struct building *t, const struct tier *r)
{
    const struct look metal = {PAINT_METAL, SCENERY_KIND_METAL, 2, 0, 0};
    const double x = (r->x0 + r->x1) / 2, z = (r->z0 + r->z1) / 2, y = r->y1;
    city_post(t->b, x, z, y, y + 4, 2.6, 2.0, 8, &t->wall);
    city_post(t->b, x, z, y + 4, y + 12, 0.8, 0.5, 8, &metal);
    city_post(t->b, x, z, y + 12, CITY_HEIGHT_M, 0.35, 0, 3, &metal);
}

// --- buildings ---

static void build_tier(struct building *t, const struct tier *r, bool top)
{
    for (int side = BOX_X0; side <= BOX_Z1; side <<= 1)
        if (side & BOX_WALLS)
            build_side(t, r, side);
    const double in = WITHIN_M;
    city_box_add(t->b, (point){r->x0 + in, r->y0, r->z0 + in},
                 (point){r->x1 - in, r->y1 - in, r->z1 - in});
    if (t->b->settings.size == CITY_FULL)
        build_cornice(t, r);
    else
        city_box(t->b, (point){r->x0, r->y1 - 1, r->z0}, (point){r->x1, r->y1, r->z1}, BOX_Y1,
                 &t->roof);
    if (top && t->landmark)
        build_mast(t, r);
    else if (top || t->b->settings.size == CITY_FULL)
        build_plant(t, r);
}

// The next tier steps back by `in` on all sides; all sides have windows, because it is above its
// neighbours.
static struct tier next_tier(const struct tier *r, double in, double y1)
{
    return (struct tier){r->x0 + in, r->z0 + in, r->x1 - in, r->z1 - in, r->y1, y1, BOX_WALLS};
}

// Finds the heights at which tiers end; returns their number.
static int find_ends(const struct building *t, double ends[4])
{
    const double h = t->height_m;
    int count = 1;
    for (int i = 0; i < 4; i++)
        ends[i] = h;
    if (h > 34) {
        ends[0] = fmin(0.45 * h, 14 + 16 * chance(t, CHANCE_TIER, 0));
        count = h > 130 ? 4 : h > 80 ? 3 : 2;
        ends[1] = count > 2 ? h * (0.5 + 0.2 * chance(t, CHANCE_TIER, 1)) : h;
        ends[2] = count > 3 ? ends[1] + (h - ends[1]) * 0.6 : h;
    }
    return count;
}

static void build_tiers(struct building *t)
{
    const struct city_lot *lot = &t->lot;
    double ends[4];
    int count = find_ends(t, ends);
    struct tier r = {lot->x0, lot->z0, lot->x1, lot->z1, CITY_KERB_M, ends[0], lot->street};
    for (int i = 0; i < count; i++) {
        const double side = fmin(r.x1 - r.x0, r.z1 - r.z0);
        const double in = i == 0 ? 1.0 + 2 * chance(t, CHANCE_TIER, 2) : 1.4;
        if (i + 1 == count ||
            side - 2 * in < (t->landmark ? 6 : 9)) { // too slender for another step back
            r.y1 = t->height_m;
            count = i + 1;
        }
        build_tier(t, &r, i + 1 == count);
        r = next_tier(&r, in, i + 1 < 4 ? ends[i + 1] : t->height_m);
    }
}

// The height of a building: the nearer to the middle, the higher.
static double height_at(const struct building *t)
{
    const struct city_lot *lot = &t->lot;
    const double x = (lot->x0 + lot->x1) / 2, z = (lot->z0 + lot->z1) / 2, r2 = x * x + z * z;
    const double towers = 165 * exp(-r2 / (95 * 95)), houses = 16 + 12 * exp(-r2 / (190.0 * 190));
    const double c = chance(t, CHANCE_HEIGHT, 0), k = chance(t, CHANCE_HEIGHT, 1);
    return fmin(houses * (0.7 + 0.6 * k) + towers * c * (0.35 + 0.65 * c), 188);
}

static void choose_looks(struct building *t)
{
    const bool glass = t->height_m > 60 ? (t->landmark || chance(t, CHANCE_STYLE, 0) < 0.55)
                                        : chance(t, CHANCE_STYLE, 0) < 0.12;
    const int first = glass ? PAINT_CURTAIN : PAINT_FACADE;
    const int end = glass ? PAINT_SHOP : PAINT_CURTAIN;
    t->texture = first + (int)((end - first) * chance(t, CHANCE_STYLE, 1));
    const struct facade_style style = city_facade_style(&t->b->settings, t->texture);
    t->wall = (struct look){style.wall, glass ? SCENERY_KIND_METAL : SCENERY_KIND_WALL, 4, 0, 0};
    t->roof = (struct look){PAINT_ROOF + (int)(6 * chance(t, CHANCE_STYLE, 2)), SCENERY_KIND_ROOF,
                            6, 0, 0};
}

// Whether a lot is the landmark's: the one at the avenue and the plaza's far corner.
static bool is_landmark(const struct city_block *block, const struct city_lot *lot)
{
    const bool here = block->index == (CITY_ROWS / 2 - 1) * CITY_COLUMNS + CITY_COLUMNS / 2;
    return here && lot->x0 == block->x0 && lot->z1 == block->z1;
}

void city_build_buildings(struct city_builder *b, int triangles)
{
    struct city_facades facades = {0};
    for (int row = 0; row < CITY_ROWS; row++) {
        for (int column = 0; column < CITY_COLUMNS; column++) {
            const struct city_block block = city_block_at(column, row);
            struct city_lot lots[CITY_MOST_LOTS];
            const int count = block.plaza ? 0 : city_lots(b, &block, lots);
            for (int i = 0; i < count; i++) {
                struct building t = {.b = b, .facades = &facades, .lot = lots[i]};
                t.landmark = is_landmark(&block, &lots[i]);
                t.height_m = t.landmark ? 196 : height_at(&t);
                choose_looks(&t);
                build_tiers(&t);
            }
        }
    }
    city_relief(b, &facades, triangles);
    free(facades.facades);
}
