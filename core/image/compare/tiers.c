// The agreement tiers T0, T1 and T2 of two encoded pictures.
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/image/compare/compare.h"
#include "core/image/compare/multiversion.h"

enum {
    MASK_CODES = 1,     // a pixel is rain when a colour is further than this from the background
    T1_MAX_CODES = 2,   // two roundings to a code, one on each side
    POSITION_CODES = 8, // a colour found a pixel away belongs to the same streak when this near
    TILE = 16,
};
static const double T1_ABOVE_ONE = 0.001, T1_BIAS_CODES = 0.25;
static const double T2_MATCHED = 0.995, T2_ENERGY_LOW = 0.99, T2_ENERGY_HIGH = 1.01;
static const double T2_TILE_CODES = 2.0;
// Values below black and above white, which the encoding clamps, are compared as light: a relative
// difference is converted to codes by the slope of sRGB's curve at white.
static const double CODES_AT_WHITE = 255 * 1.055 / 2.4;
static const double CLAMPED_LOW = 0.99, CLAMPED_HIGH = 1.01; // limits of the ratio of light

struct pictures {
    const struct rg_picture *linear_a, *linear_b;
    const uint8_t *a, *b, *background; // codes; background: NULL for none
    const uint8_t *mask;
    const bool *beyond; // by row, of those above and below it too: whether one may be clamped
    int width, height;
    float exposure;
};

// The sums of one row; integers, so that the order of adding does not matter.
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
    if (!p->background) {
        memset(mask + at, 1, (size_t)p->width);
        return;
    }
    for (int x = 0; x < p->width; x++, at++)
        mask[at] = distance(p->a + at * 4, p->background + at * 4) > MASK_CODES ||
                   distance(p->b + at * 4, p->background + at * 4) > MASK_CODES;
}

// --- light that the encoding clamps away ---

// Whether a value, once it is scaled, is outside 0..1 or NaN. Alpha is not scaled, so a scale below
// 1 counts as 1.
RG_MULTIVERSION static bool has_beyond(const float *values, int64_t count, float scale)
{
    int beyond = 0;
    for (int64_t i = 0; i < count; i++)
        beyond |= !(values[i] >= 0 && values[i] * scale <= 1);
    return beyond;
}

static bool row_has_beyond(const struct pictures *p, const struct rg_picture *of, int y)
{
    const int64_t values = (int64_t)of->width * of->channels;
    return has_beyond(of->texels + y * values, values, fmaxf(p->exposure, 1));
}

// The part of a value beyond 0..1, which codes cannot express.
static double clamped(double value)
{
    return value > 1 ? value - 1 : value < 0 ? value : 0;
}

// The difference of b's channel and a's beyond black and white, in codes. Values that are not
// finite fail the tiers elsewhere.
static double clamped_codes(const struct pictures *p, const float *a, const float *b, int channel)
{
    const bool is_colour = channel < rg_picture_colours(p->linear_a);
    const double scale = is_colour ? (double)p->exposure : 1;
    const double va = scale * (double)a[channel], vb = scale * (double)b[channel];
    if (!isfinite(va) || !isfinite(vb))
        return 0;
    const double size = fmax(fabs(va), fabs(vb));
    return size > 1 || va < 0 || vb < 0
               ? CODES_AT_WHITE * (clamped(vb) - clamped(va)) / fmax(size, 1)
               : 0;
}

// The largest such difference among a pixel's channels, either way.
static double clamped_distance(const struct pictures *p, int y, const float *a, const float *b)
{
    double worst = 0;
    if (!p->beyond[y])
        return 0;
    for (int c = 0; c < p->linear_a->channels; c++)
        worst = fmax(worst, fabs(clamped_codes(p, a, b, c)));
    return worst;
}

static const float *linear(const struct pictures *p, const uint8_t *of, int64_t pixel)
{
    const struct rg_picture *picture = of == p->a ? p->linear_a : p->linear_b;
    return picture->texels + pixel * picture->channels;
}

// --- encoded codes ---

// Whether the colour of pixel x, y of `from` is found within one pixel of it in `to`.
static bool found_near(const struct pictures *p, const uint8_t *from, const uint8_t *to, int x,
                       int y)
{
    const int64_t at = (int64_t)y * p->width + x;
    for (int ny = y - 1; ny <= y + 1; ny++)
        for (int nx = x - 1; nx <= x + 1; nx++) {
            const int64_t near = (int64_t)ny * p->width + nx;
            if (nx >= 0 && ny >= 0 && nx < p->width && ny < p->height &&
                distance(from + at * 4, to + near * 4) <= POSITION_CODES &&
                clamped_distance(p, y, linear(p, from, at), linear(p, to, near)) <= POSITION_CODES)
                return true;
        }
    return false;
}

