// Having drivers compile what tables need before any is measured.
//
// A driver compiles when something is first drawn, keeps what it made for the user (~/.cache), and
// compiles on one core. On a new machine that takes as long as the tables do, and makes cells look
// slower than they are; side by side on all cores it takes less.
#ifndef RG_HARNESS_TABLES_RUNS_COMPILE_H
#define RG_HARNESS_TABLES_RUNS_COMPILE_H

#include "harness/devices/devices.h"
#include "harness/tables/papers/published.h"

// Opens a cell of each technique that has tables among these, on each device that has a driver.
// Each is a process of this program with these arguments, as many at a time as there are cores:
//     table ID --compile --device NAME --timeout S
// which opens its one cell itself. One line tells of each that fails. Returns an enum rg_exit.
int rg_tables_compile(const struct rg_table *const tables[], int count,
                      const struct rg_devices *devices);

#endif
