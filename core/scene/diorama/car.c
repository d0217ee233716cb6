// A small car with luggage on its roof, at a kerb. It stands along x and faces +x.
#include <math.h>

#include "core/scene/diorama/build.h"

enum { SECTION = 28, STATIONS = 8 };

// A cross-section of the car: its place, half its width, and its lowest and highest point.
struct section {
    double x, half, low, high;
};

static const struct section body[STATIONS] = {
    {-1.95, 0.56, 0.44, 0.66}, {-1.83, 0.71, 0.36, 0.83}, {-1.45, 0.80, 0.32, 0.95},
    {-0.60, 0.85, 0.30, 0.98}, {0.45, 0.85, 0.30, 0.96},  {1.20, 0.81, 0.30, 0.88},
    {1.68, 0.72, 0.34, 0.78},  {1.90, 0.57, 0.42, 0.63},
};
static const struct section cabin[STATIONS] = {
    {-1.52, 0.60, 0.80, 0.93}, {-1.25, 0.66, 0.80, 1.20}, {-0.90, 0.69, 0.80, 1.43},
    {-0.40, 0.70, 0.80, 1.54}, {0.10, 0.69, 0.80, 1.52},  {0.48, 0.67, 0.80, 1.36},
    {0.78, 0.64, 0.80, 1.12},  {1.02, 0.60, 0.80, 0.90},
};

