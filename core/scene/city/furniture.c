// Street furniture: lamps, traffic lights, bollards, benches and parked cars, and the places of
// trees.
#include <math.h>

#include "core/scene/city/build.h"

// The purposes of pseudo-random numbers.
enum { CHANCE_TREE = 100, CHANCE_CAR, CHANCE_COLOUR, CHANCE_LIT };

static const struct look dark_metal = {PAINT_METAL + 1, SCENERY_KIND_METAL, 1, 0, 0};
static const struct look grey_metal = {PAINT_METAL, SCENERY_KIND_METAL, 1, 0, 0};

static bool is_full(const struct city_builder *b)
{
    return b->settings.size == CITY_FULL;
}

// A number derived from a place, for pseudo-random choices.
static uint32_t place_of(double x, double z)
{
    return (uint32_t)(int)((x + 200) * 10) * 4096u + (uint32_t)(int)((z + 200) * 10);
}

// Whether a place is so near to a camera that a thing there would fill its picture.
static bool is_before_camera(double x, double z)
{
    const struct rg_camera *const cameras[] = {&city_first_camera, &city_second_camera};
    bool before = false;
    for (int i = 0; i < 2; i++) {
        const float *p = cameras[i]->position;
        before |= hypot(x - (double)p[0], z - (double)p[2]) < 11;
    }
    return before;
}

// --- lamps ---

#define LAMP_HEIGHT_M 8.0
#define LAMP_ARM_M    2.2

// A lamp whose arm reaches over the road in the unit direction (dx, dz).
static void build_lamp(struct city_builder *b, double x, double z, double dx, double dz)
{
    const struct look light = {PAINT_LIGHT, SCENERY_KIND_LIGHT, 1, 0xb0d8ffu, 0};
    const double y = CITY_KERB_M, top = y + LAMP_HEIGHT_M;
    const double hx = x + dx * LAMP_ARM_M, hz = z + dz * LAMP_ARM_M;
    if (is_full(b)) // foot of the lamp
        city_post(b, x, z, y, y + 0.9, 0.16, 0.12, 8, &dark_metal);
    city_post(b, x, z, y, top, 0.09, 0.06, is_full(b) ? 8 : 3, &dark_metal);
    city_box(b, (point){fmin(x, hx) - 0.04, top - 0.10, fmin(z, hz) - 0.04},
             (point){fmax(x, hx) + 0.04, top - 0.02, fmax(z, hz) + 0.04}, BOX_ALL, &dark_metal);
    const double lx = 0.18 + 0.3 * fabs(dx), lz = 0.18 + 0.3 * fabs(dz);
    city_box(b, (point){hx - lx, top - 0.14, hz - lz}, (point){hx + lx, top + 0.06, hz + lz},
             BOX_ALL - BOX_Y0, &grey_metal);
    city_quad(b, (point){hx - lx, top - 0.14, hz - lz}, (point){hx + lx, top - 0.14, hz - lz},
              (point){hx + lx, top - 0.14, hz + lz}, (point){hx - lx, top - 0.14, hz + lz}, &light);
    city_lamp_add(b, CITY_STREET_LAMP, (point){hx, top - 0.2, hz}, (point){0, -1, 0});
}

static void build_lamps(struct city_builder *b, const struct city_island *o, int column)
{
    const double in = 0.6;
    const bool left_of_avenue = column == CITY_COLUMNS / 2 - 1;
    const bool right_of_avenue = column == CITY_COLUMNS / 2;
    for (int i = 0; i < 2; i++) {
        const double z = o->z0 + (o->z1 - o->z0) * (0.25 + 0.5 * i);
        const double x = o->x0 + (o->x1 - o->x0) * (0.25 + 0.5 * i);
        if (left_of_avenue || i == 0)
            build_lamp(b, o->x1 - in, z, 1, 0);
        if (right_of_avenue)
            build_lamp(b, o->x0 + in, z, -1, 0);
        if (i == 1)
            build_lamp(b, x, o->z1 - in, 0, 1);
    }
}

// --- traffic lights ---

