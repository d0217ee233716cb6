// Two parks: a lawn with a bench under a tree by a pond, and a large one about a fountain.
#include <math.h>

#include "core/scene/diorama/build.h"

static void bench(struct builder *b, point at, double turn_deg, int steps)
{
    const struct frame was = builder_enter(b, at, turn_deg, 1);
    for (int i = 0; i < 3; i++)
        soft_box(b, (point){-0.8, 0.42, -0.2 + 0.15 * i}, (point){0.8, 0.47, -0.07 + 0.15 * i},
                 0.015, steps, PAINT_WOOD);
    for (int i = 0; i < 2; i++)
        soft_box(b, (point){-0.8, 0.58 + 0.17 * i, -0.29 - 0.04 * i},
                 (point){0.8, 0.71 + 0.17 * i, -0.24 - 0.04 * i}, 0.015, steps, PAINT_WOOD);
    for (int side = -1; side <= 1; side += 2) {
        const double x = 0.66 * side;
        const point back[6] = {{x, 0, -0.28},   {x, 0.2, -0.22}, {x, 0.42, -0.22},
                               {x, 0.6, -0.25}, {x, 0.78, -0.3}, {x, 0.92, -0.34}};
        const point front[7] = {{x, 0, 0.26},    {x, 0.2, 0.21},  {x, 0.42, 0.22}, {x, 0.58, 0.23},
                                {x, 0.64, 0.16}, {x, 0.645, 0.0}, {x, 0.64, -0.24}};
        bar(b, back, 6, 0.03, 0.025, 8, PAINT_IRON);
        bar(b, front, 7, 0.03, 0.025, 8, PAINT_IRON);
    }
    builder_leave(b, was);
}

static void lamp_post(struct builder *b, point at, int around)
{
    const struct profile post[] = {{0, 0},       {0.17, 0},     {0.17, 0.12}, {0.11, 0.2},
                                   {0.08, 0.5},  {0.055, 0.55}, {0.045, 1.6}, {0.04, 2.5},
                                   {0.09, 2.58}, {0.12, 2.64},  {0, 2.66}};
    const struct profile hat[] = {{0, 3.04},   {0.25, 3.04}, {0.2, 3.1},
                                  {0.08, 3.2}, {0.03, 3.3},  {0, 3.34}};
    lathe(b, at, post, 11, around, 180, PAINT_IRON);
    ball(b, (point){at.x, at.y + 2.85, at.z}, (point){0.19, 0.22, 0.19}, 8, around, 0, 1,
         PAINT_LIGHT);
    lathe(b, at, hat, 6, around, 180, PAINT_IRON);
}

// A path of this width along points: a flat sheet.
static void path(struct builder *b, const struct spot *way, int count, double wide_m, double y)
{
    point points[2 * 40];
    for (int i = 0; i < count; i++) {
        const struct spot *from = way + (i ? i - 1 : 0), *to = way + (i + 1 < count ? i + 1 : i);
        const double dx = to->x - from->x, dz = to->y - from->y;
        const double length = sqrt(dx * dx + dz * dz);
        const double x = -dz / length * wide_m / 2, z = dx / length * wide_m / 2;
        points[2 * i] = (point){way[i].x - x, y, way[i].y - z};
        points[2 * i + 1] = (point){way[i].x + x, y, way[i].y + z};
    }
    sheet(b, points, 1, count - 1, PAINT_SAND);
    builder_end(b, 180);
}

static void duck(struct builder *b, point at, double turn_deg)
{
    const struct frame was = builder_enter(b, at, turn_deg, 1);
    ball(b, (point){0, 0.06, 0}, (point){0.22, 0.13, 0.14}, 8, 14, 0, 1, PAINT_WHITE);
    ball(b, (point){0.17, 0.25, 0}, (point){0.09, 0.09, 0.085}, 8, 12, 0, 1, PAINT_WHITE);
    ball(b, (point){0.27, 0.235, 0}, (point){0.06, 0.022, 0.04}, 6, 10, 0, 1, PAINT_ORANGE);
    const point tail[3] = {{-0.15, 0.09, 0}, {-0.22, 0.14, 0}, {-0.26, 0.19, 0}};
    bar(b, tail, 3, 0.06, 0.015, 8, PAINT_WHITE);
    builder_leave(b, was);
}

