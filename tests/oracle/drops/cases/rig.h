// Panes for the cases of the model of raindrops, and the contents of their maps.
#ifndef RG_TESTS_ORACLE_DROPS_CASES_RIG_H
#define RG_TESTS_ORACLE_DROPS_CASES_RIG_H

#include "tests/oracle/drops/state.h"

// A pane without rain, on which drops run straight down and leave no residue.
struct oracle_drops_settings quiet(int columns, int rows);
// A pane whose water never changes: a case's heights are still there after a step.
struct oracle_drops_settings still(int columns, int rows);
void even_affinity(struct oracle_drops *drops);

// The sum of all heights.
double water(const struct oracle_drops *drops);
// The cells of an ID, and the ID under a place.
int owned(const struct oracle_drops *drops, uint32_t id);
uint32_t owner(const struct oracle_drops *drops, double x_mm, double y_mm);

#endif
