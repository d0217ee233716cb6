// Prints verdicts on claims.
#ifndef RG_HARNESS_COMMANDS_TABLES_VERDICTS_H
#define RG_HARNESS_COMMANDS_TABLES_VERDICTS_H

#include "harness/commands/cli/option.h"
#include "harness/tables/claims/outcomes.h"

// Whether the results of the tables `ids` (none: all) that were read from a path can be judged
// together: each table was measured once on a machine, and with one length on all. False, with one
// logged line, if not. Adds their machines to the outcomes.
bool rg_verdicts_can_be_of(struct rg_claim_outcomes *outcomes, const struct rg_stored *stored,
                           const struct rg_words *ids, const char *path);

// Prints them in a form of harness/tables/print.h; nothing, if there are none. Returns an enum
// rg_exit.
int rg_verdicts_print(const struct rg_claim_outcomes *outcomes, int form);

#endif
