#include "tests/oracle/flow/slide.h"

#include <math.h>
#include <stdbool.h>
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

// The share of wet glass around each texel, weighted by a tent 1.45 mm wide a side. Beyond 4
// texels, every second one counts, and so on.
static double *wet_around(const struct slide_oracle *o)
{
    const int n = o->n;
    const double texel_mm = o->pane_mm / n;
    const int apart = (int)fmax(ceil(1.45 / (5 * texel_mm) - 1e-9), 1);
    const double width = fmax(1.45 / (apart * texel_mm), 1);
    double *wet = calloc((size_t)(n * n), sizeof(*wet)), all = 0;
    for (int j = -4; j <= 4; j++)
        for (int i = -4; i <= 4; i++) {
            const double weight = fmax(width - abs(i), 0) * fmax(width - abs(j), 0);
            all += weight;
            for (int t = 0; t < n * n; t++)
                wet[t] +=
                    weight * fmin(at(o->mm, n, t % n + i * apart, t / n + j * apart) / 0.06, 1);
        }
    for (int t = 0; t < n * n; t++)
        wet[t] /= all;
    return wet;
}

// Whether water that high may wet a texel with so much wet glass around.
static bool wets(const struct slide_oracle *o, double mm, double around)
{
    const double steep_mm = o->contact_slope * o->pane_mm / o->n;
    return mm >= steep_mm * fmin(fmax(5 * (0.5 - around), 0), 4);
}

static bool all_wet(const double *mm, int from, int step, int count)
{
    for (int k = 0; k <= count; k++)
        if (mm[from + k * step] <= 0.03)
            return false;
    return true;
}

// One run of levelling, between each texel and those `reach` to the right and below.
static void level(struct slide_oracle *o, const double *pull, const double *wet, double share,
                  int reach)
{
    const int n = o->n;
    double *next = malloc((size_t)(n * n) * sizeof(*next));
    memcpy(next, o->mm, (size_t)(n * n) * sizeof(*next));
    for (int i = 0; i < n * n; i++) {
        for (int way = 0; way < 2; way++) {
            if ((way ? i / n : i % n) >= n - reach)
                continue;
            const int step = way ? n : 1, j = i + reach * step;
            const double above = pressure(o->mm[i]) - pull[i] - pressure(o->mm[j]) + pull[j];
            const int giver = above > 0 ? i : j, taker = above > 0 ? j : i;
            const double layer_mm = fmin(fmax(o->mm[giver], 0.4), 1);
            const double part = fmin(share * layer_mm * fabs(above), 0.2 * o->mm[giver]);
            if (reach > 1 ? !all_wet(o->mm, i, step, reach)
                          : o->mm[taker] == 0 && !wets(o, o->mm[giver], wet[taker]))
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

// The paces of all cells: a wet cell slides as fast as any within six wet cells.
static int *paces_of(const struct slide_oracle *o, const double *wide, const double *mean_mm)
{
    const int c = o->cells;
    int *pace = malloc((size_t)(c * c) * sizeof(*pace)),
        *from = malloc((size_t)(c * c) * sizeof(*from));
    for (int i = 0; i < c * c; i++)
        pace[i] = pace_of(o, wide, i % c, i / c);
    for (int run = 0; run < 6; run++) {
        memcpy(from, pace, (size_t)(c * c) * sizeof(*from));
        for (int i = 0; i < c * c; i++)
            for (int k = 0; k < 9 && mean_mm[i] > 0.03; k++) {
                const int x = i % c + k % 3 - 1, y = i / c + k / 3 - 1;
                if (x >= 0 && y >= 0 && x < c && y < c && from[y * c + x] > pace[i])
                    pace[i] = from[y * c + x];
            }
    }
    free(from);
    return pace;
}

static void slide(struct slide_oracle *o, const double *wide, const double *mean_mm)
{
    int *pace = paces_of(o, wide, mean_mm);
    const int n = o->n, k = n / o->cells;
    double *ridge = malloc((size_t)(o->cells * o->cells) * sizeof(*ridge));
    double *next = calloc((size_t)(n * n), sizeof(*next));
    for (int i = 0; i < o->cells * o->cells; i++)
        ridge[i] = ridge_of(o, wide, i % o->cells, i / o->cells);
    for (int i = 0; i < n * n; i++) {
        const int x = i % n, y = i / n;
        const int *way = o->ways[pace[y / k * o->cells + x / k]];
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
    free(pace);
}

// Levels in rounds of texels 4, 4, 2, 2 and 1 apart, without distances above 1.2 mm.
static void level_all(struct slide_oracle *o, const double *pull)
{
    const int reaches[] = {4, 4, 2, 2, 1};
    const double texel_mm = o->pane_mm / o->n;
    const double levelled = o->levelling_mm_s * o->run_s / (texel_mm * texel_mm);
    double *wet = wet_around(o), squares = 0;
    int first = 0;
    while (first < 4 && reaches[first] * texel_mm > 1.2)
        first++;
    for (int k = first; k < 5; k++)
        squares += reaches[k] * reaches[k];
    const int rounds = (int)ceil(levelled / squares / 0.22);
    for (int run = 0; run < rounds * (5 - first); run++)
        level(o, pull, wet, levelled / squares / rounds, reaches[first + run % (5 - first)]);
    free(wet);
}

void slide_oracle_run(struct slide_oracle *o)
{
    const int n = o->n, k = n / o->cells, c2 = o->cells * o->cells;
    double *wide = calloc((size_t)c2, sizeof(*wide));
    double *mean_mm = malloc((size_t)c2 * sizeof(*mean_mm));
    double *pull = malloc((size_t)(n * n) * sizeof(*pull));
    dry(o);
    for (int i = 0; i < n * n; i++)
        wide[i / n / k * o->cells + i % n / k] += o->mm[i] / (k * k);
    memcpy(mean_mm, wide, (size_t)c2 * sizeof(*mean_mm));
    smooth(wide, o->cells, o->cell_mm);
    smooth(wide, o->cells, o->cell_mm);
    double *wet = wet_around(o);
    for (int i = 0; i < n * n; i++)
        pull[i] = o->cohesion * between(wide, o->cells, (i % n + 0.5) / k, (i / n + 0.5) / k) +
                  0.3 * wet[i];
    free(wet);
    smooth(wide, o->cells, o->cell_mm);
    smooth(wide, o->cells, o->cell_mm);
    level_all(o, pull);
    slide(o, wide, mean_mm);
    free(wide);
    free(mean_mm);
    free(pull);
}
