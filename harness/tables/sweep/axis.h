// An axis of a sweep: a parameter, and the values that it takes.
#ifndef RG_HARNESS_TABLES_SWEEP_AXIS_H
#define RG_HARNESS_TABLES_SWEEP_AXIS_H

#include <stdbool.h>

#include "harness/tables/papers/published.h"

enum { RG_AXIS_NAME = 48, RG_AXIS_VALUE = 96 };

struct rg_axis {
    char name[RG_AXIS_NAME]; // "culling_radius_m", or "device"
    int count;
    char values[RG_TABLE_ROWS][RG_AXIS_VALUE]; // as --set takes each
};

// Takes "NAME=VALUE,VALUE,..."; "5,10..40" goes on from the first number in steps of the second
// less the first, to the last. False, and one logged line, where it is no such thing.
bool rg_axis_read(const char *text, struct rg_axis *axis);

#endif
