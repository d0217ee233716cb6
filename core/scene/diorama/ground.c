// A patch of ground close by: cobbles and a kerb, a gully, puddles, stones and mushrooms.
#include "core/scene/diorama/build.h"

static void cobbles(struct builder *b)
{
    for (int row = 0; row < 4; row++) {
        for (int i = 0; i < 7; i++) {
            const uint32_t id = (uint32_t)(row * 16 + i);
            const double x = -1.76 + 0.50 * i + (row % 2 ? 0.25 : 0), z = 0.72 + 0.34 * row;
            if (x > 1.7 || (i == 3 && row == 1))
                continue;
            soft_box(b, (point){x, -0.12, z},
                     (point){x + 0.46, 0.045 + 0.03 * chance(200, id), z + 0.31}, 0.06, 1,
                     id % 5 == 2 ? PAINT_PALE_STONE
                     : id % 3    ? PAINT_STONE
                                 : PAINT_DARK_STONE);
        }
    }
}

static void kerb(struct builder *b)
{
    for (int i = 0; i < 4; i++)
        soft_box(b, (point){-1.92 + 0.96 * i, -0.1, 0.42}, (point){-0.99 + 0.96 * i, 0.17, 0.68},
                 0.035, 1, PAINT_PALE_STONE);
}

static void mushroom(struct builder *b, point at, double size, double turn_deg)
{
    const struct frame was = builder_tilt(b, at, 8, turn_deg);
    const double s = size;
    const struct profile stalk[] = {
        {0, 0}, {0.16 * s, 0}, {0.13 * s, 0.2 * s}, {0.1 * s, 0.6 * s}, {0, 0.65 * s}};
    const struct profile cap[] = {{0, 0.58 * s},        {0.36 * s, 0.52 * s}, {0.42 * s, 0.56 * s},
                                  {0.36 * s, 0.74 * s}, {0.2 * s, 0.88 * s},  {0, 0.93 * s}};
    lathe(b, (point){0, 0, 0}, stalk, 5, 12, 180, PAINT_CREAM);
    lathe(b, (point){0, 0, 0}, cap, 6, 18, 180, PAINT_RED);
    for (int i = 0; i < 5; i++)
        ball(b, (point){0.27 * s * sine(72.0 * i), 0.8 * s, 0.27 * s * cosine(72.0 * i)},
             (point){0.06 * s, 0.05 * s, 0.06 * s}, 4, 8, 0, 1, PAINT_WHITE);
    builder_leave(b, was);
}

static void snail(struct builder *b, point at, double turn_deg)
{
    const struct frame was = builder_enter(b, at, turn_deg, 1);
    const point foot[6] = {{-0.16, 0.015, 0}, {-0.08, 0.03, 0}, {0.02, 0.035, 0},
                           {0.10, 0.04, 0},   {0.15, 0.07, 0},  {0.17, 0.10, 0}};
    bar(b, foot, 6, 0.02, 0.032, 8, PAINT_PALE_WOOD);
    point spiral[20];
    for (int i = 0; i < 20; i++) {
        const double turn = 39.0 * i, r = 0.012 + 0.0034 * i;
        spiral[i] = (point){-0.01 + r * cosine(turn), 0.115 + r * sine(turn), 0.012 - 0.001 * i};
    }
    bar(b, spiral, 20, 0.012, 0.046, 8, PAINT_ORANGE);
    for (int side = -1; side <= 1; side += 2) {
        const point horn[3] = {
            {0.165, 0.10, 0.012 * side}, {0.185, 0.14, 0.025 * side}, {0.20, 0.165, 0.032 * side}};
        bar(b, horn, 3, 0.008, 0.006, 6, PAINT_PALE_WOOD);
    }
    builder_leave(b, was);
}

static void gully(struct builder *b)
{
    for (int i = 0; i < 5; i++) {
        const point slot[2] = {{0.02 + 0.065 * i, 0.055, 1.09}, {0.02 + 0.065 * i, 0.055, 1.35}};
        bar(b, slot, 2, 0.017, 0.017, 6, PAINT_IRON);
    }
    soft_box(b, (point){-0.05, -0.1, 1.06}, (point){0.32, 0.03, 1.38}, 0.02, 1, PAINT_BLACK);
}

void build_ground(struct builder *b)
{
    puddle(b, (point){0, 0, 0}, 2.6, 2.6, 3, 36, 0.01, 1, PAINT_LAWN);
    puddle(b, (point){0, 0.006, 1.4}, 2.05, 1.02, 2, 24, 0.01, 3, PAINT_BARK);
    cobbles(b);
    kerb(b);
    gully(b);
    puddle(b, (point){-0.85, 0.012, -0.45}, 0.75, 0.42, 3, 28, 0.14, 2, PAINT_WATER);
    puddle(b, (point){0.95, 0.012, -0.95}, 0.42, 0.28, 2, 24, 0.14, 5, PAINT_WATER);
    for (uint32_t i = 0; i < 11; i++) {
        const double turn = 32.7 * i, r = 0.55 + 0.5 * chance(210, i);
        const double size = 0.05 + 0.09 * chance(211, i);
        ball(b, (point){-0.85 + 1.5 * r * sine(turn), 0.03, -0.45 + 0.95 * r * cosine(turn) - 0.1},
             (point){size * 1.3, size * 0.7, size}, 5, 9, 0.07, 212 + i,
             i % 3 ? PAINT_STONE : PAINT_PALE_STONE);
    }
    mushroom(b, (point){0.42, 0, -0.35}, 0.55, 30);
    mushroom(b, (point){0.68, 0, -0.22}, 0.36, 200);
    mushroom(b, (point){0.30, 0, -0.12}, 0.26, 110);
    snail(b, (point){-0.55, 0.17, 0.55}, 15);
    flower(b, (point){-1.6, 0, 0.1}, 0.5, PAINT_YELLOW, 3);
    flower(b, (point){1.5, 0, 0.05}, 0.42, PAINT_PINK, 4);
    bush(b, (point){-1.2, 0, -1.5}, 0.38, 6, 220);
    bush(b, (point){1.5, 0, -1.55}, 0.32, 6, 221);
    fir(b, (point){0.15, 0, -1.7}, 0.95, 4, 14, 222);
}
