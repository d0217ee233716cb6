// A result: a measured table, as plain data. Code that prints or compares tables works on results:
// it opens no device, and does not depend on a result's origin.
#ifndef RG_HARNESS_RECORD_RESULT_H
#define RG_HARNESS_RECORD_RESULT_H

#include <jansson.h>

#include "core/device/device.h"
#include "harness/record/record.h"

enum {
    RG_RESULT_ROWS = 256,
    RG_RESULT_WORKS = 4,
    RG_RESULT_VARIANTS = 10,
    RG_RESULT_MISSING = RG_MAX_BACKENDS + RG_MAX_DEVICES,
    RG_NOTE_SIZE = 1024,
    RG_TITLE_SIZE = 256,
};

// A work: how much of the printed work a row's cells do.
struct rg_result_work {
    char name[RG_NAME_SIZE];     // "paper": all printed work; "reading"; "ours"; "queries"
    char saves[RG_TITLE_SIZE];   // one line about what saves work; "": nothing
    char reading[RG_TITLE_SIZE]; // one line about the reading of the paper; "": unambiguous
};

struct rg_result {
    char table[RG_NAME_SIZE]; // "creus-5.4"
    char technique[RG_NAME_SIZE];
    char hardware[RG_TITLE_SIZE]; // the paper's hardware; "": nothing is published
    // Settings, over a row's own, for the true image in a row's error; "": rows have no error.
    char truth[RG_TITLE_SIZE];
    char quick[RG_TITLE_SIZE]; // settings of quick mode; "": none
    // The user's settings over all others; "": none. With any, no cell does the printed work.
    char changed[RG_SET_SIZE];
    char note[RG_NOTE_SIZE]; // note that readers of the table need
    bool full;               // else quick
    bool is_of_textures;     // nothing is timed
    bool is_part;      // for printing only a part of a stored result: claims are not judged by it.
                       // Not stored
    int width, height; // of the image, in pixels
    int check_frames;  // simulated and drawn before images are compared
    int first_row, last_row; // of the table, from 0
    // The choices of a time budget (harness/tables/runs/budget.h), its seconds; 0: there was none.
    double budget_s;
    int size_divisor;              // width and height are the table's divided by this; 0: as 1
    bool few_samples;              // the fewest
    bool left_out[RG_RESULT_ROWS]; // from first_row on: rows that are not measured
    int resumed_rows;              // taken from an interrupted run, not measured now
    int work_count;                // 0: the table has no works
    struct rg_result_work works[RG_RESULT_WORKS];
    int variant_count;
    char variants[RG_RESULT_VARIANTS][RG_NAME_SIZE];
    int device_count;
    struct rg_device_info devices[RG_MAX_DEVICES];
    json_t *passport; // docs/records.md; owned
    int missing_count;
    // A sentence for each device that is missing although a reader may expect it.
    char missing[RG_RESULT_MISSING][256];
    // From first_row on, the records of a row's cells; owned. NULL: not measured.
    struct rg_record *rows[RG_RESULT_ROWS];
};

// The place of a cell: indices of a table's row, work, variant and device.
struct rg_place {
    int row, work, variant, device;
};

// The record of a cell; all access to rows goes through it. The row must exist (rg_result_has).
struct rg_record *rg_result_at(const struct rg_result *result, struct rg_place place);

// Iterates over the cells of existing rows, by row, work, variant and device:
// for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);)
struct rg_place rg_result_start(const struct rg_result *result);
bool rg_result_next(const struct rg_result *result, struct rg_place *at);
// The same for one row.
struct rg_place rg_result_start_row(int row);
bool rg_result_next_in_row(const struct rg_result *result, struct rg_place *at);

int rg_result_row_cells(const struct rg_result *result); // number of cells in a row
bool rg_result_has(const struct rg_result *result, int row);
// Whether an existing row is complete.
bool rg_result_is_whole(const struct rg_result *result, int row);
// Drops incomplete rows.
void rg_result_drop_begun(struct rg_result *result);
// Whether a row is wanted; rows left out by a budget are not missing.
bool rg_result_wants(const struct rg_result *result, int row);
// The first missing row; one past the last if there is none.
int rg_result_first_missing(const struct rg_result *result);

// Adds zeroed records for a row. False, with one logged line, when memory runs out.
bool rg_result_add_row(struct rg_result *result, int row);
void rg_result_drop_row(struct rg_result *result, int row);
// Copies the cells of another result into existing rows, for the same row, work, variant and
// device.
void rg_result_take(struct rg_result *into, const struct rg_result *from);
// Drops the rows before `first` and after `last`, or the cells of other works, or of other
// variants. A table without works stays as it is. False if nothing is left.
bool rg_result_keep_rows(struct rg_result *result, int first, int last);
bool rg_result_keep_work(struct rg_result *result, const char *work);
bool rg_result_keep_variant(struct rg_result *result, const char *variant);
// Whether a work's cells do the printed work, and may be compared with print.
bool rg_result_is_of_print(const struct rg_result *result, int work);
// The printed work, in the first of its readings; -1 if the result lacks it.
int rg_result_printed_work(const struct rg_result *result);

// What its measured cells' times are medians of: "3 launches", "6 to 15 samples", or both.
void rg_result_medians_of(const struct rg_result *result, char *text, size_t size);

// How much the machine's speed varied over the run, as a share of the fastest, from the calibration
// loads at the beginnings and ends of measurements. 0 if unknown.
double rg_result_drift(const struct rg_result *result);

// Frees what it owns.
void rg_result_free(struct rg_result *result);

#endif