static void reeds(struct builder *b, point at, uint32_t id)
{
    for (int i = 0; i < 4; i++) {
        const double turn = 90.0 * i, x = at.x + 0.12 * sine(turn), z = at.z + 0.12 * cosine(turn);
        const double high = 0.5 + 0.3 * chance(id, (uint32_t)i);
        const point stem[3] = {{x, at.y, z},
                               {x + 0.02, at.y + high / 2, z},
                               {x + 0.06 * sine(turn), at.y + high, z + 0.06 * cosine(turn)}};
        bar(b, stem, 3, 0.012, 0.008, 5, PAINT_DARK_LEAF);
        ball(b, (point){stem[2].x, stem[2].y, stem[2].z}, (point){0.03, 0.1, 0.03}, 5, 7, 0, 1,
             PAINT_WOOD);
    }
}

void build_park1(struct builder *b)
{
    const struct spot way[] = {{-5.0, 1.5}, {-3.8, 1.9}, {-2.6, 2.0}, {-1.4, 1.9},
                               {-0.3, 1.6}, {0.7, 1.1},  {1.6, 0.4},  {2.3, -0.5},
                               {2.8, -1.5}, {3.1, -2.6}, {3.2, -3.8}};
    puddle(b, (point){0, 0, 0}, 5.4, 5.4, 4, 44, 0.01, 1, PAINT_LAWN);
    path(b, way, 11, 1.1, 0.012);
    puddle(b, (point){2.9, 0.02, 2.7}, 1.5, 1.1, 3, 32, 0.1, 2, PAINT_WATER);
    for (int i = 0; i < 15; i++) {
        const double turn = 24.0 * i, out = 1.06;
        ball(b, (point){2.9 + 1.5 * out * sine(turn), 0.03, 2.7 + 1.1 * out * cosine(turn)},
             (point){0.24, 0.12, 0.2}, 6, 10, 0.05, 10 + (uint32_t)i, PAINT_STONE);
    }
    duck(b, (point){2.7, 0.03, 2.8}, 30);
    duck(b, (point){3.4, 0.03, 2.4}, 200);
    reeds(b, (point){4.2, 0, 2.3}, 7);
    bench(b, (point){-1.9, 0, 0.7}, 10, 2);
    lamp_post(b, (point){0.3, 0, 0.5}, 12);
    tree(b, (point){-2.8, 0, -1.1}, 4.3, 1.3, PAINT_LEAF, 20);
    tree(b, (point){0.7, 0, -2.9}, 3.9, 1.2, PAINT_BLOSSOM, 21);
    fir(b, (point){-4.1, 0, -2.3}, 3.8, 4, 16, 22);
    fir(b, (point){-1.2, 0, -3.8}, 3.2, 4, 16, 23);
    fir(b, (point){4.3, 0, -1.0}, 2.8, 4, 16, 24);
    bush(b, (point){1.9, 0, -3.2}, 0.55, 8, 25);
    bush(b, (point){-3.6, 0, 0.4}, 0.5, 8, 26);
}

// --- the large park ---

static void fountain(struct builder *b)
{
    const struct profile basin[] = {{0, 0},       {1.75, 0},    {1.8, 0.05}, {1.7, 0.12},
                                    {1.7, 0.38},  {1.82, 0.44}, {1.84, 0.5}, {1.78, 0.54},
                                    {1.58, 0.54}, {1.52, 0.48}, {1.5, 0.2},  {0, 0.2}};
    const struct profile bowl[] = {{0, 0.2},    {0.4, 0.2},   {0.42, 0.26}, {0.2, 0.36},
                                   {0.16, 0.7}, {0.22, 1.0},  {0.7, 1.14},  {0.82, 1.24},
                                   {0.84, 1.3}, {0.78, 1.32}, {0.7, 1.24},  {0.3, 1.16},
                                   {0.12, 1.2}, {0.1, 1.5},   {0.13, 1.56}, {0, 1.6}};
    lathe(b, (point){0, 0, 0}, basin, 12, 56, 180, PAINT_PALE_STONE);
    lathe(b, (point){0, 0, 0}, bowl, 16, 40, 180, PAINT_PALE_STONE);
    ball(b, (point){0, 0.42, 0}, (point){1.53, 0.02, 1.53}, 6, 56, 0, 1, PAINT_WATER);
    ball(b, (point){0, 1.25, 0}, (point){0.74, 0.02, 0.74}, 4, 40, 0, 1, PAINT_WATER);
    for (int i = 0; i < 7; i++) {
        point jet[9];
        for (int k = 0; k < 9; k++) {
            const double t = k / 8.0, out = i < 6 ? 0.12 + 1.0 * t : 0;
            const double up = i < 6 ? 1.56 + 1.3 * t - 2.35 * t * t : 1.5 + 0.75 * t;
            const double turn = 60.0 * i + 15;
            jet[k] = (point){out * sine(turn), up, out * cosine(turn)};
        }
        bar(b, jet, 9, 0.06, 0.085, 10, PAINT_WATER);
    }
}

