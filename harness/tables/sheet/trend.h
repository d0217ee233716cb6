// Whether a device's numbers vary along a table's rows as the published ones do, or how they vary
// if nothing is published; and the spread of numbers over rows with names.
#ifndef RG_HARNESS_TABLES_SHEET_TREND_H
#define RG_HARNESS_TABLES_SHEET_TREND_H

#include "harness/record/result.h"

enum rg_trend_verdict {
    RG_TREND_REPRODUCED, // same order of the rows, and same slope along the axis
    RG_TREND_ONLY,       // same order, different slope
    RG_TREND_ORDER,      // same order, for rows without an axis
    RG_TREND_NOT,        // another order
    RG_TREND_UNDECIDED,  // the samples do not decide the order
    RG_TREND_GROWTH,     // nothing is published: the growth of a frame's time along the axis
    RG_TREND_UNKNOWN,
    RG_TREND_OTHER_WORK, // the measured work is not the printed one
};
const char *rg_trend_text(enum rg_trend_verdict verdict);

struct rg_trend {
    enum rg_trend_verdict verdict;
    const struct rg_named *axis;   // of the first row used; NULL: none
    int pairs;                     // of rows whose published numbers differ by more than rounding
    int pairs_in_order;            // pairs in the published order, by their medians
    int pairs_undecided;           // pairs whose order the samples do not decide
    bool has_slope;                // the rows have an axis
    double slope, published_slope; // of log(fps) over log(axis); NAN: nothing is published
    double slope_low, slope_high;  // the slope's 95 % interval; NAN if there is none
    double margin;                 // the error of the published slope (claims/margin.h)
};

// The trend of a place's work, variant and device; its row is ignored. Only rows that differ in
// nothing but the axis are compared: with two cameras, each forms a group.
struct rg_trend rg_trend_of(const struct rg_result *result, struct rg_place of);

// The axis of rows: the first number among their keys. NULL if there is none.
const struct rg_named *rg_trend_axis(const struct rg_record *record);

// The trends of all works, variants and devices as in docs/records.md (`shapes`); the caller owns
// the JSON.
json_t *rg_trends_json(const struct rg_result *result);

struct rg_spread {
    double least_fps, most_fps; // over all rows and variants
    double share;               // relative difference between most and least
    double of_a_variant;        // the greatest such difference within one variant
};

// The spread over the rows of a work on a device. False if there are fewer than two, if rows have
// no names, or if a cell has no number.
bool rg_spread_of(const struct rg_result *result, int work, int device, struct rg_spread *measured,
                  struct rg_spread *published);

#endif
