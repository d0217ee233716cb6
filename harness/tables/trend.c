// Whether the numbers of a table fall as published.
#include <math.h>

#include "harness/tables/table.h"

// Slopes closer than this, in powers of the axis, count as the same.
#define SAME_SLOPE 0.25

const char *rg_shape_verdict_text(enum rg_shape_verdict verdict)
{
    static const char *const texts[] = {"reproduced", "trend only", "same order", "not reproduced",
                                        "not comparable"};
    return texts[verdict];
}

// Counts the pairs that a row forms with those before it. Equal numbers in print order nothing.
static void count_pairs(struct rg_shape *shape, const double *published, const double *measured,
                        int row)
{
    for (int other = 0; other < row; other++) {
        const double order = published[row] - published[other];
        shape->pairs += order != 0;
        shape->pairs_in_order += order * (measured[row] - measured[other]) > 0;
    }
}

struct rg_shape rg_table_shape(const struct rg_table_run *run, int variant, int device)
{
    const struct rg_table *table = run->table;
    double axis[RG_TABLE_ROWS], published[RG_TABLE_ROWS], measured[RG_TABLE_ROWS];
    struct rg_shape shape = {.verdict = RG_SHAPE_UNKNOWN};
    int rows = 0;
    if (!rg_table_is_published(table) || table->is_of_textures ||
        rg_table_first_missing(run) <= run->last_row)
        return shape;
    for (int row = run->first_row; row <= run->last_row; row++, rows++) {
        const struct rg_cell *cell = rg_table_cell(run, row, variant, device);
        if (cell->status != RG_OK)
            return (struct rg_shape){.verdict = RG_SHAPE_UNKNOWN};
        axis[rows] = log(table->rows[row].values[0]);
        published[rows] = log(rg_table_published_fps(table, row, variant));
        measured[rows] = log(rg_cell_fps(cell));
        count_pairs(&shape, published, measured, rows);
    }
    if (!shape.pairs)
        return shape;
    shape.slope = table->key_count ? rg_slope(axis, measured, rows) : NAN;
    shape.published_slope = table->key_count ? rg_slope(axis, published, rows) : NAN;
    shape.has_slope = isfinite(shape.slope) && isfinite(shape.published_slope);
    const double apart = fabs(shape.slope - shape.published_slope);
    shape.verdict = shape.pairs_in_order < shape.pairs ? RG_SHAPE_NOT
                    : !shape.has_slope                 ? RG_SHAPE_ORDER
                    : apart <= SAME_SLOPE              ? RG_SHAPE_REPRODUCED
                                                       : RG_SHAPE_TREND;
    return shape;
}
