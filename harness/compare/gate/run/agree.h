// Whether both sides of a gate do the same work: only what agrees is timed.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_AGREE_H
#define RG_HARNESS_COMPARE_GATE_RUN_AGREE_H

#include "harness/compare/gate/cells/cells.h"
#include "harness/compare/gate/run/sides.h"
#include "harness/frames/session.h"

enum { RG_AGREEMENT_TEXT = 640 };

struct rg_agreement {
    enum rg_outcome outcome; // OK: they agree; fail: they do not; else what kept it from being seen
    const char *device;      // the side that it is about, where one alone failed; NULL: both
    char message[RG_AGREEMENT_TEXT]; // why, one line; "" where they agree
    char details[RG_AGREEMENT_TEXT]; // the first stage that left other bits; ""
    bool has_code;
    struct rg_session_code code[RG_SIDES];
    double pixels,
        difference; // that differ, and the most a channel of them does; NAN: not compared
};

// Runs a cell on both sides, which are open, and compares its picture, by the tier that the two owe
// each other, its states to the bit where that is T0, and its counters and the work of a frame
// exactly.
void rg_gate_agree(const struct rg_gate_cell *cell, struct rg_side sides[RG_SIDES],
                   struct rg_agreement *agreement);

#endif
