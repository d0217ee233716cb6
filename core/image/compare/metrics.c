#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/image/compare/compare.h"
#include "core/image/compare/multiversion.h"

const float rg_above_thresholds[RG_ABOVE_COUNT] = {1e-6f, 1e-4f, 1e-3f, 1e-2f};

// Sums run in LANES fixed lanes and are added row by row, so that vector width and threads change
// no bit.
enum { LANES = 16 };

// fmaxf handles NaN at the cost of a call for each value; this one does not.
static inline float larger(float a, float b)
{
    return a > b ? a : b;
}

struct row_metrics {
    double sum, square_sum;
    float max, largest_value;
    int max_index; // index of the largest difference in its row
    int differing_values, differing_pixels;
    int values_above[RG_ABOVE_COUNT], pixels_above[RG_ABOVE_COUNT];
    int nonfinite_a, nonfinite_b, mismatches;
};

// Sums up a row of finite values. False, and nothing set, if a value is not finite.
RG_MULTIVERSION static bool sum_finite_row(const float *a, const float *b, int values,
                                           struct row_metrics *row)
{
    double sum[LANES] = {0}, squares[LANES] = {0};
    float max[LANES] = {0}, largest[LANES] = {0}, poison[LANES] = {0};
    int i = 0;
    for (; i + LANES <= values; i += LANES)
        for (int l = 0; l < LANES; l++) {
            float d = fabsf(a[i + l] - b[i + l]);
            float v = larger(fabsf(a[i + l]), fabsf(b[i + l]));
            sum[l] += (double)d;
            squares[l] += (double)d * (double)d;
            max[l] = larger(d, max[l]);
            largest[l] = larger(v, largest[l]);
            poison[l] += a[i + l] * 0.0f + b[i + l] * 0.0f;
        }
    for (int l = 0; i < values; i++, l++) {
        float d = fabsf(a[i] - b[i]);
        sum[l] += (double)d;
        squares[l] += (double)d * (double)d;
        max[l] = larger(max[l], d);
        largest[l] = larger(largest[l], larger(fabsf(a[i]), fabsf(b[i])));
        poison[l] += a[i] * 0.0f + b[i] * 0.0f;
    }
    for (int l = 0; l < LANES; l++)
        if (poison[l] != 0.0f)
            return false;
    for (int l = 0; l < LANES; l++) {
        row->sum += sum[l];
        row->square_sum += squares[l];
        row->max = larger(row->max, max[l]);
        row->largest_value = larger(row->largest_value, largest[l]);
    }
    return true;
}

// The same for rows with any values.
static void sum_any_row(const float *a, const float *b, int values, struct row_metrics *row)
{
    for (int i = 0; i < values; i++) {
        bool finite_a = isfinite(a[i]), finite_b = isfinite(b[i]);
        row->nonfinite_a += !finite_a;
        row->nonfinite_b += !finite_b;
        if (finite_a && finite_b) {
            float d = fabsf(a[i] - b[i]);
            row->sum += (double)d;
            row->square_sum += (double)d * (double)d;
            row->max = larger(row->max, d);
            row->largest_value = larger(row->largest_value, larger(fabsf(a[i]), fabsf(b[i])));
        } else if (!(isnan(a[i]) && isnan(b[i])) && a[i] != b[i]) {
            row->mismatches++;
            row->max = INFINITY;
        }
    }
}

// How far two values are apart for counting: a mismatch is further than every threshold.
static inline float apart(float a, float b)
{
    const float d = fabsf(a - b);
    return d <= 3.4e38f ? d : a == b || (isnan(a) && isnan(b)) ? 0.0f : INFINITY;
}

static inline int differs(float a, float b)
{
    uint32_t bits_a, bits_b;
    memcpy(&bits_a, &a, sizeof(bits_a));
    memcpy(&bits_b, &b, sizeof(bits_b));
    return bits_a != bits_b;
}

enum { BLOCK = 256 }; // pixels whose differences are kept, so that both loops become vectors

struct block {
    float d[BLOCK * 4];
    int differs[BLOCK * 4];
};

static inline __attribute__((always_inline)) void
count_pixels(const struct block *block, int pixels, int channels, struct row_metrics *row)
{
    int differing = 0, above[RG_ABOVE_COUNT] = {0};
    for (int x = 0; x < pixels; x++) {
        float worst = 0.0f;
        int any = 0;
        for (int c = 0; c < channels; c++) {
            worst = larger(block->d[x * channels + c], worst);
            any |= block->differs[x * channels + c];
        }
        differing += any;
        for (int t = 0; t < RG_ABOVE_COUNT; t++)
            above[t] += worst > rg_above_thresholds[t];
    }
    row->differing_pixels += differing;
    for (int t = 0; t < RG_ABOVE_COUNT; t++)
        row->pixels_above[t] += above[t];
}

static inline __attribute__((always_inline)) void
count_block(const float *a, const float *b, int pixels, int channels, struct row_metrics *row)
{
    struct block block;
    int differing = 0, above[RG_ABOVE_COUNT] = {0};
    for (int i = 0; i < pixels * channels; i++) {
        block.d[i] = apart(a[i], b[i]);
        block.differs[i] = differs(a[i], b[i]);
        differing += block.differs[i];
        for (int t = 0; t < RG_ABOVE_COUNT; t++)
            above[t] += block.d[i] > rg_above_thresholds[t];
    }
    row->differing_values += differing;
    for (int t = 0; t < RG_ABOVE_COUNT; t++)
        row->values_above[t] += above[t];
    count_pixels(&block, pixels, channels, row);
}

