// The agreement tiers T0, T1 and T2 of two encoded pictures.
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/image/compare/compare.h"

enum {
    MASK_CODES = 1,     // a pixel is rain when a colour is further than this from the background
    T1_MAX_CODES = 2,   // two roundings to a code, one on each side
    POSITION_CODES = 8, // a colour found a pixel away is the same streak's when this near
    TILE = 16,
};
static const double T1_ABOVE_ONE = 0.001, T1_BIAS_CODES = 0.25;
static const double T2_MATCHED = 0.995, T2_ENERGY_LOW = 0.99, T2_ENERGY_HIGH = 1.01;
static const double T2_TILE_CODES = 2.0;

struct pictures {
    const struct rg_picture *linear_a, *linear_b;
    const uint8_t *a, *b, *background; // codes; background: NULL for none
    const uint8_t *mask;
    int width, height;
};

// What one row adds; integers, so that the order of adding does not matter.
struct row_sums {
    int64_t mask_pixels, above_one, coverage_mismatches, unmatched_a, unmatched_b;
    int64_t bias[3], energy_a, energy_b;
    int max_codes;
};

static inline int distance(const uint8_t *p, const uint8_t *q)
{
    int r = abs(p[0] - q[0]), g = abs(p[1] - q[1]), b = abs(p[2] - q[2]);
    int rg = r > g ? r : g;
    return rg > b ? rg : b;
}

static void mask_row(const struct pictures *p, int y, uint8_t *mask)
{
    int64_t at = (int64_t)y * p->width;
    for (int x = 0; x < p->width; x++, at++)
        mask[at] = !p->background || distance(p->a + at * 4, p->background + at * 4) > MASK_CODES ||
                   distance(p->b + at * 4, p->background + at * 4) > MASK_CODES;
}

// Whether the colour of pixel x, y of `from` is found within one pixel of it in `to`.
static bool found_near(const struct pictures *p, const uint8_t *from, const uint8_t *to, int x,
                       int y)
{
    const uint8_t *colour = from + ((int64_t)y * p->width + x) * 4;
    for (int ny = y - 1; ny <= y + 1; ny++)
        for (int nx = x - 1; nx <= x + 1; nx++)
            if (nx >= 0 && ny >= 0 && nx < p->width && ny < p->height &&
                distance(colour, to + ((int64_t)ny * p->width + nx) * 4) <= POSITION_CODES)
                return true;
    return false;
}

static void measure_differing(const struct pictures *p, int x, int y, struct row_sums *s)
{
    int64_t at = ((int64_t)y * p->width + x) * 4;
    const uint8_t *a = p->a + at, *b = p->b + at;
    int colours = distance(a, b), alpha = abs(a[3] - b[3]);
    int worst = colours > alpha ? colours : alpha;
    s->max_codes = worst > s->max_codes ? worst : s->max_codes;
    if (!p->mask[at / 4])
        return;
    s->above_one += worst > 1;
    for (int c = 0; c < 3; c++)
        s->bias[c] += b[c] - a[c];
    if (p->background) {
        int from_a = distance(a, p->background + at), from_b = distance(b, p->background + at);
        s->coverage_mismatches +=
            (from_a > MASK_CODES && from_b == 0) || (from_b > MASK_CODES && from_a == 0);
    }
    if (colours > POSITION_CODES) {
        s->unmatched_a += !found_near(p, p->a, p->b, x, y);
        s->unmatched_b += !found_near(p, p->b, p->a, x, y);
    }
}

static int energy(const uint8_t *codes, const uint8_t *background)
{
    if (!background)
        return codes[0] + codes[1] + codes[2];
    return abs(codes[0] - background[0]) + abs(codes[1] - background[1]) +
           abs(codes[2] - background[2]);
}

static struct row_sums measure_row(const struct pictures *p, int y)
{
    struct row_sums s;
    memset(&s, 0, sizeof(s));
    int64_t start = (int64_t)y * p->width;
    bool same = memcmp(p->a + start * 4, p->b + start * 4, (size_t)p->width * 4) == 0;
    for (int x = 0; x < p->width; x++) {
        int64_t at = (start + x) * 4;
        s.mask_pixels += p->mask[start + x];
        if (!p->mask[start + x] && p->background && same)
            continue;
        const uint8_t *background = p->background ? p->background + at : NULL;
        s.energy_a += energy(p->a + at, background);
        s.energy_b += energy(p->b + at, background);
        if (!same && memcmp(p->a + at, p->b + at, 4) != 0)
            measure_differing(p, x, y, &s);
    }
    return s;
}

