#include "harness/tables/claims/order.h"

#include <math.h>
#include <string.h>

enum { EXACT = 20 };

// The number of pairs in which the first is below the second; a tie counts half.
static double pairs_below(const double *low, int low_count, double factor, const double *high,
                          int high_count)
{
    double below = 0;
    for (int i = 0; i < low_count; i++)
        for (int j = 0; j < high_count; j++) {
            const double x = low[i] * factor;
            below += x < high[j] ? 1 : x > high[j] ? 0 : 0.5;
        }
    return below;
}

// The probability of each count of the m n pairs. The largest sample is from the first set with
// probability m / (m + n), and then below none of the other; otherwise it is above all m. So the
// distributions of (m - 1, n) and (m, n - 1) give that of (m, n).
static void make_distribution(int m, int n, double p[EXACT + 1][EXACT * EXACT + 1])
{
    for (int i = 0; i <= m; i++) {
        for (int j = 0; j <= n; j++) {
            double *now = p[j];
            const double *fewer = j ? p[j - 1] : NULL; // the distribution of i and j - 1
            double next[EXACT * EXACT + 1];
            for (int u = 0; u <= i * j; u++) {
                // `now` still holds i - 1 and j.
                const double of_first = i && u <= (i - 1) * j ? now[u] * i / (i + j) : 0;
                const double of_second =
                    j && u >= i && u - i <= i * (j - 1) ? fewer[u - i] * j / (i + j) : 0;
                next[u] = i + j ? of_first + of_second : 1;
            }
            memcpy(now, next, (size_t)(i * j + 1) * sizeof(*now));
        }
    }
}

// The probability of at least `pairs` of m n pairs. Keeps the last distribution, because the next
// question is mostly about the same numbers of samples.
static double exact(int m, int n, int pairs)
{
    static _Thread_local double p[EXACT + 1][EXACT * EXACT + 1];
    static _Thread_local int made_m = -1, made_n = -1;
    if (m != made_m || n != made_n) {
        make_distribution(m, n, p);
        made_m = m;
        made_n = n;
    }
    double sum = 0;
    for (int u = m * n; u >= pairs; u--)
        sum += p[n][u];
    return sum;
}

double rg_order_probability(const double *low, int low_count, double factor, const double *high,
                            int high_count)
{
    const double pairs = pairs_below(low, low_count, factor, high, high_count);
    if (low_count <= EXACT && high_count <= EXACT)
        return exact(low_count, high_count, (int)floor(pairs));
    const double mean = 0.5 * low_count * high_count;
    const double sigma = sqrt(mean * (low_count + high_count + 1) / 6);
    return 0.5 * erfc((pairs - 0.5 - mean) / sigma / sqrt(2));
}
