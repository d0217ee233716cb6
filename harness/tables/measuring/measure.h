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

// When a measurement must end, within a budget of time; both by rg_now_ms. The first row is begun
// in any case; another is not, where it surely would not end in time: by what those before it took.
struct rg_table_deadline {
    double rows_ms; // rows are to end before this,
    double end_ms;  // behind which no cell is begun, so that a row of several is given up
    bool whole;     // rows are worth nothing unless all of them end in time
};

// Units of a bar for what is to be measured of a result. Rows that the journal (NULL: none) has are
// not.
int64_t rg_table_units(const struct rg_result *result, const struct rg_journal *journal);

// Measures the rows of a result that was begun, on those of kept->devices that it names; rows that
// the journal (NULL: none) has are taken from it. `bar` (NULL: it has one of its own) is told how
// far it is. Rows behind the deadline (NULL: there is none) are left out. What cannot be had is the
// outcome of its record. Where it is interrupted, rows that are not whole are missing. False, with
// one logged line, without memory. The caller calls rg_result_free in either case.
bool rg_table_measure(struct rg_result *result, const struct rg_table *table, struct rg_kept *kept,
                      struct rg_journal *journal, struct rg_progress *bar,
                      const struct rg_table_deadline *deadline);

#endif
