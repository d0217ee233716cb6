// The course of a table's launches on each device. The next step follows from the records alone, so
// that a course goes on from a journal.
#ifndef RG_HARNESS_TABLES_LAUNCHING_LAUNCHES_H
#define RG_HARNESS_TABLES_LAUNCHING_LAUNCHES_H

#include "harness/console/progress.h"
#include "harness/record/disk/journal.h"
#include "harness/tables/claims/claim.h"
#include "harness/tables/launching/launch.h"

// What launches are taken for.
struct rg_launches_wanted {
    // Until each of these claims is decided, or no look is left: rg_claims, or others, likewise
    // ended by one without a table. NULL: for no claim.
    const struct rg_claim *claims;
    int most; // undisturbed launches of a claim's cell; 0: as many as its looks ask for
    // Without claims: so many undisturbed launches of each measured cell. A cell's disturbed
    // launches are taken again at most as often.
    int of_each;
};

// Drops from a begun result the rows and variants that no claim needs. False if the paper claims
// nothing about the table.
bool rg_launches_choose(struct rg_result *result, const struct rg_table *table);

// Takes launches of a measured result, whose records get them; each is kept in the journal (NULL:
// none). No launch begins after `end_ms` by rg_now_ms (0: no limit), nor after
// an interruption. False if a launch failed, which one logged line said; other devices go on.
bool rg_launches_take(struct rg_result *result, const struct rg_table *table,
                      const struct rg_launches_wanted *wanted, struct rg_journal *journal,
                      struct rg_progress *bar, double end_ms);

// Whether launches would go on: a budget ended them, or an interruption.
bool rg_launches_are_due(const struct rg_result *result, const struct rg_launches_wanted *wanted);

// The cells that the device's next launch times: those of one work that want one. Returns its
// number; 0: none is wanted.
int rg_launches_next(const struct rg_result *result, const struct rg_launches_wanted *wanted,
                     int device, struct rg_launch_cells *cells);

#endif
