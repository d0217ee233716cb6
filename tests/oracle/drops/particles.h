// Drops: their birth, their movement, their end.
#ifndef RG_TESTS_ORACLE_DROPS_PARTICLES_H
#define RG_TESTS_ORACLE_DROPS_PARTICLES_H

#include "tests/oracle/drops/state.h"

// Whether a drop of this mass overcomes the force that holds it.
bool oracle_drops_runs(const struct oracle_drops *drops, double mass_mg);
// Inserts a copy of a drop with its own ID, which it returns.
uint32_t oracle_drops_insert(struct oracle_drops *drops, struct oracle_drop drop);
// Ends a drop's ID; the drop is removed later.
void oracle_drops_end(struct oracle_drops *drops, struct oracle_drop *drop);
// The drop of an ID; NULL: it has ended. The pointer is valid until a drop is inserted.
struct oracle_drop *oracle_drops_find(const struct oracle_drops *drops, uint32_t id);

void oracle_drops_generate(struct oracle_drops *drops);
// Moves every drop that runs by one step, one after the other.
void oracle_drops_move(struct oracle_drops *drops);
void oracle_drops_clear_away(struct oracle_drops *drops);
void oracle_drops_place_static(struct oracle_drops *drops);

#endif