static void measure_differing(const struct pictures *p, int x, int y, struct row_sums *s)
{
    int64_t at = ((int64_t)y * p->width + x) * 4;
    const uint8_t *a = p->a + at, *b = p->b + at;
    const double lost = clamped_distance(p, y, linear(p, p->a, at / 4), linear(p, p->b, at / 4));
    int colours = distance(a, b), alpha = abs(a[3] - b[3]);
    int worst = colours > alpha ? colours : alpha;
    s->max_codes = worst > s->max_codes ? worst : s->max_codes;
    if (!p->mask[at / 4])
        return;
    s->above_one += worst > 1 || lost > 1;
    for (int c = 0; c < 3; c++)
        s->bias[c] += b[c] - a[c];
    if (p->background) {
        int from_a = distance(a, p->background + at), from_b = distance(b, p->background + at);
        s->coverage_mismatches +=
            (from_a > MASK_CODES && from_b == 0) || (from_b > MASK_CODES && from_a == 0);
    }
    if (colours > POSITION_CODES || lost > POSITION_CODES) {
        s->unmatched_a += !found_near(p, p->a, p->b, x, y);
        s->unmatched_b += !found_near(p, p->b, p->a, x, y);
    }
}

static int energy(const uint8_t *codes, const uint8_t *background)
{
    return abs(codes[0] - background[0]) + abs(codes[1] - background[1]) +
           abs(codes[2] - background[2]);
}

// The energies of a row without a background, whose mask is the whole row.
RG_MULTIVERSION static void add_energies(const uint8_t *a, const uint8_t *b, int width,
                                         struct row_sums *s)
{
    int sum_a = 0, sum_b = 0; // of at most RG_PICTURE_MAX_SIDE_PX times 765
    for (int x = 0; x < width; x++) {
        sum_a += a[x * 4] + a[x * 4 + 1] + a[x * 4 + 2];
        sum_b += b[x * 4] + b[x * 4 + 1] + b[x * 4 + 2];
    }
    s->energy_a += sum_a;
    s->energy_b += sum_b;
    s->mask_pixels += width;
}

// Whether a pixel's codes differ, or the values that the encoding may have clamped away.
static bool differs(const struct pictures *p, int64_t pixel, int y)
{
    uint32_t a, b;
    memcpy(&a, p->a + pixel * 4, sizeof(a));
    memcpy(&b, p->b + pixel * 4, sizeof(b));
    const size_t texel = (size_t)p->linear_a->channels * sizeof(float);
    return a != b ||
           (p->beyond[y] && memcmp(linear(p, p->a, pixel), linear(p, p->b, pixel), texel) != 0);
}

