// Reports what a budget left out of tables.
#ifndef RG_HARNESS_TABLES_RUNS_LEFT_H
#define RG_HARNESS_TABLES_RUNS_LEFT_H

#include <stdio.h>

#include "harness/devices/devices.h"
#include "harness/record/result.h"
#include "harness/tables/runs/order.h"

// Why the first omitted part of a table was left out; "": no time was left.
struct rg_left_why {
    char text[160];
};

// Notes why a step is left out, unless an earlier one of the table was: its expected time and the
// time left. A negative time left means that it began and did not end in time.
void rg_left_why(struct rg_left_why *why, const struct rg_devices *devices,
                 const struct rg_step *step, double expected_s, double left_s);

// Prints a line for each table that is incomplete; one if all are complete.
void rg_left_tell(const struct rg_standing *standings, const struct rg_result *results,
                  const struct rg_left_why *whys, int count, const struct rg_devices *devices,
                  FILE *out);

#endif
