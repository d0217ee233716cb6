// What cells are expected to take, by opening some of them for a moment.
#ifndef RG_HARNESS_TABLES_RUNS_PROBE_H
#define RG_HARNESS_TABLES_RUNS_PROBE_H

#include "harness/tables/measuring/measure.h"
#include "harness/tables/runs/look.h"

// Opens the first and the last needed row of a table on cpu, and on devices of which nothing is
// known the last, for two frames of the smallest picture, and the last at the next size as well;
// what lies between, and beyond, follows from them. Where more frames are simulated before those
// that are timed, rows are opened on cpu once more for these. What opens late is opened twice, for
// drivers compile once. Of a table of textures it opens the first row on each device. `full`: it is
// measured in full mode, and opened at its whole size alone. What fails is expected to take
// nothing, for its cells end at once. False, and one logged line, where cpu, cpu:reference or the
// truth does: then that is all cells of the table.
bool rg_budget_probe(const struct rg_table *table, struct rg_kept *kept, bool full,
                     struct rg_budget_kind *kind, struct rg_budget_table *costs);

// Opens rows of a part of a table likewise, all of them on cpu and the last in each of its works on
// each device, at their whole size, and fills in what cells of each take on average over works and
// devices.
bool rg_budget_probe_rows(const struct rg_table *table, struct rg_kept *kept,
                          const struct rg_table_part *part, const bool rows[RG_TABLE_ROWS],
                          struct rg_budget_kind *kind, struct rg_cell_time times[RG_TABLE_ROWS]);

// Expects of a table what another of its technique takes, where there is no time to look at it.
void rg_budget_alike(const struct rg_table *table, const struct rg_budget_table *other,
                     struct rg_budget_table *costs);

#endif
