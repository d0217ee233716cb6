// Digests: equal things have equal ones.
#ifndef RG_HARNESS_COMPARE_GATE_CELLS_DIGEST_H
#define RG_HARNESS_COMPARE_GATE_CELLS_DIGEST_H

#include "harness/compare/gate/cells/cells.h"

enum { RG_DIGEST_SIZE = 17 };

// XXH3 in 16 hexadecimal digits.
void rg_digest_of(const void *bytes, size_t size, char digest[RG_DIGEST_SIZE]);
// Of all that a cell is: technique, size, frames and every parameter, those by default too.
void rg_digest_of_cell(const struct rg_gate_cell *cell, char digest[RG_DIGEST_SIZE]);

#endif
