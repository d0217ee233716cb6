// Counts cells for the last line of a command that measures tables.
#ifndef RG_HARNESS_TABLES_RUNS_CLOSING_H
#define RG_HARNESS_TABLES_RUNS_CLOSING_H

#include "harness/record/result.h"

struct rg_closing {
    int cells, failed, unsupported; // all cells; among them, those without a number
};

// Counts the cells of a result.
void rg_closing_add(struct rg_closing *closing, const struct rg_result *result);

// The number of cells with a number.
int rg_closing_measured(const struct rg_closing *closing);

// Logs in one line how many cells were measured on so many devices.
void rg_closing_tell(const struct rg_closing *closing, int devices);

#endif