// A traffic light's head with three lamps that faces (dx, dz); one of them is on.
static void build_signal(struct city_builder *b, double x, double z, double dx, double dz, bool red)
{
    const double y0 = CITY_KERB_M + 2.6, half = 0.16, height = 1.05, lamp = 0.11;
    city_box(b, (point){x - half, y0, z - half}, (point){x + half, y0 + height, z + half}, BOX_ALL,
             &dark_metal);
    for (int i = 0; i < 3; i++) { // green at the bottom, red on top
        const bool on = red ? i == 2 : i == 0;
        const uint32_t colours[3] = {0x60ff40u, 0x30c0ffu, 0x2828ffu};
        const uint32_t dim = colours[i] >> 2 & 0x3f3f3fu;
        const struct look look = {PAINT_LIGHT, SCENERY_KIND_LIGHT, 1, on ? colours[i] : dim,
                                  on ? 7 : 0};
        const double y = y0 + 0.2 + 0.33 * i, out = half + 0.01;
        const double cx = x + dx * out, cz = z + dz * out, rx = dz * lamp, rz = -dx * lamp;
        if (is_full(b) || on)
            city_quad(b, (point){cx - rx, y - lamp, cz - rz}, (point){cx + rx, y - lamp, cz + rz},
                      (point){cx + rx, y + lamp, cz + rz}, (point){cx - rx, y + lamp, cz - rz},
                      &look);
        if (is_full(b)) // visor
            city_box(b,
                     (point){fmin(cx - rx, cx + rx) - 0.02 + fmin(0, dx * 0.2), y + lamp,
                             fmin(cz - rz, cz + rz) - 0.02 + fmin(0, dz * 0.2)},
                     (point){fmax(cx - rx, cx + rx) + 0.02 + fmax(0, dx * 0.2), y + lamp + 0.02,
                             fmax(cz - rz, cz + rz) + 0.02 + fmax(0, dz * 0.2)},
                     BOX_ALL, &dark_metal);
        if (on)
            city_lamp_add(b, red ? CITY_TRAFFIC_RED : CITY_TRAFFIC_GREEN,
                          (point){x + dx * 0.4, y, z + dz * 0.4}, (point){dx, 0, dz});
    }
    if (is_full(b))
        city_post(b, x, z, CITY_KERB_M, y0, 0.06, 0.06, 8, &dark_metal);
}

// Traffic lights at the four corners of an island: the avenue has red.
static void build_signals(struct city_builder *b, const struct city_island *o)
{
    const double in = 0.7;
    build_signal(b, o->x1 - in, o->z0 + in, 0, -1, true);
    build_signal(b, o->x0 + in, o->z1 - in, 0, 1, true);
    build_signal(b, o->x0 + in, o->z0 + in, -1, 0, false);
    build_signal(b, o->x1 - in, o->z1 - in, 1, 0, false);
}

// --- trees ---

static void build_tree(struct city_builder *b, double x, double z, double y)
{
    if (!is_before_camera(x, z))
        city_build_tree(b, (point){x, y, z}, place_of(x, z));
}

// --- benches, bollards ---

static void build_bench(struct city_builder *b, double x, double z)
{
    const struct look wood = {PAINT_BARK, SCENERY_KIND_WALL, 1, 0x5a90c8u, 0};
    const double y = CITY_KERB_M;
    for (int i = 0; i < 4; i++)
        city_box(b, (point){x - 0.9, y + 0.42, z - 0.26 + 0.13 * i},
                 (point){x + 0.9, y + 0.46, z - 0.16 + 0.13 * i}, BOX_ALL, &wood);
    for (int i = 0; i < 3; i++)
        city_box(b, (point){x - 0.9, y + 0.55 + 0.13 * i, z + 0.27},
                 (point){x + 0.9, y + 0.65 + 0.13 * i, z + 0.31}, BOX_ALL, &wood);
    for (int i = -1; i <= 1; i += 2) {
        city_box(b, (point){x + 0.7 * i - 0.04, y, z - 0.24},
                 (point){x + 0.7 * i + 0.04, y + 0.42, z + 0.24}, BOX_ON_GROUND, &dark_metal);
        city_box(b, (point){x + 0.7 * i - 0.03, y + 0.42, z + 0.24},
                 (point){x + 0.7 * i + 0.03, y + 0.92, z + 0.27}, BOX_ALL, &dark_metal);
    }
}

