// One regenerated table: measuring its cells, and what is said of them.
#ifndef RG_HARNESS_TABLES_TABLE_H
#define RG_HARNESS_TABLES_TABLE_H

#include <jansson.h>

#include "harness/console/sheet.h"
#include "harness/devices/kept.h"
#include "harness/devices/devices.h"
#include "harness/measure/measure.h"
#include "harness/tables/papers/papers.h"

// How far a row's image is from the table's truth: 8-bit encoded, over the rain mask and the whole.
struct rg_table_error {
    double flip_mask_mean, flip_mean; // 0 the same, 1 as different as can be
    int max_codes;                    // largest difference, of 255
};

// What a row's cells of one variant have in common.
struct rg_table_group {
    bool is_missing; // not measured, for the run was interrupted
    void *settings;  // owned
    // Where the table has a truth: OK, and the row's distance from it, or why there is none.
    enum rg_outcome error_status;
    struct rg_table_error error;
    char error_detail[200];
};

struct rg_journal;

// The cells of rows first_row..last_row (from 0) of a table on some devices: row by row, variant by
// variant, device by device.
struct rg_table_run {
    const struct rg_table *table;
    const struct rg_devices *devices;
    int first_row, last_row;
    bool full;
    int resumed_rows; // not measured now but by an earlier run that was interrupted
    int cell_count;
    struct rg_cell *cells;
    struct rg_table_group *groups; // one a row and variant
    json_t *journal;               // what was read of it, which holds those rows' names; or NULL
};

// Measures the rows, a batch at a time; those that the journal (harness/record/journal.h; NULL:
// none) has are taken from it. What cannot be had is the status of its cells. Where it is
// interrupted, the rows of the batch and those behind it are missing. False, with one logged line,
// without memory for the cells. The caller calls rg_table_run_free in either case.
bool rg_table_measure(struct rg_table_run *run, struct rg_kept *kept, struct rg_journal *journal);
void rg_table_run_free(struct rg_table_run *run);

// Opens, checks and warms up the cells of a row's variant, or sets their status.
void rg_table_prepare(struct rg_table_run *run, struct rg_kept *kept, int row, int variant,
                      const struct rg_measure_options *options);
// What the devices tell of the texture that a row is about.
void rg_table_tell_texture(struct rg_table_run *run, struct rg_kept *kept, int row, int variant);
// The first row that is missing, from 0; one behind the last where none is.
int rg_table_first_missing(const struct rg_table_run *run);
// The assignments of a row and variant, and of quick mode, over the defaults. Owned by the caller.
char *rg_table_assignments(const struct rg_table_run *run, int row, int variant);
// How many samples its measured cells took, at least and at most; 0 where none was measured.
void rg_table_samples(const struct rg_table_run *run, int *least, int *most);

struct rg_cell *rg_table_cell(const struct rg_table_run *run, int row, int variant, int device);
struct rg_table_group *rg_table_group(const struct rg_table_run *run, int row, int variant);

// Frames a second of a measured cell, and of a row and variant in print, NAN where nothing is.
double rg_cell_fps(const struct rg_cell *cell);
double rg_table_published_fps(const struct rg_table *table, int row, int variant);

// Whether a device's numbers fall as the published ones do.
enum rg_trend_verdict {
    RG_TREND_REPRODUCED, // same order of the rows, and same slope along the axis
    RG_TREND_ONLY,       // same order, another slope
    RG_TREND_ORDER,      // same order, of rows without an axis
    RG_TREND_NOT,        // another order
    RG_TREND_UNKNOWN,
};
struct rg_trend {
    enum rg_trend_verdict verdict;
    int pairs;                     // of rows whose published numbers differ
    int pairs_in_order;            // so many of them stand in the published order
    bool has_slope;                // the rows have an axis
    double slope, published_slope; // of log(fps) over log(axis)
};
const char *rg_trend_text(enum rg_trend_verdict verdict);
struct rg_trend rg_table_trend(const struct rg_table_run *run, int variant, int device);

// The machine form (docs/records.md); the caller owns it.
json_t *rg_table_json(const struct rg_table_run *run);
// The table for people, in `sheet`, which is zeroed before.
void rg_table_sheet(const struct rg_table_run *run, struct rg_sheet *sheet);

#endif
