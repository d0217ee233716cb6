// Estimates the time and memory that a table takes, before it is measured.
#ifndef RG_HARNESS_TABLES_OWN_ESTIMATE_H
#define RG_HARNESS_TABLES_OWN_ESTIMATE_H

#include <stdio.h>

#include "harness/devices/kept.h"
#include "harness/tables/table.h"

struct rg_plan {
    int rows, devices, failed;       // failed: how many of the devices could not be opened
    double device_s[RG_MAX_DEVICES]; // for its cells; NAN: it failed
    double check_s;                  // for the expected images, drawn by cpu:reference
    double row_bytes;                // of this process's memory, for the largest row
    double all_bytes;                // for all rows together
};

// Opens the first and the last row on each device until frames resemble the timed ones
// (rg_cell_look), and interpolates times and memory of the other rows. Logs a line for a device
// that cannot open a row. False if the input is at fault, if no device is left, or if
// cpu:reference, which checks the images, fails.
bool rg_plan_make(const struct rg_table *table, const char *set, bool is_full, struct rg_kept *kept,
                  struct rg_plan *plan);

// Prints one line: "8 rows on cpu, gl: 16 cells, about 40 s (cpu 14 s, gl 20 s, images to check by
// 6 s), ...".
void rg_plan_print(const struct rg_plan *plan, const struct rg_devices *devices, FILE *out);

#endif
