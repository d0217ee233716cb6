// The course of a table's claims: launches of each device until every claim is decided, or no look
// is left. `claims` are rg_claims, or others, likewise ended by one without a table. The next step
// follows from the records alone, so that a course goes on from a journal.
#ifndef RG_HARNESS_TABLES_LAUNCHING_LAUNCHES_H
#define RG_HARNESS_TABLES_LAUNCHING_LAUNCHES_H

#include "harness/console/progress.h"
#include "harness/record/disk/journal.h"
#include "harness/tables/claims/claim.h"
#include "harness/tables/launching/launch.h"

// Drops from a begun result the rows and variants that no claim needs. False if the paper claims
// nothing about the table.
bool rg_launches_choose(struct rg_result *result, const struct rg_table *table);

// Takes launches for the claims about a measured result, whose records get them; each is kept in
// the journal (NULL: none). No launch begins after `end_ms` by rg_now_ms (0: no limit), nor after
// an interruption. False if a launch failed, which one logged line said; other devices go on.
bool rg_launches_take(struct rg_result *result, const struct rg_table *table,
                      const struct rg_claim *claims, struct rg_journal *journal,
                      struct rg_progress *bar, double end_ms);

// Whether launches would go on: a budget ended them, or an interruption.
bool rg_launches_are_due(const struct rg_result *result, const struct rg_claim *claims);

// The cells that the device's next launch times, because a claim about them is not decided yet.
// Returns its number; 0: none is needed.
int rg_launches_next(const struct rg_result *result, const struct rg_claim *claims, int device,
                     struct rg_launch_cells *cells);

#endif
