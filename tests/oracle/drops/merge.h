// Drops whose water touches become one.
#ifndef RG_TESTS_ORACLE_DROPS_MERGE_H
#define RG_TESTS_ORACLE_DROPS_MERGE_H

#include "tests/oracle/drops/state.h"

// Merges in one pass over the ID map.
void oracle_drops_merge(struct oracle_drops *drops);

#endif