static struct row_sums measure_row(const struct pictures *p, int y)
{
    struct row_sums s;
    memset(&s, 0, sizeof(s));
    const int64_t start = (int64_t)y * p->width, end = start + p->width;
    if (!p->background)
        add_energies(p->a + start * 4, p->b + start * 4, p->width, &s);
    const size_t row = (size_t)(p->width * p->linear_a->channels) * sizeof(float);
    const bool same =
        p->background && memcmp(linear(p, p->a, start), linear(p, p->b, start), row) == 0;
    for (int64_t at = start; p->background && at < end; at++) {
        s.mask_pixels += p->mask[at];
        if (same && !p->mask[at])
            continue;
        s.energy_a += energy(p->a + at * 4, p->background + at * 4);
        s.energy_b += energy(p->b + at * 4, p->background + at * 4);
    }
    if (!p->beyond[y] && memcmp(p->a + start * 4, p->b + start * 4, (size_t)p->width * 4) == 0)
        return s;
    for (int64_t at = start; at < end; at++)
        if (differs(p, at, y))
            measure_differing(p, (int)(at - start), y, &s);
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

// Adds the differences of some pixels of row y beyond black and white, by channel.
static void add_clamped(const struct pictures *p, int y, int64_t pixel, int count, double codes[4])
{
    if (!p->beyond[y])
        return;
    const int channels = p->linear_a->channels;
    const float *a = linear(p, p->a, pixel), *b = linear(p, p->b, pixel);
    if (memcmp(a, b, (size_t)count * (size_t)channels * sizeof(*a)) == 0)
        return;
    for (int i = 0; i < count * channels; i++)
        codes[i % channels] +=
            clamped_codes(p, a + i - i % channels, b + i - i % channels, i % channels);
}

// Adds the differences of b's codes and a's, by channel and column.
RG_MULTIVERSION static void add_codes(const uint8_t *a, const uint8_t *b, int codes,
                                      int sums[TILE * 4])
{
    for (int i = 0; i < codes; i++)
        sums[i] += b[i] - a[i];
}

// The largest difference of a colour's mean among the tiles of the row of tiles that starts at y0.
static double tile_row_max(const struct pictures *p, int y0)
{
    double max = 0;
    int rows = p->height - y0 < TILE ? p->height - y0 : TILE;
    for (int x0 = 0; x0 < p->width; x0 += TILE) {
        int columns = p->width - x0 < TILE ? p->width - x0 : TILE, sum[4] = {0};
        int sums[TILE * 4] = {0};
        double lost[4] = {0};
        for (int y = y0; y < y0 + rows; y++) {
            int64_t at = ((int64_t)y * p->width + x0) * 4;
            add_codes(p->a + at, p->b + at, columns * 4, sums);
            add_clamped(p, y, at / 4, columns, lost);
        }
        for (int i = 0; i < columns * 4; i++)
            sum[i & 3] += sums[i];
        for (int c = 0; c < 3; c++)
            max = fmax(max, fabs(sum[c] + lost[c]) / (double)(rows * columns));
    }
    return max;
}

// Relative differences of linear light, over the mask of one row: sums for the mean, and the
// largest of a pixel. Values that are not finite are skipped, because they fail the tiers
// elsewhere.
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
        if (!isfinite(difference) || size == 0) // fmax of a NaN and a number may return either
            continue;
        sums[0] += difference;
        sums[1] += size;
        if (difference > *max * size)
            *max = difference / size;
    }
}

// Sums of a row's light that the encoding clamps away.
struct clamped_sums {
    double max_codes;        // anywhere
    double bias[4];          // over the mask, by channel
    double light_a, light_b; // over the mask's values that are beyond black or white in A or B
};

static void clamped_row(const struct pictures *p, int y, struct clamped_sums *s)
{
    const int colours = rg_picture_colours(p->linear_a);
    if (!p->beyond[y])
        return;
    for (int64_t at = (int64_t)y * p->width; at < ((int64_t)y + 1) * p->width; at++) {
        const float *a = linear(p, p->a, at), *b = linear(p, p->b, at);
        s->max_codes = fmax(s->max_codes, clamped_distance(p, y, a, b));
        for (int c = 0; p->mask[at] && c < colours; c++) {
            const double va = fabs((double)(p->exposure * a[c])),
                         vb = fabs((double)(p->exposure * b[c]));
            if ((a[c] >= 0 && b[c] >= 0 && va <= 1 && vb <= 1) || !isfinite(va) || !isfinite(vb))
                continue;
            s->light_a += fmax(va, 1);
            s->light_b += fmax(vb, 1);
        }
        if (p->mask[at])
            add_clamped(p, y, at, 1, s->bias);
    }
}

