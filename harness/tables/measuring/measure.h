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
    double reference_ms;         // both of cpu:reference alone; 0: it is none of the devices
};

enum rg_bar_part { RG_BAR_OPENING, RG_BAR_SAMPLING, RG_BAR_PARTS };

// What a bar expects of the tables of a technique that are not begun, which the rows that were
// opened tell: one look at a cell does not see how its frames grow longer as rain builds up. Zeroed
// before its tables are added.
struct rg_table_learned {
    struct {
        double planned, taken; // units of rows that were opened: due beforehand, and then
        int64_t left;          // due beforehand, of what is not begun
        int64_t shown;         // of the bar's, for these
    } parts[RG_BAR_PARTS];
};

// A table's part of a bar, which may be over several tables: units of each cell of a row.
struct rg_table_bar {
    struct rg_progress *progress;
    struct rg_table_learned *learned; // of its technique
    bool is_expected;                 // units are times, which rows that are opened can correct
    int64_t cell_units[RG_TABLE_ROWS][RG_BAR_PARTS];
};

// The length of a unit, in milliseconds, where it is known what cells take.
#define RG_TABLE_UNIT_MS 1e-3
// The part of a table whose rows' cells are expected to take so long; NULL: nobody knows, and each
// cell has the same units.
struct rg_table_bar rg_table_bar_of(const struct rg_cell_time times[RG_TABLE_ROWS],
                                    struct rg_progress *progress, struct rg_table_learned *learned);
// The units of what is to be measured of a row.
int64_t rg_table_row_units(const struct rg_result *result, const struct rg_table_bar *bar, int row,
                           enum rg_bar_part part);
// Adds what is to be measured of a table, before the bar is started; returns its units. Rows that
// the journal (NULL: none) has are not.
int64_t rg_table_bar_add(const struct rg_table_bar *bar, const struct rg_result *result,
                         const struct rg_journal *journal);
// Begins units that are left. Returns what they come to on the bar, by what is known now.
int64_t rg_table_bar_begin(const struct rg_table_bar *bar, enum rg_bar_part part, int64_t units);
// Learns from units that take so long.
void rg_table_bar_learn(const struct rg_table_bar *bar, enum rg_bar_part part, int64_t units,
                        double ms);
// Units that came to `shown` on the bar, which are done, have taken so long.
void rg_table_bar_correct(const struct rg_table_bar *bar, int64_t shown, double ms);

// Measures the rows of a result that was begun; those that the journal (NULL: none) has are taken
// from it. `bar` (NULL: it has one of its own) is told how far it is. What cannot be had is the
// outcome of its record. Where it is interrupted, rows that are not whole are missing. False, with
// one logged line, without memory. The caller calls rg_result_free in either case.
bool rg_table_measure(struct rg_result *result, const struct rg_table *table, struct rg_kept *kept,
                      struct rg_journal *journal, const struct rg_table_bar *bar);

#endif
