// A table laid for four, outdoors: cups, a teapot, a cake, flowers and a lamp, with four chairs.
// Everything is round, so that a vertex has one normal.
#include "core/scene/diorama/build.h"

static const double top_m = 0.76;

static void table(struct builder *b)
{
    const struct profile leg[] = {{0, 0},       {0.34, 0.0},  {0.36, 0.03}, {0.33, 0.06},
                                  {0.16, 0.10}, {0.08, 0.18}, {0.06, 0.30}, {0.075, 0.40},
                                  {0.06, 0.50}, {0.06, 0.62}, {0.12, 0.70}, {0, 0.72}};
    const struct profile top[] = {{0, 0.70},     {0.86, 0.70},  {0.90, 0.71}, {0.91, 0.73},
                                  {0.90, 0.752}, {0.86, 0.755}, {0, 0.755}};
    lathe(b, (point){0, 0, 0}, leg, 12, 40, 180, PAINT_PALE_WOOD);
    lathe(b, (point){0, 0, 0}, top, 7, 64, 180, PAINT_PALE_WOOD);
}

// A tablecloth that hangs over the rim in folds.
static void cloth(struct builder *b)
{
    enum { HANGING = 13, RINGS = 20, AROUND = 72 };
    point points[RINGS * AROUND];
    for (int i = 0; i < RINGS; i++) {
        for (int j = 0; j < AROUND; j++) {
            const double turn = 360.0 * j / AROUND,
                         fall = i < HANGING ? (double)(HANGING - i) / HANGING : 0;
            const double fold = fall * (0.045 * cosine(12 * turn) + 0.02 * cosine(5 * turn + 40));
            const double radius =
                i < HANGING ? 0.935 + 0.03 * fall + fold : 0.93 * (RINGS - i) / (RINGS - HANGING);
            const double y = i < HANGING ? top_m + 0.004 - 0.30 * fall : top_m + 0.006;
            points[i * AROUND + j] = (point){radius * sine(turn), y, radius * cosine(turn)};
        }
    }
    b->is_thin = true;
    skin(b, points, RINGS, AROUND, NULL, &(point){0, top_m + 0.006, 0}, PAINT_CREAM);
    b->is_thin = false;
    builder_end(b, 180);
    struct profile band[13];
    for (int i = 0; i <= 12; i++)
        band[i] =
            (struct profile){0.78 + 0.035 * cosine(30.0 * (i % 12)), 0.004 * sine(30.0 * (i % 12))};
    lathe(b, (point){0, top_m + 0.006, 0}, band, 13, 64, 180, PAINT_BLUE);
}

static void cup(struct builder *b, point at, double turn_deg, enum paint paint)
{
    const struct frame was = builder_enter(b, at, turn_deg, 1);
    const struct profile saucer[] = {{0, 0.004},     {0.05, 0.004},  {0.06, 0.008}, {0.115, 0.022},
                                     {0.118, 0.027}, {0.112, 0.028}, {0.06, 0.016}, {0, 0.014}};
    const struct profile outer[] = {{0, 0.014},     {0.035, 0.015}, {0.04, 0.022}, {0.036, 0.028},
                                    {0.058, 0.05},  {0.072, 0.085}, {0.077, 0.12}, {0.075, 0.125},
                                    {0.071, 0.122}, {0.066, 0.09},  {0.05, 0.05},  {0, 0.035}};
    lathe(b, (point){0, 0, 0}, saucer, 8, 44, 180, PAINT_WHITE);
    lathe(b, (point){0, 0, 0}, outer, 12, 44, 180, paint);
    ball(b, (point){0, 0.105, 0}, (point){0.069, 0.004, 0.069}, 4, 44, 0, 1, PAINT_COFFEE);
    point handle[12];
    for (int i = 0; i < 12; i++)
        handle[i] = (point){0.066 + 0.042 * sine(180.0 * i / 11),
                            0.075 + 0.032 * cosine(180.0 * i / 11), 0};
    bar(b, handle, 12, 0.009, 0.009, 8, paint);
    builder_leave(b, was);
}