static void build_plaza(struct city_builder *b, const struct city_block *block)
{
    const double y = CITY_KERB_M;
    for (double x = block->x0 + 12; x < block->x1 - 9; x += 8)
        for (double z = block->z0 + 12; z < block->z1 - 9; z += 8)
            if (city_chance(b, CHANCE_TREE, place_of(x, z), 2000) < 0.8)
                build_tree(b, x, z, y + 0.35);
    if (!is_full(b))
        return;
    for (double x = block->x0 + 8; x < block->x1 - 6; x += 6) {
        build_bench(b, x, block->z0 + 7.5);
        build_bench(b, x, block->z1 - 7.5);
    }
    for (double z = block->z0 + 1; z < block->z1; z += 2) {
        city_post(b, block->x0 - 3.6, z, y, y + 0.85, 0.09, 0.08, 8, &dark_metal);
        city_post(b, block->x1 + 2.2, z, y, y + 0.85, 0.09, 0.08, 8, &dark_metal);
    }
}

// --- cars ---

// A point on a car; its front is at the greatest z when the car stands along z.
static point car_point(double x, double z, bool along_z, double side, double y, double ahead)
{
    return along_z ? (point){x + side, y, z + ahead} : (point){x + ahead, y, z - side};
}

// Joins two outlines of four points each; `low` is the wider one.
static void car_body(struct city_builder *b, const point low[4], const point high[4],
                     const struct look *walls, const struct look *lid)
{
    for (int i = 0; i < 4; i++)
        city_quad(b, low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i], walls);
    city_quad(b, high[0], high[1], high[2], high[3], lid);
}

// The lights of a car that waits with its lights on, one at each end. A low beam's cone points so
// far down that it ends 2 degrees above the horizon.
static void light_car(struct city_builder *b, double x, double z, bool along_z)
{
    const double down = sin(12 * M_PI / 180), level = sqrt(1 - down * down);
    const point ahead = along_z ? (point){0, -down, level} : (point){level, -down, 0};
    const point behind = along_z ? (point){0, 0, -1} : (point){-1, 0, 0};
    city_lamp_add(b, CITY_HEADLIGHT, car_point(x, z, along_z, 0, 0.65, 2.3), ahead);
    city_lamp_add(b, CITY_TAIL_LIGHT, car_point(x, z, along_z, 0, 0.65, -2.3), behind);
}

// The two lamps of a car's end, between two heights and two places along the car.
static void car_lamps(struct city_builder *b, const point *car, bool along_z, const double y[2],
                      const double ahead[2], const struct look *look)
{
    for (int i = -1; i <= 1; i += 2) {
        const point p = car_point(car->x, car->z, along_z, 0.6 * i - 0.18, y[0], ahead[0]);
        const point q = car_point(car->x, car->z, along_z, 0.6 * i + 0.18, y[1], ahead[1]);
        city_box(b, (point){fmin(p.x, q.x), p.y, fmin(p.z, q.z)},
                 (point){fmax(p.x, q.x), q.y, fmax(p.z, q.z)}, BOX_ALL, look);
    }
}

