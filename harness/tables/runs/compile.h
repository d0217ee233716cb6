// Makes drivers compile what tables need before anything is measured.
//
// A driver compiles when something is first drawn, on one core, and keeps the result for the user
// (~/.cache). On a new machine this takes as long as the tables do, and makes cells look slower
// than they are. In parallel on all cores it takes less.
#ifndef RG_HARNESS_TABLES_RUNS_COMPILE_H
#define RG_HARNESS_TABLES_RUNS_COMPILE_H

#include "harness/devices/devices.h"
#include "harness/tables/papers/published.h"

// Opens a cell of each technique in these tables on each device that has a driver. A process of
// this program opens each cell, as many at a time as there are cores:
//     raingauge table ID --compile --device NAME --timeout S
// Each failure is logged in one line. Returns an enum rg_exit.
int rg_tables_compile(const struct rg_table *const tables[], int count,
                      const struct rg_devices *devices);

#endif
