// A result: a table as it was measured, as plain data. What prints tables, and what compares them,
// takes results: it opens no device, and need not know where one came from.
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

// What tells apart how much work a row's cells do.
struct rg_result_work {
    char name[RG_NAME_SIZE];     // "paper": what was printed; "reading"; "ours"; "queries"
    char saves[RG_TITLE_SIZE];   // what saves work, one line; "": nothing
    char reading[RG_TITLE_SIZE]; // how the paper is read, one line; "": there is one way
};

struct rg_result {
    char table[RG_NAME_SIZE]; // "creus-5.4"
    char technique[RG_NAME_SIZE];
    char hardware[RG_TITLE_SIZE]; // what the paper measured on; "": nothing is published
    // The settings, over a row's own, of the image that a row's error is reckoned against; "": rows
    // have no error.
    char truth[RG_TITLE_SIZE];
    char quick[RG_TITLE_SIZE]; // what quick mode sets; "": nothing
    // What the user sets over all that; "": nothing. Then no cell does what was printed.
    char changed[RG_SET_SIZE];
    char note[RG_NOTE_SIZE]; // what a reader of the table must know
    bool full;               // else quick
    bool is_of_textures;     // nothing is timed
    int width, height;       // of the image, in pixels
    int check_frames;        // simulated and drawn before images are compared
    int first_row, last_row; // of the table, from 0
    // What a budget of seconds chose (harness/tables/runs/plan.h); 0: there was none.
    double budget_s;
    int size_divisor;     // width and height are those of the table by this; 0: as 1
    double budget_end_ms; // by rg_now_ms, when no row is begun any more; 0: never; in no document
    bool few_samples;     // the fewest
    bool left_out[RG_RESULT_ROWS]; // of first_row and those behind it: not to be measured
    int resumed_rows;              // not measured now but by an earlier run that was interrupted
    int work_count;                // 0: the table does not tell works apart
    struct rg_result_work works[RG_RESULT_WORKS];
    int variant_count;
    char variants[RG_RESULT_VARIANTS][RG_NAME_SIZE];
    int device_count;
    struct rg_device_info devices[RG_MAX_DEVICES];
    json_t *passport; // docs/records.md; owned
    int missing_count;
    // A sentence for each device that a reader may look for in vain.
    char missing[RG_RESULT_MISSING][256];
    // Of first_row and those behind it, a record a cell; owned. NULL: the row was not measured.
    struct rg_record *rows[RG_RESULT_ROWS];
};

// Where a cell stands: indices of a row of the table, and among works, variants and devices.
struct rg_place {
    int row, work, variant, device;
};

// The record of a cell; nothing else indexes the rows. Its row must be there (rg_result_has).
struct rg_record *rg_result_at(const struct rg_result *result, struct rg_place place);

// The cells of the rows that are there, row by row, work by work, variant by variant, device by
// device:   for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);)
struct rg_place rg_result_start(const struct rg_result *result);
bool rg_result_next(const struct rg_result *result, struct rg_place *at);
// The same of one row alone.
struct rg_place rg_result_start_row(int row);
bool rg_result_next_in_row(const struct rg_result *result, struct rg_place *at);

int rg_result_row_cells(const struct rg_result *result); // cells of a row
bool rg_result_has(const struct rg_result *result, int row);
// Whether nothing of a row that is there is left to measure.
bool rg_result_is_whole(const struct rg_result *result, int row);
// Drops the rows of which something is left to measure.
void rg_result_drop_begun(struct rg_result *result);
// Whether a row is to be there: a budget leaves some out, which are not missing.
bool rg_result_wants(const struct rg_result *result, int row);
// The first row that is missing; one behind the last where none is.
int rg_result_first_missing(const struct rg_result *result);

// Zeroed records for a row. False, with one logged line, without memory for them.
bool rg_result_add_row(struct rg_result *result, int row);
void rg_result_drop_row(struct rg_result *result, int row);
// Leaves out the rows before `first` and behind `last`, or the cells of other works, or of other
// variants. A table that does not tell works apart stays as it is. False where nothing is left.
bool rg_result_keep_rows(struct rg_result *result, int first, int last);
bool rg_result_keep_work(struct rg_result *result, const char *work);
bool rg_result_keep_variant(struct rg_result *result, const char *variant);
// Whether the cells of a work do what was printed, and may be held against it.
bool rg_result_is_of_print(const struct rg_result *result, int work);
// The work that was printed, in the first of its readings; -1 where the result has it not.
int rg_result_printed_work(const struct rg_result *result);

// How many samples its measured cells took, at least and at most; 0 where none was measured.
void rg_result_samples(const struct rg_result *result, int *least, int *most);

// By how much the machine's speed went up or down over the run, as a share of the fastest: by what
// its calibration took at the beginnings and ends of what was measured together. 0 where none
// tells.
double rg_result_drift(const struct rg_result *result);

// Frees what it owns.
void rg_result_free(struct rg_result *result);

#endif