static void build_car(struct city_builder *b, double x, double z, bool along_z)
{
    if (is_before_camera(x, z))
        return;
    const uint32_t id = place_of(x, z);
    const bool is_lit = city_chance(b, CHANCE_LIT, id, 0) < 0.65;
    if (is_lit)
        light_car(b, x, z, along_z);
    if (!is_full(b))
        return;
    static const uint32_t colours[] = {0x303030u, 0xd8d8d8u, 0x9a9a94u, 0x2a2a90u,
                                       0x803020u, 0x486048u, 0xf0f0f0u, 0x584030u};
    const uint32_t colour = colours[(int)(8 * city_chance(b, CHANCE_COLOUR, id, 0))];
    const struct look paint = {PAINT_METAL + 2, SCENERY_KIND_METAL, 2, colour, 0};
    const struct look glass = {PAINT_METAL + 1, SCENERY_KIND_GLASS, 2, 0x807060u, 0};
    const struct look tyre = {PAINT_METAL + 1, SCENERY_KIND_WALL, 1, 0x404040u, 0};
    const double w = 0.88, l = 2.15, top = 0.66;
    point o[4][4];
    const double rings[4][4] = {{w - 0.04, -l, l, 0.28},
                                {w, -l, l, 0.55},
                                {w - 0.06, -l + 0.05, l - 0.1, 0.88},
                                {top, -1.45, 0.55, 1.42}};
    for (int i = 0; i < 4; i++) {
        const double side = rings[i][0], back = rings[i][1], front = rings[i][2], y = rings[i][3];
        o[i][0] = car_point(x, z, along_z, -side, y, front);
        o[i][1] = car_point(x, z, along_z, side, y, front);
        o[i][2] = car_point(x, z, along_z, side, y, back);
        o[i][3] = car_point(x, z, along_z, -side, y, back);
    }
    point waist[4];
    waist[0] = car_point(x, z, along_z, -w + 0.1, 0.88, 1.15);
    waist[1] = car_point(x, z, along_z, w - 0.1, 0.88, 1.15);
    waist[2] = car_point(x, z, along_z, w - 0.1, 0.88, -1.95);
    waist[3] = car_point(x, z, along_z, -w + 0.1, 0.88, -1.95);
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 4; k++)
            city_quad(b, o[i][k], o[i][(k + 1) % 4], o[i + 1][(k + 1) % 4], o[i + 1][k], &paint);
    city_quad(b, o[2][0], o[2][1], o[2][2], o[2][3], &paint);
    car_body(b, waist, o[3], &glass, &paint);
    for (int i = 0; i < 4; i++) {
        const double ahead = i < 2 ? 1.35 : -1.3, side = i % 2 ? 0.62 : -0.84;
        const point p = car_point(x, z, along_z, side, 0, ahead - 0.32);
        const point q = car_point(x, z, along_z, side + 0.22, 0.62, ahead + 0.32);
        city_box(b, (point){fmin(p.x, q.x), 0, fmin(p.z, q.z)},
                 (point){fmax(p.x, q.x), 0.6, fmax(p.z, q.z)}, BOX_WALLS, &tyre);
    }
    const struct look tail = {PAINT_LIGHT, SCENERY_KIND_LIGHT, 1, 0x2020a0u, 2};
    const struct look head = {PAINT_LIGHT, SCENERY_KIND_LIGHT, 1, 0xd8f0ffu, 7};
    const point car = {x, 0, z};
    car_lamps(b, &car, along_z, (const double[]){0.58, 0.72},
              (const double[]){-l - 0.01, -l + 0.05}, &tail);
    if (is_lit)
        car_lamps(b, &car, along_z, (const double[]){0.58, 0.74},
                  (const double[]){l - 0.1, l + 0.01}, &head);
}

// Parks cars along the east and north side of an island.
static void build_cars(struct city_builder *b, const struct city_island *o)
{
    for (double z = o->z0 + 11; z < o->z1 - 11; z += 5.6)
        if (city_chance(b, CHANCE_CAR, place_of(o->x1, z), 0) < 0.55)
            build_car(b, o->x1 + 1.15, z, true);
    for (double x = o->x0 + 11; x < o->x1 - 11; x += 5.6)
        if (city_chance(b, CHANCE_CAR, place_of(x, o->z1), 0) < 0.45)
            build_car(b, x, o->z1 + 1.15, false);
}

// Plants trees along the avenue.
static void build_avenue(struct city_builder *b, const struct city_island *o, int column)
{
    const double x = column < CITY_COLUMNS / 2 ? o->x1 - 1.4 : o->x0 + 1.4;
    for (double z = o->z0 + 6; z < o->z1 - 4; z += 9)
        build_tree(b, x, z, CITY_KERB_M);
}

void city_build_furniture(struct city_builder *b)
{
    for (int column = 0; column < CITY_COLUMNS; column++) {
        for (int row = 0; row < CITY_ROWS; row++) {
            const struct city_block block = city_block_at(column, row);
            const struct city_island island = city_island_at(column, row);
            build_lamps(b, &island, column);
            build_signals(b, &island);
            if (block.plaza)
                build_plaza(b, &block);
            build_cars(b, &island); // the small city has their lights alone
            if (is_full(b) && (column == CITY_COLUMNS / 2 || column == CITY_COLUMNS / 2 - 1))
                build_avenue(b, &island, column);
        }
    }
}
