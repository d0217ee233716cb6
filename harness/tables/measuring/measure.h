// Measures the rows of a table: options, progress and the measuring itself.
#ifndef RG_HARNESS_TABLES_MEASURING_MEASURE_H
#define RG_HARNESS_TABLES_MEASURING_MEASURE_H

#include "harness/console/progress.h"
#include "harness/devices/measure/job.h"
#include "harness/record/disk/journal.h"
#include "harness/tables/table.h"

// The options for full or quick measurements.
const struct rg_measure_options *rg_table_options(bool is_full);
// The options within a tight budget, and under RG_FEW_SAMPLES: quick, with the fewest samples.
const struct rg_measure_options *rg_table_few_samples(void);

// The end of a measurement within a budget; times are by rg_now_ms. The first row begins in any
// case; later ones begin only if earlier times say that they may end in time.
struct rg_table_deadline {
    double rows_ms; // rows have to end before this
    double end_ms;  // no cell begins after this, so a row of several cells may be given up
    bool whole;     // rows count only if all of them end in time
};

// Units of the progress bar for the rows of a result that have to be measured. Rows in the journal
// (NULL: none) are left out.
int64_t rg_table_units(const struct rg_result *result, const struct rg_journal *journal);

// Measures the rows of a begun result on those of kept->devices that it names; rows in the journal
// (NULL: none) are taken from there. `bar` shows the progress (NULL: a new bar does). Rows after
// the deadline (NULL: none) are left out. A failure becomes the outcome of its record. After an
// interruption incomplete rows are missing. False, with one logged line, without memory. The caller
// calls rg_result_free in either case.
bool rg_table_measure(struct rg_result *result, const struct rg_table *table, struct rg_kept *kept,
                      struct rg_journal *journal, struct rg_progress *bar,
                      const struct rg_table_deadline *deadline);

#endif
