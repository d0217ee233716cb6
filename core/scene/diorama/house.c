// Two houses: one with corrugated tiles, shutters, flowers and a rain barrel, and a plain one. Both
// show their gable to +z.
#include <math.h>

#include "core/scene/diorama/build.h"

// --- roofs ---

// One slope of a roof: half the roof's width, and the heights of eave and ridge.
struct slope {
    double half, eave, ridge, back, front; // z of its ends
};

// A point of a slope: the share 0 to 1 of the way up, and the distance off it.
static point on_slope(const struct slope *s, int side, double up, double z, double off)
{
    const double rise = s->ridge - s->eave, length = sqrt(s->half * s->half + rise * rise);
    return (point){side * (s->half * (1 - up) + off * rise / length),
                   s->eave + rise * up + off * s->half / length, z};
}

static void boards(struct builder *b, const struct slope *s, double thick, enum paint paint)
{
    for (int side = -1; side <= 1; side += 2) {
        point p[4];
        for (int k = 0; k < 4; k++)
            p[k] = on_slope(s, side, k == 1 || k == 2, 0, k >= 2 ? 0 : -thick);
        struct spot outline[4];
        for (int k = 0; k < 4; k++)
            outline[k] = (struct spot){p[side > 0 ? 3 - k : k].x, p[side > 0 ? 3 - k : k].y};
        prism(b, outline, 4, s->back, s->front, paint);
    }
}

enum { TILES = 11, TILE_SEGMENTS = 4, TILE_ROWS = 8, ACROSS = TILES * TILE_SEGMENTS };

// A row of tiles from side to side: waves, lifted where they overlap the row below.
static void tile_row(struct builder *b, const struct slope *s, int side, int row)
{
    point points[3 * (ACROSS + 1)];
    const double share = 1.0 / TILE_ROWS;
    for (int i = 0; i < 3; i++) {
        const double up = share * (row + (i == 0 ? -0.18 : 0.5 * i));
        const double lift = i == 0 ? 0.10 : i == 1 ? 0.075 : 0.05;
        for (int j = 0; j <= ACROSS; j++) {
            const double along = (double)j / ACROSS, wave = cosine(360.0 * j / TILE_SEGMENTS);
            const double z = side > 0 ? s->front + (s->back - s->front) * along
                                      : s->back + (s->front - s->back) * along;
            points[i * (ACROSS + 1) + j] = on_slope(s, side, up, z, lift + 0.045 * wave);
        }
    }
    sheet(b, points, ACROSS, 2, PAINT_TILE);
    builder_end(b, 180);
}

static void tiles(struct builder *b, const struct slope *s)
{
    for (int row = 0; row < TILE_ROWS; row++)
        for (int side = -1; side <= 1; side += 2)
            tile_row(b, s, side, row);
    const double length = (s->front - s->back) / 10;
    for (int i = 0; i < 10; i++) {
        const double z = s->back + length * i;
        const point ends[3] = {{0, s->ridge + 0.05, z - 0.05},
                               {0, s->ridge + 0.07, z + length / 2},
                               {0, s->ridge + 0.09, z + length + 0.05}};
        bar(b, ends, 3, 0.15, 0.17, 10, PAINT_TILE);
    }
}

// --- windows and doors ---

static void shutters(struct builder *b, double half, double height)
{
    for (int side = -1; side <= 1; side += 2) {
        const double x = side * (half + 0.28);
        soft_box(b, (point){x - 0.2, 0, 0.02}, (point){x + 0.2, height, 0.09}, 0.02, 1, PAINT_TEAL);
        for (int i = 0; i < 3; i++) {
            const double y = height * (i + 0.75) / 3.5;
            const point slat[2] = {{x - 0.13, y, 0.095}, {x + 0.13, y, 0.095}};
            bar(b, slat, 2, 0.025, 0.025, 6, PAINT_TEAL);
        }
    }
}

static void window_bars(struct builder *b, double half, double height)
{
    const double y[2] = {0, height};
    for (int i = 0; i < 2; i++) {
        soft_box(b, (point){-half - 0.07, y[i] - 0.07, 0}, (point){half + 0.07, y[i] + 0.07, 0.11},
                 0.02, 1, PAINT_WHITE);
        const double x = i ? half : -half;
        soft_box(b, (point){x - 0.07, 0, 0}, (point){x + 0.07, height, 0.1}, 0.02, 1, PAINT_WHITE);
    }
    const point upright[2] = {{0, 0, 0.05}, {0, height, 0.05}};
    const point level[2] = {{-half, height / 2, 0.05}, {half, height / 2, 0.05}};
    bar(b, upright, 2, 0.035, 0.035, 6, PAINT_WHITE);
    bar(b, level, 2, 0.035, 0.035, 6, PAINT_WHITE);
}

