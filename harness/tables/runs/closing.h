// How a command that measures tables ended: its cells, counted.
#ifndef RG_HARNESS_TABLES_RUNS_CLOSING_H
#define RG_HARNESS_TABLES_RUNS_CLOSING_H

#include "harness/record/result.h"

struct rg_closing {
    int cells, failed, unsupported; // all that there are; of these, those without a number
};

// Adds the cells of a result that are there.
void rg_closing_add(struct rg_closing *closing, const struct rg_result *result);

// Of them, those with a number.
int rg_closing_measured(const struct rg_closing *closing);

// Says in one line on stderr how many were measured on so many devices.
void rg_closing_tell(const struct rg_closing *closing, int devices);

#endif
