// Prints verdicts on claims.
#ifndef RG_HARNESS_COMMANDS_TABLES_VERDICTS_H
#define RG_HARNESS_COMMANDS_TABLES_VERDICTS_H

#include "harness/tables/claims/text.h"

// Prints them in a form of harness/tables/print.h; nothing, if there are none. Returns an enum
// rg_exit.
int rg_verdicts_print(const struct rg_claim_outcomes *outcomes, int form);

#endif
