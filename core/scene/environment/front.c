// Houses: walls in storeys, shops below, windows of which some are lit.
#include "core/scene/environment/parts.h"

#define SHOP_M   4.2 // height of the ground floor
#define STOREY_M 3.1
#define LOT_M    11.0

enum { TINTS = 6, GLOWS = 4, NEONS = 5 };

static const double tints[TINTS][3] = {{.36, .19, .13}, {.62, .55, .44}, {.50, .40, .28},
                                       {.34, .35, .37}, {.58, .50, .36}, {.24, .22, .21}};
static const double glows[GLOWS][3] = {{1, .66, .32}, {1, .76, .46}, {1, .9, .74}, {.75, .88, 1}};
static const double neons[NEONS][3] = {
    {1, .12, .16}, {.1, .5, 1}, {1, .45, .06}, {.12, .95, .55}, {.95, .2, .75}};

double street_height(int row, double along_m)
{
    const int lot = street_floor(along_m / LOT_M);
    const double by_chance = street_chance(lot, row, 1);
    if (row >= 2) // towers behind the street's houses, with air between them
        return by_chance < 0.45 ? 0 : 10 + 34 * (by_chance - 0.45);
    return SHOP_M + STOREY_M * (3 + street_floor(by_chance * 3.99));
}

// --- what a wall shows ---

// Windows of half their cell, lit by chance, at `u` cells along the lot and `v` storeys up. Adds
// what shines, and returns the share that is wall.
static double windows(const struct street_look *look, const struct street_wall *w, int lot,
                      double u, double v, double light[3])
{
    const double across = w->width_m / LOT_M * 4, up = w->width_m / STOREY_M;
    const double pane = street_stripes(u + .25, .5, across) * street_stripes(v + .24, .56, up);
    const double bars = street_stripes(2 * u, .08, 2 * across);
    const int column = street_floor(u + .25), storey = street_floor(v + .24);
    const double drawn = street_chance(column + 64 * lot, storey, w->row + 11);
    const bool lit = drawn < look->lit;
    const double *glow = glows[street_floor(street_chance(column, storey + 9 * lot, 12) * GLOWS)];
    const double inside = v + .24 - storey; // 0 at the sill, .56 at the top
    const double bright = lit ? look->windows * (.35 + inside) * (.4 + 8 * drawn) : 0;
    const double seen = pane * (1 - bars);
    for (int i = 0; i < 3; i++)
        light[i] += seen * (bright * glow[i] + look->sky * look->zenith[i] * (.12 + .25 * inside));
    return 1 - pane;
}

static double shop(const struct street_look *look, const struct street_wall *w, int lot, double u,
                   double light[3])
{
    const double by_chance = street_chance(lot, w->row, 21);
    const double up = w->width_m;
    const double window = street_stripes((w->up_m - .5) / 10, .24, up / 10) *
                          street_stripes(u / 2 + .06, .88, w->width_m / LOT_M * 2);
    const double sign = street_stripes((w->up_m - 3.2) / 10, .055, up / 10) *
                        street_stripes(u / 4 - .2, .5, w->width_m / LOT_M);
    const double goods = .2 + 1.2 * street_noise(w->along_m * 1.7, w->up_m * 1.3, lot & 255);
    const double *glow = glows[street_floor(by_chance * GLOWS)];
    const double *neon = neons[street_floor(street_chance(lot, w->row, 22) * NEONS)];
    const double open = street_chance(lot, w->row, 23) < .7 ? look->windows * 1.1 : 0;
    for (int i = 0; i < 3; i++)
        light[i] += window * (open * goods * glow[i] + look->sky * .12 * look->zenith[i]) +
                    sign * (look->windows * 2.2 * neon[i] + look->sky * .1 * (.3 + neon[i]));
    return (1 - window) * (1 - sign);
}

void street_front(const struct street_look *look, const struct street_wall *w, double light[3])
{
    const double lots = w->along_m / LOT_M;
    const int lot = street_floor(lots);
    const double u = (lots - lot) * 4, storeys = (w->up_m - SHOP_M) / STOREY_M;
    const double *tint = tints[street_floor(street_chance(lot, w->row, 2) * TINTS)];
    for (int i = 0; i < 3; i++)
        light[i] = 0;
    const double wall =
        storeys < 0 ? shop(look, w, lot, u, light) : windows(look, w, lot, u, storeys, light);
    const double ledge = 1 + .5 * street_stripes(storeys + .06, .12, w->width_m / STOREY_M);
    const double stain = .75 + .4 * street_noise(w->along_m * .7, w->up_m * .4, 31);
    const double lamps =
        w->row < 2 ? street_lamplight(look, w->x_m, w->up_m, w->along_m) : look->lamps * .01;
    const double open = .45 + .55 * street_clamp(w->up_m / 18);
    for (int i = 0; i < 3; i++) {
        const double fallen = look->sky * open * (.5 * look->horizon[i] + .5 * look->zenith[i]);
        light[i] += wall * ledge * stain * tint[i] * (fallen + lamps * street_lamp[i]);
    }
}
