// Plants and stones.
#include "core/scene/diorama/build.h"

static int finer(double detail, int usual)
{
    const int made = (int)(detail * usual + 0.5);
    return made > 3 ? made : 3;
}

void tree(struct builder *b, point at, double height_m, double detail, enum paint paint,
          uint32_t id)
{
    const double h = height_m, crown = 0.27 * h;
    const struct profile trunk[] = {{0.075 * h, 0},       {0.05 * h, 0.05 * h}, {0.04 * h, 0.2 * h},
                                    {0.036 * h, 0.4 * h}, {0.02 * h, 0.62 * h}, {0, 0.64 * h}};
    lathe(b, at, trunk, 6, finer(detail, 12), 180, PAINT_BARK);
    const int rings = finer(detail, 9), around = finer(detail, 16);
    ball(b, (point){at.x, at.y + h - crown, at.z}, (point){crown, crown * 0.95, crown}, rings,
         around, 0.03, id, paint);
    for (uint32_t i = 0; i < 4; i++) {
        const double turn = 90.0 * i + 60 * chance(id, 900 + i), off = 0.72 * crown;
        const double size = crown * (0.62 + 0.2 * chance(id, 910 + i));
        const point middle = {at.x + off * sine(turn),
                              at.y + h - crown * (1.25 + 0.35 * chance(id, 920 + i)),
                              at.z + off * cosine(turn)};
        ball(b, middle, (point){size, size * 0.85, size}, finer(detail, 7), finer(detail, 13), 0.03,
             id + 31 * (i + 1), paint);
    }
}

void fir(struct builder *b, point at, double height_m, int skirts, int around, uint32_t id)
{
    const double h = height_m;
    const struct profile trunk[] = {{0.05 * h, 0}, {0.04 * h, 0.25 * h}, {0, 0.3 * h}};
    lathe(b, at, trunk, 3, 10, 180, PAINT_BARK);
    for (int i = 0; i < skirts; i++) {
        const double share = (double)i / skirts, low = h * (0.14 + 0.8 * share);
        const double radius = h * (0.27 - 0.2 * share);
        const double top = i + 1 < skirts ? low + h * 1.5 / skirts : h;
        point rim[64];
        for (int j = 0; j < around; j++) {
            const double turn = 360.0 * (j + chance(id, (uint32_t)i) * 3) / around;
            const double out = radius * (j % 2 ? 0.84 : 1), down = j % 2 ? 0.02 * h : 0;
            rim[j] = (point){at.x + out * sine(turn), at.y + low + down, at.z + out * cosine(turn)};
        }
        skin(b, rim, 1, around, &(point){at.x, at.y + low + 0.05 * h, at.z},
             &(point){at.x, at.y + top, at.z}, PAINT_DARK_LEAF);
        builder_end(b, 180);
    }
}

void bush(struct builder *b, point at, double radius_m, int rings, uint32_t id)
{
    const double r = radius_m;
    ball(b, (point){at.x, at.y + 0.6 * r, at.z}, (point){r, 0.75 * r, r}, rings, 2 * rings, 0.035,
         id, id % 2 ? PAINT_LEAF : PAINT_DARK_LEAF);
}

void flower(struct builder *b, point at, double height_m, enum paint paint, uint32_t id)
{
    const double lean = 0.12 * height_m, turn = 360 * chance(id, 0);
    const point stem[4] = {
        at,
        {at.x, at.y + 0.4 * height_m, at.z},
        {at.x + 0.4 * lean * sine(turn), at.y + 0.75 * height_m, at.z + 0.4 * lean * cosine(turn)},
        {at.x + lean * sine(turn), at.y + height_m, at.z + lean * cosine(turn)}};
    const double r = 0.16 * height_m;
    bar(b, stem, 4, 0.02 * height_m, 0.02 * height_m, 5, PAINT_MEADOW);
    for (int i = 0; i < 5; i++) {
        const double way = 72.0 * i + turn;
        const point petal = {stem[3].x + r * sine(way), stem[3].y, stem[3].z + r * cosine(way)};
        ball(b, petal, (point){0.8 * r, 0.35 * r, 0.8 * r}, 4, 7, 0, id, paint);
    }
    ball(b, (point){stem[3].x, stem[3].y + 0.15 * r, stem[3].z},
         (point){0.6 * r, 0.45 * r, 0.6 * r}, 4, 8, 0, id, PAINT_YELLOW);
}

void blade(struct builder *b, point at, double height_m, double turn_deg, int faces,
           enum paint paint)
{
    point points[16];
    const double s = sine(turn_deg), c = cosine(turn_deg), half = 0.09 * height_m;
    for (int i = 0; i < faces + 2; i++) {
        const double up = i < 2 ? 0 : (double)(i - 1) / faces, out = 0.5 * height_m * up * up;
        const double aside = (i % 2 ? 1 : -1) * half * (1 - up);
        points[i] =
            (point){at.x + out * s + aside * c, at.y + height_m * up, at.z + out * c - aside * s};
    }
    b->is_thin = true;
    for (int i = 0; i < faces; i++) {
        const int odd = i % 2;
        builder_face(b, points[i + odd], points[i + 1 - odd], points[i + 2], paint);
    }
    b->is_thin = false;
    builder_end(b, 180);
}

void pebble(struct builder *b, point at, double radius_m, int faces, uint32_t id, enum paint paint)
{
    const int rings = faces % 6 == 0 && faces >= 24 ? 4 : faces % 4 == 0 && faces >= 12 ? 3 : 2;
    const double long_m = radius_m * (1 + 0.4 * chance(id, 900));
    ball(b, (point){at.x, at.y + 0.35 * radius_m, at.z}, (point){long_m, 0.6 * radius_m, radius_m},
         rings, faces / (2 * (rings - 1)), 0.08, id, paint);
}
