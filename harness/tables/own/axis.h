// An axis of a sweep: a parameter and its values.
#ifndef RG_HARNESS_TABLES_OWN_AXIS_H
#define RG_HARNESS_TABLES_OWN_AXIS_H

#include <stdbool.h>

#include "harness/tables/papers/published.h"

enum { RG_AXIS_NAME = 48, RG_AXIS_VALUE = 96 };

struct rg_axis {
    const char *word;        // what messages call an axis: "--axis"
    char name[RG_AXIS_NAME]; // "culling_radius_m", or "device"
    int count;
    char values[RG_TABLE_ROWS][RG_AXIS_VALUE]; // as arguments of --set
};

// Reads "NAME=VALUE,VALUE,..."; "5,10..40" continues from the second number to the last, in steps
// of the second less the first. False, and one logged line, if the text is not valid.
bool rg_axis_read(const char *word, const char *text, struct rg_axis *axis);

#endif
