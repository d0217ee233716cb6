// Measuring the rows of a table: how, how far it is, and the measuring itself.
#ifndef RG_HARNESS_TABLES_MEASURING_MEASURE_H
#define RG_HARNESS_TABLES_MEASURING_MEASURE_H

#include "harness/console/progress.h"
#include "harness/measure/job.h"
#include "harness/record/disk/journal.h"
#include "harness/tables/table.h"

// How cells of this length are measured.
const struct rg_measure_options *rg_table_options(bool is_full);
// How they are where a budget is short of time: quick, with the fewest samples.
const struct rg_measure_options *rg_table_few_samples(void);

// What a cell of a row is expected to take, on average over the devices; 0: nobody knows.
struct rg_cell_time {
    double open_ms, sampling_ms; // with what checks it; with the passes told apart
};

// A table's part of a bar, which may be over several tables: units of each cell of a row.
struct rg_table_bar {
    struct rg_progress *progress;
    struct {
        int64_t open_units, sampling_units;
    } rows[RG_TABLE_ROWS];
};

// The length of a unit, in milliseconds, where it is known what cells take.
#define RG_TABLE_UNIT_MS 1e-3
// The part of a table whose rows' cells are expected to take so long; NULL: nobody knows, and each
// cell has the same units.
struct rg_table_bar rg_table_bar_of(const struct rg_cell_time times[RG_TABLE_ROWS],
                                    struct rg_progress *progress);
int64_t rg_table_row_units(const struct rg_result *result, const struct rg_table_bar *bar, int row);
// The units of what is to be measured of a table: rows that the journal (NULL: none) has are not.
int64_t rg_table_units(const struct rg_result *result, const struct rg_table_bar *bar,
                       const struct rg_journal *journal);

// Measures the rows of a result that was begun; those that the journal (NULL: none) has are taken
// from it. `bar` (NULL: it has one of its own) is told how far it is. What cannot be had is the
// outcome of its record. Where it is interrupted, rows that are not whole are missing. False, with
// one logged line, without memory. The caller calls rg_result_free in either case.
bool rg_table_measure(struct rg_result *result, const struct rg_table *table, struct rg_kept *kept,
                      struct rg_journal *journal, const struct rg_table_bar *bar);

#endif
