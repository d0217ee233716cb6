// What a budget left out of tables, in lines for a user.
#ifndef RG_HARNESS_TABLES_RUNS_LEFT_H
#define RG_HARNESS_TABLES_RUNS_LEFT_H

#include <stdio.h>

#include "harness/devices/devices.h"
#include "harness/record/result.h"
#include "harness/tables/runs/order.h"

// Why the first of what is left out of a table was; "": there was no time left.
struct rg_left_why {
    char text[160];
};

// Notes why a step is left out, unless another of the table was before: it is expected to take so
// long, and so much is left (negative: it was begun, and did not end in time).
void rg_left_why(struct rg_left_why *why, const struct rg_devices *devices,
                 const struct rg_step *step, double expected_s, double left_s);

// Prints a line for each table that is not whole, or that there is none.
void rg_left_tell(const struct rg_standing *standings, const struct rg_result *results,
                  const struct rg_left_why *whys, int count, const struct rg_devices *devices,
                  FILE *out);

#endif
