// A table's part of a command's bar.
#include "harness/tables/measuring/measure.h"

// How far a cell is of which nobody knows how long it takes: so much when it is open, and as much
// again when it is sampled.
enum { CELL_UNITS = 1000 };

struct rg_table_bar rg_table_bar_of(const struct rg_cell_time *time, struct rg_progress *progress)
{
    if (!time)
        return (struct rg_table_bar){progress, CELL_UNITS, CELL_UNITS};
    return (struct rg_table_bar){progress, (int64_t)(time->open_ms / RG_TABLE_UNIT_MS),
                                 (int64_t)(time->sampling_ms / RG_TABLE_UNIT_MS)};
}

int64_t rg_table_row_units(const struct rg_result *result, const struct rg_table_bar *bar)
{
    return (bar->open_units + bar->sampling_units) * rg_result_row_cells(result);
}

int64_t rg_table_units(const struct rg_result *result, const struct rg_table_bar *bar,
                       const struct rg_journal *journal)
{
    int64_t units = 0;
    for (int row = result->first_row; row <= result->last_row; row++)
        if (rg_result_wants(result, row) && !rg_journal_has(journal, row))
            units += rg_table_row_units(result, bar);
    return units;
}