static void flower_bed(struct builder *b, point at, double radius, uint32_t id)
{
    static const enum paint petals[] = {PAINT_PINK, PAINT_YELLOW, PAINT_RED, PAINT_WHITE,
                                        PAINT_ORANGE};
    ball(b, at, (point){radius, 0.14, radius}, 6, 24, 0.02, id, PAINT_BARK);
    for (int i = 0; i < 7; i++) {
        const double turn = 60.0 * i, r = i < 6 ? 0.6 * radius : 0;
        flower(b, (point){at.x + r * sine(turn), at.y + 0.08, at.z + r * cosine(turn)},
               0.42 + 0.14 * chance(id, (uint32_t)i), petals[(id + (uint32_t)i % 2) % 5],
               id + (uint32_t)i);
    }
}

static void hedge(struct builder *b, double turn_deg)
{
    const struct frame was = builder_enter(b, (point){0, 0, 0}, turn_deg, 1);
    soft_box(b, (point){-1.9, 0, -4.55}, (point){1.9, 0.62, -4.05}, 0.16, 3, PAINT_DARK_LEAF);
    ball(b, (point){-2.2, 0.5, -4.3}, (point){0.42, 0.5, 0.42}, 10, 18, 0.03, 3, PAINT_LEAF);
    ball(b, (point){2.2, 0.5, -4.3}, (point){0.42, 0.5, 0.42}, 10, 18, 0.03, 4, PAINT_LEAF);
    builder_leave(b, was);
}

static void avenues(struct builder *b)
{
    puddle(b, (point){0, 0, 0}, 8.6, 8.6, 6, 72, 0.01, 1, PAINT_LAWN);
    puddle(b, (point){0, 0.012, 0}, 3.3, 3.3, 3, 56, 0, 1, PAINT_SAND);
    for (int i = 0; i < 4; i++) {
        const struct frame was = builder_enter(b, (point){0, 0.014, 0}, 90.0 * i, 1);
        const struct spot way[] = {{0, 3.1}, {0, 4.2}, {0, 5.4}, {0, 6.6}, {0, 8.2}};
        path(b, way, 5, 1.7, 0);
        builder_leave(b, was);
    }
    puddle(b, (point){1.9, 0.02, 2.6}, 0.5, 0.3, 2, 24, 0.15, 2, PAINT_WATER);
    puddle(b, (point){-0.3, 0.02, 5.4}, 0.45, 0.3, 2, 24, 0.15, 5, PAINT_WATER);
}

void build_park2(struct builder *b)
{
    avenues(b);
    fountain(b);
    for (int i = 0; i < 4; i++) {
        const double turn = 90.0 * i + 45;
        const uint32_t id = 100 + 40 * (uint32_t)i;
        const struct frame was = builder_enter(b, (point){0, 0, 0}, turn, 1);
        bench(b, (point){0, 0, 2.75}, 180, 2);
        lamp_post(b, (point){1.25, 0, 2.75}, 16);
        flower_bed(b, (point){0, 0, 4.4}, 0.75, id);
        tree(b, (point){-0.2, 0, 6.4}, 4.4 + 0.5 * i, 1.3, i % 2 ? PAINT_LEAF : PAINT_BLOSSOM, id);
        tree(b, (point){-2.2, 0, 6.2}, 3.4, 1.1, PAINT_LEAF, id + 10);
        fir(b, (point){2.1, 0, 6.3}, 4.2, 6, 24, id + 20);
        builder_leave(b, was);
        hedge(b, 90.0 * i + 22.5);
    }
    for (int i = 0; i < 3; i++)
        duck(b, (point){1.1 * sine(120.0 * i), 0.44, 1.1 * cosine(120.0 * i)}, 120.0 * i + 70);
}