// Counts of a row that has a difference. Loops over a fixed number of channels become vectors.
RG_MULTIVERSION static void count_row(const float *a, const float *b, int width, int channels,
                                      struct row_metrics *row)
{
    for (int x = 0; x < width; x += BLOCK) {
        const int pixels = width - x < BLOCK ? width - x : BLOCK;
        const float *pa = a + (int64_t)x * channels, *pb = b + (int64_t)x * channels;
        if (channels == 4)
            count_block(pa, pb, pixels, 4, row);
        else if (channels == 3)
            count_block(pa, pb, pixels, 3, row);
        else
            count_block(pa, pb, pixels, channels, row);
    }
}

// The first value of a row with its largest difference.
static int find_max(const float *a, const float *b, int values, float max)
{
    for (int i = 0; i < values; i++) {
        float d = fabsf(a[i] - b[i]);
        if (isinf(max) ? a[i] != b[i] && !(isnan(a[i]) && isnan(b[i])) && !(d <= 3e38f) : d == max)
            return i;
    }
    return 0;
}

static void measure_row(const float *a, const float *b, const struct rg_picture *shape,
                        struct row_metrics *row)
{
    int values = shape->width * shape->channels;
    memset(row, 0, sizeof(*row));
    if (!sum_finite_row(a, b, values, row))
        sum_any_row(a, b, values, row);
    if (memcmp(a, b, (size_t)values * 4) != 0)
        count_row(a, b, shape->width, shape->channels, row);
    if (row->max > 0.0f)
        row->max_index = find_max(a, b, values, row->max);
}

// Adds the rows up, top to bottom.
static void add_rows(const struct row_metrics *rows, int height, int channels, struct rg_metrics *m)
{
    double sum = 0, squares = 0;
    float largest = 1; // 1, so that dark pictures are measured relative to white
    for (int y = 0; y < height; y++) {
        const struct row_metrics *row = &rows[y];
        sum += row->sum;
        squares += row->square_sum;
        largest = larger(largest, row->largest_value);
        if (row->max > m->max) {
            m->max = (double)row->max;
            m->max_x = row->max_index / channels;
            m->max_y = y;
            m->max_channel = row->max_index % channels;
        }
        m->differing_values += row->differing_values;
        m->differing_pixels += row->differing_pixels;
        for (int t = 0; t < RG_ABOVE_COUNT; t++) {
            m->values_above[t] += row->values_above[t];
            m->pixels_above[t] += row->pixels_above[t];
        }
        m->nonfinite_a += row->nonfinite_a;
        m->nonfinite_b += row->nonfinite_b;
        m->nonfinite_mismatches += row->mismatches;
    }
    m->mean = sum / (double)m->values;
    m->rms = sqrt(squares / (double)m->values);
    const bool is_equal = m->rms == 0 && !m->nonfinite_mismatches;
    m->psnr_db = is_equal                           ? INFINITY
                 : m->nonfinite_a || m->nonfinite_b ? NAN
                                                    : 20 * log10((double)largest / m->rms);
}

static const float *row_of(const struct rg_picture *picture, int y)
{
    return picture->texels + (int64_t)y * picture->width * picture->channels;
}

static void measure_rows(const struct rg_picture *a, const struct rg_picture *b,
                         struct row_metrics *rows)
{
#pragma omp parallel for schedule(static)
    for (int y = 0; y < a->height; y++)
        measure_row(row_of(a, y), row_of(b, y), a, &rows[y]);
}

// The same for rows that `make` computes. False when memory for them runs out.
static bool measure_made_rows(const struct rg_picture *a, const struct rg_picture *b,
                              rg_row_maker *make, struct row_metrics *rows)
{
    const size_t values = (size_t)a->width * (size_t)a->channels;
    bool ok = true;
#pragma omp parallel reduction(&& : ok)
    {
        float *made = malloc(2 * values * sizeof(*made));
        ok = made != NULL;
#pragma omp for schedule(static)
        for (int y = 0; y < a->height; y++)
            if (made) {
                make(a, y, made);
                make(b, y, made + values);
                measure_row(made, made + values, a, &rows[y]);
            }
        free(made);
    }
    return ok;
}

bool rg_metrics_of_rows(const struct rg_picture *a, const struct rg_picture *b, rg_row_maker *make,
                        struct rg_metrics *metrics)
{
    struct row_metrics *rows = calloc((size_t)a->height, sizeof(*rows));
    const bool ok = rows && (!make || measure_made_rows(a, b, make, rows));
    if (ok && !make)
        measure_rows(a, b, rows);
    memset(metrics, 0, sizeof(*metrics));
    metrics->values = rg_picture_values(a);
    if (ok)
        add_rows(rows, a->height, a->channels, metrics);
    free(rows);
    return ok ||
           rg_harness_error("comparing %d x %d pixels: no memory; crop them", a->width, a->height);
}

bool rg_metrics_compute(const struct rg_picture *a, const struct rg_picture *b,
                        struct rg_metrics *metrics)
{
    return rg_metrics_of_rows(a, b, NULL, metrics);
}
