// Finds the rows and variants that a table's curves and claims cannot do without.
#ifndef RG_HARNESS_TABLES_RUNS_NEEDED_H
#define RG_HARNESS_TABLES_RUNS_NEEDED_H

#include "harness/tables/papers/published.h"

// Finds the needed rows: the first and last row of quick mode and of each claim, a claim's knee,
// and the middle of a curve without another row between its ends. Tables of textures take little
// time and need all rows. Returns how many.
int rg_needed_rows(const struct rg_table *table, bool needed[RG_TABLE_ROWS]);
// The needed rows, and all others of quick mode. Returns how many.
int rg_quick_rows(const struct rg_table *table, bool rows[RG_TABLE_ROWS]);
// The first variant, and those in claims. Returns how many.
int rg_needed_variants(const struct rg_table *table, bool needed[RG_TABLE_VARIANTS]);
// Whether there are claims about the table.
bool rg_has_claims(const struct rg_table *table);
// The largest divisor of a table's width and height, 4 or 1. Pictures keep their size if they are
// small, if they are textures, or if a claim is about how fast their frames are.
int rg_most_divisor(const struct rg_table *table);
// Whether picture errors are measured at this size: only at full size, unless a claim is about
// them.
bool rg_wants_truth(const struct rg_table *table, int divisor);

#endif