static void teapot(struct builder *b, point at, double turn_deg)
{
    const struct frame was = builder_enter(b, at, turn_deg, 1);
    const struct profile pot[] = {
        {0, 0},        {0.08, 0},      {0.09, 0.012},  {0.085, 0.02},  {0.125, 0.05}, {0.145, 0.09},
        {0.14, 0.13},  {0.115, 0.17},  {0.08, 0.19},   {0.083, 0.196}, {0.07, 0.205}, {0.03, 0.215},
        {0.012, 0.22}, {0.012, 0.228}, {0.022, 0.238}, {0.02, 0.25},   {0, 0.256}};
    lathe(b, (point){0, 0, 0}, pot, 17, 56, 180, PAINT_BLUE);
    const point spout[8] = {{0.10, 0.06, 0},  {0.15, 0.065, 0}, {0.19, 0.085, 0},
                            {0.21, 0.12, 0},  {0.225, 0.15, 0}, {0.24, 0.17, 0},
                            {0.255, 0.18, 0}, {0.265, 0.182, 0}};
    bar(b, spout, 8, 0.04, 0.016, 14, PAINT_BLUE);
    point handle[14];
    for (int i = 0; i < 14; i++)
        handle[i] =
            (point){-0.115 - 0.09 * sine(180.0 * i / 13), 0.11 + 0.06 * cosine(180.0 * i / 13), 0};
    bar(b, handle, 14, 0.014, 0.014, 10, PAINT_BLUE);
    builder_leave(b, was);
}

static void cake(struct builder *b, point at)
{
    const struct profile stand[] = {{0, 0},        {0.09, 0},   {0.095, 0.01}, {0.03, 0.03},
                                    {0.022, 0.07}, {0.05, 0.1}, {0.19, 0.11},  {0.2, 0.118},
                                    {0.19, 0.124}, {0, 0.122}};
    const struct profile sponge[] = {{0, 0.122},    {0.15, 0.122}, {0.155, 0.13}, {0.155, 0.16},
                                     {0.158, 0.17}, {0.158, 0.21}, {0.15, 0.22},  {0, 0.222}};
    lathe(b, at, stand, 10, 44, 180, PAINT_WHITE);
    lathe(b, at, sponge, 8, 44, 180, PAINT_PINK);
    for (int i = 0; i < 7; i++) {
        const double r = i < 6 ? 0.115 : 0;
        ball(b, (point){at.x + r * sine(60.0 * i), at.y + 0.238, at.z + r * cosine(60.0 * i)},
             (point){0.026, 0.026, 0.026}, 10, 14, 0, 1, PAINT_RED);
    }
}

static void lamp(struct builder *b, point at)
{
    const struct profile foot[] = {{0, 0},        {0.09, 0},    {0.095, 0.015}, {0.07, 0.03},
                                   {0.025, 0.05}, {0.02, 0.12}, {0.035, 0.17},  {0.02, 0.22},
                                   {0.015, 0.34}, {0, 0.35}};
    const struct profile shade[] = {{0.165, 0.27}, {0.17, 0.275}, {0.16, 0.30}, {0.12, 0.38},
                                    {0.08, 0.46},  {0.06, 0.475}, {0.05, 0.48}, {0, 0.482}};
    lathe(b, at, foot, 10, 36, 180, PAINT_TEAL);
    b->is_thin = true;
    lathe(b, at, shade, 8, 48, 180, PAINT_LIGHT);
    b->is_thin = false;
    ball(b, (point){at.x, at.y + 0.33, at.z}, (point){0.045, 0.06, 0.045}, 8, 14, 0, 1,
         PAINT_YELLOW);
    ball(b, (point){at.x, at.y + 0.495, at.z}, (point){0.014, 0.02, 0.014}, 6, 10, 0, 1,
         PAINT_TEAL);
}

static void vase(struct builder *b, point at)
{
    static const enum paint petals[] = {PAINT_PINK, PAINT_ORANGE, PAINT_WHITE, PAINT_YELLOW,
                                        PAINT_RED};
    const struct profile glass[] = {{0, 0},        {0.04, 0},     {0.055, 0.03}, {0.06, 0.07},
                                    {0.04, 0.12},  {0.03, 0.15},  {0.045, 0.18}, {0.047, 0.185},
                                    {0.04, 0.182}, {0.026, 0.15}, {0, 0.14}};
    lathe(b, at, glass, 11, 36, 180, PAINT_TEAL);
    for (int i = 0; i < 4; i++) {
        const struct frame was =
            builder_tilt(b, (point){at.x, at.y + 0.12, at.z}, i ? 24 : 4, 120.0 * i + 20);
        flower(b, (point){0, 0, 0}, 0.26, petals[i], 60 + (uint32_t)i);
        builder_leave(b, was);
    }
}

