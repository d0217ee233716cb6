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

// Of the pixels (in the mask, if any) whose value agrees with `prefix` above the digit at `shift`.
// The first digit has no prefix and one bin more, for the value 1.
static void count_digits(const float *map, const uint8_t *mask, int64_t pixels, uint32_t prefix,
                         int shift, bool first, struct histogram *total)
{
    memset(total, 0, sizeof(*total));
#pragma omp parallel
    {
        struct histogram own;
        memset(&own, 0, sizeof(own));
#pragma omp for schedule(static)
        for (int64_t i = 0; i < pixels; i++) {
            uint32_t value = fixed(map[i]);
            if ((mask && !mask[i]) || (!first && value >> (shift + DIGIT_BITS) != prefix))
                continue;
            uint32_t digit = value >> shift;
            if (!first)
                digit &= BINS - 2;
            own.count[digit]++;
            own.sum[digit] += value;
        }
#pragma omp critical
        for (int b = 0; b < BINS; b++) {
            total->count[b] += own.count[b];
            total->sum[b] += own.sum[b];
        }
    }
}

// The smallest value at which the running total (of counts, or of values) passes `target`.
// `top` is the histogram of the first digit.
static double select_value(const float *map, const uint8_t *mask, int64_t pixels,
                           const struct histogram *top, bool by_sum, uint64_t target)
{
    struct histogram digits = *top;
    uint64_t running = 0;
    uint32_t prefix = 0;
    for (int shift = FIRST_SHIFT;; shift -= DIGIT_BITS) {
        const uint64_t *bins = by_sum ? digits.sum : digits.count;
        uint32_t bin = 0;
        while (bin < BINS - 1 && running + bins[bin] <= target)
            running += bins[bin++];
        prefix = shift == FIRST_SHIFT ? bin : prefix << DIGIT_BITS | bin;
        if (shift < DIGIT_BITS)
            return (double)((uint64_t)prefix << shift) / 2147483648.0;
        count_digits(map, mask, pixels, prefix, shift - DIGIT_BITS, false, &digits);
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

bool rg_flip_pool(const float *map, const uint8_t *mask, int64_t pixels, struct rg_flip *flip)
{
    memset(flip, 0, sizeof(*flip));
    struct histogram top;
    count_digits(map, NULL, pixels, 0, FIRST_SHIFT, true, &top);
    uint64_t count = add(top.count), sum = add(top.sum);
    if (sum == 0)
        return true;
    float max = 0.0f;
    for (int64_t i = 0; i < pixels; i++)
        max = map[i] > max ? map[i] : max;
    flip->max = (double)max;
    flip->mean = (double)sum / 2147483648.0 / (double)count;
    flip->p99 = select_value(map, NULL, pixels, &top, false, rank_p99(count));
    flip->weighted_median = select_value(map, NULL, pixels, &top, true, sum / 2);
    flip->weighted_quartile_1 = select_value(map, NULL, pixels, &top, true, sum / 4);
    flip->weighted_quartile_3 = select_value(map, NULL, pixels, &top, true, sum / 4 * 3);
    flip->mask_mean = flip->mean;
    flip->mask_p99 = flip->p99;
    if (!mask)
        return true;
    flip->mask_mean = flip->mask_p99 = 0;
    count_digits(map, mask, pixels, 0, FIRST_SHIFT, true, &top);
    count = add(top.count);
    if (count == 0)
        return true;
    flip->mask_mean = (double)add(top.sum) / 2147483648.0 / (double)count;
    flip->mask_p99 = select_value(map, mask, pixels, &top, false, rank_p99(count));
    return true;
}