// Interpolates between the second and the third of four numbers (Catmull and Rom).
static double between(double a, double b, double c, double d, double t)
{
    return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

// The section at a share of the length, from 0 at the back to 1.
static struct section section_at(const struct section *s, double share)
{
    const double at = share * (STATIONS - 1);
    const int i = at >= STATIONS - 1 ? STATIONS - 2 : (int)at;
    const int before = i > 0 ? i - 1 : 0, behind = i + 2 < STATIONS ? i + 2 : STATIONS - 1;
    const struct section *a = s + before, *b = s + i, *c = s + i + 1, *d = s + behind;
    const double t = at - i;
    return (struct section){
        between(a->x, b->x, c->x, d->x, t), between(a->half, b->half, c->half, d->half, t),
        between(a->low, b->low, c->low, d->low, t), between(a->high, b->high, c->high, d->high, t)};
}

// A point of the skin: a section is a square with round corners (a superellipse of the fourth
// power); 0 degrees is left, 90 up. `out` is the distance from the skin, in metres.
static point on_skin(const struct section *s, double share, double turn_deg, double out)
{
    const struct section at = section_at(s, share);
    const double c = cosine(turn_deg), n = sine(turn_deg);
    const double reach = 1 / sqrt(sqrt(c * c * c * c + n * n * n * n));
    const double half = at.half + out, high = (at.high - at.low) / 2 + out;
    return (point){at.x, (at.low + at.high) / 2 + high * reach * n, -half * reach * c};
}

static void hull(struct builder *b, const struct section *s, int rings, enum paint paint)
{
    point points[64 * SECTION];
    for (int i = 0; i < rings; i++)
        for (int j = 0; j < SECTION; j++)
            points[i * SECTION + j] = on_skin(s, (double)i / (rings - 1), 360.0 * j / SECTION, 0);
    const point back = {s[0].x, (s[0].low + s[0].high) / 2, 0};
    const point front = {s[STATIONS - 1].x, (s[STATIONS - 1].low + s[STATIONS - 1].high) / 2, 0};
    skin(b, points, rings, SECTION, &back, &front, paint);
    builder_end(b, 50);
}

// A patch slightly off the skin, between two shares of the length and two angles.
static void patch(struct builder *b, const struct section *s, const double share[2],
                  const double turn_deg[2], int across, int along, enum paint paint)
{
    point points[20 * 20];
    for (int i = 0; i <= along; i++)
        for (int j = 0; j <= across; j++)
            points[i * (across + 1) + j] =
                on_skin(s, share[0] + (share[1] - share[0]) * j / across,
                        turn_deg[1] + (turn_deg[0] - turn_deg[1]) * i / along, 0.012);
    sheet(b, points, across, along, paint);
    builder_end(b, 180);
}

static void windows(struct builder *b)
{
    const double rear[2] = {0.30, 0.44}, front[2] = {0.47, 0.70};
    const double left[2] = {14, 47}, right[2] = {166, 133};
    patch(b, cabin, rear, left, 6, 5, PAINT_GLASS);
    patch(b, cabin, front, left, 8, 5, PAINT_GLASS);
    patch(b, cabin, (double[2]){rear[1], rear[0]}, right, 6, 5, PAINT_GLASS);
    patch(b, cabin, (double[2]){front[1], front[0]}, right, 8, 5, PAINT_GLASS);
    patch(b, cabin, (double[2]){0.70, 0.96}, (double[2]){52, 128}, 8, 10, PAINT_GLASS);
    patch(b, cabin, (double[2]){0.06, 0.25}, (double[2]){55, 125}, 6, 8, PAINT_GLASS);
    patch(b, body, (double[2]){0.36, 0.58}, (double[2]){-32, 42}, 8, 7, PAINT_RED);
    patch(b, body, (double[2]){0.58, 0.36}, (double[2]){212, 138}, 8, 7, PAINT_RED);
    patch(b, body, (double[2]){0.66, 0.93}, (double[2]){58, 122}, 8, 7, PAINT_RED);
}

// A wheel about its axle, which is upright here.
static void wheel(struct builder *b)
{
    struct profile tyre[11];
    for (int i = 0; i <= 10; i++)
        tyre[i] =
            (struct profile){0.25 + 0.10 * cosine(36.0 * (i % 10)), 0.12 * sine(36.0 * (i % 10))};
    lathe(b, (point){0, 0, 0}, tyre, 11, 18, 180, PAINT_BLACK);
    const struct profile rim[] = {{0, -0.08},   {0.19, -0.08}, {0.2, 0.06},  {0.17, 0.09},
                                  {0.13, 0.07}, {0.08, 0.08},  {0.05, 0.12}, {0, 0.135}};
    lathe(b, (point){0, 0, 0}, rim, 8, 14, 60, PAINT_CHROME);
}

static void wheels(struct builder *b)
{
    for (int i = 0; i < 4; i++) {
        const double x = i < 2 ? 1.18 : -1.18, side = i % 2 ? 1 : -1;
        const struct frame was =
            builder_tilt(b, (point){x, 0.35, 0.77 * side}, 90, side > 0 ? 90 : -90);
        wheel(b);
        builder_leave(b, was);
        point arch[9];
        for (int k = 0; k < 9; k++)
            arch[k] =
                (point){x + 0.43 * cosine(22.5 * k), 0.36 + 0.43 * sine(22.5 * k), 0.80 * side};
        bar(b, arch, 9, 0.07, 0.07, 8, PAINT_RED);
    }
}

static void bumper(struct builder *b, double end)
{
    point points[11];
    for (int i = 0; i < 11; i++) {
        const double z = 0.15 * (i - 5), bent = z * z * 0.22;
        points[i] = (point){end * (2.02 - bent), 0.42, z};
    }
    bar(b, points, 11, 0.055, 0.055, 9, PAINT_CHROME);
    const double x = end * 1.985;
    soft_box(b, (point){x - 0.02, 0.50, -0.22}, (point){x + 0.02, 0.61, 0.22}, 0.012, 1,
             PAINT_WHITE);
}

static void lamps(struct builder *b)
{
    for (int side = -1; side <= 1; side += 2) {
        ball(b, (point){1.74, 0.70, 0.53 * side}, (point){0.14, 0.16, 0.16}, 7, 12, 0, 1,
             PAINT_LIGHT);
        const struct frame was = builder_tilt(b, (point){1.78, 0.70, 0.53 * side}, 90, 0);
        ring(b, (point){0, 0, 0}, 0.155, 0.026, 6, 16, PAINT_CHROME);
        builder_leave(b, was);
        ball(b, (point){-1.84, 0.68, 0.55 * side}, (point){0.08, 0.11, 0.08}, 6, 10, 0, 2,
             PAINT_ORANGE);
        ball(b, (point){0.66, 1.02, 0.86 * side}, (point){0.04, 0.075, 0.09}, 6, 10, 0, 3,
             PAINT_CHROME);
        const point stalk[3] = {
            {0.70, 0.95, 0.66 * side}, {0.69, 0.99, 0.74 * side}, {0.67, 1.01, 0.82 * side}};
        bar(b, stalk, 3, 0.016, 0.016, 8, PAINT_CHROME);
        const point handle[4] = {{-0.28, 0.78, 0.865 * side},
                                 {-0.24, 0.79, 0.90 * side},
                                 {-0.12, 0.79, 0.90 * side},
                                 {-0.08, 0.78, 0.865 * side}};
        bar(b, handle, 4, 0.014, 0.014, 8, PAINT_CHROME);
    }
    for (int i = 0; i < 4; i++) {
        const double y = 0.50 + 0.05 * i;
        const point slat[3] = {{1.86, y, -0.30}, {1.92, y, 0}, {1.86, y, 0.30}};
        bar(b, slat, 3, 0.014, 0.014, 8, PAINT_CHROME);
    }
}

static void luggage(struct builder *b)
{
    for (int side = -1; side <= 1; side += 2) {
        const point rail[5] = {{-0.95, 1.48, 0.42 * side},
                               {-0.88, 1.60, 0.42 * side},
                               {-0.35, 1.62, 0.42 * side},
                               {0.18, 1.60, 0.42 * side},
                               {0.25, 1.46, 0.42 * side}};
        bar(b, rail, 5, 0.02, 0.02, 8, PAINT_CHROME);
    }
    for (int i = 0; i < 4; i++) {
        const point slat[2] = {{-0.80 + 0.30 * i, 1.61, -0.46}, {-0.80 + 0.30 * i, 1.61, 0.46}};
        bar(b, slat, 2, 0.022, 0.022, 8, PAINT_WOOD);
    }
    soft_box(b, (point){-0.82, 1.635, -0.36}, (point){-0.18, 1.86, 0.30}, 0.05, 1, PAINT_WOOD);
    soft_box(b, (point){-0.12, 1.635, -0.30}, (point){0.14, 1.99, 0.28}, 0.05, 1, PAINT_TEAL);
    soft_box(b, (point){-0.70, 1.865, -0.28}, (point){-0.28, 2.00, 0.20}, 0.04, 1, PAINT_YELLOW);
    for (int i = 0; i < 2; i++) {
        const double x = -0.66 + 0.32 * i;
        box(b, (point){x, 1.63, -0.368}, (point){x + 0.05, 1.868, 0.308}, PAINT_COFFEE);
    }
}

static void street(struct builder *b)
{
    puddle(b, (point){0, 0, 0}, 4.6, 4.6, 3, 40, 0, 1, PAINT_ROAD);
    puddle(b, (point){1.9, 0.012, 1.7}, 0.9, 0.5, 2, 24, 0.16, 2, PAINT_WATER);
    puddle(b, (point){-1.6, 0.012, 2.3}, 0.55, 0.35, 2, 20, 0.16, 5, PAINT_WATER);
    for (int i = 0; i < 9; i++) {
        const double x = -3.6 + 0.8 * i;
        box(b, (point){x, -0.05, -1.55}, (point){x + 0.78, 0.13, -1.33}, PAINT_PALE_STONE);
    }
    for (int i = 0; i < 7; i++) {
        const double x = -3.5 + i;
        box(b, (point){x + 0.01, -0.05, -2.06}, (point){x + 0.99, 0.115, -1.57}, PAINT_STONE);
    }
    const struct spot lawn[] = {{-3.62, -1.55}, {3.62, -1.55}, {3.1, -2.5},  {2.1, -3.4},
                                {0.8, -3.95},   {-0.8, -3.95}, {-2.1, -3.4}, {-3.1, -2.5}};
    point points[16];
    for (int i = 0; i < 8; i++) {
        points[i] = (point){lawn[i].x, -0.05, lawn[i].y};
        points[8 + i] = (point){lawn[i].x, 0.10, lawn[i].y};
    }
    skin(b, points, 2, 8, NULL, &(point){0, 0.10, -2.6}, PAINT_LAWN);
    builder_end(b, 40);
}

void build_car(struct builder *b)
{
    street(b);
    hull(b, body, 17, PAINT_RED);
    hull(b, cabin, 13, PAINT_RED);
    windows(b);
    wheels(b);
    bumper(b, 1);
    bumper(b, -1);
    lamps(b);
    luggage(b);
    tree(b, (point){-2.2, 0.1, -2.5}, 2.6, 0.65, PAINT_LEAF, 40);
    bush(b, (point){1.6, 0.1, -2.3}, 0.42, 5, 50);
    bush(b, (point){2.3, 0.1, -2.1}, 0.34, 5, 51);
}
