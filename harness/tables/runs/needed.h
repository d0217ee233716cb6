// Which rows and variants of a table its curves and its claims cannot do without.
#ifndef RG_HARNESS_TABLES_RUNS_NEEDED_H
#define RG_HARNESS_TABLES_RUNS_NEEDED_H

#include "harness/tables/papers/published.h"

// The ends of the table as quick mode has it and of each claim, the knee of one that has it, and
// the middle of a curve that would have none of its rows between its ends; of tables of textures,
// which take little, all. Returns how many.
int rg_needed_rows(const struct rg_table *table, bool needed[RG_TABLE_ROWS]);
// These, and all others that quick mode has. Returns how many.
int rg_quick_rows(const struct rg_table *table, bool rows[RG_TABLE_ROWS]);
// The first variant, and those that claims are about. Returns how many.
int rg_needed_variants(const struct rg_table *table, bool needed[RG_TABLE_VARIANTS]);
// Whether claims are about it.
bool rg_has_claims(const struct rg_table *table);
// The most that a table's width and height can be divided by, 4 or 1: pictures stay as they are
// where a claim is about how fast their frames are, where they are small, or of textures.
int rg_most_divisor(const struct rg_table *table);
// Whether errors of pictures are measured at this size: where they are whole, or where a claim is
// about them.
bool rg_wants_truth(const struct rg_table *table, int divisor);

#endif