// A window on the wall z = 0, with `at` in the middle of its sill.
static void window(struct builder *b, point at, double turn_deg, double half, double height)
{
    const struct frame was = builder_enter(b, at, turn_deg, 1);
    box(b, (point){-half, 0, -0.05}, (point){half, height, 0.02}, PAINT_GLASS);
    window_bars(b, half, height);
    shutters(b, half, height);
    builder_leave(b, was);
}

static void flower_box(struct builder *b, point at, double turn_deg, uint32_t id)
{
    static const enum paint petals[] = {PAINT_PINK, PAINT_YELLOW, PAINT_WHITE, PAINT_ORANGE};
    const struct frame was = builder_enter(b, at, turn_deg, 1);
    soft_box(b, (point){-0.62, -0.26, 0.1}, (point){0.62, -0.04, 0.36}, 0.03, 1, PAINT_WOOD);
    for (uint32_t i = 0; i < 3; i++)
        flower(b, (point){-0.38 + 0.38 * i, -0.05, 0.22}, 0.42 + 0.08 * chance(id, i),
               petals[(i + id) % 4], id + i);
    builder_leave(b, was);
}

static void door(struct builder *b, point at)
{
    struct spot outline[18];
    const struct frame was = builder_enter(b, at, 0, 1);
    for (int ring = 0; ring < 2; ring++) {
        const double half = ring ? 0.50 : 0.62, top = 1.55;
        outline[0] = (struct spot){-half, 0};
        outline[1] = (struct spot){half, 0};
        for (int i = 0; i <= 12; i++)
            outline[2 + i] = (struct spot){half * cosine(15.0 * i), top + half * sine(15.0 * i)};
        prism(b, outline, 15, -0.05, ring ? 0.10 : 0.06, ring ? PAINT_BLUE : PAINT_PALE_STONE);
    }
    ball(b, (point){0.36, 1.0, 0.15}, (point){0.05, 0.05, 0.05}, 6, 10, 0, 1, PAINT_YELLOW);
    ball(b, (point){0, 1.55, 0.1}, (point){0.2, 0.2, 0.03}, 6, 16, 0, 2, PAINT_GLASS);
    soft_box(b, (point){-0.8, -0.2, 0}, (point){0.8, 0, 0.7}, 0.03, 1, PAINT_PALE_STONE);
    soft_box(b, (point){-1.0, -0.4, 0}, (point){1.0, -0.2, 1.1}, 0.03, 1, PAINT_STONE);
    const point arm[4] = {
        {0.95, 1.85, 0}, {0.95, 1.98, 0.1}, {0.95, 1.98, 0.25}, {0.95, 1.88, 0.3}};
    bar(b, arm, 4, 0.02, 0.02, 6, PAINT_IRON);
    ball(b, (point){0.95, 1.74, 0.3}, (point){0.1, 0.14, 0.1}, 8, 12, 0, 3, PAINT_LIGHT);
    builder_leave(b, was);
}

static void chimney(struct builder *b, double x, double z, double low, double high)
{
    box(b, (point){x - 0.35, low, z - 0.35}, (point){x + 0.35, high, z + 0.35}, PAINT_BRICK);
    soft_box(b, (point){x - 0.45, high, z - 0.45}, (point){x + 0.45, high + 0.16, z + 0.45}, 0.04,
             1, PAINT_PALE_STONE);
    const struct profile pot[] = {{0.16, 0},   {0.13, 0.3}, {0.17, 0.34}, {0.17, 0.4},
                                  {0.11, 0.4}, {0.1, 0.1},  {0, 0.1}};
    lathe(b, (point){x, high + 0.16, z}, pot, 7, 14, 60, PAINT_TILE);
}

// --- the garden ---

static void barrel(struct builder *b, point at)
{
    const struct profile staves[] = {{0, 0},      {0.34, 0},    {0.40, 0.3},
                                     {0.42, 0.5}, {0.40, 0.72}, {0.35, 1.0},
                                     {0.30, 1.0}, {0.30, 0.9},  {0, 0.9}};
    lathe(b, at, staves, 8, 18, 60, PAINT_WOOD);
    ball(b, (point){at.x, at.y + 0.9, at.z}, (point){0.31, 0.02, 0.31}, 4, 18, 0, 1, PAINT_WATER);
    for (int i = 0; i < 2; i++)
        ring(b, (point){at.x, at.y + 0.25 + 0.5 * i, at.z}, 0.40, 0.03, 6, 18, PAINT_IRON);
}

static void stepping_stones(struct builder *b, double z0, int count)
{
    for (int i = 0; i < count; i++)
        ball(b, (point){0.18 * sine(70.0 * i), 0, z0 + 0.62 * i}, (point){0.42, 0.05, 0.27}, 4, 12,
             0.05, 70 + (uint32_t)i, PAINT_PALE_STONE);
}

