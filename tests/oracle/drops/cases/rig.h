// Panes for the cases of the model of raindrops, and what their maps hold.
#ifndef RG_TESTS_ORACLE_DROPS_CASES_RIG_H
#define RG_TESTS_ORACLE_DROPS_CASES_RIG_H

#include "tests/oracle/drops/state.h"

// A pane without rain, on which drops run straight down and leave no residue.
struct oracle_drops_settings quiet(int columns, int rows);
// One whose water nothing changes: what a case has written is there after a step.
struct oracle_drops_settings still(int columns, int rows);
void even_affinity(struct oracle_drops *drops);

// The sum of all heights.
double water(const struct oracle_drops *drops);
// The cells of an ID, and the ID under a place.
int owned(const struct oracle_drops *drops, uint32_t id);
uint32_t owner(const struct oracle_drops *drops, double x_mm, double y_mm);

#endif
