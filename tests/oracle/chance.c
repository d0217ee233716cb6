#include "tests/oracle/chance.h"

#include <math.h>
#include <stdlib.h>

enum { CELLS = 64 };

struct ranked {
    double value;
    int row;
};

static int ascending(const void *a, const void *b)
{
    const struct ranked *x = a, *y = b;
    if (x->value != y->value)
        return x->value < y->value ? -1 : 1;
    return x->row - y->row; // equal values in their order
}

// Each number's rank, as a share of all.
static double *shares_of(const double *column, int count)
{
    struct ranked *ranks = malloc((size_t)count * sizeof(*ranks));
    double *shares = malloc((size_t)count * sizeof(*shares));
    for (int i = 0; ranks && i < count; i++)
        ranks[i] = (struct ranked){column[i], i};
    if (ranks)
        qsort(ranks, (size_t)count, sizeof(*ranks), ascending);
    for (int i = 0; ranks && shares && i < count; i++)
        shares[ranks[i].row] = (double)i / count;
    free(ranks);
    return shares;
}

// The excess of two columns' chi-square in 8 x 8 cells, or, with a third, in 4 x 4 x 4. Ranks fill
// each column's classes evenly, which leaves 7 x 7 degrees of freedom, or 63 - 3 x 3.
static double excess(const double *a, const double *b, const double *c, int count)
{
    int counts[CELLS] = {0};
    const int sides = c ? 4 : 8;
    for (int i = 0; i < count; i++) {
        const int cell = (int)(a[i] * sides) + sides * (int)(b[i] * sides);
        counts[cell + (c ? sides * sides * (int)(c[i] * sides) : 0)]++;
    }
    const double due = (double)count / CELLS, freedom = c ? 54 : 49;
    double chi_square = 0;
    for (int i = 0; i < CELLS; i++)
        chi_square += (counts[i] - due) * (counts[i] - due) / due;
    return (chi_square - freedom) / sqrt(2 * freedom);
}

double oracle_dependence(const double *const *columns, int column_count, int count)
{
    double *shares[ORACLE_COLUMNS] = {0}, most = 0;
    if (column_count > ORACLE_COLUMNS)
        return INFINITY;
    for (int i = 0; i < column_count; i++) {
        shares[i] = shares_of(columns[i], count);
        most = shares[i] ? most : INFINITY;
    }
    for (int i = 0; isfinite(most) && i < column_count; i++)
        for (int j = 0; j < i; j++) {
            most = fmax(most, excess(shares[i], shares[j], NULL, count));
            for (int k = 0; k < j; k++)
                most = fmax(most, excess(shares[i], shares[j], shares[k], count));
        }
    for (int i = 0; i < column_count; i++)
        free(shares[i]);
    return most;
}