static void add_row(const struct row_sums *row, struct row_sums *total)
{
    total->mask_pixels += row->mask_pixels;
    total->above_one += row->above_one;
    total->coverage_mismatches += row->coverage_mismatches;
    total->unmatched_a += row->unmatched_a;
    total->unmatched_b += row->unmatched_b;
    for (int c = 0; c < 3; c++)
        total->bias[c] += row->bias[c];
    total->energy_a += row->energy_a;
    total->energy_b += row->energy_b;
    total->max_codes = row->max_codes > total->max_codes ? row->max_codes : total->max_codes;
}

// The largest difference of a colour's mean among the tiles of the row of tiles that starts at y0.
static double tile_row_max(const struct pictures *p, int y0)
{
    double max = 0;
    int rows = p->height - y0 < TILE ? p->height - y0 : TILE;
    for (int x0 = 0; x0 < p->width; x0 += TILE) {
        int columns = p->width - x0 < TILE ? p->width - x0 : TILE, sum[4] = {0};
        for (int y = y0; y < y0 + rows; y++) {
            int64_t at = ((int64_t)y * p->width + x0) * 4;
            for (int i = 0; i < columns * 4; i++)
                sum[i & 3] += p->b[at + i] - p->a[at + i];
        }
        for (int c = 0; c < 3; c++)
            max = fmax(max, abs(sum[c]) / (double)(rows * columns));
    }
    return max;
}

// Relative differences of linear light, over the mask of one row: sums for the mean, and the
// largest of a pixel. Values that are not finite are left out; they fail the tiers by themselves.
static void relative_row(const struct pictures *p, int y, double sums[2], double *max)
{
    int channels = p->linear_a->channels, colours = rg_picture_colours(p->linear_a);
    int64_t start = (int64_t)y * p->width;
    const float *a = p->linear_a->texels + start * channels;
    const float *b = p->linear_b->texels + start * channels;
    for (int x = 0; x < p->width; x++, a += channels, b += channels) {
        if (!p->mask[start + x])
            continue;
        double difference = 0, size = 0;
        for (int c = 0; c < colours; c++) {
            double va = fabs((double)a[c]), vb = fabs((double)b[c]);
            difference += fabs((double)a[c] - (double)b[c]);
            size += va > vb ? va : vb;
        }
        if (!isfinite(difference) || size == 0) // the larger of a NaN and a number can be either
            continue;
        sums[0] += difference;
        sums[1] += size;
        if (difference > *max * size)
            *max = difference / size;
    }
}

static bool measure_relative(const struct pictures *p, struct rg_tiers *tiers)
{
    double(*rows)[3] = calloc((size_t)p->height, sizeof(*rows));
    if (!rows)
        return false;
#pragma omp parallel for schedule(static)
    for (int y = 0; y < p->height; y++)
        relative_row(p, y, rows[y], &rows[y][2]);
    double difference = 0, size = 0;
    for (int y = 0; y < p->height; y++) {
        difference += rows[y][0];
        size += rows[y][1];
        tiers->relative_max = fmax(tiers->relative_max, rows[y][2]);
    }
    tiers->relative_mean = size > 0 ? difference / size : 0;
    free(rows);
    return true;
}

