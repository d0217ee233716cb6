// Tables of a few rows, with results as if measured at chosen frame rates, from which tests make
// sheets and trends.
#ifndef RG_TESTS_HARNESS_RESULTS_FORMS_RIG_H
#define RG_TESTS_HARNESS_RESULTS_FORMS_RIG_H

#include <stdbool.h>

#include "harness/tables/sheet/sheet.h"
#include "harness/tables/sheet/trend.h"
#include "harness/tables/table.h"

// Named rows of a paper; rows of two variants and two works; rows along an axis, with two variants.
extern const struct rg_table sheet_names_table, sheet_styles_table, sheet_axis_table;

// The device of the results: a software device.
extern struct rg_device sheet_device;

// A result on one device, as if measured at these frame rates. They are in the order of the table's
// rows, and within a row of its works and variants; 0: the cell failed.
struct rig {
    struct rg_devices devices;
    struct rg_result result;
};

// Takes `samples` of each cell, close to the frame rate. The caller frees rig->result.
void sheet_measure_few(struct rig *rig, const struct rg_table *table, const double *fps,
                       int samples);
// The same with eleven samples.
void sheet_measure(struct rig *rig, const struct rg_table *table, const double *fps);
// The same on so many of cpu, cpu:reference, gl and vulkan, whose rates follow each other in a
// cell.
void sheet_measure_on(struct rig *rig, const struct rg_table *table, const double *fps,
                      int devices);
// The trend of one variant of a table measured at these frame rates.
struct rg_trend sheet_trend_of(const struct rg_table *table, int variant, const double *fps);

// The record of a row and variant.
struct rg_record *sheet_record_at(const struct rig *rig, int row, int variant);
void sheet_tell(struct rg_record *record, const char *name, double number);
void sheet_add_pass(struct rg_record *record, const char *name, double ms);

// A cell's text; NULL: the sheet has no such column.
const char *sheet_text_at(const struct rg_sheet *sheet, int row, const char *column);
void sheet_expect_text(const struct rg_sheet *sheet, int row, const char *column, const char *text);
bool sheet_has_note(const struct rg_sheet *sheet, const char *text);

#endif