static bool measure_clamped(const struct pictures *p, struct rg_tiers *tiers)
{
    struct clamped_sums *rows = calloc((size_t)p->height, sizeof(*rows)), all = {0};
    if (!rows)
        return false;
#pragma omp parallel for schedule(static)
    for (int y = 0; y < p->height; y++)
        clamped_row(p, y, &rows[y]);
    for (int y = 0; y < p->height; y++) {
        all.max_codes = fmax(all.max_codes, rows[y].max_codes);
        for (int c = 0; c < 3; c++)
            all.bias[c] += rows[y].bias[c];
        all.light_a += rows[y].light_a;
        all.light_b += rows[y].light_b;
    }
    free(rows);
    tiers->clamped_max = all.max_codes / CODES_AT_WHITE;
    const double mask = CODES_AT_WHITE * (double)(tiers->mask_pixels ? tiers->mask_pixels : 1);
    for (int c = 0; c < rg_picture_colours(p->linear_a); c++)
        if (fabs(all.bias[c] / mask) > fabs(tiers->clamped_bias))
            tiers->clamped_bias = all.bias[c] / mask;
    tiers->clamped_ratio = all.light_a > 0 ? all.light_b / all.light_a : 1;
    return true;
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

// Notes why a tier fails, unless a reason is noted already.
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
    if (t->clamped_max > T1_MAX_CODES / CODES_AT_WHITE)
        fail_tier(&t->of[RG_T1],
                  "beyond black and white: largest difference %.3g %% is above %.3g %%",
                  100 * t->clamped_max, 100 * T1_MAX_CODES / CODES_AT_WHITE);
    if (t->above_one_fraction > T1_ABOVE_ONE)
        fail_tier(&t->of[RG_T1], "%.3g %% of the mask is above 1/255, allowed %g %%",
                  100 * t->above_one_fraction, 100 * T1_ABOVE_ONE);
    if (fabs(t->bias_codes) > T1_BIAS_CODES)
        fail_tier(&t->of[RG_T1], "bias %.3g/255 is beyond %g/255", t->bias_codes, T1_BIAS_CODES);
    if (fabs(t->clamped_bias) > T1_BIAS_CODES / CODES_AT_WHITE)
        fail_tier(&t->of[RG_T1], "beyond black and white: bias %.3g %% is beyond %.3g %%",
                  100 * t->clamped_bias, 100 * T1_BIAS_CODES / CODES_AT_WHITE);
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
    if (!(t->clamped_ratio >= CLAMPED_LOW && t->clamped_ratio <= CLAMPED_HIGH))
        fail_tier(&t->of[RG_T2], "beyond black and white: light's ratio %.5g is outside %g to %g",
                  t->clamped_ratio, CLAMPED_LOW, CLAMPED_HIGH);
    if (t->tile_max_codes > T2_TILE_CODES)
        fail_tier(&t->of[RG_T2], "a 16 x 16 tile's mean differs by %.3g/255, above %g/255",
                  t->tile_max_codes, T2_TILE_CODES);
}

static void judge(const struct rg_metrics *metrics, struct rg_tiers *t)
{
    for (int i = 0; i < RG_TIER_COUNT; i++) {
        t->of[i].holds = true;
        if (i == RG_T0 && metrics->differing_values)
            fail_tier(&t->of[i], "%lld values differ", (long long)metrics->differing_values);
        if (t->mask_pixels == 0)
            fail_tier(&t->of[i], "the rain mask is empty: neither picture has rain");
        if (i > RG_T0 && metrics->nonfinite_mismatches)
            fail_tier(&t->of[i], "%lld values are NaN or infinite in one picture only",
                      (long long)metrics->nonfinite_mismatches);
    }
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

// By row, whether it or a row next to it has values to be clamped; the caller frees it.
static bool *find_beyond(const struct pictures *p)
{
    bool *of_rows = calloc((size_t)p->height, 2 * sizeof(*of_rows));
    if (!of_rows)
        return NULL;
    bool *beside = of_rows + p->height;
#pragma omp parallel for schedule(static)
    for (int y = 0; y < p->height; y++)
        beside[y] = row_has_beyond(p, p->linear_a, y) || row_has_beyond(p, p->linear_b, y);
    for (int y = 0; y < p->height; y++)
        of_rows[y] = beside[y] || (y > 0 && beside[y - 1]) || (y < p->height - 1 && beside[y + 1]);
    return of_rows;
}

bool rg_tiers_compute(const struct rg_picture *a, const struct rg_picture *b,
                      const uint8_t *a_codes, const uint8_t *b_codes,
                      const uint8_t *background_codes, float exposure,
                      const struct rg_metrics *metrics, uint8_t *mask, struct rg_tiers *tiers)
{
    struct pictures p = {a,    b,    a_codes,  b_codes,   background_codes,
                         mask, NULL, a->width, a->height, exposure};
    bool *beyond = find_beyond(&p);
    if (!beyond)
        return rg_harness_error("comparing %d x %d pixels: no memory; crop them", p.width,
                                p.height);
    p.beyond = beyond;
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
    conclude(&total, tiers);
    const bool ok = measure_relative(&p, tiers) && measure_clamped(&p, tiers);
    free(beyond);
    if (!ok)
        return rg_harness_error("comparing %d x %d pixels: no memory; crop them", p.width,
                                p.height);
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

enum rg_outcome rg_comparison_outcome(const struct rg_comparison *comparison, enum rg_tier owed)
{
    const struct rg_tiers *tiers = &comparison->tiers;
    if (!tiers->mask_pixels && (owed != RG_T0 || !comparison->metrics.differing_values))
        return RG_NOTHING;
    return tiers->of[owed].holds ? RG_OK : RG_FAIL;
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
