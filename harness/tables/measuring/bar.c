// A table's part of a command's bar.
#include "harness/tables/measuring/measure.h"

// How far a cell is of which nobody knows how long it takes: so much when it is open, and as much
// again when it is sampled.
enum { CELL_UNITS = 1000 };

struct rg_table_bar rg_table_bar_of(const struct rg_cell_time times[RG_TABLE_ROWS],
                                    struct rg_progress *progress)
{
    struct rg_table_bar bar = {.progress = progress};
    for (int row = 0; row < RG_TABLE_ROWS; row++) {
        bar.rows[row].open_units =
            times ? (int64_t)(times[row].open_ms / RG_TABLE_UNIT_MS) : CELL_UNITS;
        bar.rows[row].sampling_units =
            times ? (int64_t)(times[row].sampling_ms / RG_TABLE_UNIT_MS) : CELL_UNITS;
    }
    return bar;
}

int64_t rg_table_row_units(const struct rg_result *result, const struct rg_table_bar *bar, int row)
{
    return (bar->rows[row].open_units + bar->rows[row].sampling_units) *
           rg_result_row_cells(result);
}

int64_t rg_table_units(const struct rg_result *result, const struct rg_table_bar *bar,
                       const struct rg_journal *journal)
{
    int64_t units = 0;
    for (int row = result->first_row; row <= result->last_row; row++)
        if (rg_result_wants(result, row) && !rg_journal_has(journal, row))
            units += rg_table_row_units(result, bar, row);
    return units;
}