void build_house1(struct builder *b)
{
    const struct spot gable[] = {{-3, 0}, {3, 0}, {3, 3}, {0, 5.3}, {-3, 3}};
    const struct slope roof = {3.55, 2.72, 5.44, -2.75, 2.75};
    puddle(b, (point){0, 0, 0.4}, 6.4, 6.4, 5, 48, 0.01, 1, PAINT_LAWN);
    soft_box(b, (point){-3.1, -0.1, -2.5}, (point){3.1, 0.4, 2.5}, 0.05, 1, PAINT_STONE);
    prism(b, gable, 5, -2.4, 2.4, PAINT_PLASTER);
    boards(b, &roof, 0.14, PAINT_PALE_WOOD);
    tiles(b, &roof);
    chimney(b, 1.5, -0.9, 3.6, 5.9);
    door(b, (point){0, 0.4, 2.4});
    for (int side = -1; side <= 1; side += 2) {
        window(b, (point){1.85 * side, 1.25, 2.4}, 0, 0.42, 1.15);
        flower_box(b, (point){1.85 * side, 1.2, 2.4}, 0, 80 + (uint32_t)(side + 1) * 10);
        window(b, (point){3, 1.25, 1.1 * side}, 90, 0.42, 1.15);
    }
    window(b, (point){0, 3.35, 2.4}, 0, 0.42, 0.95);
    const struct frame was = builder_tilt(b, (point){0, 4.72, 2.4}, 90, -90);
    ring(b, (point){0, 0, 0}, 0.22, 0.05, 6, 16, PAINT_WHITE);
    builder_leave(b, was);
    barrel(b, (point){3.5, 0, 2.5});
    stepping_stones(b, 3.9, 5);
    tree(b, (point){-4.4, 0, -1.2}, 5.2, 0.75, PAINT_LEAF, 60);
    bush(b, (point){-2.6, 0, 3.1}, 0.55, 7, 61);
    bush(b, (point){-3.4, 0, 2.9}, 0.42, 6, 62);
    bush(b, (point){2.2, 0, 3.1}, 0.45, 7, 63);
}

void build_house2(struct builder *b)
{
    const struct spot gable[] = {{-2.2, 0}, {2.2, 0}, {2.2, 2.5}, {0, 4.3}, {-2.2, 2.5}};
    const struct slope roof = {2.7, 2.24, 4.46, -2.1, 2.1};
    puddle(b, (point){0, 0, 0.4}, 5, 5, 2, 24, 0.02, 1, PAINT_LAWN);
    prism(b, gable, 5, -1.8, 1.8, PAINT_CREAM);
    boards(b, &roof, 0.16, PAINT_TILE);
    box(b, (point){0.9, 2.9, -0.7}, (point){1.4, 4.7, -0.2}, PAINT_BRICK);
    box(b, (point){-0.45, 0, 1.8}, (point){0.45, 1.85, 1.86}, PAINT_TEAL);
    box(b, (point){-0.65, 0, 1.8}, (point){0.65, 0.14, 2.5}, PAINT_PALE_STONE);
    for (int side = -1; side <= 1; side += 2) {
        const double x = 1.35 * side;
        box(b, (point){x - 0.42, 0.95, 1.8}, (point){x + 0.42, 1.95, 1.88}, PAINT_WHITE);
        box(b, (point){x - 0.33, 1.04, 1.8}, (point){x + 0.33, 1.86, 1.9}, PAINT_GLASS);
    }
    box(b, (point){2.2, 0.95, -0.5}, (point){2.28, 1.95, 0.5}, PAINT_WHITE);
    box(b, (point){2.2, 1.04, -0.41}, (point){2.3, 1.86, 0.41}, PAINT_GLASS);
    ball(b, (point){0.32, 0.95, 1.9}, (point){0.06, 0.06, 0.06}, 4, 8, 0, 1, PAINT_YELLOW);
    for (int i = 0; i < 3; i++)
        ball(b, (point){0.2 * sine(80.0 * i), 0, 3.0 + 0.6 * i}, (point){0.4, 0.06, 0.26}, 4, 9,
             0.04, 90 + (uint32_t)i, PAINT_PALE_STONE);
    const point trunk[3] = {{-3.1, 0, -0.4}, {-3.1, 0.9, -0.4}, {-3.0, 1.7, -0.4}};
    bar(b, trunk, 3, 0.2, 0.1, 8, PAINT_BARK);
    ball(b, (point){-3.05, 2.5, -0.4}, (point){1.05, 1.15, 1.05}, 7, 11, 0.05, 3, PAINT_LEAF);
    ball(b, (point){-3.5, 1.9, 0.1}, (point){0.6, 0.55, 0.6}, 5, 9, 0.05, 4, PAINT_LEAF);
    ball(b, (point){2.9, 0.35, 1.3}, (point){0.55, 0.45, 0.5}, 5, 9, 0.05, 5, PAINT_DARK_LEAF);
}