static void chair_back(struct builder *b)
{
    point hoop[21];
    for (int i = 0; i <= 20; i++) {
        const double turn = 9.0 * i;
        hoop[i] = (point){0.20 * cosine(turn), 0.45 + 0.47 * sine(turn) * (1 - 0.1 * sine(turn)),
                          -0.17 - 0.09 * sine(turn)};
    }
    bar(b, hoop, 21, 0.018, 0.018, 14, PAINT_WOOD);
    for (int i = 0; i < 4; i++) {
        const double x = -0.12 + 0.08 * i, high = 0.87 - 4.0 * x * x;
        const point spindle[4] = {
            {x * 0.9, 0.46, -0.165}, {x * 0.97, 0.6, -0.19}, {x, 0.74, -0.22}, {x, high, -0.245}};
        bar(b, spindle, 4, 0.011, 0.009, 8, PAINT_WOOD);
    }
}

static void chair(struct builder *b, point at, double turn_deg, enum paint paint)
{
    const struct frame was = builder_enter(b, at, turn_deg, 1);
    const struct profile seat[] = {{0, 0.42},      {0.21, 0.42},  {0.228, 0.428}, {0.23, 0.44},
                                   {0.225, 0.452}, {0.21, 0.457}, {0, 0.452}};
    const struct profile cushion[] = {{0, 0.452},    {0.18, 0.452}, {0.205, 0.465}, {0.21, 0.485},
                                      {0.19, 0.505}, {0.10, 0.513}, {0, 0.505}};
    lathe(b, (point){0, 0, 0}, seat, 7, 44, 180, PAINT_WOOD);
    lathe(b, (point){0, 0, 0}, cushion, 7, 44, 180, paint);
    for (int z = -1; z <= 1; z += 2) {
        // One bar from a foot up to the seat, along under it and down to the other foot.
        point legs[17];
        for (int i = 0; i < 17; i++) {
            const double x = i < 8 ? -1 : 1, down = i == 8 ? 0 : i < 8 ? 7 - i : i - 9;
            const double out = i == 8 ? 0 : 0.125 + 0.012 * down;
            legs[i] = (point){x * out, i == 8 ? 0.43 : 0.425 - 0.425 * down / 7,
                              z * (0.135 + 0.011 * down)};
        }
        bar(b, legs, 17, 0.018, 0.018, 16, PAINT_WOOD);
    }
    ring(b, (point){0, 0.20, 0}, 0.26, 0.011, 8, 40, PAINT_WOOD);
    chair_back(b);
    builder_leave(b, was);
}

void build_table(struct builder *b)
{
    static const enum paint cups[] = {PAINT_RED, PAINT_TEAL, PAINT_YELLOW, PAINT_PINK};
    static const enum paint cushions[] = {PAINT_TEAL, PAINT_ORANGE, PAINT_TEAL, PAINT_ORANGE};
    puddle(b, (point){0, 0, 0}, 2.3, 2.3, 12, 36, 0.01, 1, PAINT_SAND);
    puddle(b, (point){1.0, 0.004, 1.35}, 0.38, 0.22, 6, 16, 0.16, 2, PAINT_WATER);
    puddle(b, (point){-1.35, 0.004, 0.75}, 0.24, 0.17, 6, 14, 0.16, 5, PAINT_WATER);
    table(b);
    cloth(b);
    for (int i = 0; i < 4; i++) {
        const double turn = 90.0 * i + 20;
        cup(b, (point){0.58 * sine(turn), top_m + 0.006, 0.58 * cosine(turn)}, turn + 130, cups[i]);
        chair(b, (point){1.22 * sine(turn + 25), 0, 1.22 * cosine(turn + 25)}, turn + 205 + 8.0 * i,
              cushions[i]);
    }
    teapot(b, (point){-0.22, top_m + 0.006, 0.30}, 200);
    cake(b, (point){0.34, top_m + 0.006, -0.12});
    lamp(b, (point){-0.30, top_m + 0.006, -0.34});
    vase(b, (point){0.02, top_m + 0.006, -0.02});
}
