// Whether the numbers of a table fall as published.
#include <math.h>

#include "harness/tables/table.h"

// Slopes closer than this, in powers of the axis, count as the same.
#define SAME_SLOPE 0.25

const char *rg_trend_text(enum rg_trend_verdict verdict)
{
    static const char *const texts[] = {"reproduced", "trend only", "same order", "not reproduced",
                                        "not comparable"};
    return texts[verdict];
}

// Counts the pairs that a row forms with those before it. Equal numbers in print order nothing.
static void count_pairs(struct rg_trend *trend, const double *published, const double *measured,
                        int row)
{
    for (int other = 0; other < row; other++) {
        const double order = published[row] - published[other];
        trend->pairs += order != 0;
        trend->pairs_in_order += order * (measured[row] - measured[other]) > 0;
    }
}

struct rg_trend rg_table_trend(const struct rg_table_run *run, int variant, int device)
{
    const struct rg_table *table = run->table;
    double axis[RG_TABLE_ROWS], published[RG_TABLE_ROWS], measured[RG_TABLE_ROWS];
    struct rg_trend trend = {.verdict = RG_TREND_UNKNOWN};
    int rows = 0;
    if (!rg_table_is_published(table) || table->is_of_textures ||
        rg_table_first_missing(run) <= run->last_row)
        return trend;
    for (int row = run->first_row; row <= run->last_row; row++, rows++) {
        const struct rg_cell *cell = rg_table_cell(run, row, variant, device);
        if (cell->status != RG_OK)
            return (struct rg_trend){.verdict = RG_TREND_UNKNOWN};
        axis[rows] = log(table->rows[row].values[0]);
        published[rows] = log(rg_table_published_fps(table, row, variant));
        measured[rows] = log(rg_cell_fps(cell));
        count_pairs(&trend, published, measured, rows);
    }
    if (!trend.pairs)
        return trend;
    trend.slope = table->key_count ? rg_slope(axis, measured, rows) : NAN;
    trend.published_slope = table->key_count ? rg_slope(axis, published, rows) : NAN;
    trend.has_slope = isfinite(trend.slope) && isfinite(trend.published_slope);
    const double apart = fabs(trend.slope - trend.published_slope);
    trend.verdict = trend.pairs_in_order < trend.pairs ? RG_TREND_NOT
                    : !trend.has_slope                 ? RG_TREND_ORDER
                    : apart <= SAME_SLOPE              ? RG_TREND_REPRODUCED
                                                       : RG_TREND_ONLY;
    return trend;
}
