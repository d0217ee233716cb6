#include "tests/oracle/flow/slide.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// A value of a map of n x n, 0 outside.
static double at(const double *map, int n, int x, int y)
{
    return x >= 0 && y >= 0 && x < n && y < n ? map[y * n + x] : 0;
}

static double between(const double *map, int n, double u, double v)
{
    const int x = (int)floor(u - 0.5), y = (int)floor(v - 0.5);
    const double fx = u - 0.5 - x, fy = v - 0.5 - y;
    return (at(map, n, x, y) * (1 - fx) + at(map, n, x + 1, y) * fx) * (1 - fy) +
           (at(map, n, x, y + 1) * (1 - fx) + at(map, n, x + 1, y + 1) * fx) * fy;
}

// Widens a map by a variance of 0.69 mm2 a side. The weights w, 1 - 2 w, w have one of 2 w cells.
static void smooth(double *map, int n, double cell_mm)
{
    const double w = 0.69 / (2 * cell_mm * cell_mm);
    double *from = malloc((size_t)(n * n) * sizeof(*from));
    for (int way = 0; way < 2; way++) {
        memcpy(from, map, (size_t)(n * n) * sizeof(*from));
        for (int y = 0; y < n; y++)
            for (int x = 0; x < n; x++)
                map[y * n + x] = (1 - 2 * w) * at(from, n, x, y) +
                                 w * (way ? at(from, n, x - 1, y) + at(from, n, x + 1, y)
                                          : at(from, n, x, y - 1) + at(from, n, x, y + 1));
    }
    free(from);
}

static void dry(struct slide_oracle *o)
{
    for (int i = 0; i < o->n * o->n; i++) {
        const double square = o->mm[i] * o->mm[i] - 2 * o->drying_mm2_s * o->run_s;
        o->mm[i] = o->drying_mm2_s > 0 ? sqrt(fmax(square, 0)) : o->mm[i];
    }
}

static double pressure(double mm)
{
    return mm < 0.8 ? mm * mm / 1.6 : mm - 0.4;
}

// One run of levelling, between each texel and those to the right and below.
static void level(struct slide_oracle *o, const double *pull, double share)
{
    const int n = o->n;
    const double texel_mm = o->pane_mm / n;
    double *next = malloc((size_t)(n * n) * sizeof(*next));
    memcpy(next, o->mm, (size_t)(n * n) * sizeof(*next));
    for (int i = 0; i < n * n; i++) {
        for (int way = 0; way < 2; way++) {
            if ((way ? i / n : i % n) == n - 1)
                continue;
            const int j = way ? i + n : i + 1;
            const double above = pressure(o->mm[i]) - pull[i] - pressure(o->mm[j]) + pull[j];
            const int giver = above > 0 ? i : j, taker = above > 0 ? j : i;
            const double layer_mm = fmin(fmax(o->mm[giver], 0.4), 1);
            const double part = fmin(share * layer_mm * fabs(above), 0.2 * o->mm[giver]);
            if (o->mm[taker] == 0 && o->mm[giver] < o->contact_slope * texel_mm)
                continue;
            next[giver] -= part;
            next[taker] += part;
        }
    }
    memcpy(o->mm, next, (size_t)(n * n) * sizeof(*next));
    free(next);
}

// The pace of a cell, from the most water within 3.7 mm.
static int pace_of(const struct slide_oracle *o, const double *wide, int x, int y)
{
    const double around_mm2 = 2 * 3.14159265358979 * 4 * 0.69;
    double most = 0;
    for (int j = -3; j <= 3; j++)
        for (int i = -3; i <= 3; i++)
            if ((i * i + j * j) * o->cell_mm * o->cell_mm <= 3.7 * 3.7)
                most = fmax(most, at(wide, o->cells, x + i, y + j) * around_mm2);
    const double speed =
        (most * pow(o->cos_alpha, 1.5) / o->slide_above_mm3 - 1) * o->slide_gain_mm_s;
    int pace = 0;
    while (pace < 7 && speed > o->slide_most_mm_s * pow(2, (pace + 1 - 7) / 2.0))
        pace++;
    return pace;
}

// How much more water a drop has on its axis than on its flanks, 2 mm beside it.
static double ridge_of(const struct slide_oracle *o, const double *wide, int x, int y)
{
    const double aside = 2 / o->cell_mm, here = at(wide, o->cells, x, y);
    const double u = x + 0.5, v = y + 0.5;
    const double flanks = between(wide, o->cells, u + o->down_y * aside, v - o->down_x * aside) +
                          between(wide, o->cells, u - o->down_y * aside, v + o->down_x * aside);
    return here > 0 ? fmin(fmax(2 * (2 * here - flanks) / here - 0.3, 0), 1) : 0;
}

static void slide(struct slide_oracle *o, const double *wide)
{
    const int n = o->n, k = n / o->cells;
    double *ridge = malloc((size_t)(o->cells * o->cells) * sizeof(*ridge));
    double *next = calloc((size_t)(n * n), sizeof(*next));
    for (int i = 0; i < o->cells * o->cells; i++)
        ridge[i] = ridge_of(o, wide, i % o->cells, i / o->cells);
    for (int i = 0; i < n * n; i++) {
        const int x = i % n, y = i / n;
        const int *way = o->ways[pace_of(o, wide, x / k, y / k)];
        const double held = o->beads_mm[i] * between(ridge, o->cells, (x + 0.5) / k, (y + 0.5) / k);
        const double gives = way[0] || way[1] ? fmax(o->mm[i] - held, 0) : 0;
        next[i] += o->mm[i] - gives;
        const int to_x = x + way[0], to_y = y + way[1];
        if (to_x >= 0 && to_y >= 0 && to_x < n && to_y < n)
            next[to_y * n + to_x] += gives;
    }
    memcpy(o->mm, next, (size_t)(n * n) * sizeof(*next));
    free(next);
    free(ridge);
}

void slide_oracle_run(struct slide_oracle *o)
{
    const int n = o->n, k = n / o->cells, c2 = o->cells * o->cells;
    const double texel_mm = o->pane_mm / n;
    const double levelled = o->levelling_mm_s * o->run_s / (texel_mm * texel_mm);
    const int runs = (int)ceil(levelled / 0.22);
    double *wide = calloc((size_t)c2, sizeof(*wide));
    double *pull = malloc((size_t)(n * n) * sizeof(*pull));
    dry(o);
    for (int i = 0; i < n * n; i++)
        wide[i / n / k * o->cells + i % n / k] += o->mm[i] / (k * k);
    smooth(wide, o->cells, o->cell_mm);
    smooth(wide, o->cells, o->cell_mm);
    for (int i = 0; i < n * n; i++)
        pull[i] = o->cohesion * between(wide, o->cells, (i % n + 0.5) / k, (i / n + 0.5) / k);
    smooth(wide, o->cells, o->cell_mm);
    smooth(wide, o->cells, o->cell_mm);
    for (int run = 0; run < runs; run++)
        level(o, pull, levelled / runs);
    slide(o, wide);
    free(wide);
    free(pull);
}
