// Mean and percentiles of a FLIP map. Values are taken as 31-bit fixed-point numbers, so that sums
// are exact in any order and percentiles are found digit by digit, without sorting.
#include <math.h>
#include <string.h>

#include "core/image/compare/compare.h"

enum { DIGIT_BITS = 10, BINS = (1 << DIGIT_BITS) + 1, FIRST_SHIFT = 31 - DIGIT_BITS };

struct histogram {
    uint64_t count[BINS], sum[BINS];
};

static inline uint32_t fixed(float flip)
{
    return (uint32_t)(flip * 2147483648.0f);
}

// A value to find: the smallest at which the running total, of counts or of values, passes a
// target. Its digits are found from the highest on.
struct wanted {
    bool by_sum;
    uint64_t target, running; // running: the total below the digits found so far
    uint32_t prefix;          // the digits found so far
    struct histogram digits;  // histogram of the next digit, over the pixels that share the prefix
};
enum { MOST_WANTED = 4 };

static inline void count_value(struct histogram *histogram, uint32_t digit, uint32_t value)
{
    histogram->count[digit]++;
    histogram->sum[digit] += value;
}

static void add_histogram(struct histogram *total, const struct histogram *own)
{
    for (int b = 0; b < BINS; b++) {
        total->count[b] += own->count[b];
        total->sum[b] += own->sum[b];
    }
}

// Counts the first digit of the pixels in the mask, if any. There is one bin more, for the value 1.
static void count_first(const float *map, const uint8_t *mask, int64_t pixels,
                        struct histogram *total)
{
    memset(total, 0, sizeof(*total));
#pragma omp parallel
    {
        struct histogram own;
        memset(&own, 0, sizeof(own));
#pragma omp for schedule(static)
        for (int64_t i = 0; i < pixels; i++) {
            const uint32_t value = fixed(map[i]);
            if (!mask || mask[i])
                count_value(&own, value >> FIRST_SHIFT, value);
        }
#pragma omp critical
        add_histogram(total, &own);
    }
}

// Counts the digit at `shift` of the pixels that share a wanted value's prefix, for all wanted
// values in one pass; the first digit excludes most pixels.
static void count_next(const float *map, const uint8_t *mask, int64_t pixels, int shift,
                       struct wanted *wanted, int count)
{
    bool is_near[BINS] = {false};
    for (int w = 0; w < count; w++) {
        is_near[wanted[w].prefix >> (FIRST_SHIFT - shift - DIGIT_BITS)] = true;
        memset(&wanted[w].digits, 0, sizeof(wanted[w].digits));
    }
#pragma omp parallel
    {
        struct histogram own[MOST_WANTED];
        memset(own, 0, sizeof(own));
#pragma omp for schedule(static)
        for (int64_t i = 0; i < pixels; i++) {
            const uint32_t value = fixed(map[i]);
            if (!is_near[value >> FIRST_SHIFT] || (mask && !mask[i]))
                continue;
            for (int w = 0; w < count; w++)
                if (value >> (shift + DIGIT_BITS) == wanted[w].prefix)
                    count_value(&own[w], value >> shift & (BINS - 2), value);
        }
#pragma omp critical
        for (int w = 0; w < count; w++)
            add_histogram(&wanted[w].digits, &own[w]);
    }
}

static void take_digit(struct wanted *wanted, int shift)
{
    const uint64_t *bins = wanted->by_sum ? wanted->digits.sum : wanted->digits.count;
    uint32_t bin = 0;
    while (bin < BINS - 1 && wanted->running + bins[bin] <= wanted->target)
        wanted->running += bins[bin++];
    wanted->prefix = shift == FIRST_SHIFT ? bin : wanted->prefix << DIGIT_BITS | bin;
}

// Finds all wanted values. `top` is the histogram of the first digit.
static void select_values(const float *map, const uint8_t *mask, int64_t pixels,
                          const struct histogram *top, struct wanted *wanted, int count,
                          double *values)
{
    for (int w = 0; w < count; w++)
        wanted[w].digits = *top;
    for (int shift = FIRST_SHIFT;; shift -= DIGIT_BITS) {
        for (int w = 0; w < count; w++) {
            take_digit(&wanted[w], shift);
            values[w] = (double)((uint64_t)wanted[w].prefix << shift) / 2147483648.0;
        }
        if (shift < DIGIT_BITS)
            return;
        count_next(map, mask, pixels, shift - DIGIT_BITS, wanted, count);
    }
}

static uint64_t add(const uint64_t *bins)
{
    uint64_t sum = 0;
    for (int b = 0; b < BINS; b++)
        sum += bins[b];
    return sum;
}

// Zero-based rank of the 99th percentile by the nearest-rank rule.
static uint64_t rank_p99(uint64_t count)
{
    return (count * 99 + 99) / 100 - 1;
}

static float largest(const float *map, int64_t pixels)
{
    float max = 0.0f;
#pragma omp parallel for schedule(static) reduction(max : max)
    for (int64_t i = 0; i < pixels; i++)
        max = map[i] > max ? map[i] : max;
    return max;
}

bool rg_flip_pool(const float *map, const uint8_t *mask, int64_t pixels, struct rg_flip *flip)
{
    memset(flip, 0, sizeof(*flip));
    struct histogram top;
    count_first(map, NULL, pixels, &top);
    uint64_t count = add(top.count), sum = add(top.sum);
    if (sum == 0)
        return true;
    struct wanted wanted[MOST_WANTED] = {{.target = rank_p99(count)},
                                         {.by_sum = true, .target = sum / 2},
                                         {.by_sum = true, .target = sum / 4},
                                         {.by_sum = true, .target = sum / 4 * 3}};
    double values[MOST_WANTED];
    select_values(map, NULL, pixels, &top, wanted, MOST_WANTED, values);
    flip->max = (double)largest(map, pixels);
    flip->mean = (double)sum / 2147483648.0 / (double)count;
    flip->p99 = values[0];
    flip->weighted_median = values[1];
    flip->weighted_quartile_1 = values[2];
    flip->weighted_quartile_3 = values[3];
    flip->mask_mean = flip->mean;
    flip->mask_p99 = flip->p99;
    if (!mask)
        return true;
    flip->mask_mean = flip->mask_p99 = 0;
    count_first(map, mask, pixels, &top);
    count = add(top.count);
    if (count == 0)
        return true;
    struct wanted in_mask = {.target = rank_p99(count)};
    flip->mask_mean = (double)add(top.sum) / 2147483648.0 / (double)count;
    select_values(map, mask, pixels, &top, &in_mask, 1, &flip->mask_p99);
    return true;
}
