#include "harness/judge/shift.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PAIRS = RG_SHIFT_SAMPLES * RG_SHIFT_SAMPLES, HALF = PAIRS / 2 + 1 };

// The probabilities that, for two samples from one distribution, exactly u of all pairs have b
// above a, for each u up to half of the pairs. A recursion over the samples' sizes gives them: the
// smallest value is either an a, with all b's above it, or a b, which is above no a.
static const double *distribution(int a_count, int b_count)
{
    static double of[RG_SHIFT_SAMPLES + 1][HALF]; // by the number of b's
    const int half = a_count * b_count / 2 + 1;
    for (int b = 0; b <= b_count; b++)
        for (int u = 0; u < half; u++)
            of[b][u] = u == 0;
    for (int a = 1; a <= a_count; a++)
        for (int b = 1; b <= b_count; b++) {
            const int most = a * b < half ? a * b : half - 1;
            const double of_a = (double)a / (a + b), of_b = (double)b / (a + b);
            for (int u = most; u >= 0; u--)
                of[b][u] = (u >= b ? of_a * of[b][u - b] : 0) + of_b * of[b - 1][u];
        }
    return of[b_count];
}

// The largest k with P(U < k) <= tail; 0 when there is none.
static int outer_rank(int a_count, int b_count, double tail)
{
    const double *probability = distribution(a_count, b_count);
    const int most = a_count * b_count / 2;
    double below = 0;
    int k = 0;
    while (k < most && below + probability[k] <= tail)
        below += probability[k++];
    return k;
}

struct rg_interval rg_shift(const double *a, int a_count, const double *b, int b_count, double tail)
{
    double differences[PAIRS];
    const int pairs = a_count * b_count;
    for (int i = 0; i < a_count; i++)
        for (int j = 0; j < b_count; j++)
            differences[i * b_count + j] = b[j] - a[i];
    rg_sort(differences, pairs);
    const int k = outer_rank(a_count, b_count, tail);
    return (struct rg_interval){
        .median = (differences[(pairs - 1) / 2] + differences[pairs / 2]) / 2,
        .low = k ? differences[k - 1] : NAN,
        .high = k ? differences[pairs - k] : NAN,
    };
}
