// What a table will take, before it is measured.
#ifndef RG_HARNESS_TABLES_SWEEP_PLAN_H
#define RG_HARNESS_TABLES_SWEEP_PLAN_H

#include <stdio.h>

#include "harness/devices/kept.h"
#include "harness/tables/table.h"

struct rg_plan {
    int rows, devices, failed;       // of the devices, those that could not be looked at
    double device_s[RG_MAX_DEVICES]; // that its cells take; NAN: it failed
    double check_s;                  // that cpu:reference takes for the images that they must show
    double row_bytes;                // of this process's memory, what the largest row takes
    double all_bytes;                // what all rows take together
};

// Opens the first and the last row on each device until frames are like those that are timed
// (rg_cell_look), and reckons what lies between from them: times and memory as they go from row to
// row by the same factor. One logged line for a device on which one cannot be opened; false where
// the input is at fault, where no device is left, or where cpu:reference, which checks the images,
// fails.
bool rg_plan_make(const struct rg_table *table, const char *set, bool is_full, struct rg_kept *kept,
                  struct rg_plan *plan);

// "8 rows on cpu, gl: 16 cells, about 40 s (cpu 14 s, gl 20 s, images to check by 6 s), ...", one
// line.
void rg_plan_print(const struct rg_plan *plan, const struct rg_devices *devices, FILE *out);

#endif
