// Whether a device's numbers fall along a table's rows as the published ones do, or, of a table of
// no paper, how they fall; and how far numbers of rows that have names lie apart.
#ifndef RG_HARNESS_TABLES_SHEET_TREND_H
#define RG_HARNESS_TABLES_SHEET_TREND_H

#include "harness/record/result.h"

enum rg_trend_verdict {
    RG_TREND_REPRODUCED, // same order of the rows, and same slope along the axis
    RG_TREND_ONLY,       // same order, another slope
    RG_TREND_ORDER,      // same order, of rows without an axis
    RG_TREND_NOT,        // another order
    RG_TREND_UNDECIDED,  // the samples do not settle the order
    RG_TREND_GROWTH,     // nothing is published: how the time of a frame grows along the axis
    RG_TREND_UNKNOWN,
    RG_TREND_OTHER_WORK, // what was measured is not the work that was printed
};
const char *rg_trend_text(enum rg_trend_verdict verdict);

struct rg_trend {
    enum rg_trend_verdict verdict;
    const struct rg_named *axis;   // of the first row that takes part; NULL: there is none
    int pairs;                     // of rows whose published numbers differ by more than rounding
    int pairs_in_order;            // so many of them stand in the published order, by their medians
    int pairs_undecided;           // of so many the samples do not settle the order
    bool has_slope;                // the rows have an axis
    double slope, published_slope; // of log(fps) over log(axis); NAN: nothing is published
    double slope_low, slope_high;  // the slope's interval of 95 %; NAN where there is none
    double margin;                 // the published slope is so sure (claims/margin.h)
};

// The trend of the work, variant and device that a place names; its row is not looked at. Rows
// are held against each other where they differ in the axis alone: of two cameras, each is apart.
struct rg_trend rg_trend_of(const struct rg_result *result, struct rg_place of);

// What rows have as their axis: the first of the numbers that tell them apart. NULL where there is
// none.
const struct rg_named *rg_trend_axis(const struct rg_record *record);

// The trends of all works, variants and devices as in docs/records.md (`shapes`); the caller owns
// it.
json_t *rg_trends_json(const struct rg_result *result);

struct rg_spread {
    double least_fps, most_fps; // of all rows and variants
    double share;               // by which the least is below the most
    double of_a_variant;        // the greatest of these shares over the rows of one variant
};

// Of the rows of a work on a device. False where there are fewer than two, rows have no names, or a
// cell has no number.
bool rg_spread_of(const struct rg_result *result, int work, int device, struct rg_spread *measured,
                  struct rg_spread *published);

#endif