static void fail_tier(struct rg_verdict *verdict, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

// Notes why a tier fails; the first reason stays.
static void fail_tier(struct rg_verdict *verdict, const char *format, ...)
{
    if (!verdict->holds)
        return;
    verdict->holds = false;
    va_list args;
    va_start(args, format);
    vsnprintf(verdict->why, sizeof(verdict->why), format, args);
    va_end(args);
}

static void judge_t1(struct rg_tiers *t)
{
    if (t->coverage_mismatches)
        fail_tier(&t->of[RG_T1], "coverage differs in %lld pixels",
                  (long long)t->coverage_mismatches);
    if (t->max_codes > T1_MAX_CODES)
        fail_tier(&t->of[RG_T1], "largest difference %d/255 is above %d/255", t->max_codes,
                  T1_MAX_CODES);
    if (t->above_one_fraction > T1_ABOVE_ONE)
        fail_tier(&t->of[RG_T1], "%.3g %% of the mask is above 1/255, allowed %g %%",
                  100 * t->above_one_fraction, 100 * T1_ABOVE_ONE);
    if (fabs(t->bias_codes) > T1_BIAS_CODES)
        fail_tier(&t->of[RG_T1], "bias %.3g/255 is beyond %g/255", t->bias_codes, T1_BIAS_CODES);
}

static void judge_t2(struct rg_tiers *t)
{
    double matched = fmin(t->matched_a, t->matched_b);
    if (matched < T2_MATCHED)
        fail_tier(&t->of[RG_T2], "only %.4g %% of the mask is found within 1 pixel, needed %g %%",
                  100 * matched, 100 * T2_MATCHED);
    if (!(t->energy_ratio >= T2_ENERGY_LOW && t->energy_ratio <= T2_ENERGY_HIGH))
        fail_tier(&t->of[RG_T2], "energy ratio %.5g is outside %g to %g", t->energy_ratio,
                  T2_ENERGY_LOW, T2_ENERGY_HIGH);
    if (t->tile_max_codes > T2_TILE_CODES)
        fail_tier(&t->of[RG_T2], "a 16 x 16 tile's mean differs by %.3g/255, above %g/255",
                  t->tile_max_codes, T2_TILE_CODES);
}

static void judge(const struct rg_metrics *metrics, struct rg_tiers *t)
{
    for (int i = 0; i < RG_TIER_COUNT; i++) {
        t->of[i].holds = true;
        if (t->mask_pixels == 0)
            fail_tier(&t->of[i], "the rain mask is empty: neither picture has rain");
        if (i > RG_T0 && metrics->nonfinite_mismatches)
            fail_tier(&t->of[i], "%lld values are NaN or infinite in one picture only",
                      (long long)metrics->nonfinite_mismatches);
    }
    if (metrics->differing_values)
        fail_tier(&t->of[RG_T0], "%lld values differ", (long long)metrics->differing_values);
    judge_t1(t);
    judge_t2(t);
}

static void conclude(const struct row_sums *sums, struct rg_tiers *t)
{
    t->mask_pixels = sums->mask_pixels;
    t->max_codes = sums->max_codes;
    t->coverage_mismatches = sums->coverage_mismatches;
    double mask = sums->mask_pixels ? (double)sums->mask_pixels : 1;
    t->above_one_fraction = (double)sums->above_one / mask;
    for (int c = 0; c < 3; c++)
        if (fabs((double)sums->bias[c] / mask) > fabs(t->bias_codes))
            t->bias_codes = (double)sums->bias[c] / mask;
    t->matched_a = 1 - (double)sums->unmatched_a / mask;
    t->matched_b = 1 - (double)sums->unmatched_b / mask;
    t->energy_ratio = sums->energy_a   ? (double)sums->energy_b / (double)sums->energy_a
                      : sums->energy_b ? INFINITY
                                       : 1;
}

bool rg_tiers_compute(const struct rg_picture *a, const struct rg_picture *b,
                      const uint8_t *a_codes, const uint8_t *b_codes,
                      const uint8_t *background_codes, const struct rg_metrics *metrics,
                      uint8_t *mask, struct rg_tiers *tiers)
{
    struct pictures p = {a, b, a_codes, b_codes, background_codes, mask, a->width, a->height};
    struct row_sums total;
    memset(&total, 0, sizeof(total));
    memset(tiers, 0, sizeof(*tiers));
    tiers->mask_is_whole = !background_codes;
    double tile_max = 0;
#pragma omp parallel
    {
        struct row_sums own;
        memset(&own, 0, sizeof(own));
#pragma omp for schedule(static)
        for (int y = 0; y < p.height; y++)
            mask_row(&p, y, mask);
#pragma omp for schedule(dynamic, 8) nowait
        for (int y = 0; y < p.height; y++) {
            struct row_sums row = measure_row(&p, y);
            add_row(&row, &own);
        }
#pragma omp for schedule(static) reduction(max : tile_max)
        for (int y = 0; y < p.height; y += TILE)
            tile_max = fmax(tile_max, tile_row_max(&p, y));
#pragma omp critical
        add_row(&own, &total);
    }
    tiers->tile_max_codes = tile_max;
    if (!measure_relative(&p, tiers))
        return rg_error("comparing %d x %d pixels: no memory; crop them", p.width, p.height);
    conclude(&total, tiers);
    judge(metrics, tiers);
    return true;
}

bool rg_shows_rain(const uint8_t *codes, const uint8_t *background_codes, int64_t pixels)
{
    bool shows = false;
    for (int64_t i = 0; i < pixels && !shows; i++)
        shows = distance(codes + i * 4, background_codes + i * 4) > MASK_CODES;
    return shows;
}

int rg_tiers_strictest(const struct rg_tiers *tiers)
{
    int tier = 0;
    while (tier < RG_TIER_COUNT && !tiers->of[tier].holds)
        tier++;
    return tier;
}

void rg_tiers_text(const struct rg_tiers *tiers, char text[RG_TIERS_TEXT])
{
    const int tier = rg_tiers_strictest(tiers);
    if (tier < RG_TIER_COUNT)
        snprintf(text, RG_TIERS_TEXT, "%s would hold", rg_tier_name((enum rg_tier)tier));
    else
        snprintf(text, RG_TIERS_TEXT, "no tier would hold: %s", tiers->of[RG_T2].why);
}
